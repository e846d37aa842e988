// Pipeline documents: JSON files → PipelineDesc, and the merged text of a document with the origin of each line.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/Document.h"
#include "core/Files.h"
#include "plan/PipelineDesc.h"

namespace crevice {

/// One `--set PATH=VALUE`.
struct StageSet {
    std::string path;   ///< "SsaoStage.params.seed" (or "SsaoStage.seed"), "LightingStage.material.blurRadius",
                        ///< "cc_ssaoMap.scale"
    std::string value;  ///< JSON scalar or array text; bare words are strings.
};

/// Default priority of a stage class, as the registry knows it; nothing for unknown and data-only classes.
using PriorityLookup = std::function<std::optional<int>(const std::string& stageClass)>;

/// Which document, and what the caller changes in it. Precedence: document < option < set.
struct PipelineRequest {
    std::string nameOrPath;                      ///< A name below the asset roots, or a path that ends in ".json".
    std::map<std::string, std::string> options;  ///< Option → value as text: "false", "0.5", "article".
    std::vector<StageSet> sets;                  ///< In order.
    std::optional<std::string> text = {};        ///< The document itself; `nameOrPath` then names it in messages.
    PriorityLookup defaultPriority = {};         ///< Places an `insert` that has neither before/after nor a priority.
};

/// Reads a document with everything it names. Throws Error with up to 20 problems.
PipelineDesc loadPipeline(const AssetRoots& roots, const PipelineRequest& request);

/// The same from memory; `file` names the text in messages, and its folder is where relative `extends` paths start.
PipelineDesc parsePipeline(std::string_view text, const std::string& file, const AssetRoots& roots,
                           const PipelineRequest& request = {});

/// What `flatten` does with options: keeps them (requested values become defaults) or resolves every `$name`.
enum class FlattenOptions { Keep, Resolve };

/// The merged document: `extends`, flow files, edits and sets applied. Every value keeps the place it was written at.
Value flattenPipeline(const AssetRoots& roots, const PipelineRequest& request,
                      FlattenOptions options = FlattenOptions::Keep);
Value flattenParsed(std::string_view text, const std::string& file, const AssetRoots& roots,
                    const PipelineRequest& request = {}, FlattenOptions options = FlattenOptions::Keep);

/// JSON text of a document in which every line with a value ends in `// file:line`. The text is valid input again.
std::string flattenText(const Value& document);

/// Checks list order against priorities, explicit ones and those of the classes: within each flow they may not
/// decrease. Adds an error per violation that names both stages.
void checkPriorities(const PipelineDesc& desc, const PriorityLookup& defaultPriority, Problems& problems);

}  // namespace crevice
