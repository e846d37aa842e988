// JSON Schema for editors and tables for the docs, from the same key tables that reading uses.
#pragma once

#include <string>
#include <vector>

#include "core/Document.h"

namespace crevice {

/// A registered stage class as the schema shows it.
struct StageSchema {
    std::string name;
    std::string help;
    Value paramsSchema;  ///< ParamTable::schema() of its parameters.
};

/// JSON Schema (draft 2020-12) of a pipeline document. `$defs/flowFile` is that of a flow file.
Value pipelineSchema(const std::vector<StageSchema>& stages);

/// All key tables as Markdown: a heading and a table for each kind of object.
std::string pipelineKeysMarkdown();

}  // namespace crevice
