// Small glTFs put together by a test, loaded and drawn; what is checked are single pixels at places known by hand.
#pragma once

#include <cstring>
#include <initializer_list>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "FrameFixture.h"
#include "core/Image.h"
#include "scene/GltfLoader.h"
#include "scene/SceneAsset.h"

namespace crevice {

/// A glTF piece by piece. Every function returns the index of what it added.
class ModelText {
public:
    int add(const std::string& list, const std::string& item) {
        lists_[list].push_back(item);
        return static_cast<int>(lists_[list].size()) - 1;
    }
    /// A buffer view; bytes begin at a multiple of 4.
    int view(const void* data, std::size_t size, const std::string& more = {}) {
        while (bytes_.size() % 4) bytes_.push_back(0);
        const std::size_t at = bytes_.size();
        bytes_.resize(at + size);
        std::memcpy(&bytes_[at], data, size);
        return add("bufferViews", "{\"buffer\": 0, \"byteOffset\": " + std::to_string(at) +
                                      ", \"byteLength\": " + std::to_string(size) + more + "}");
    }
    template <class T>
    int accessor(const char* type, const std::vector<T>& numbers, const std::string& more = {}) {
        const int bufferView = view(numbers.data(), numbers.size() * sizeof(T));
        return add("accessors", "{\"bufferView\": " + std::to_string(bufferView) + ", " +
                                    accessorText<T>(type, numbers.size() / componentsOf(type)) + more + "}");
    }
    /// Everything of an accessor but where its bytes are.
    template <class T>
    static std::string accessorText(const char* type, std::size_t count) {
        const int component = std::is_same_v<T, std::int8_t>     ? 5120
                              : std::is_same_v<T, std::uint8_t>  ? 5121
                              : std::is_same_v<T, std::int16_t>  ? 5122
                              : std::is_same_v<T, std::uint16_t> ? 5123
                              : std::is_same_v<T, std::uint32_t> ? 5125
                                                                 : 5126;
        return "\"componentType\": " + std::to_string(component) + ", \"count\": " + std::to_string(count) +
               ", \"type\": \"" + type + "\"";
    }
    /// Positions of rectangles that face +z, four corners each: low, low right, high, low left's upper one.
    static std::vector<float> corners(const glm::vec2& low, const glm::vec2& high, float z = 0) {
        return {low.x, low.y, z, high.x, low.y, z, high.x, high.y, z, low.x, high.y, z};
    }
    int rectangle(const glm::vec2& low, const glm::vec2& high, float z = 0) {
        return accessor("VEC3", corners(low, high, z));
    }
    /// Indices of `count` rectangles, counter-clockwise as seen from +z.
    int rectangleIndices(std::uint16_t count = 1) {
        std::vector<std::uint16_t> indices;
        for (std::uint16_t i = 0; i < count; ++i)
            for (const int corner : {0, 1, 2, 0, 2, 3}) indices.push_back(static_cast<std::uint16_t>(4 * i + corner));
        return accessor("SCALAR", indices);
    }
    static std::string primitive(const std::string& attributes, int indices, int material,
                                 const std::string& more = {}) {
        return "{\"attributes\": {" + attributes + "}" +
               (indices >= 0 ? ", \"indices\": " + std::to_string(indices) : "") +
               (material >= 0 ? ", \"material\": " + std::to_string(material) : "") + more + "}";
    }
    int mesh(const std::string& primitives, const std::string& more = {}) {
        return add("meshes", "{\"primitives\": [" + primitives + "]" + more + "}");
    }
    /// A rectangle as a mesh.
    int rectangleMesh(const glm::vec2& low, const glm::vec2& high, int material, float z = 0) {
        const int position = rectangle(low, high, z);
        return mesh(primitive("\"POSITION\": " + std::to_string(position), rectangleIndices(), material));
    }
    int node(const std::string& members) { return add("nodes", "{" + members + "}"); }
    /// A node at the root of the scene that is shown.
    int root(const std::string& members) {
        roots_ += (roots_.empty() ? "" : ", ") + std::to_string(lists_["nodes"].size());
        return node(members);
    }
    /// Gives off its base colour whatever light there is. `base`: members of pbrMetallicRoughness; `more`: of the
    /// material.
    int unlit(const std::string& base, const std::string& more = {}) {
        return add("materials", "{\"pbrMetallicRoughness\": {" + base +
                                    "}, \"extensions\": {\"KHR_materials_unlit\": {}}" + more + "}");
    }
    int texture(const Image& image, const std::string& sampler = {}) {
        const std::vector<std::byte> png = encodePng(image);
        const int source =
            add("images",
                "{\"mimeType\": \"image/png\", \"bufferView\": " + std::to_string(view(png.data(), png.size())) + "}");
        const std::string read =
            sampler.empty() ? "" : ", \"sampler\": " + std::to_string(add("samplers", "{" + sampler + "}"));
        return add("textures", "{\"source\": " + std::to_string(source) + read + "}");
    }
    std::string top{};  ///< More members of the document, each with a comma before it.

