// Opens a glTF: the container, its JSON, the version, the extensions, then everything else in order.
#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "core/JsonRepeats.h"
#include "core/LimitedFiles.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kGlbMagic = "glTF";
constexpr const char* kRepair = "this breaks a rule of glTF 2.0: repair the entry, or export the file again";
constexpr std::size_t kMaxFaultsTold = 10;
constexpr std::array kSupportedExtensions = {"KHR_lights_punctual",     "KHR_materials_emissive_strength",
                                             "KHR_materials_unlit",     "KHR_texture_transform",
                                             "KHR_mesh_quantization",   "KHR_materials_pbrSpecularGlossiness",
                                             "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
                                             "EXT_texture_webp",        "KHR_node_visibility"};

SourceLoc placeOf(const File& file, const Value* value) {
    // Lines of a .glb's JSON chunk say nothing: it is one long line inside a binary file.
    return value && !file.binary ? value->where() : SourceLoc{file.name};
}

void checkVersion(const File& file) {
    const Value* asset = objectIn(&file.json, "asset");
    const Value* version = asset ? asset->find("version") : nullptr;
    const std::string text = version && version->isString() ? version->string() : "";
    if (text.starts_with("1.") || text == "1")
        throw Error(placeOf(file, version), "this is glTF 1.0; Crevice reads glTF 2.0", "convert it to glTF 2.0");
    const bool digits = text.size() > 2 &&
                        std::all_of(text.begin() + 2, text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
    if (!text.starts_with("2.") || !digits)
        throw Error(placeOf(file, version ? version : &file.json),
                    "'asset.version' is not 2.x: this is no glTF 2.0 file",
                    "a glTF 2.0 file has \"asset\": { \"version\": \"2.0\" }");
    if (text != "2.0") file.note(fmt::format("'asset.version' is {}: it is read as glTF 2.0", text.substr(0, 20)));
    const Value* least = asset->find("minVersion");
    if (least && (!least->isString() || least->string() != "2.0"))
        throw Error(placeOf(file, least), "'asset.minVersion' asks for more than glTF 2.0, which Crevice reads",
                    "export the file as glTF 2.0");
}

const std::vector<Value>& namesIn(const File& file, const char* key) {
    const Value* list = file.json.find(key);
    if (list && !list->isArray()) throw Error(placeOf(file, list), fmt::format("'{}' is not a list", key), kRepair);
    for (const Value& name : listIn(file.json, key))
        if (!name.isString())
            throw Error(placeOf(file, &name), fmt::format("'{}' holds {}", key, name.typeName()), kRepair);
    return listIn(file.json, key);
}

void checkExtensions(const File& file) {
    const std::vector<Value>&used = namesIn(file, "extensionsUsed"), &required = namesIn(file, "extensionsRequired");
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        std::set<std::string> names;
        const Value* list = file.json.find(key);
        if (list && listIn(file.json, key).empty()) file.fault(placeOf(file, list), fmt::format("'{}' is empty", key));
        for (const Value& name : listIn(file.json, key)) {
            if (!names.insert(name.string()).second)
                file.fault(placeOf(file, &name), fmt::format("'{}' is in '{}' twice", name.string(), key));
        }
    }
    std::set<std::string> declared;
    for (const Value& name : used) declared.insert(name.string());
    for (const Value& name : required) {
        if (!isSupportedExtension(name.string()))
            throw Error(placeOf(file, &name),
                        fmt::format("the file requires the extension '{}', which Crevice does not read", name.string()),
                        "export it without that extension");
        if (!declared.contains(name.string()))
            file.fault(placeOf(file, &name),
                       fmt::format("the required extension '{}' is not in 'extensionsUsed'", name.string()));
    }
    for (const std::string& name : declared)
        if (!isSupportedExtension(name))
            file.note(fmt::format("the extension '{}' is not read; the scene is shown without it", name));
}

void parseDocument(File& file) {
    std::string_view text(reinterpret_cast<const char*>(file.content.data()), file.content.size());
    file.binary = text.starts_with(kGlbMagic);
    if (file.binary) text = readContainer(file);
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text.starts_with(kByteOrderMark)) {
        file.fault(SourceLoc{file.name}, "the JSON begins with a byte order mark");
        text.remove_prefix(kByteOrderMark.size());
    }
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin != std::string_view::npos && std::string_view("{[\"/-0123456789tfn").find(text[begin]) == text.npos)
        throw Error(SourceLoc{file.name}, "it begins neither as JSON nor as a .glb",
                    "a .gltf begins with '{', a .glb with the letters glTF");
    const Limits& limits = file.options.limits;
    // Specification, 2.7: keys should be unique; a later value overrides the one before.
    file.json = parseJsonLastWins(
        text, file.name,
        {.maxBytes = limits.maxFileBytes, .maxDepth = limits.maxDocumentDepth, .maxNodes = limits.maxDocumentValues},
        [&](std::string_view key, const SourceLoc& where) {
            file.fault(
                file.binary ? SourceLoc{file.name} : where,
                fmt::format("key '{}' stands twice in an object: the last value counts", shortened(std::string(key))));
        });
    if (!file.json.isObject())
        throw Error(placeOf(file, &file.json),
                    fmt::format("the glTF must be an object, found {}", file.json.typeName()),
                    "a glTF is one object that begins with '{'");
}

}  // namespace

