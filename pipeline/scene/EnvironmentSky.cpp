// Environments that are computed: gradients between zenith, horizon and nadir.
#include <cmath>

#include "scene/Environment.h"
#include "scene/Scene.h"

namespace crevice {
namespace {

constexpr std::uint32_t kHeight = 128;
constexpr float kSoftness = 0.5f;  // as the property of skybox.effect is by default

}  // namespace

Environment skyEnvironment(const Sky& sky) {
    Image image(2 * kHeight, kHeight, Format::RGBA32F);
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        const auto height = static_cast<float>(equirectDirection(0, y, image.width, kHeight).y);
        const glm::vec3 away = height >= 0 ? sky.zenith : sky.nadir;
        const glm::vec3 color = glm::mix(sky.horizon, away, std::pow(std::abs(height), kSoftness));
        auto* row = reinterpret_cast<glm::vec4*>(image.pixel(0, y));
        for (std::uint32_t x = 0; x < image.width; ++x) row[x] = glm::vec4(color, 1);
    }
    return makeEnvironment(std::move(image), "sky", Log(LogLevel::Error));
}

Environment defaultEnvironment() {
    // Of a gradient a level surface receives a fifth from the horizon and four fifths from its end: 0.42 from above,
    // 0.25 from below. The default key light adds 0.32 to the former.
    Environment environment =
        skyEnvironment({.zenith = {0.28f, 0.3f, 0.33f}, .horizon = {0.9f, 0.9f, 0.9f}, .nadir = {0.1f, 0.09f, 0.08f}});
    environment.visible = false;
    return environment;
}

}  // namespace crevice
