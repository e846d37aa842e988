// Environments that are computed: gradients between zenith, horizon and nadir, and a studio with three lamps.
#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/Environment.h"
#include "scene/Scene.h"

namespace crevice {
namespace {

constexpr std::uint32_t kHeight = 128;
constexpr float kSoftness = 0.5f;  // as the property of skybox.effect is by default

Image gradient(const Sky& sky) {
    Image image(2 * kHeight, kHeight, Format::RGBA32F);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        const auto height = static_cast<float>(equirectDirection(0, y, image.width, kHeight).y);
        const glm::vec3 away = height >= 0 ? sky.zenith : sky.nadir;
        const glm::vec3 color = glm::mix(sky.horizon, away, std::pow(std::abs(height), kSoftness));
        auto* row = reinterpret_cast<glm::vec4*>(image.pixel(0, y));
        for (std::uint32_t x = 0; x < image.width; ++x) row[x] = glm::vec4(color, 1);
    }
    return image;
}

/// A lamp behind a rectangle of cloth, infinitely far away.
struct SoftBox {
    glm::vec3 towards;   ///< Its middle, any length.
    glm::vec2 halfSize;  ///< Tangents of the angles that its halves span.
    float radiance;
};
// Above on the key light's side, a narrow weak one at the viewer's right, and a flat one behind that draws edges.
constexpr SoftBox kStudio[] = {{{-0.5f, 0.8f, 0.45f}, {0.26f, 0.2f}, 3.0f},
                               {{1.0f, 0.35f, 0.6f}, {0.14f, 0.4f}, 1.8f},
                               {{-0.3f, 0.5f, -1.0f}, {0.5f, 0.1f}, 2.5f}};
constexpr glm::vec3 kStudioZenith{0.145f, 0.15f, 0.16f}, kStudioHorizon{0.5f}, kStudioNadir{0.105f, 0.1f, 0.095f};

// 1 inside, 0 outside, smooth over a fifth of the half size.
float within(float tangent, float half) {
    constexpr float kEdge = 0.2f;
    const float t = std::clamp((1 + kEdge - std::abs(tangent) / half) / kEdge, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

void addBox(Image& image, const SoftBox& box) {
    const glm::vec3 axis = glm::normalize(box.towards);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), axis));
    const glm::vec3 up = glm::cross(axis, right);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        auto* row = reinterpret_cast<glm::vec4*>(image.pixel(0, y));
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const glm::vec3 direction(equirectDirection(x, y, image.width, image.height));
            const float along = glm::dot(direction, axis);
            if (along <= 0) continue;
            const float share = within(glm::dot(direction, right) / along, box.halfSize.x) *
                                within(glm::dot(direction, up) / along, box.halfSize.y);
            row[x] += glm::vec4(glm::vec3(share * box.radiance), 0);
        }
    }
}

}  // namespace

Environment skyEnvironment(const Sky& sky) { return makeEnvironment(gradient(sky), "sky", Log(LogLevel::Error)); }

Environment defaultEnvironment() {
    Image image = gradient({.zenith = kStudioZenith, .horizon = kStudioHorizon, .nadir = kStudioNadir});
    for (const SoftBox& box : kStudio) addBox(image, box);
    Environment environment = makeEnvironment(std::move(image), "studio", Log(LogLevel::Error));
    environment.visible = false;
    return environment;
}

}  // namespace crevice
