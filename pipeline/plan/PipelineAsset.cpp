// Loads a pipeline document, step by step.
#include "plan/PipelineAsset.h"

#include <algorithm>
#include <set>

#include "plan/PipelineAssetFiles.h"
#include "plan/PipelineAssetReader.h"
#include "plan/PipelineEdits.h"
#include "plan/PipelineEditsTree.h"
#include "plan/PipelineOptions.h"

namespace crevice {
namespace {

using Chain = std::vector<PipelineSource>;

/// The document's options; nothing where it has none, or is no object yet.
const Value* optionsOf(const Value& document) {
    const Value* options = document.isObject() ? document.find("options") : nullptr;
    return options && options->isObject() ? options : nullptr;
}

/// Names of the options that `flowFile` declares and `older` does not.
void addNewOptions(const Value& flowFile, const Value& older, std::set<std::string>& names) {
    const Value* brought = optionsOf(flowFile);
    const Value* known = optionsOf(older);
    if (!brought) return;
    for (const Member& option : brought->members())
        if (!known || !known->find(option.key)) names.insert(option.key);
}

/// Sets apply in the order of the options. What a flow file brings is a preset of its stages: the documents, which know
/// the whole pipeline, have the last word, those that are older than the one that names the flow, too.
void putFirst(Value& document, const std::set<std::string>& flowOptions) {
    Value* options = document.find("options");
    if (!options || !options->isObject()) return;
    std::stable_partition(options->members().begin(), options->members().end(),
                          [&](const Member& option) { return flowOptions.contains(option.key); });
}

/// Parent first: what the chain of documents says together, edits applied. Options are still open.
PipelineTree mergeChain(const Chain& chain, const PriorityLookup& defaultPriority, Problems& problems) {
    PipelineTree tree;
    std::set<std::string> flowOptions;
    for (const PipelineSource& source : chain) {
        tree.reach.addDocument(source.file, source.isFlowFile);
        if (source.isFlowFile) addNewOptions(source.tree, tree.document, flowOptions);
        mergeDocument(tree, source.tree, problems);
        applyEdits(tree, source.tree, defaultPriority, problems);
    }
    tree.document.setWhere(chain.back().tree.where());
    putFirst(tree.document, flowOptions);
    checkChoiceSets(tree, problems);
    return tree;
}

/// Takes out every `reach` that does not hold for what its stage became.
void dropStaleReach(PipelineTree& tree, const AssetRoots& roots) {
    for (Value& flow : treeFlows(tree.document)) {
        for (Value& stage : flowStages(flow)) {
            const Value* reach = stage.find("reach");
            const Value* effect = stage.find("effect");
            const bool isOther = reach && effect && effect->isString() &&
                                 tree.reach.isForAnotherEffect(roots, effect->string(), reach->where());
            if (reach && (isOther || tree.reach.isStale(stageName(stage), reach->where()))) stage.erase("reach");
        }
    }
}

PipelineDesc loadChain(const Chain& chain, const AssetRoots& roots, const PipelineRequest& request,
                       Problems& problems) {
    PipelineTree tree = mergeChain(chain, request.defaultPriority, problems);
    std::vector<OptionDesc> options = readOptions(tree.document, request.options, problems);
    applyChoiceSets(tree, options);
    applySets(tree, request.sets, problems);
    dropStaleReach(tree, roots);
    substituteOptions(tree.document, options, problems);
    PipelineDesc desc = readPipelineTree(tree.document, std::move(options), chain.back().file, problems);
    for (const PipelineSource& source : chain) desc.files.push_back(source.file);
    problems.throwIfErrors();
    return desc;
}

/// The keys of a document in the order of a reader's interest.
Value inReadingOrder(const Value& document) {
    Value ordered = Value::makeObject(document.where());
    for (const char* key : {"name", "help", "output", "profile", "fallbacks", "macros", "guard", "plugins", "options",
                            "targets", "blocks", "flows"})
        for (const Member& member : document.members())
            if (member.key == key) ordered.set(key, member.value, member.keyLoc);
    return ordered;
}

Value flattenChain(const Chain& chain, const AssetRoots& roots, const PipelineRequest& request, FlattenOptions mode,
                   Problems& problems) {
    (void)loadChain(chain, roots, request, problems);  // Only a document without mistakes is flattened.
    PipelineTree tree = mergeChain(chain, request.defaultPriority, problems);
    std::vector<OptionDesc> options = readOptions(tree.document, request.options, problems);
    if (mode == FlattenOptions::Resolve) applyChoiceSets(tree, options);
    applySets(tree, request.sets, problems);
    if (mode == FlattenOptions::Resolve) {
        substituteOptions(tree.document, options, problems);
        tree.document.erase("options");
    } else if (!options.empty()) {
        std::vector<std::string> paths;
        for (const StageSet& set : request.sets) paths.push_back(set.path);
        keepOptions(tree, options, paths);
    }
    dropStaleReach(tree, roots);
    return inReadingOrder(tree.document);
}

}  // namespace

PipelineDesc loadPipeline(const AssetRoots& roots, const PipelineRequest& request) {
    Problems problems;
    return loadChain(readPipelineChain(roots, request, problems), roots.forDocument(request.nameOrPath), request,
                     problems);
}

PipelineDesc parsePipeline(std::string_view text, const std::string& file, const AssetRoots& roots,
                           const PipelineRequest& request) {
    Problems problems;
    return loadChain(parsePipelineChain(roots, text, file, request.options, problems), roots.forDocument(file), request,
                     problems);
}

Value flattenPipeline(const AssetRoots& roots, const PipelineRequest& request, FlattenOptions options) {
    Problems problems;
    return flattenChain(readPipelineChain(roots, request, problems), roots.forDocument(request.nameOrPath), request,
                        options, problems);
}

Value flattenParsed(std::string_view text, const std::string& file, const AssetRoots& roots,
                    const PipelineRequest& request, FlattenOptions options) {
    Problems problems;
    return flattenChain(parsePipelineChain(roots, text, file, request.options, problems), roots.forDocument(file),
                        request, options, problems);
}

}  // namespace crevice
