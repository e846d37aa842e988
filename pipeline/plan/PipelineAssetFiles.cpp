// Follows `extends` and puts flow files in place of their names.
#include "plan/PipelineAssetFiles.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"

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
    ChainReader(AssetRoots roots, const OptionTexts& requested, Problems& problems)
        : roots_(std::move(roots)), requested_(requested), problems_(problems) {}

    /// The folder of the document the user named: what lies in its tree may be read.
    void allowFolder(const fs::path& folder) { roots_.prepend(folder.empty() ? fs::path(".") : folder); }
    std::vector<PipelineSource> read(Value document, const std::string& file);

private:
    std::vector<PipelineSource> readAncestors(Value document, const std::string& file);
    fs::path findParent(const Value& extends, const fs::path& folder) const;
    const Value* declaration(const std::string& option, const char* key) const;
    std::vector<std::string> declaredOptions() const;
    std::optional<std::string> optionText(const std::string& option) const;
    bool resolveName(Value& name);
    void reportLostFlow(const Value& name, const std::string& written) const;
    void placeFlows(Value& document, const fs::path& folder, std::vector<PipelineSource>& brought);
    void placeFlow(Value& flow, const fs::path& folder, std::vector<PipelineSource>& brought);
    std::optional<fs::path> findFlow(const std::string& name, const fs::path& folder) const;
    void keepGoodStages(Value& flow);

    AssetRoots roots_;
    const OptionTexts& requested_;
    Problems& problems_;
    fs::path youngestFolder_;
    std::vector<Value> declared_;  ///< The "options" of the documents, youngest first.
};

/// Oldest first, each flow file in front of the document that names it.
std::vector<PipelineSource> ChainReader::read(Value document, const std::string& file) {
    std::vector<PipelineSource> documents = readAncestors(std::move(document), file);
    youngestFolder_ = fs::path(file).parent_path();
    // All documents first: a name of a flow file may use options that a parent declares or a child changes.
    for (const PipelineSource& source : documents)
        if (const Value* options = source.tree.find("options"); options && options->isObject())
            declared_.push_back(*options);
    std::vector<PipelineSource> chain;
    for (PipelineSource& source : documents) {
        std::vector<PipelineSource> brought;
        placeFlows(source.tree, fs::path(source.file).parent_path(), brought);
        chain.push_back(std::move(source));
        std::move(brought.rbegin(), brought.rend(), std::back_inserter(chain));
    }
    std::reverse(chain.begin(), chain.end());
    return chain;
}

/// The document and its parents, youngest first.
std::vector<PipelineSource> ChainReader::readAncestors(Value document, const std::string& file) {
    std::vector<PipelineSource> chain;
    std::vector<std::string> seen;
    std::string current = file;
    while (true) {
        const fs::path folder = fs::path(current).parent_path();
        const ObjectReader reader(document, pipelineKeys(), "the pipeline", problems_);
        if (!reader.isObject()) problems_.throwIfErrors();
        const Value extends = reader.get("extends") ? *reader.get("extends") : Value();
        chain.push_back({std::move(document), current, false});
        seen.push_back(shownPath(current));
        if (extends.isNull()) break;
        const fs::path parent = findParent(extends, folder);
        current = shownPath(parent);
        const bool circular = std::find(seen.begin(), seen.end(), current) != seen.end();
        seen.push_back(current);
        if (circular)
            throw Error(extends.where(),
                        fmt::format("pipelines extend each other in a circle: '{}'", join(seen, "' → '")),
                        "remove one 'extends', or name another parent");
        document = parseJson(readText(parent), current);
        seen.pop_back();
    }
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
                    "move the parent into the folder of the document or below");
    return path;
}

std::optional<fs::path> ChainReader::findFlow(const std::string& name, const fs::path& folder) const {
    if (const auto found = roots_.find(AssetKind::Flow, name)) return found;
    // Beside the document that names it, or the one that chooses it by an option.
    for (const fs::path& place : {folder, youngestFolder_})
        for (const fs::path& candidate : {place / "flows" / (name + ".flow.json"), place / (name + ".flow.json")})
            if (fs::is_regular_file(candidate) && roots_.contains(candidate)) return candidate;
    return std::nullopt;
}

/// What the youngest document that gives it says under `key` of an option.
const Value* ChainReader::declaration(const std::string& option, const char* key) const {
    for (const Value& options : declared_) {
        const Value* one = options.find(option);
        if (!one || !one->isObject()) continue;
        if (const Value* value = one->find(key)) return value;
    }
    return nullptr;
}

