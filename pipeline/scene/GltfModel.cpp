// tinygltf reads what checkSchema() let pass; members of the checked JSON as numbers.
#include "scene/GltfModel.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include <tiny_gltf.h>
#include <glm/gtc/type_ptr.hpp>

namespace crevice::gltf {

namespace {

const Value* memberOf(const Value& object, std::string_view key) {
    return object.isObject() ? object.find(key) : nullptr;
}

/// Rows and columns of an accessor's type.
struct TypeRow {
    const char* name;
    int columns, rows;
};
constexpr TypeRow kTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 1, 2}, {"VEC3", 1, 3}, {"VEC4", 1, 4},
                              {"MAT2", 2, 2},   {"MAT3", 3, 3}, {"MAT4", 4, 4}};

const TypeRow* typeOf(const Value& accessor) {
    const std::string type = textOr(accessor, "type");
    const auto* row =
        std::find_if(std::begin(kTypes), std::end(kTypes), [&](const TypeRow& r) { return type == r.name; });
    return row == std::end(kTypes) ? nullptr : row;
}

/// tinygltf refuses unknown types even where nobody reads the accessor, which does no harm: it sees others.
Value withKnownTypes(Value accessors) {
    for (Value& item : accessors.items()) {
        if (!typeOf(item)) item.set("type", Value::makeString("SCALAR"));
        if (tinygltf::GetComponentSizeInBytes(std::uint32_t(intOr(item, "componentType"))) <= 0)
            item.set("componentType", Value::makeNumber(kFloat));
    }
    return accessors;
}

/// The same for distances between elements; they are read from the checked JSON.
Value withoutStrides(Value views) {
    for (Value& item : views.items()) item.erase("byteStride");
    return views;
}

/// tinygltf reads these; bytes and pictures it never sees: they are read within the limits by Resources.
constexpr const char* kParsed[] = {"asset", "accessors", "bufferViews", "textures", "meshes", "nodes"};

tinygltf::Model parse(const Value& json, const std::string& name) {
    Value known = Value::makeObject();
    for (const char* key : kParsed)
        if (const Value* list = memberOf(json, key))
            known.set(key, std::string_view(key) == "accessors"     ? withKnownTypes(*list)
                           : std::string_view(key) == "bufferViews" ? withoutStrides(*list)
                                                                    : *list);
    const std::string text = known.toJson(0);
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string errors, warnings;
    bool good = false;
    try {
        good = parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(), unsigned(text.size()), "");
    } catch (const std::exception& failure) {
        errors += failure.what();
    }
    // Its words are not for users; checkSchema() has words for what is likely.
    if (!good)
        throw Error(SourceLoc{name}, "the glTF breaks a rule of its format that is not told apart here",
                    "check the file with a glTF validator, or export it again");
    return model;
}

AttributeMap attributesIn(const Value* object) {
    AttributeMap attributes;
    if (object && object->isObject())
        for (const Member& member : object->members())
            if (member.value.isNumber()) attributes.emplace(member.key, int(member.value.number()));
    return attributes;
}

AttributeMap attributesOf(const std::map<std::string, int>& from) { return {from.begin(), from.end()}; }

std::vector<float> floatsOf(const std::vector<double>& from) { return {from.begin(), from.end()}; }

BufferPart readBuffer(const Value& from) {
    BufferPart to{.byteLength = sizeOr(from, "byteLength"), .uri = textOr(from, "uri")};
    to.hasUri = memberOf(from, "uri") != nullptr;
    if (const Value* meshopt = extensionOf(from, "EXT_meshopt_compression")) to.fallback = flagOr(*meshopt, "fallback");
    return to;
}

ImagePart readImage(const Value& from) {
    return {.name = nameIn(from), .uri = textOr(from, "uri"), .bufferView = intOr(from, "bufferView")};
}

BufferViewPart readBufferView(const tinygltf::BufferView& from, const Value& json) {
    BufferViewPart to{.buffer = from.buffer,
                      .byteOffset = from.byteOffset,
                      .byteLength = from.byteLength,
                      .byteStride = sizeOr(json, "byteStride")};
    if (const Value* meshopt = extensionOf(json, "EXT_meshopt_compression"))
        to.compression = Compression{.buffer = intOr(*meshopt, "buffer"),
                                     .byteOffset = sizeOr(*meshopt, "byteOffset"),
                                     .byteLength = sizeOr(*meshopt, "byteLength"),
                                     .byteStride = sizeOr(*meshopt, "byteStride"),
                                     .count = sizeOr(*meshopt, "count"),
                                     .mode = textOr(*meshopt, "mode"),
                                     .filter = textOr(*meshopt, "filter", "NONE")};
    return to;
}

AccessorPart readAccessor(const tinygltf::Accessor& from, const Value& json) {
    AccessorPart to{.bufferView = from.bufferView,
                    .byteOffset = from.byteOffset,
                    .count = from.count,
                    .componentType = intOr(json, "componentType"),
                    .normalized = from.normalized};
    if (const TypeRow* type = typeOf(json)) to.columns = type->columns, to.rows = type->rows;
    // tinygltf keeps offsets of sparse parts in 32 bits with a sign: they are read from the checked JSON.
    const Value* sparse = objectIn(&json, "sparse");
    const Value* indices = objectIn(sparse, "indices");
    const Value* values = objectIn(sparse, "values");
    if (indices && values)
        to.sparse = SparsePart{.count = sizeOr(*sparse, "count"),
                               .indicesView = intOr(*indices, "bufferView"),
                               .valuesView = intOr(*values, "bufferView"),
                               .indicesOffset = sizeOr(*indices, "byteOffset"),
                               .valuesOffset = sizeOr(*values, "byteOffset"),
                               .indicesType = intOr(*indices, "componentType")};
    return to;
}

