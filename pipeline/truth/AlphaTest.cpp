// Base colour × texture × vertex colour, as in effects/chunks/standard-base-color.chunk.
#include "truth/AlphaTest.h"

#include <algorithm>
#include <cmath>

namespace crevice {
namespace {

std::uint32_t wrapTexel(int texel, std::uint32_t size, TextureWrap wrap) {
    const int n = static_cast<int>(size);
    if (wrap == TextureWrap::Clamp) return static_cast<std::uint32_t>(std::clamp(texel, 0, n - 1));
    const int period = wrap == TextureWrap::Mirror ? 2 * n : n;
    const int place = ((texel % period) + period) % period;
    return static_cast<std::uint32_t>(place < n ? place : period - 1 - place);
}

/// Keeps texel numbers far inside an int whatever the coordinates are; repeats every second texture width.
float wrapCoordinate(float u, TextureWrap wrap) {
    if (!std::isfinite(u)) return 0;
    return wrap == TextureWrap::Clamp ? std::clamp(u, -1.0f, 2.0f) : u - 2 * std::floor(0.5f * u);
}

}  // namespace

float sampleAlpha(const SceneTexture& texture, const glm::vec2& uv) {
    const Image& image = texture.image;
    const SamplerDesc& sampler = texture.sampler;
    if (image.width == 0 || image.height == 0) return 1;
    const auto at = [&](int x, int y) {
        return image.at(wrapTexel(x, image.width, sampler.wrapU), wrapTexel(y, image.height, sampler.wrapV)).a;
    };
    const glm::vec2 place(wrapCoordinate(uv.x, sampler.wrapU) * float(image.width),
                          wrapCoordinate(uv.y, sampler.wrapV) * float(image.height));
    if (!sampler.linearMag) return at(int(std::floor(place.x)), int(std::floor(place.y)));
    const glm::vec2 corner = glm::floor(place - 0.5f), part = place - 0.5f - corner;
    const int x = int(corner.x), y = int(corner.y);
    return glm::mix(glm::mix(at(x, y), at(x + 1, y), part.x), glm::mix(at(x, y + 1), at(x + 1, y + 1), part.x), part.y);
}

bool passesAlphaTest(const Scene& scene, const Mesh& mesh, const SceneMaterial& material, std::uint32_t primitive,
                     const glm::vec2& barycentric) {
    const std::uint32_t* index = &mesh.indices[std::size_t(3) * primitive];
    const glm::vec3 weight(1 - barycentric.x - barycentric.y, barycentric.x, barycentric.y);
    float alpha = 0;
    glm::vec2 uv(0);
    for (int i = 0; i < 3; ++i) {
        const Vertex& vertex = mesh.vertices[index[i]];
        alpha += weight[i] * vertex.color.a;
        uv += weight[i] * texcoordOf(vertex, material.baseColorMap.texcoord);
    }
    alpha *= material.baseColor.a;
    if (material.baseColorMap)
        alpha *= sampleAlpha(scene.textures[static_cast<std::size_t>(material.baseColorMap.texture)],
                             material.baseColorMap.transform.apply(uv));
    return !(alpha < material.alphaCutoff);
}

}  // namespace crevice
