// Opens a glTF: the container, the checks tinygltf leaves out, and reads that stay inside the allowed folders.
#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <span>

#include <fmt/format.h>

#include "core/Files.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kGlbMagic = 0x46546c67;   // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr double kMaxInteger = 9007199254740992.0;  // 2^53: integers beyond are not exact in JSON
constexpr const char* kRepair = "this breaks a rule of glTF 2.0: repair the entry, or export the file again";
constexpr std::array kSupportedExtensions = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                             "KHR_materials_unlit", "KHR_mesh_quantization"};

std::uint32_t word(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

// The JSON chunk of a .glb. Layout: glTF 2.0 specification, 4 "GLB File Format Specification".
std::string_view jsonOfGlb(std::span<const std::byte> bytes, const std::string& name) {
    const auto refuse = [&](const std::string& why) {
        throw Error(SourceLoc{name}, "broken .glb: " + why, "the file may be truncated: export or download it again");
    };
    if (bytes.size() < 20) refuse(fmt::format("{} bytes are less than its header", bytes.size()));
    if (word(bytes, 4) == 1)
        throw Error(SourceLoc{name}, "this is glTF 1.0; Crevice reads glTF 2.0", "convert it to glTF 2.0");
    if (word(bytes, 4) != 2) refuse(fmt::format("container version {} is not 2", word(bytes, 4)));
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size()) refuse(fmt::format("its header says {} bytes, the file has {}", length, bytes.size()));
    const std::size_t jsonLength = word(bytes, 12);
    if (word(bytes, 16) != kJsonChunk) refuse("the first chunk is not JSON");
    if (jsonLength < 1 || jsonLength > length - 20 || length < 20) refuse("the JSON chunk reaches beyond the file");
    const std::size_t next = 20 + jsonLength;
    if (next != length) {
        if (length - next < 8) refuse("the second chunk has no header");
        if (word(bytes, next) > length - next - 8) refuse("the binary chunk reaches beyond the file");
        if (word(bytes, next + 4) != kBinaryChunk) refuse("the second chunk is not binary data");
    }
    return {reinterpret_cast<const char*>(bytes.data()) + 20, jsonLength};
}

const Value* findObject(const Value& object, const char* key) {
    const Value* value = object.isObject() ? object.find(key) : nullptr;
    return value && value->isObject() ? value : nullptr;
}

const std::vector<Value>& itemsOf(const Value& object, const char* key) {
    static const std::vector<Value> kNone;
    const Value* value = object.isObject() ? object.find(key) : nullptr;
    return value && value->isArray() ? value->items() : kNone;
}

// A member that must be a count or an index if it is there.
std::optional<std::size_t> sizeMember(const File& file, std::string_view list, std::size_t index, const Value& object,
                                      const char* key) {
    const Value* value = object.isObject() ? object.find(key) : nullptr;
    if (!value) return std::nullopt;
    if (!value->isNumber() || value->number() < 0 || value->number() >= kMaxInteger ||
        value->number() != double(std::size_t(value->number())))
        file.fail(list, index, fmt::format("'{}' is not a non-negative integer", key));
    return std::size_t(value->number());
}

// "%20" → " ". RFC 3986, 2.1; a percent sign without two hex digits stands for itself.
std::string decodeUri(const std::string& uri) {
    const auto hex = [](char c) {
        return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1;
    };
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && hex(uri[i + 1]) >= 0 && hex(uri[i + 2]) >= 0) {
            text += char(hex(uri[i + 1]) * 16 + hex(uri[i + 2]));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

// How many bytes a "data:…;base64," URI holds; 0 when it is none.
std::size_t base64Bytes(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) return 0;
    std::string_view digits = uri.substr(comma + 1);
    while (digits.ends_with('=')) digits.remove_suffix(1);
    const bool good = std::all_of(digits.begin(), digits.end(), [](unsigned char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
    });
    return good ? digits.size() * 3 / 4 : 0;
}