    /// The document and, as another file, its buffer.
    std::string json(const std::string& bufferUri) const {
        std::string text = "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [" + roots_ +
                           "]}], \"buffers\": [{\"byteLength\": " + std::to_string(bytes_.size()) + ", \"uri\": \"" +
                           bufferUri + "\"}]" + top;
        for (const auto& [name, items] : lists_) {
            text += ", \"" + name + "\": [";
            for (std::size_t i = 0; i < items.size(); ++i) text += (i ? ", " : "") + items[i];
            text += "]";
        }
        return text + "}";
    }
    const std::vector<unsigned char>& bytes() const { return bytes_; }

private:
    static std::size_t componentsOf(const std::string& type) {
        return type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
    }
    std::map<std::string, std::vector<std::string>> lists_;
    std::vector<unsigned char> bytes_;
    std::string roots_;
};

/// Which pose of a model is shown; the rest pose by default.
struct ModelPose {
    std::string animation{};
    std::optional<float> time{};
};

class GltfPictureTest : public FrameTest {
protected:
    static constexpr float kHalfUnit = 1.0f / 1024;  // stores into half floats may round down by one unit of 11 bits

    Scene sceneOf(const ModelText& model, const ModelPose& pose = {}) const {
        writeFileAtomically(folder_ / "model.bin",
                            std::string(reinterpret_cast<const char*>(model.bytes().data()), model.bytes().size()));
        writeFileAtomically(folder_ / "model.gltf", model.json("model.bin"));
        const Log silent(LogLevel::Error);
        LoadOptions options{.log = silent};
        options.animation = pose.animation;
        options.time = pose.time;
        return loadGltf(folder_ / "model.gltf", options);
    }
    Image pictureOf(Scene scene, const std::string& pipeline = "deferred", std::uint32_t size = 64) {
        renderer_->setScene(std::move(scene));
        if (loaded_ != pipeline) load(pipeline);
        loaded_ = pipeline;
        return radiance(viewOf(frontCamera(), size, size));
    }
    /// Of the whole model from the front: x and y from -2 to 2, seen along -z.
    Image pictureOf(const ModelText& model, const ModelPose& pose = {}) { return pictureOf(sceneOf(model, pose)); }

    /// What is seen at (x, y) of the plane z = 0.
    static glm::vec3 seen(const Image& picture, float x, float y) {
        return glm::vec3(at(picture, viewOf(frontCamera(), picture.width, picture.height), {x, y, 0}));
    }
    static void expectSeen(const Image& picture, float x, float y, const glm::vec3& color,
                           const std::string& what = {}) {
        const glm::vec3 found = seen(picture, x, y);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], color[c], 2 * kHalfUnit * std::max(1.0f, color[c]))
                << what << " at (" << x << ", " << y << "), channel " << c;
    }
    static constexpr glm::vec3 kWhite{1}, kNothing{0};

    std::string loaded_;
};

}  // namespace crevice
