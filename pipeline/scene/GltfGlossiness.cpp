// KHR_materials_pbrSpecularGlossiness as metallic-roughness: the conversion that the extension's own appendix names,
// by perceived brightness, for each texel.
#include <algorithm>
#include <cmath>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

constexpr float kDielectric = 0.04f;
constexpr float kSmall = 1e-6f;

struct Converted {
    glm::vec3 baseColor{0};
    float metallic = 0;
};

// ITU-R BT.601 luma weights on squares, as HSP colour models take brightness.
float brightness(const glm::vec3& c) { return std::sqrt(0.299f * c.r * c.r + 0.587f * c.g * c.g + 0.114f * c.b * c.b); }

// Equates what both models reflect: a quadratic equation in the metallic share.
float solveMetallic(float diffuse, float specular, float oneMinusSpecular) {
    if (specular < kDielectric) return 0;
    const float b = diffuse * oneMinusSpecular / (1 - kDielectric) + specular - 2 * kDielectric;
    const float c = kDielectric - specular;
    const float root = std::sqrt(std::max(b * b - 4 * kDielectric * c, 0.0f));
    return std::clamp((root - b) / (2 * kDielectric), 0.0f, 1.0f);
}

Converted convert(const glm::vec3& diffuse, const glm::vec3& specular) {
    const float oneMinusSpecular = 1 - std::max({specular.r, specular.g, specular.b});
    Converted to;
    to.metallic = solveMetallic(brightness(diffuse), brightness(specular), oneMinusSpecular);
    const glm::vec3 fromDiffuse = diffuse * (oneMinusSpecular / (1 - kDielectric) / std::max(1 - to.metallic, kSmall));
    const glm::vec3 fromSpecular =
        (specular - glm::vec3(kDielectric * (1 - to.metallic))) / std::max(to.metallic, kSmall);
    to.baseColor = glm::clamp(glm::mix(fromDiffuse, fromSpecular, to.metallic * to.metallic), 0.0f, 1.0f);
    return to;
}

// IEC 61966-2-1.
float fromSrgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }
float toSrgb(float c) { return c <= 0.0031308f ? c * 12.92f : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f; }
glm::vec4 linear(const glm::vec4& c) { return {fromSrgb(c.r), fromSrgb(c.g), fromSrgb(c.b), c.a}; }

std::byte toByte(float value) { return std::byte(std::clamp(int(value * 255 + 0.5f), 0, 255)); }

/// The texel of a map of another size that lies at the same place; white without a map.
glm::vec4 texelAt(const Image* image, std::uint32_t x, std::uint32_t y, glm::uvec2 size) {
    if (!image) return glm::vec4(1);
    const auto scaled = [](std::uint32_t i, std::uint32_t from, std::uint32_t to) {
        return std::uint32_t(std::uint64_t(i) * to / from);
    };
    return linear(image->at(scaled(x, size.x, image->width), scaled(y, size.y, image->height)));
}

const Image* imageOf(const TextureRef& map, const Scene& scene) {
    return map ? &scene.textures[std::size_t(map.texture)].image : nullptr;
}

glm::uvec2 sizeOf(const SpecularGlossiness& from, const Scene& scene) {
    glm::uvec2 size(1);
    for (const Image* image : {imageOf(from.diffuseMap, scene), imageOf(from.specularGlossinessMap, scene)})
        if (image) size = glm::max(size, glm::uvec2(image->width, image->height));
    return size;
}

