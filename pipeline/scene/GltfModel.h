// The parts of a glTF that are indexed or read often, as plain structs; the rest is read from its checked JSON.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/Document.h"

namespace crevice::gltf {

/// The numbers that componentType may be: those of OpenGL.
enum ComponentType { kByte = 5120, kUByte = 5121, kShort = 5122, kUShort = 5123, kUInt = 5125, kFloat = 5126 };
/// The numbers that a primitive's mode may be.
enum Mode { kPoints, kLines, kLineLoop, kLineStrip, kTriangles, kTriangleStrip, kTriangleFan };

struct BufferPart {
    std::size_t byteLength = 0;
    std::string uri{};
    bool hasUri = false;
    bool fallback = false;  ///< EXT_meshopt_compression: has no bytes, what lies in it comes out of compressed views.
    std::span<const std::byte> bytes{};  ///< Empty: there is no data.
};

/// EXT_meshopt_compression of a buffer view.
struct Compression {
    int buffer = -1;
    std::size_t byteOffset = 0, byteLength = 0, byteStride = 0, count = 0;
    std::string mode{}, filter{};
};

struct BufferViewPart {
    int buffer = -1;
    std::size_t byteOffset = 0, byteLength = 0, byteStride = 0;
    std::optional<Compression> compression{};
    std::span<const std::byte> bytes{};  ///< Decompressed; empty: the buffer has no data.
};

struct SparsePart {
    std::size_t count = 0;
    int indicesView = -1, valuesView = -1;
    std::size_t indicesOffset = 0, valuesOffset = 0;
    int indicesType = 0;
};

struct AccessorPart {
    int bufferView = -1;
    std::size_t byteOffset = 0, count = 0;
    int componentType = 0;
    bool normalized = false;
    int columns = 1, rows = 0;  ///< A vector is one column; 0 rows: an unknown type.
    std::optional<SparsePart> sparse{};
    int components() const { return columns * rows; }
};

struct ImagePart {
    std::string name{}, uri{};
    int bufferView = -1;
    std::span<const std::byte> bytes{};  ///< The encoded file; empty: there is none.
};

struct TexturePart {
    int source = -1, webp = -1, sampler = -1;
};

using AttributeMap = std::map<std::string, int, std::less<>>;  ///< Semantic → accessor

struct PrimitivePart {
    AttributeMap attributes{};
    std::vector<AttributeMap> targets{};
    int indices = -1, material = -1, mode = kTriangles;
};

struct MeshPart {
    std::string name{};
    std::vector<PrimitivePart> primitives{};
    std::vector<float> weights{};
    bool jointed = false;  ///< A primitive has JOINTS_0.
};

struct NodePart {
    std::string name{};
    std::vector<int> children{};
    int mesh = -1, skin = -1, camera = -1, light = -1;
    std::optional<glm::mat4> matrix{};
    glm::vec3 translation{0}, scale{1};
    glm::quat rotation{1, 0, 0, 0};
    std::vector<float> weights{};
    AttributeMap instancing{};  ///< EXT_mesh_gpu_instancing
    bool visible = true;        ///< KHR_node_visibility
};

struct Model {
    std::vector<BufferPart> buffers;
    std::vector<BufferViewPart> bufferViews;
    std::vector<AccessorPart> accessors;
    std::vector<ImagePart> images;
    std::vector<TexturePart> textures;
    std::vector<MeshPart> meshes;
    std::vector<NodePart> nodes;
};

/// Reads a document that checkSchema() let pass, by tinygltf: it trusts its input. Throws Error when it refuses.
Model readModel(const Value& json, const std::string& name);

// Members of an object that checkSchema() let pass; `otherwise` when they are absent.
double numberOr(const Value& object, std::string_view key, double otherwise);
int intOr(const Value& object, std::string_view key, int otherwise = -1);
std::size_t sizeOr(const Value& object, std::string_view key, std::size_t otherwise = 0);
bool flagOr(const Value& object, std::string_view key, bool otherwise = false);
std::string textOr(const Value& object, std::string_view key, const std::string& otherwise = {});
/// 'name' of an object as the scene keeps it: at most 200 bytes, as instances copy it.
std::string nameIn(const Value& object);
std::string shortened(std::string text);
/// The object member, or null. `object` may be null.
const Value* objectIn(const Value* object, std::string_view key);
const Value* extensionOf(const Value& object, std::string_view name);
const std::vector<Value>& listIn(const Value& object, std::string_view key);
std::vector<float> floatsIn(const Value& object, std::string_view key);

}  // namespace crevice::gltf
