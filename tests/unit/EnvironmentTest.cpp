// Panoramas: directions, bad texels, diffuse light; each against numbers worked out by hand.
#include "scene/Environment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "SceneTestTools.h"
#include "scene/Scene.h"

namespace crevice {
namespace {

using test::contains;

constexpr double kPi = 3.14159265358979323846;

glm::vec4& texel(Image& image, std::uint32_t x, std::uint32_t y) {
    return *reinterpret_cast<glm::vec4*>(image.pixel(x, y));
}

Image panorama(std::uint32_t height, const glm::vec3& color) {
    Image image(2 * height, height, Format::RGBA32F);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < 2 * height; ++x) texel(image, x, y) = glm::vec4(color, 1);
    return image;
}

Environment environmentOf(Image image) { return makeEnvironment(std::move(image), "test", Log(LogLevel::Error)); }

TEST(Environment, TheMiddleIsPlusXAndThreeQuartersPlusZ) {
    // Texel edges: column 4 of 8 begins at the middle of the picture, column 6 at three quarters.
    const auto expectNear = [](const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), 1e-9); };
    expectNear(equirectDirection(3.5, 1.5, 8, 4), {1, 0, 0});
    expectNear(equirectDirection(5.5, 1.5, 8, 4), {0, 0, 1});
    expectNear(equirectDirection(1.5, 1.5, 8, 4), {0, 0, -1});
    expectNear(equirectDirection(-0.5, 1.5, 8, 4), {-1, 0, 0});
    expectNear(equirectDirection(0, -0.5, 8, 4), {0, 1, 0});
    expectNear(equirectDirection(5, 3.5, 8, 4), {0, -1, 0});
}

TEST(Environment, SamplingIsTheTexelAtItsCentreAndTheMeanAtTheWrap) {
    Image image = panorama(4, glm::vec3(0));
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) texel(image, x, y) = glm::vec4(float(10 * y + x), 0, 0, 1);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x)
            EXPECT_NEAR(sampleEquirect(image, glm::vec3(equirectDirection(x, y, 8, 4))).r, float(10 * y + x), 1e-4);
    // Half-way between the last and the first column of row 1: (17 + 10) / 2.
    EXPECT_NEAR(sampleEquirect(image, glm::vec3(equirectDirection(7.5, 1, 8, 4))).r, 13.5f, 1e-4);
    EXPECT_NEAR(sampleEquirect(image, glm::vec3(equirectDirection(-0.5, 1, 8, 4))).r, 13.5f, 1e-4);
}

TEST(Environment, AcrossThePoleLiesTheOtherSide) {
    Image image = panorama(4, glm::vec3(0));
    for (std::uint32_t x = 0; x < 8; ++x) texel(image, x, 0) = glm::vec4(float(x), 0, 0, 1);
    // Just beside the pole, between the columns 1 and 1 + 4 of the top row: their mean, from either side.
    const glm::vec3 at = sampleEquirect(image, glm::vec3(equirectDirection(1, -0.4999, 8, 4)));
    const glm::vec3 opposite = sampleEquirect(image, glm::vec3(equirectDirection(5, -0.4999, 8, 4)));
    EXPECT_NEAR(at.r, 3.0f, 1e-2);
    EXPECT_NEAR(opposite.r, 3.0f, 1e-2);
}

TEST(Environment, AUniformOneLightsEveryNormalAlike) {
    const Environment environment = environmentOf(panorama(16, {0.25f, 1, 4}));
    for (const glm::vec3& normal :
         {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1), glm::normalize(glm::vec3(1, -2, 3))}) {
        const glm::vec3 diffuse = environment.diffuse(normal);
        EXPECT_NEAR(diffuse.r, 0.25, 1e-6);
        EXPECT_NEAR(diffuse.g, 1, 4e-6);
        EXPECT_NEAR(diffuse.b, 4, 1.6e-5);
    }
}

/// One bright texel of 64 x 32 and its solid angle.
struct Spot {
    Environment environment;
    glm::vec3 direction;
    double solidAngle;
};
Spot spotAt(std::uint32_t x, std::uint32_t y, float radiance) {
    Image image = panorama(32, glm::vec3(0));
    texel(image, x, y) = glm::vec4(radiance, radiance, radiance, 1);
    const double angle = (std::cos(kPi * y / 32) - std::cos(kPi * (y + 1) / 32)) * 2 * kPi / 64;
    return {environmentOf(std::move(image)), glm::vec3(equirectDirection(x, y, 64, 32)), angle};
}

TEST(Environment, ABrightTexelFollowsTheCosineAsFarAsOrderTwoCan) {
    for (const auto& [x, y] : {std::pair{5u, 3u}, std::pair{40u, 16u}, std::pair{63u, 28u}}) {
        const Spot spot = spotAt(x, y, 1e4f);
        const double full = 1e4 * spot.solidAngle / kPi;  // irradiance / pi of a surface that faces it
        const glm::vec3 side = glm::normalize(glm::cross(spot.direction, glm::vec3(0.3f, 0.8f, -0.5f)));
        for (const double degrees : {0.0, 30.0, 45.0, 60.0, 90.0, 120.0, 180.0}) {
            const double angle = degrees * kPi / 180, c = std::cos(angle);
            const glm::vec3 normal = float(c) * spot.direction + float(std::sin(angle)) * side;
            const double lit = spot.environment.diffuse(normal).g;
            // The formula of the header, and the cosine itself within what Ramamoorthi and Hanrahan give for order 2.
            EXPECT_NEAR(lit / full, std::max(0.0, 0.25 + c / 2 + 5 * (3 * c * c - 1) / 32), 2e-3) << degrees;
            EXPECT_NEAR(lit / full, std::max(0.0, c), 0.1) << degrees;
        }
    }
}

