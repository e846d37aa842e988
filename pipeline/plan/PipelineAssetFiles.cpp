// Follows `extends` and puts flow files in place of their names.
#include "plan/PipelineAssetFiles.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/PipelineAssetKeys.h"

namespace crevice {
namespace fs = std::filesystem;
namespace {

/// Paths below the working folder are shown as the user would type them.
std::string shownPath(const fs::path& path) {
    std::error_code failed;
    const fs::path absolute = fs::weakly_canonical(path, failed);
    const fs::path here = fs::current_path(failed);
    if (failed) return path.string();
    const fs::path relative = absolute.lexically_relative(here);
    return relative.empty() || *relative.begin() == ".." ? absolute.string() : relative.string();
}

class ChainReader {
public:
    ChainReader(AssetRoots roots, Problems& problems) : roots_(std::move(roots)), problems_(problems) {}

    /// The folder of the document the user named: what lies in its tree may be read.
    void allowFolder(const fs::path& folder) { roots_.prepend(folder.empty() ? fs::path(".") : folder); }
    std::vector<PipelineSource> read(Value document, const std::string& file);

private:
    fs::path findParent(const Value& extends, const fs::path& folder) const;
    void placeFlows(Value& document, const fs::path& folder, std::vector<PipelineSource>& brought);
    void placeFlow(Value& flow, const fs::path& folder, std::vector<PipelineSource>& brought);
    std::optional<fs::path> findFlow(const std::string& name, const fs::path& folder) const;
    void keepGoodStages(Value& flow);