bool isSupportedExtension(const std::string& name) {
    return std::any_of(kSupportedExtensions.begin(), kSupportedExtensions.end(),
                       [&](const char* n) { return name == n; });
}

const Value& File::item(std::string_view list, std::size_t index) const { return listIn(json, list)[index]; }

SourceLoc File::where(std::string_view list, std::size_t index) const {
    if (list == "lights") {
        const Value* lights = extensionOf(json, "KHR_lights_punctual");
        if (!binary && lights && index < listIn(*lights, list).size()) return listIn(*lights, list)[index].where();
        return SourceLoc{name};
    }
    const auto& items = listIn(json, list);
    if (binary || index >= items.size()) return SourceLoc{name};
    return items[index].where();
}

void File::fail(std::string_view list, std::size_t index, const std::string& message, const std::string& help) const {
    throw Error(where(list, index), fmt::format("{}[{}]: {}", list, index, message), help.empty() ? kRepair : help);
}

void File::fault(std::string_view list, std::size_t index, const std::string& message) const {
    fault(where(list, index), fmt::format("{}[{}]: {}", list, index, message));
}

void File::fault(const SourceLoc& where, const std::string& message) const {
    if (options.strict) throw Error(where, message, "repair the entry, or leave --strict out: it does no harm");
    if (faults.size() >= kMaxFaultsTold || !faults.insert(message).second) return;
    if (faults.size() < kMaxFaultsTold) return options.log.warning(fmt::format("{}: {}", name, message));
    options.log.warning(fmt::format("{}: more faults of this kind are not listed; --strict stops at the first", name));
}

void File::lack(std::string_view list, std::size_t index, const std::string& message) const {
    if (options.strict) fail(list, index, message, "repair the file, or leave --strict out");
    warn(list, index, message);
}

void File::warn(std::string_view list, std::size_t index, const std::string& message) const {
    options.log.warning(fmt::format("{}: {}[{}]: {}", name, list, index, message));
}

void File::note(const std::string& message) const { options.log.note(fmt::format("{}: {}", name, message)); }

void File::spend(std::size_t numbers) const {
    constexpr std::size_t kFree = 10'000'000, kPerByte = 4;
    const std::size_t most = kFree + kPerByte * bytesHeld;
    if (numbers > most - std::min(spent, most))
        throw Error(
            SourceLoc{name},
            fmt::format("its accessors name the same bytes so often that they stand for more than {} numbers", most),
            options.strict ? "leave --strict out: it looks at all of them" : "export the file again");
    spent += numbers;
}

void File::tell(std::string_view what, double share) const {
    if (options.progress) options.progress(what, float(std::min(share, 1.0)));
}

File open(const fs::path& path, const LoadOptions& options) {
    File file{.name = path.string(), .options = options};
    file.tell("reading", 0);
    constexpr std::size_t kMostBytes = 0xffffffff;  // what lengths in a .glb can say
    file.content = options.limits.maxFileBytes > kMostBytes ? readBytes(path, kMostBytes)
                                                            : readBytesWithin(path, options.limits.maxFileBytes);
    parseDocument(file);
    checkVersion(file);
    checkExtensions(file);
    checkSchema(file);
    normalise(file.json);
    file.model = readModel(file.json, file.name);
    Resources resources(file, fs::absolute(path).parent_path());
    resources.readBuffers();
    resources.readBufferViews();
    resources.readImages();
    file.bytesHeld = file.content.size();
    for (const std::vector<std::byte>& part : file.storage) file.bytesHeld += part.size();
    file.tell("checking", 0);
    for (std::size_t i = 0; i < file.model.accessors.size(); ++i) checkAccessor(file, i);
    checkRules(file);
    checkAttributes(file);
    checkLights(file);
    checkSkins(file);
    checkUses(file);
    checkAnimations(file);
    checkData(file);
    return file;
}

}  // namespace crevice::gltf
