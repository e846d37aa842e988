// The grid of lights: every light is listed wherever it reaches, few lists are long, and lights without an end are
// found.
#include "flow/LightGrid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

namespace crevice {
namespace {

Light pointLight(const glm::vec3& position, float range, float intensity = 1) {
    Light light;
    light.type = LightType::Point;
    light.position = position;
    light.range = range;
    light.intensity = intensity;
    return light;
}

Aabb box(const glm::vec3& low, const glm::vec3& high) {
    Aabb result;
    result.add(low);
    result.add(high);
    return result;
}

// As lightsNear() and lightAt() in cc-lights.chunk read it.
std::vector<std::uint32_t> lightsAt(const LightGrid& grid, const glm::vec3& point) {
    const std::uint32_t cells = grid.size.x * grid.size.y * grid.size.z;
    std::vector<std::uint32_t> lights(grid.words.begin() + cells + 1, grid.words.begin() + cells + 1 + grid.everywhere);
    const glm::vec3 cell = glm::floor((point - grid.origin) * grid.cellsPerUnit);
    if (glm::any(glm::lessThan(cell, glm::vec3(0))) || glm::any(glm::greaterThanEqual(cell, glm::vec3(grid.size))))
        return lights;
    const std::uint32_t index =
        std::uint32_t(cell.x) + grid.size.x * (std::uint32_t(cell.y) + grid.size.y * std::uint32_t(cell.z));
    lights.insert(lights.end(), grid.words.begin() + grid.words[index], grid.words.begin() + grid.words[index + 1]);
    return lights;
}

using Indices = std::vector<std::uint32_t>;

TEST(LightGrid, WithoutLightsEveryListIsEmpty) {
    const LightGrid grid = makeLightGrid({}, box({-1, -1, -1}, {1, 1, 1}), 1);
    EXPECT_EQ(lightsAt(grid, {0, 0, 0}), Indices{});
    EXPECT_EQ(lightsAt(grid, {9, -9, 9}), Indices{});
}

TEST(LightGrid, TheMainLightIsNotCountedAndOtherDirectionalOnesAreEverywhere) {
    Scene scene;
    scene.lights = {pointLight({50, 0, 0}, 1), Light{}, Light{}};  // the first directional light is the main one
    const LightGrid grid = makeLightGrid(scene, box({-100, -1, -1}, {100, 1, 1}), 1);
    EXPECT_EQ(lightsAt(grid, {-50, 0, 0}), Indices{1});
    EXPECT_EQ(lightsAt(grid, {50, 0, 0}), (Indices{1, 0}));
}

// The rule of the grid: whatever is within a light's range finds the light. And the other way round the lists are worth
// having: on the mean a point finds few more lights than reach it.
TEST(LightGrid, EveryPointFindsTheLightsThatReachIt) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-10, 10), reach(0.3f, 1.5f);
    Scene scene;
    for (int i = 0; i < 1000; ++i)
        scene.lights.push_back(pointLight({place(random), place(random), place(random)}, reach(random)));
    const LightGrid grid = makeLightGrid(scene, box({-10, -10, -10}, {10, 10, 10}), 1);
    std::size_t reaching = 0, listed = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 point(place(random), place(random), place(random));
        const Indices found = lightsAt(grid, point);
        listed += found.size();
        for (std::uint32_t light = 0; light < scene.lights.size(); ++light) {
            if (glm::distance(point, scene.lights[light].position) >= scene.lights[light].range) continue;
            ++reaching;
            EXPECT_NE(std::find(found.begin(), found.end(), light), found.end()) << "light " << light;
        }
    }
    EXPECT_GT(reaching, 500u);
    EXPECT_LT(listed, 3 * reaching);
}

TEST(LightGrid, HugeLightsDoNotMakeHugeLists) {
    Scene scene;
    for (int i = 0; i < 1000; ++i) scene.lights.push_back(pointLight({float(i) * 0.01f, 0, 0}, 90));
    const LightGrid grid = makeLightGrid(scene, box({-100, -100, -100}, {100, 100, 100}), 1);
    EXPECT_LT(grid.words.size(), std::size_t(3) << 20);
    EXPECT_EQ(lightsAt(grid, {0, 0, 0}).size(), 1000u);
}

TEST(LightGrid, ALightThatReachesAllIsEverywhere) {
    Scene scene;
    scene.lights = {pointLight({0, 0, 0}, 2)};
    const LightGrid grid = makeLightGrid(scene, box({-1, -1, -1}, {1, 1, 1}), 1);
    EXPECT_EQ(grid.everywhere, 1u);
    EXPECT_EQ(lightsAt(grid, {0.9f, 0.9f, 0.9f}), Indices{0});
}

// 1 candela, exposure 1: radiance of white matter that faces it is 1 / (pi d²). Half of 1/255 where sRGB is linear is
// 1 / (2 · 255 · 12.92) = 1.5176e-4, so d = sqrt(1 / (pi · 1.5176e-4)) = 45.80.
TEST(LightGrid, WithoutARangeALightEndsWhereItCannotBeSeen) {
    EXPECT_NEAR(negligibleDistance(pointLight({0, 0, 0}, 0), 1, 1), 45.80f, 0.01f);
    EXPECT_NEAR(negligibleDistance(pointLight({0, 0, 0}, 0, 4), 1, 1), 91.60f, 0.02f);
    EXPECT_NEAR(negligibleDistance(pointLight({0, 0, 0}, 0), 1, 100), 458.0f, 0.1f) << "a hundred together";

    Scene scene;
    scene.lights = {pointLight({0, 0, 0}, 0)};
    const LightGrid grid = makeLightGrid(scene, box({-200, -1, -1}, {200, 1, 1}), 1);
    EXPECT_EQ(lightsAt(grid, {45, 0, 0}), Indices{0});
    EXPECT_EQ(lightsAt(grid, {80, 0, 0}), Indices{});
}

TEST(LightGrid, FlatAndPointLikeBoundsAreFine) {
    Scene scene;
    scene.lights = {pointLight({0, 0, 0}, 1), pointLight({5, 0, 0}, 1)};
    for (const glm::vec3& extent : {glm::vec3(6, 0, 6), glm::vec3(6, 0, 0), glm::vec3(6, 1e-7f, 6)}) {
        const LightGrid grid = makeLightGrid(scene, box(-extent, extent), 1);
        EXPECT_EQ(lightsAt(grid, {0, 0, 0}), Indices{0});
        EXPECT_EQ(lightsAt(grid, {5, 0, 0}), Indices{1});
    }
}

TEST(LightGrid, BytesAreAsTheChunkDeclaresThem) {
    Scene scene;
    scene.lights = {pointLight({0, 0, 0}, 1), Light{}, Light{}};
    const LightGrid grid = makeLightGrid(scene, box({-9, -9, -9}, {9, 9, 9}), 1);
    const std::vector<std::byte> bytes = lightGridBytes(grid);
    ASSERT_EQ(bytes.size(), 48 + 4 * grid.words.size());
    glm::vec4 origin, cells;
    glm::uvec4 size;
    std::memcpy(&origin, bytes.data(), 16);
    std::memcpy(&cells, bytes.data() + 16, 16);
    std::memcpy(&size, bytes.data() + 32, 16);
    EXPECT_EQ(glm::vec3(origin), grid.origin);
    EXPECT_EQ(glm::vec3(cells), grid.cellsPerUnit);
    EXPECT_EQ(size, glm::uvec4(grid.size, 1));
}

}  // namespace
}  // namespace crevice