/// Answers tinygltf's wishes for files.
struct Reader {
    fs::path folder;
    AssetRoots allowed;
    std::size_t bytesLeft;
    std::map<fs::path, std::size_t> wantedBytes;  ///< Buffers may be longer than the part that is used.

    bool isAllowed(const fs::path& path) const { return allowed.contains(path); }
};

bool fileExists(const std::string& path, void* user) {
    std::error_code error;
    return static_cast<const Reader*>(user)->isAllowed(path) && fs::is_regular_file(path, error);
}

std::string keepPath(const std::string& path, void*) { return path; }

bool readWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
    Reader& reader = *static_cast<Reader*>(user);
    try {
        const std::vector<std::byte> bytes = readBytes(path, reader.bytesLeft);
        const auto wanted = reader.wantedBytes.find(fs::path(path).lexically_normal());
        const std::size_t count =
            wanted == reader.wantedBytes.end() ? bytes.size() : std::min(wanted->second, bytes.size());
        reader.bytesLeft -= bytes.size();
        const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
        out->assign(begin, begin + count);
        return true;
    } catch (const std::exception& failure) {
        if (error) *error = failure.what();
        return false;
    }
}

bool keepEncoded(tinygltf::Image* image, int, std::string* error, std::string*, int, int, const unsigned char* bytes,
                 int size, void* user) {
    Reader& reader = *static_cast<Reader*>(user);
    if (size < 0 || std::size_t(size) > reader.bytesLeft) {
        if (error) *error += "the images are larger than the limit";
        return false;
    }
    reader.bytesLeft -= size;
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

void checkVersion(const File& file) {
    const Value* asset = findObject(file.json, "asset");
    const Value* version = asset ? asset->find("version") : nullptr;
    const std::string text = version && version->isString() ? version->string() : "";
    if (text.starts_with("1.") || text == "1")
        throw Error(version->where(), "this is glTF 1.0; Crevice reads glTF 2.0", "convert it to glTF 2.0");
    if (!text.starts_with("2."))
        throw Error(version       ? version->where()
                    : file.binary ? SourceLoc{file.name}
                                  : file.json.where(),
                    "'asset.version' is not 2.x: this is no glTF 2.0 file",
                    "a glTF 2.0 file has \"asset\": { \"version\": \"2.0\" }");
}

void checkExtensions(const File& file) {
    const auto isSupported = [](const std::string& name) {
        return std::any_of(kSupportedExtensions.begin(), kSupportedExtensions.end(),
                           [&](const char* n) { return name == n; });
    };
    for (const Value& name : itemsOf(file.json, "extensionsRequired"))
        if (!name.isString() || !isSupported(name.string()))
            throw Error(file.binary ? SourceLoc{file.name} : name.where(),
                        fmt::format("the file requires the extension '{}', which Crevice does not read",
                                    name.isString() ? name.string() : "?"),
                        "export it without that extension");
    for (const Value& name : itemsOf(file.json, "extensionsUsed"))
        if (name.isString() && !isSupported(name.string()))
            file.note(fmt::format("the extension '{}' is not read; the scene is shown without it", name.string()));
}

// A file that a buffer or an image names: inside the allowed folders, or nothing if it is data in the JSON.
std::optional<fs::path> namedFile(const File& file, const Reader& reader, std::string_view list, std::size_t index,
                                  const Value& object) {
    const Value* uri = object.isObject() ? object.find("uri") : nullptr;
    if (!uri) return std::nullopt;
    if (!uri->isString()) file.fail(list, index, "'uri' is not a string");
    if (uri->string().starts_with("data:")) return std::nullopt;
    const std::string name = decodeUri(uri->string());
    if (name.find('\0') != std::string::npos) file.fail(list, index, "'uri' has a zero byte");
    const fs::path path = reader.folder / name;
    if (!reader.isAllowed(path))
        file.fail(list, index, fmt::format("'{}' lies outside the scene's folder", name),
                  "files are only read from the folder of the scene and below: copy it there");
    return path;
}

void checkBuffers(const File& file, Reader& reader) {
    std::size_t total = 0;
    const auto& buffers = itemsOf(file.json, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::size_t length = sizeMember(file, "buffers", i, buffers[i], "byteLength").value_or(0);
        if (length == 0) file.fail("buffers", i, "'byteLength' is missing or 0");
        total += std::min(length, file.options.limits.maxFileBytes + 1);
        if (total > file.options.limits.maxFileBytes) file.fail("buffers", i, "the buffers are larger than the limit");
        if (const auto path = namedFile(file, reader, "buffers", i, buffers[i])) {
            std::error_code error;
            const std::uintmax_t size = fs::file_size(*path, error);
            if (error)
                file.fail("buffers", i, fmt::format("cannot read '{}': {}", path->filename().string(), error.message()),
                          "the geometry lives in that file: keep it beside the .gltf");
            if (size < length)
                file.fail(
                    "buffers", i,
                    fmt::format("'{}' has {} bytes, 'byteLength' says {}", path->filename().string(), size, length),
                    "the file may be truncated: export or download it again");
            std::size_t& wanted = reader.wantedBytes[path->lexically_normal()];
            wanted = std::max(wanted, length);
        } else if (const Value* uri = buffers[i].find("uri"); uri && base64Bytes(uri->string()) < length) {
            file.fail("buffers", i, fmt::format("'uri' does not hold the {} bytes of 'byteLength' as base64", length));
        }
    }
}

void checkBufferViews(const File& file) {
    const auto& buffers = itemsOf(file.json, "buffers");
    const auto& views = itemsOf(file.json, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const auto size = [&](const char* key) { return sizeMember(file, "bufferViews", i, views[i], key); };
        const std::size_t buffer = size("buffer").value_or(buffers.size());
        if (buffer >= buffers.size())
            file.fail("bufferViews", i,
                      fmt::format("'buffer' is missing or names none of the {} buffers", buffers.size()));
        const std::size_t bufferLength = *sizeMember(file, "buffers", buffer, buffers[buffer], "byteLength");
        const std::size_t offset = size("byteOffset").value_or(0), length = size("byteLength").value_or(0);
        if (length == 0) file.fail("bufferViews", i, "'byteLength' is missing or 0");
        if (offset > bufferLength || length > bufferLength - offset)
            file.fail("bufferViews", i,
                      fmt::format("'byteOffset' {} and 'byteLength' {} reach beyond buffers[{}] of {} bytes", offset,
                                  length, buffer, bufferLength));
        if (size("byteStride").value_or(4) > 252) file.fail("bufferViews", i, "'byteStride' is above 252");
    }
}

// Where tinygltf would take anything for an integer.
void checkIntegers(const File& file) {
    const auto& accessors = itemsOf(file.json, "accessors");
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        for (const char* key : {"bufferView", "byteOffset", "componentType", "count"})
            sizeMember(file, "accessors", i, accessors[i], key);
        const Value* sparse = accessors[i].isObject() ? accessors[i].find("sparse") : nullptr;
        if (!sparse) continue;
        if (!findObject(*sparse, "indices") || !findObject(*sparse, "values"))
            file.fail("accessors", i, "'sparse' lacks 'indices' or 'values'");
    }
    const auto& images = itemsOf(file.json, "images");
    for (std::size_t i = 0; i < images.size(); ++i) sizeMember(file, "images", i, images[i], "bufferView");
    const auto& nodes = itemsOf(file.json, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const char* key : {"mesh", "skin", "camera"}) sizeMember(file, "nodes", i, nodes[i], key);
    const auto& meshes = itemsOf(file.json, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i)
        for (const Value& primitive : itemsOf(meshes[i], "primitives")) {
            for (const char* key : {"indices", "material", "mode"}) sizeMember(file, "meshes", i, primitive, key);
            const Value* attributes = findObject(primitive, "attributes");
            if (!attributes) continue;
            for (const Member& attribute : attributes->members())
                sizeMember(file, "meshes", i, *attributes, attribute.key.c_str());
        }
}

