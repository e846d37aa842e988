// Internal to the glTF loader: the opened file and the steps that turn its parts into a Scene.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <tiny_gltf.h>

#include "core/Document.h"
#include "scene/GltfLoader.h"

namespace crevice::gltf {

/// An opened file: tinygltf's model, and the same JSON with positions for messages. Images are still encoded.
struct File {
    std::string name;  ///< As given by the caller.
    bool binary = false;
    Value json{};
    tinygltf::Model model{};
    const LoadOptions& options;

    /// The place of `list[index]`, as exact as the format allows.
    SourceLoc where(std::string_view list, std::size_t index) const;
    /// Throws an Error at `list[index]`; the message begins with that path.
    [[noreturn]] void fail(std::string_view list, std::size_t index, const std::string& message,
                           const std::string& help = {}) const;
    void warn(std::string_view list, std::size_t index, const std::string& message) const;
    void note(const std::string& message) const;
};

/// Reads the file and everything it names except image pixels. Every accessor, buffer view and buffer is checked here.
File open(const std::filesystem::path& path, const LoadOptions& options);

/// Numbers of an accessor, converted to float: normalised integers to [0,1] or [-1,1].
struct Floats {
    std::vector<float> values;
    int components = 0;
    std::size_t count() const { return components ? values.size() / components : 0; }
};
void checkAccessor(const File& file, std::size_t index);
Floats readFloats(const File& file, int accessor);

/// Vectors of floats as a mesh takes them, one after the other: read where they lie in the file's buffer when they are
/// floats already, so that big meshes are not copied twice. Must not outlive the file.
class FloatStream {
public:
    int components = 0;  ///< 0: the attribute is not there.
    std::size_t count = 0;

    template <int N>
    glm::vec<N, float> at(std::size_t index) const {
        glm::vec<N, float> value;
        std::memcpy(&value, data_ + index * stride_, sizeof value);
        return value;
    }

private:
    friend FloatStream readFloatStream(const File& file, int accessor);
    const unsigned char* data_ = nullptr;
    std::size_t stride_ = 0;
    std::vector<float> converted_;  ///< What data_ points to, unless that is the file. Moves keep the place.
};
FloatStream readFloatStream(const File& file, int accessor);
/// Unsigned integers of a scalar or vector accessor (indices, joints), one after the other.
std::vector<std::uint32_t> readIntegers(const File& file, int accessor);

/// The textures that materials asked for; pixels are decoded at the end, all at once.
class Images {
public:
    explicit Images(const File& file) : file_(file) {}
    /// Index of the scene texture for a glTF texture in one colour space, or -1.
    int use(int texture, bool srgb, std::string_view user);
    /// Decodes every image in use on all cores; a broken one becomes white, with a warning.
    std::vector<SceneTexture> decode() const;

private:
    using Key = std::tuple<int, int, bool>;  // image, sampler, srgb
    const File& file_;
    std::map<Key, int> indices_;
    std::vector<Key> keys_;
};

std::vector<SceneMaterial> readMaterials(const File& file, Images& images);

/// A glTF primitive as it is drawn.
struct Part {
    int mesh = 0;
    int material = -1;  ///< -1: the default material
};

/// Meshes read once each, when a node first wants them.
class Meshes {
public:
    Meshes(const File& file, std::vector<Mesh>& meshes) : file_(file), meshes_(meshes) {}
    /// The drawable primitives of a mesh; `skin` (or -1) bends them with the joints' matrices given.
    const std::vector<Part>& parts(int mesh, int skin, const std::vector<glm::mat4>& joints);

private:
    std::optional<Mesh> readPrimitive(int mesh, std::size_t primitive, const std::vector<glm::mat4>& joints);
    void countVertices(std::size_t vertices, std::size_t indices, int mesh);

    const File& file_;
    std::vector<Mesh>& meshes_;
    std::map<std::pair<int, int>, std::vector<Part>> parts_;
    std::size_t vertexCount_ = 0, indexCount_ = 0;
    bool notedLines_ = false, notedMorph_ = false;
};

/// Walks the node tree: instances, lights and cameras in world space.
void readNodes(const File& file, Meshes& meshes, Scene& scene);

}  // namespace crevice::gltf