    AssetRoots roots_;
    Problems& problems_;
};

std::vector<PipelineSource> ChainReader::read(Value document, const std::string& file) {
    std::vector<PipelineSource> chain;  // Youngest first.
    std::vector<std::string> seen;
    std::string current = file;
    while (true) {
        const fs::path folder = fs::path(current).parent_path();
        const ObjectReader reader(document, pipelineKeys(), "the pipeline", problems_);
        if (!reader.isObject()) problems_.throwIfErrors();
        const Value extends = reader.get("extends") ? *reader.get("extends") : Value();
        std::vector<PipelineSource> brought;
        placeFlows(document, folder, brought);
        chain.push_back({std::move(document), current});
        std::move(brought.rbegin(), brought.rend(), std::back_inserter(chain));
        seen.push_back(shownPath(current));
        if (extends.isNull()) break;
        const fs::path parent = findParent(extends, folder);
        current = shownPath(parent);
        const bool circular = std::find(seen.begin(), seen.end(), current) != seen.end();
        seen.push_back(current);
        if (circular)
            throw Error(extends.where(), fmt::format("pipelines extend each other in a circle: {}", join(seen, " → ")),
                        "remove one 'extends', or name another parent");
        document = parseJson(readText(parent), current);
        seen.pop_back();
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
}

fs::path ChainReader::findParent(const Value& extends, const fs::path& folder) const {
    const std::string& name = extends.string();
    if (!name.ends_with(".json")) {
        if (const auto found = roots_.find(AssetKind::Pipeline, name)) return *found;
        const fs::path beside = folder / (name + ".pipeline.json");
        if (isPlainName(name) && fs::exists(beside)) return beside;
        throw Error(extends.where(), fmt::format("no pipeline named '{}' to extend", name),
                    didYouMean(name, roots_.list(AssetKind::Pipeline), "pipelines"));
    }
    const fs::path path = folder / name;
    if (!fs::is_regular_file(path))
        throw Error(extends.where(), fmt::format("no file '{}' to extend", path.string()),
                    "a path is relative to the document that names it");
    if (!roots_.contains(path))
        throw Error(extends.where(),
                    fmt::format("'{}' is outside of the asset roots and the document's own folder", name),
                    "move the parent into the folder of the document, or add its root with --root");
    return path;
}

std::optional<fs::path> ChainReader::findFlow(const std::string& name, const fs::path& folder) const {
    if (const auto found = roots_.find(AssetKind::Flow, name)) return found;
    for (const fs::path& candidate : {folder / "flows" / (name + ".flow.json"), folder / (name + ".flow.json")})
        if (fs::is_regular_file(candidate) && roots_.contains(candidate)) return candidate;
    return std::nullopt;
}

/// Removes elements that no later step could name, after reporting them.
void ChainReader::keepGoodStages(Value& flow) {
    const std::string& flowName = flow.find("flow")->string();
    std::vector<Value> good;
    std::size_t number = 0;
    for (Value& stage : flow.find("stages")->items()) {
        const std::string what = fmt::format("stage {} of flow '{}'", ++number, flowName);
        if (!checkStageShape(stage, what, problems_)) continue;
        good.push_back(std::move(stage));
    }
    flow.find("stages")->items() = std::move(good);
}

/// Puts the stages of a flow file into `flow`. What else it brings along becomes a document of its own, older than this
/// one.
void ChainReader::placeFlow(Value& flow, const fs::path& folder, std::vector<PipelineSource>& brought) {
    const Value& nameValue = *flow.find("flow");
    const std::string name = nameValue.string();
    const auto path = findFlow(name, folder);
    if (!path) {
        problems_.error(
            nameValue.where(), fmt::format("no flow file named '{}'", name),
            didYouMean(name, roots_.list(AssetKind::Flow), "flow files") + "; or write the flow's \"stages\" here");
        return;
    }
    Value file;
    try {
        file = parseJson(readText(*path), shownPath(*path));
    } catch (const Error& error) {
        problems_.add(error);
        return;
    }
    const ObjectReader reader(file, flowFileKeys(), fmt::format("flow file '{}'", name), problems_);
    Value sections = Value::makeObject(file.where());
    for (const char* section : {"targets", "blocks", "options"})
        if (const Value* value = reader.get(section)) sections.set(section, *value, value->where());
    brought.push_back({std::move(sections), shownPath(*path)});
    for (const char* key : {"priority", "help"})
        if (const Value* value = reader.get(key); value && !flow.find(key)) flow.set(key, *value, value->where());
    if (const Value* stages = reader.get("stages")) flow.set("stages", *stages, stages->where());
}

/// Leaves only flows with a name and a list of stages.
void ChainReader::placeFlows(Value& document, const fs::path& folder, std::vector<PipelineSource>& brought) {
    Value* flows = document.find("flows");
    if (!flows || !flows->isArray()) return;
    std::vector<Value> all = std::move(flows->items());
    std::vector<Value> good;
    std::size_t number = 0;
    for (Value& flow : all) {
        if (!checkFlowShape(flow, fmt::format("flow {}", ++number), problems_)) continue;
        if (!flow.find("stages")) placeFlow(flow, folder, brought);
        if (!flow.find("stages")) continue;
        const bool wasEmpty = flow.find("stages")->items().empty();
        keepGoodStages(flow);
        if (flow.find("stages")->items().empty() && !wasEmpty) continue;
        good.push_back(std::move(flow));
    }
    document.find("flows")->items() = std::move(good);
}

}  // namespace

std::vector<PipelineSource> readPipelineChain(const AssetRoots& roots, const std::string& nameOrPath,
                                              Problems& problems) {
    ChainReader reader(roots, problems);
    fs::path path = nameOrPath;
    if (nameOrPath.ends_with(".json")) {
        reader.allowFolder(path.parent_path());
        if (!fs::is_regular_file(path))
            throw Error(fmt::format("no pipeline file '{}'", nameOrPath),
                        "give the path of a .pipeline.json file, or a name");
    } else {
        const auto found = roots.find(AssetKind::Pipeline, nameOrPath);
        if (!found)
            throw Error(fmt::format("no pipeline named '{}'", nameOrPath),
                        didYouMean(nameOrPath, roots.list(AssetKind::Pipeline), "pipelines") +
                            "; a path has to end in '.json'");
        path = *found;
    }
    const std::string file = shownPath(path);
    return reader.read(parseJson(readText(path), file), file);
}

std::vector<PipelineSource> parsePipelineChain(const AssetRoots& roots, std::string_view text, const std::string& file,
                                               Problems& problems) {
    ChainReader reader(roots, problems);
    const fs::path folder = fs::path(file).parent_path();
    if (!folder.empty()) reader.allowFolder(folder);
    return reader.read(parseJson(text, file), file);
}

}  // namespace crevice