void checkImages(const File& file, const Reader& reader) {
    const auto& images = itemsOf(file.json, "images");
    for (std::size_t i = 0; i < images.size(); ++i)
        if (const auto path = namedFile(file, reader, "images", i, images[i]); path && !fs::is_regular_file(*path))
            file.warn("images", i, fmt::format("no file '{}': shown white", path->filename().string()));
}

void parseModel(File& file, Reader& reader, std::span<const std::byte> bytes) {
    tinygltf::TinyGLTF parser;
    parser.SetImageLoader(keepEncoded, &reader);
    parser.SetFsCallbacks({fileExists, keepPath, readWholeFile, nullptr, &reader});
    std::string errors, warnings;
    bool good = false;
    try {
        const std::string folder = reader.folder.string();
        const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
        const auto size = static_cast<unsigned>(bytes.size());
        good = file.binary ? parser.LoadBinaryFromMemory(&file.model, &errors, &warnings, data, size, folder)
                           : parser.LoadASCIIFromString(&file.model, &errors, &warnings,
                                                        reinterpret_cast<const char*>(data), size, folder);
    } catch (const std::exception& failure) {
        errors += failure.what();
    }
    // What tinygltf says is in its own terms; the checks above have words for what is likely.
    if (!good)
        throw Error(SourceLoc{file.name}, "the glTF breaks a rule of its format that is not told apart here",
                    "check the file with a glTF validator, or export it again");
}

}  // namespace