TexturePart readTexture(const tinygltf::Texture& from, const Value& json) {
    TexturePart to{.source = from.source, .sampler = from.sampler};
    if (const Value* webp = extensionOf(json, "EXT_texture_webp")) to.webp = intOr(*webp, "source");
    return to;
}

MeshPart readMesh(const tinygltf::Mesh& from, const Value&) {
    MeshPart to{.name = shortened(from.name), .weights = floatsOf(from.weights)};
    for (const tinygltf::Primitive& item : from.primitives) {
        PrimitivePart primitive{.attributes = attributesOf(item.attributes),
                                .indices = item.indices,
                                .material = item.material,
                                .mode = item.mode};
        for (const auto& target : item.targets) primitive.targets.push_back(attributesOf(target));
        to.jointed = to.jointed || primitive.attributes.contains("JOINTS_0");
        to.primitives.push_back(std::move(primitive));
    }
    return to;
}

NodePart readNode(const tinygltf::Node& from, const Value& json) {
    NodePart to{.name = shortened(from.name),
                .children = from.children,
                .mesh = from.mesh,
                .skin = from.skin,
                .camera = from.camera,
                .weights = floatsOf(from.weights)};
    if (from.matrix.size() == 16) to.matrix = glm::mat4(glm::make_mat4(from.matrix.data()));
    if (const auto& t = from.translation; t.size() == 3) to.translation = {t[0], t[1], t[2]};
    if (const auto& s = from.scale; s.size() == 3) to.scale = {s[0], s[1], s[2]};
    if (const auto& r = from.rotation; r.size() == 4)
        to.rotation = glm::quat(float(r[3]), float(r[0]), float(r[1]), float(r[2]));
    if (const Value* light = extensionOf(json, "KHR_lights_punctual")) to.light = intOr(*light, "light");
    if (const Value* copies = extensionOf(json, "EXT_mesh_gpu_instancing"))
        to.instancing = attributesIn(objectIn(copies, "attributes"));
    if (const Value* visibility = extensionOf(json, "KHR_node_visibility"))
        to.visible = flagOr(*visibility, "visible", true);
    return to;
}

template <class Part>
void readAll(const Value& json, const char* list, std::vector<Part>& parts, Part (*read)(const Value&)) {
    parts.reserve(listIn(json, list).size());
    for (const Value& item : listIn(json, list)) parts.push_back(read(item));
}

template <class Part, class Parsed>
void readAll(const std::vector<Parsed>& parsed, const Value& json, const char* list, std::vector<Part>& parts,
             Part (*read)(const Parsed&, const Value&)) {
    const std::vector<Value>& items = listIn(json, list);
    assert(parsed.size() == items.size());
    parts.reserve(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) parts.push_back(read(parsed[i], items[i]));
}

}  // namespace

double numberOr(const Value& object, std::string_view key, double otherwise) {
    const Value* value = memberOf(object, key);
    return value && value->isNumber() ? value->number() : otherwise;
}

int intOr(const Value& object, std::string_view key, int otherwise) {
    const double number = numberOr(object, key, otherwise);
    return int(std::clamp(number, -2147483648.0, 2147483647.0));
}

std::size_t sizeOr(const Value& object, std::string_view key, std::size_t otherwise) {
    const Value* value = memberOf(object, key);
    return value && value->isNumber() && value->number() >= 0 ? std::size_t(value->number()) : otherwise;
}

bool flagOr(const Value& object, std::string_view key, bool otherwise) {
    const Value* value = memberOf(object, key);
    return value && value->isBool() ? value->boolean() : otherwise;
}

std::string textOr(const Value& object, std::string_view key, const std::string& otherwise) {
    const Value* value = memberOf(object, key);
    return value && value->isString() ? value->string() : otherwise;
}

std::string shortened(std::string text) {
    constexpr std::size_t kMost = 200;
    std::replace(text.begin(), text.end(), '\n', ' ');  // a name of two lines would forge a message of its own
    if (text.size() <= kMost) return text;
    std::size_t end = kMost;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;  // not inside a UTF-8 sequence
    text.resize(end);
    return text;
}

std::string nameIn(const Value& object) { return shortened(textOr(object, "name")); }

const Value* objectIn(const Value* object, std::string_view key) {
    const Value* value = object ? memberOf(*object, key) : nullptr;
    return value && value->isObject() ? value : nullptr;
}

const Value* extensionOf(const Value& object, std::string_view name) {
    return objectIn(objectIn(&object, "extensions"), name);
}

const std::vector<Value>& listIn(const Value& object, std::string_view key) {
    static const std::vector<Value> kNone;
    const Value* value = memberOf(object, key);
    return value && value->isArray() ? value->items() : kNone;
}

std::vector<float> floatsIn(const Value& object, std::string_view key) {
    std::vector<float> floats;
    for (const Value& item : listIn(object, key)) floats.push_back(item.isNumber() ? float(item.number()) : 0.0f);
    return floats;
}

Model readModel(const Value& json, const std::string& name) {
    const tinygltf::Model parsed = parse(json, name);
    Model model;
    readAll(json, "buffers", model.buffers, readBuffer);
    readAll(json, "images", model.images, readImage);
    readAll(parsed.bufferViews, json, "bufferViews", model.bufferViews, readBufferView);
    readAll(parsed.accessors, json, "accessors", model.accessors, readAccessor);
    readAll(parsed.textures, json, "textures", model.textures, readTexture);
    readAll(parsed.meshes, json, "meshes", model.meshes, readMesh);
    readAll(parsed.nodes, json, "nodes", model.nodes, readNode);
    return model;
}

}  // namespace crevice::gltf