// Adds two textures of that size: base colour, then metallic-roughness.
void convertTextures(const SpecularGlossiness& from, const glm::uvec2& size, const std::string& name, Scene& scene) {
    const Image* diffuse = imageOf(from.diffuseMap, scene);
    const Image* specular = imageOf(from.specularGlossinessMap, scene);
    SceneTexture color, rough;
    color.name = name + " base colour";
    color.image = Image(size.x, size.y, Format::RGBA8);
    color.srgb = true;
    rough.name = name + " metallic-roughness";
    rough.image = Image(size.x, size.y, Format::RGBA8);
    for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x) {
            const glm::vec4 d = texelAt(diffuse, x, y, size) * from.diffuse;
            const glm::vec4 s = texelAt(specular, x, y, size) * glm::vec4(from.specular, from.glossiness);
            const Converted made = convert(glm::vec3(d), glm::vec3(s));
            std::byte* c = color.image.pixel(x, y);
            for (int i = 0; i < 3; ++i) c[i] = toByte(toSrgb(made.baseColor[i]));
            c[3] = toByte(d.a);
            std::byte* r = rough.image.pixel(x, y);
            r[0] = toByte(1);
            r[1] = toByte(1 - s.a);
            r[2] = toByte(made.metallic);
            r[3] = toByte(1);
        }
    // Both maps are read like the one that is there; if they lie differently, like the diffuse one.
    const TextureRef& like = from.diffuseMap ? from.diffuseMap : from.specularGlossinessMap;
    color.sampler = rough.sampler = scene.textures[std::size_t(like.texture)].sampler;
    scene.textures.push_back(std::move(color));
    scene.textures.push_back(std::move(rough));
}

/// Converts each pair of maps with the same factors once.
class Conversion {
public:
    Conversion(const File& file, std::size_t bytesLeft, Scene& scene)
        : file_(file), bytesLeft_(bytesLeft), scene_(scene) {}

    void convertMaterial(const SpecularGlossiness& from) {
        SceneMaterial& to = scene_.materials[from.material];
        to.baseColorMap = to.metallicRoughnessMap = {};
        if (from.specularGlossinessMap || (from.diffuseMap && brightness(from.specular) > kDielectric)) {
            if (const int first = texturesOf(from, to.name); first >= 0) {
                to.baseColor = glm::vec4(1);
                to.metallic = to.roughness = 1;
                to.baseColorMap = to.metallicRoughnessMap =
                    from.diffuseMap ? from.diffuseMap : from.specularGlossinessMap;
                to.baseColorMap.texture = first;
                to.metallicRoughnessMap.texture = first + 1;
                return;
            }
        }
        // Nothing is metallic: the diffuse map is kept, the numbers are converted for a white texel.
        const Converted made = convert(glm::vec3(from.diffuse), from.specular);
        to.baseColor = glm::vec4(made.baseColor, from.diffuse.a);
        to.metallic = made.metallic;
        to.roughness = 1 - from.glossiness;
        to.baseColorMap = from.diffuseMap;
    }

private:
    using Key = std::array<float, 10>;

    // The first of two textures, or -1 when they do not fit what is left.
    int texturesOf(const SpecularGlossiness& from, const std::string& name) {
        const glm::vec4& d = from.diffuse;
        const glm::vec3& s = from.specular;
        const Key key{float(from.diffuseMap.texture),
                      float(from.specularGlossinessMap.texture),
                      d.r,
                      d.g,
                      d.b,
                      d.a,
                      s.r,
                      s.g,
                      s.b,
                      from.glossiness};
        const auto [entry, isNew] = made_.try_emplace(key, -1);
        if (!isNew) return entry->second;
        const glm::uvec2 size = sizeOf(from, scene_);
        const std::size_t bytes = std::size_t(8) * size.x * size.y;
        if (bytes > bytesLeft_) {
            file_.lack("materials", from.material,
                       "no room for textures converted from specular-glossiness, it is shown without; " +
                           raiseLimit("image-bytes"));
            return -1;
        }
        bytesLeft_ -= bytes;
        entry->second = int(scene_.textures.size());
        convertTextures(from, size, name, scene_);
        return entry->second;
    }

    const File& file_;
    std::size_t bytesLeft_;
    Scene& scene_;
    std::map<Key, int> made_;
};

}  // namespace

void convertSpecularGlossiness(const File& file, const std::vector<SpecularGlossiness>& materials,
                               std::size_t bytesLeft, Scene& scene) {
    Conversion conversion(file, bytesLeft, scene);
    for (const SpecularGlossiness& from : materials) conversion.convertMaterial(from);
}

}  // namespace crevice::gltf
