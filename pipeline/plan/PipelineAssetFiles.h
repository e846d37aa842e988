// Finds and reads the files of a pipeline document: the chain of `extends` and the flow files it names.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"
#include "plan/PipelineAsset.h"

namespace crevice {

/// One document of the chain. Its `flows` hold only objects with a name and well-formed stages; flow files are in
/// place.
struct PipelineSource {
    Value tree;
    std::string file;         ///< As messages name it.
    bool isFlowFile = false;  ///< Brought along by a flow of the next document.
};

/// What the caller asks of options; here it only decides between flow files (`"flow": "ao/$ao"`).
using OptionTexts = std::map<std::string, std::string>;

/// The document of that name or path and its ancestors, oldest first. Throws Error when a file is missing or no JSON,
/// or when `extends` is wrong; mistakes inside the documents go to `problems`.
std::vector<PipelineSource> readPipelineChain(const AssetRoots& roots, const std::string& nameOrPath,
                                              const OptionTexts& requested, Problems& problems);
/// The document of a request: from its text where it has one.
std::vector<PipelineSource> readPipelineChain(const AssetRoots& roots, const PipelineRequest& request,
                                              Problems& problems);
/// The same, the youngest document from memory.
std::vector<PipelineSource> parsePipelineChain(const AssetRoots& roots, std::string_view text, const std::string& file,
                                               const OptionTexts& requested, Problems& problems);

}  // namespace crevice