SourceLoc File::where(std::string_view list, std::size_t index) const {
    // Lines of a .glb's JSON chunk say nothing: it is one long line inside a binary file.
    const auto& items = itemsOf(json, std::string(list).c_str());
    if (binary || index >= items.size()) return SourceLoc{name};
    return items[index].where();
}

void File::fail(std::string_view list, std::size_t index, const std::string& message, const std::string& help) const {
    throw Error(where(list, index), fmt::format("{}[{}]: {}", list, index, message), help.empty() ? kRepair : help);
}

void File::warn(std::string_view list, std::size_t index, const std::string& message) const {
    options.log.warning(fmt::format("{}: {}[{}]: {}", name, list, index, message));
}

void File::note(const std::string& message) const { options.log.note(fmt::format("{}: {}", name, message)); }

File open(const fs::path& path, const LoadOptions& options) {
    File file{.name = path.string(), .options = options};
    const std::vector<std::byte> bytes =
        readBytes(path, std::min(options.limits.maxFileBytes, std::size_t(0xffffffff)));
    file.binary = bytes.size() >= 4 && word(bytes, 0) == kGlbMagic;

    std::string_view json(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (file.binary) json = jsonOfGlb(bytes, file.name);
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (json.starts_with(kByteOrderMark)) json.remove_prefix(kByteOrderMark.size());
    file.json = parseJson(json, file.name, {.maxBytes = options.limits.maxFileBytes});
    if (!file.json.isObject())
        throw Error(file.binary ? SourceLoc{file.name} : file.json.where(),
                    fmt::format("the glTF must be an object, found {}", file.json.typeName()),
                    "a glTF is one object that begins with '{'");

    const fs::path absolute = fs::absolute(path).parent_path();
    std::vector<fs::path> roots = options.allowedRoots;
    roots.insert(roots.begin(), absolute);
    Reader reader{absolute, AssetRoots(std::move(roots)), options.limits.maxFileBytes, {}};

    checkVersion(file);
    checkExtensions(file);
    checkBuffers(file, reader);
    checkBufferViews(file);
    checkIntegers(file);
    checkImages(file, reader);
    parseModel(file, reader, bytes);
    for (std::size_t i = 0; i < file.model.accessors.size(); ++i) checkAccessor(file, i);
    return file;
}

}  // namespace crevice::gltf
