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

void convertTextures(const SpecularGlossiness& from, SceneMaterial& to, Scene& scene) {
    const auto imageOf = [&](const TextureRef& ref) {
        return ref ? &scene.textures[std::size_t(ref.texture)].image : nullptr;
    };
    const Image* diffuse = imageOf(from.diffuseMap);
    const Image* specular = imageOf(from.specularGlossinessMap);
    glm::uvec2 size(1);
    for (const Image* image : {diffuse, specular})
        if (image) size = glm::max(size, glm::uvec2(image->width, image->height));
    SceneTexture color, rough;
    color.name = to.name + " base colour";
    color.image = Image(size.x, size.y, Format::RGBA8);
    color.srgb = true;
    rough.name = to.name + " metallic-roughness";
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
    to.baseColor = glm::vec4(1);
    to.metallic = to.roughness = 1;
    to.baseColorMap = to.metallicRoughnessMap = like;
    to.baseColorMap.texture = int(scene.textures.size());
    scene.textures.push_back(std::move(color));
    to.metallicRoughnessMap.texture = int(scene.textures.size());
    scene.textures.push_back(std::move(rough));
}

}  // namespace

void convertSpecularGlossiness(const std::vector<SpecularGlossiness>& materials, Scene& scene) {
    for (const SpecularGlossiness& from : materials) {
        SceneMaterial& to = scene.materials[from.material];
        to.baseColorMap = to.metallicRoughnessMap = {};
        if (from.specularGlossinessMap || (from.diffuseMap && brightness(from.specular) > kDielectric)) {
            convertTextures(from, to, scene);
            continue;
        }
        // Nothing is metallic: the diffuse map is kept, the numbers are converted for a white texel.
        const Converted made = convert(glm::vec3(from.diffuse), from.specular);
        to.baseColor = glm::vec4(made.baseColor, from.diffuse.a);
        to.metallic = made.metallic;
        to.roughness = 1 - from.glossiness;
        to.baseColorMap = from.diffuseMap;
    }
}

}  // namespace crevice::gltf