TEST(Environment, TurningTakesTheLightAlong) {
    Image image = panorama(32, glm::vec3(0));
    for (std::uint32_t y = 8; y < 24; ++y)
        for (std::uint32_t x = 28; x < 36; ++x) texel(image, x, y) = glm::vec4(1, 1, 1, 1);  // around the middle: +X
    Environment environment = environmentOf(std::move(image));
    const float towards = environment.diffuse({1, 0, 0}).r, away = environment.diffuse({0, 0, -1}).r;
    ASSERT_GT(towards, 3 * away);
    environment.rotation = float(kPi / 2);  // the middle now is -Z
    EXPECT_NEAR(environment.diffuse({0, 0, -1}).r, towards, 1e-5);
    EXPECT_NEAR(environment.diffuse({1, 0, 0}).r, environment.diffuse({-1, 0, 0}).r, 1e-5);
    environment.intensity = 3;
    EXPECT_NEAR(environment.diffuse({0, 0, -1}).r, 3 * towards, 3e-5);
}

TEST(Environment, BadTexelsAreClampedWithANote) {
    Image image = panorama(4, glm::vec3(1));
    texel(image, 0, 0).r = std::numeric_limits<float>::quiet_NaN();
    texel(image, 1, 0).g = -2;
    texel(image, 2, 0).b = std::numeric_limits<float>::infinity();
    texel(image, 3, 0).b = -std::numeric_limits<float>::infinity();
    texel(image, 4, 1).r = 1e4f;
    test::Listener listener;
    const Environment environment = makeEnvironment(std::move(image), "bad.exr", listener.log);
    EXPECT_EQ(environment.radiance.at(0, 0).r, 0);
    EXPECT_EQ(environment.radiance.at(1, 0).g, 0);
    EXPECT_EQ(environment.radiance.at(2, 0).b, 1e9f);
    EXPECT_EQ(environment.radiance.at(3, 0).b, 0);
    EXPECT_EQ(environment.radiance.at(4, 1).r, 1e4f);
    for (const glm::vec3& c : environment.harmonics) EXPECT_TRUE(std::isfinite(c.r + c.g + c.b));
    EXPECT_TRUE(contains(listener.text, "'bad.exr': 1 texel not a number")) << listener.text;
    EXPECT_TRUE(contains(listener.text, "2 texels negative")) << listener.text;
    EXPECT_TRUE(contains(listener.text, "1 texel brighter than 1e9")) << listener.text;
}

TEST(Environment, AnythingButAPanoramaIsRefused) {
    const std::string message = test::errorOf([] { environmentOf(Image(8, 8, Format::RGBA32F)); });
    EXPECT_TRUE(contains(message, "'test' is 8 x 8 pixels")) << message;
    EXPECT_TRUE(contains(message, "twice as wide as high")) << message;
}

TEST(Environment, TheDefaultLightsLevelSurfacesAsDocumented) {
    const Environment environment = defaultEnvironment();
    EXPECT_FALSE(environment.visible);
    // Of a gradient a level surface receives a fifth from the horizon and four fifths from its end: 0.22 and 0.18. A
    // soft box that spans a solid angle w around a direction with height h adds radiance * w * h / pi; with its soft
    // edge a box is a tenth wider and higher on all sides: they span 0.236, 0.245 and 0.211 sr.
    // Order 2 may miss 6 % of a small lamp's peak, here 0.3, and 5 % of a gradient.
    const double boxes = (3 * 0.236 * 0.765 + 1.8 * 0.245 * 0.287 + 2.5 * 0.211 * 0.432) / kPi;
    EXPECT_NEAR(environment.diffuse({0, 1, 0}).g, 0.22 + boxes, 0.03);
    EXPECT_NEAR(environment.diffuse({0, -1, 0}).g, 0.18, 0.03);
    // Something bright for mirrors: the boxes' middles.
    for (const glm::vec3& middle :
         {glm::vec3(-0.5f, 0.8f, 0.45f), glm::vec3(1, 0.35f, 0.6f), glm::vec3(-0.3f, 0.5f, -1)})
        EXPECT_GT(sampleEquirect(environment.radiance, glm::normalize(middle)).g, 1.8f);
}

TEST(Environment, TheSkyIsTheGradientThatTheStageDraws) {
    const Sky sky{.enabled = true, .zenith = {1, 2, 3}, .horizon = {4, 4, 4}, .nadir = {0, 1, 0}};
    const Environment environment = skyEnvironment(sky);
    // Half-way up, h = sin 30°: horizon + (zenith - horizon) sqrt(0.5).
    const glm::vec3 at = sampleEquirect(environment.radiance, glm::normalize(glm::vec3(std::sqrt(3.0f), 1, 0)));
    EXPECT_NEAR(at.r, 4 - 3 * std::sqrt(0.5), 5e-3);
    EXPECT_NEAR(at.g, 4 - 2 * std::sqrt(0.5), 5e-3);
    EXPECT_NEAR(at.b, 4 - 1 * std::sqrt(0.5), 5e-3);
    EXPECT_NEAR(sampleEquirect(environment.radiance, {0, -1, 0}).g, 1, 5e-2);
}

}  // namespace
}  // namespace crevice
