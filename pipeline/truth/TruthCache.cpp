// Keys take in large arrays as their hashes; the sizes of the arrays in a file follow from what is asked.
#include "truth/TruthCache.h"

#include <span>
#include <type_traits>

#include "core/CacheFile.h"
#include "core/Files.h"
#include "truth/AlphaTest.h"

namespace crevice {
namespace {

constexpr std::string_view kMagic = "CREVICE TRUTH 1\n";  // raised whenever the tracer gives other numbers
constexpr std::string_view kHeightfieldMagic = "CREVICE HEIGHTFIELD 1\n";

/// Collects what a key depends on. Large arrays go in as their hashes.
class KeyText {
public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        append(&value, sizeof value);
    }
    template <int N>
    void add(const glm::vec<N, float>& v) {
        append(&v[0], sizeof v);
    }
    void add(const glm::mat4& m) { append(&m[0][0], sizeof m); }
    void add(std::string_view text) {
        add(text.size());
        text_ += text;
    }
    template <class T>
    void addHash(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::string_view(contentHash({reinterpret_cast<const char*>(values.data()), values.size_bytes()})));
    }
    std::string hash() const { return contentHash(text_); }

private:
    void append(const void* data, std::size_t bytes) { text_.append(static_cast<const char*>(data), bytes); }
    std::string text_;
};

void addMesh(KeyText& key, const Mesh& mesh, const SceneMaterial& material) {
    std::vector<float> values;
    const bool masked = material.alphaMode == AlphaMode::Mask;
    values.reserve(mesh.vertices.size() * (masked ? 9 : 6));
    for (const Vertex& vertex : mesh.vertices) {
        for (int i = 0; i < 3; ++i) values.push_back(vertex.position[i]);
        for (int i = 0; i < 3; ++i) values.push_back(vertex.normal[i]);
        if (!masked) continue;
        const glm::vec2 uv = texcoordOf(vertex, material.baseColorMap.texcoord);
        values.insert(values.end(), {uv.x, uv.y, vertex.color.a});
    }
    key.addHash(std::span<const float>(values));
    key.addHash(std::span<const std::uint32_t>(mesh.indices));
    if (mesh.topology != MeshTopology::Triangles) key.add(mesh.topology);
}

void addMaterial(KeyText& key, const SceneMaterial& material, const Scene& scene) {
    key.add(material.alphaMode);
    key.add(material.doubleSided);
    if (material.alphaMode != AlphaMode::Mask) return;
    key.add(material.alphaCutoff);
    key.add(material.baseColor.a);
    key.add(static_cast<bool>(material.baseColorMap));
    if (!material.baseColorMap) return;
    if (const UvTransform& moved = material.baseColorMap.transform; !moved.isIdentity())
        for (int row = 0; row < 2; ++row) key.add(moved.row(row));
    const SceneTexture& texture = scene.textures[static_cast<std::size_t>(material.baseColorMap.texture)];
    key.add(texture.image.width);
    key.add(texture.image.height);
    key.add(texture.image.format);
    key.addHash(std::span<const std::byte>(texture.image.pixels));
    key.add(texture.sampler.wrapU);
    key.add(texture.sampler.wrapV);
    key.add(texture.sampler.linearMag);
}

void addCamera(KeyText& key, const Camera& camera) {
    key.add(camera.view);
    key.add(camera.orthographic);
    key.add(camera.orthographic ? camera.orthoHeight : camera.fovY);
    key.add(camera.near);
    key.add(camera.far);
    key.add(camera.lensShift);
}

/// A changed formula under the same name is another falloff.
void addTerm(KeyText& key, const AmbientTerm& term) {
    const Falloff& falloff = *term.falloff;
    key.add(term.radius);
    key.add(falloff.directions);
    for (const float value : {falloff.reach, falloff.base, falloff.strength, falloff.occlusionPower, falloff.power})
        key.add(value);
    constexpr int kPlaces = 16;
    for (int i = 0; i < kPlaces; ++i) key.add(falloff.at(falloff.reach * (float(i) + 0.5f) / kPlaces));
}

/// Every array of a map, always in the same order.
template <class Map, class Visit>
void forEachArray(Map& map, Visit&& visit) {
    visit(map.viewDepth);
    visit(map.normal);
    visit(map.isCounted);
    for (auto& layer : map.layers) {
        visit(layer.first);
        visit(layer.second);
    }
}

std::filesystem::path fileOf(const std::filesystem::path& folder, const std::string& key) {
    return folder / (key + ".truth");
}

}  // namespace

std::string truthKey(const Scene& scene, const Camera& camera, const glm::uvec2& size,
                     const AmbientSettings& settings) {
    KeyText key;
    key.add(kMagic);
    for (const Instance& instance : scene.instances) {
        const SceneMaterial& material = scene.materials[static_cast<std::size_t>(instance.material)];
        addMaterial(key, material, scene);
        if (material.alphaMode == AlphaMode::Blend) continue;
        key.add(instance.world);
        key.add(instance.flipped);
        addMesh(key, scene.meshes[static_cast<std::size_t>(instance.mesh)], material);
    }
    key.add(scene.bounds().diagonal());
    addCamera(key, camera);
    key.add(size.x);
    key.add(size.y);
    for (const AmbientTerm& term : settings.terms) addTerm(key, term);
    key.add(settings.samples);
    key.add(settings.seed);
    return key.hash();
}

bool loadTruth(const std::filesystem::path& folder, const std::string& key, AmbientMap& map) {
    std::vector<std::span<std::byte>> arrays;
    forEachArray(map, [&](auto& values) { arrays.push_back(std::as_writable_bytes(std::span(values))); });
    return loadArrays(fileOf(folder, key), kMagic, arrays);
}

void storeTruth(const std::filesystem::path& folder, const std::string& key, const AmbientMap& map) {
    std::vector<std::span<const std::byte>> arrays;
    forEachArray(map, [&](const auto& values) { arrays.push_back(std::as_bytes(std::span(values))); });
    storeArrays(fileOf(folder, key), kMagic, arrays);
}

std::string heightfieldKey(const HeightfieldInput& input, const HeightfieldSettings& settings) {
    KeyText key;
    key.add(kHeightfieldMagic);
    addCamera(key, input.camera);
    key.add(input.size.x);
    key.add(input.size.y);
    key.addHash(input.viewDepth);
    key.addHash(input.normal);
    key.addHash(input.isCounted);
    for (const float value : {settings.radius, settings.thickness}) key.add(value);
    for (const std::uint32_t value : {settings.slices, settings.steps, settings.seed}) key.add(value);
    return key.hash();
}

bool loadHeightfield(const std::filesystem::path& folder, const std::string& key, std::vector<float>& map) {
    return loadArrays(fileOf(folder, key), kHeightfieldMagic, {std::as_writable_bytes(std::span(map))});
}

void storeHeightfield(const std::filesystem::path& folder, const std::string& key, const std::vector<float>& map) {
    storeArrays(fileOf(folder, key), kHeightfieldMagic, {std::as_bytes(std::span(map))});
}

}  // namespace crevice