std::vector<std::string> ChainReader::declaredOptions() const {
    std::vector<std::string> names;
    for (const Value& options : declared_)
        for (const Member& member : options.members())
            if (!member.value.isNull()) names.push_back(member.key);
    return names;
}

/// The value of an option as text: requested, else its default. A request for a choice that is none is reported with
/// the other options; until then the default holds.
std::optional<std::string> ChainReader::optionText(const std::string& option) const {
    const auto asText = [](const Value& value) { return value.isString() ? value.string() : value.toJson(-1); };
    const Value* otherwise = declaration(option, "default");
    if (const auto asked = requested_.find(option); asked != requested_.end()) {
        const Value* choices = declaration(option, "choices");
        bool known = !choices;
        if (choices && choices->isArray())
            for (const Value& choice : choices->items()) known |= asText(choice) == asked->second;
        if (choices && choices->isObject()) known = choices->find(asked->second) != nullptr;
        if (known) return asked->second;
    }
    return otherwise ? std::optional(asText(*otherwise)) : std::nullopt;
}

/// Puts values in place of each `$option` of a flow's name; false when one is unknown.
bool ChainReader::resolveName(Value& name) {
    std::string text = name.string();
    for (std::size_t at = text.find('$'); at != std::string::npos; at = text.find('$', at)) {
        std::size_t end = at + 1;
        while (end < text.size() && isPlainName(text.substr(at + 1, end - at))) ++end;
        const std::string option = text.substr(at + 1, end - at - 1);
        const auto value = optionText(option);
        if (!value) {
            const std::vector<std::string> known = declaredOptions();
            problems_.error(name.where(), fmt::format("'${}' in the name of a flow names no option", option),
                            known.empty() ? "declare it under \"options\" of this document or of a parent"
                                          : didYouMean(option, known, "options"));
            return false;
        }
        text.replace(at, end - at, *value);
        at += value->size();
    }
    const SourceLoc where = name.where();
    name = Value::makeString(text, where);
    return true;
}

/// `written` is the name before options were put in.
void ChainReader::reportLostFlow(const Value& name, const std::string& written) const {
    std::vector<std::string> known = roots_.list(AssetKind::Flow);
    if (written == name.string()) {
        const std::string near = known.empty() ? "" : didYouMean(name.string(), known, "flow files") + "; or ";
        problems_.error(
            name.where(), fmt::format("no flow file named '{}'", name.string()),
            near + fmt::format("write the flow's \"stages\" here, or the file flows/{}.flow.json", name.string()));
        return;
    }
    const std::string prefix = written.substr(0, written.find('$'));
    std::erase_if(known, [&](const std::string& other) { return !other.starts_with(prefix); });
    problems_.error(name.where(), fmt::format("no flow file named '{}', which '{}' stands for", name.string(), written),
                    fmt::format("{}; or write the file flows/{}.flow.json",
                                known.empty() ? "there are none" : "flow files: " + join(known, ", "), name.string()));
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
    Value& nameValue = *flow.find("flow");
    const std::string written = nameValue.string();
    if (!resolveName(nameValue)) return;
    const std::string name = nameValue.string();
    const auto path = findFlow(name, folder);
    if (!path) return reportLostFlow(nameValue, written);
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
    brought.push_back({std::move(sections), shownPath(*path), true});
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
        const bool isFile = !flow.find("stages");
        if (isFile) placeFlow(flow, folder, brought);
        if (!flow.find("stages")) continue;
        // A flow file may say "nothing": the choice that switches off.
        if (isFile && flow.find("stages")->isArray() && flow.find("stages")->items().empty()) continue;
        const bool wasEmpty = flow.find("stages")->items().empty();
        keepGoodStages(flow);
        if (flow.find("stages")->items().empty() && !wasEmpty) continue;
        good.push_back(std::move(flow));
    }
    document.find("flows")->items() = std::move(good);
}

}  // namespace

std::vector<PipelineSource> readPipelineChain(const AssetRoots& roots, const std::string& nameOrPath,
                                              const OptionTexts& requested, Problems& problems) {
    ChainReader reader(roots, requested, problems);
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
                                               const OptionTexts& requested, Problems& problems) {
    ChainReader reader(roots, requested, problems);
    const fs::path folder = fs::path(file).parent_path();
    if (!folder.empty()) reader.allowFolder(folder);
    return reader.read(parseJson(text, file), file);
}

std::vector<PipelineSource> readPipelineChain(const AssetRoots& roots, const PipelineRequest& request,
                                              Problems& problems) {
    return request.text ? parsePipelineChain(roots, *request.text, request.nameOrPath, request.options, problems)
                        : readPipelineChain(roots, request.nameOrPath, request.options, problems);
}

}  // namespace crevice
