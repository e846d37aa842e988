// Members of checked JSON as numbers and structs.
#include "scene/GltfModel.h"

#include <algorithm>

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

AttributeMap attributesIn(const Value* object) {
    AttributeMap attributes;
    if (object && object->isObject())
        for (const Member& member : object->members())
            if (member.value.isNumber()) attributes.emplace(member.key, int(member.value.number()));
    return attributes;
}

BufferPart readBuffer(const Value& from) {
    BufferPart to{.byteLength = sizeOr(from, "byteLength"), .uri = textOr(from, "uri")};
    to.hasUri = memberOf(from, "uri") != nullptr;
    if (const Value* meshopt = extensionOf(from, "EXT_meshopt_compression")) to.fallback = flagOr(*meshopt, "fallback");
    return to;
}

BufferViewPart readBufferView(const Value& from) {
    BufferViewPart to{.buffer = intOr(from, "buffer"),
                      .byteOffset = sizeOr(from, "byteOffset"),
                      .byteLength = sizeOr(from, "byteLength"),
                      .byteStride = sizeOr(from, "byteStride")};
    if (const Value* meshopt = extensionOf(from, "EXT_meshopt_compression"))
        to.compression = Compression{.buffer = intOr(*meshopt, "buffer"),
                                     .byteOffset = sizeOr(*meshopt, "byteOffset"),
                                     .byteLength = sizeOr(*meshopt, "byteLength"),
                                     .byteStride = sizeOr(*meshopt, "byteStride"),
                                     .count = sizeOr(*meshopt, "count"),
                                     .mode = textOr(*meshopt, "mode"),
                                     .filter = textOr(*meshopt, "filter", "NONE")};
    return to;
}

AccessorPart readAccessor(const Value& from) {
    AccessorPart to{.bufferView = intOr(from, "bufferView"),
                    .byteOffset = sizeOr(from, "byteOffset"),
                    .count = sizeOr(from, "count"),
                    .componentType = intOr(from, "componentType"),
                    .normalized = flagOr(from, "normalized")};
    const std::string type = textOr(from, "type");
    for (const TypeRow& row : kTypes)
        if (type == row.name) to.columns = row.columns, to.rows = row.rows;
    const Value* sparse = objectIn(&from, "sparse");
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

TexturePart readTexture(const Value& from) {
    TexturePart to{.source = intOr(from, "source"), .sampler = intOr(from, "sampler")};
    if (const Value* webp = extensionOf(from, "EXT_texture_webp")) to.webp = intOr(*webp, "source");
    return to;
}

MeshPart readMesh(const Value& from) {
    MeshPart to{.name = textOr(from, "name"), .weights = floatsIn(from, "weights")};
    for (const Value& item : listIn(from, "primitives")) {
        PrimitivePart primitive{.attributes = attributesIn(objectIn(&item, "attributes")),
                                .indices = intOr(item, "indices"),
                                .material = intOr(item, "material"),
                                .mode = intOr(item, "mode", kTriangles)};
        for (const Value& target : listIn(item, "targets")) primitive.targets.push_back(attributesIn(&target));
        to.primitives.push_back(std::move(primitive));
    }
    return to;
}

NodePart readNode(const Value& from) {
    NodePart to{.name = textOr(from, "name"),
                .mesh = intOr(from, "mesh"),
                .skin = intOr(from, "skin"),
                .camera = intOr(from, "camera"),
                .weights = floatsIn(from, "weights")};
    for (const Value& child : listIn(from, "children")) to.children.push_back(int(child.number()));
    if (const std::vector<float> m = floatsIn(from, "matrix"); m.size() == 16) {
        glm::mat4& matrix = to.matrix.emplace(1);
        for (std::size_t i = 0; i < 16; ++i) matrix[int(i / 4)][int(i % 4)] = m[i];
    }
    if (const auto t = floatsIn(from, "translation"); t.size() == 3) to.translation = {t[0], t[1], t[2]};
    if (const auto s = floatsIn(from, "scale"); s.size() == 3) to.scale = {s[0], s[1], s[2]};
    if (const auto r = floatsIn(from, "rotation"); r.size() == 4) to.rotation = glm::quat(r[3], r[0], r[1], r[2]);
    if (const Value* light = extensionOf(from, "KHR_lights_punctual")) to.light = intOr(*light, "light");
    if (const Value* copies = extensionOf(from, "EXT_mesh_gpu_instancing"))
        to.instancing = attributesIn(objectIn(copies, "attributes"));
    return to;
}

template <class Part>
void readAll(const Value& json, const char* list, std::vector<Part>& parts, Part (*read)(const Value&)) {
    parts.reserve(listIn(json, list).size());
    for (const Value& item : listIn(json, list)) parts.push_back(read(item));
}

ImagePart readImage(const Value& from) {
    return {.name = textOr(from, "name"), .uri = textOr(from, "uri"), .bufferView = intOr(from, "bufferView")};
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

Model readModel(const Value& json) {
    Model model;
    readAll(json, "buffers", model.buffers, readBuffer);
    readAll(json, "bufferViews", model.bufferViews, readBufferView);
    readAll(json, "accessors", model.accessors, readAccessor);
    readAll(json, "images", model.images, readImage);
    readAll(json, "textures", model.textures, readTexture);
    readAll(json, "meshes", model.meshes, readMesh);
    readAll(json, "nodes", model.nodes, readNode);
    return model;
}

}  // namespace crevice::gltf
