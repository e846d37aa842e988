// The heightfield reference against closed formulas where the whole occluder is on the screen, and what it must not
// see.
#include <algorithm>

#include "TruthTools.h"
#include "truth/CameraRay.h"
#include "truth/HeightfieldReference.h"

namespace crevice::test {
namespace {

constexpr double kPi = glm::pi<double>();

/// Depth and normals of a scene as rays meet it.
struct Seen {
    AmbientMap map;
    Camera camera;

    Seen(const Scene& scene, const Camera& from, const glm::uvec2& size) : camera(from) {
        map = traceAmbient(scene, camera, size, {.samples = 2});
    }
    HeightfieldInput input() const { return {map.size, camera, map.viewDepth, map.normal}; }
    glm::vec3 positionAt(std::uint32_t x, std::uint32_t y) const {
        const Ray ray = makeCameraRay(camera, glm::vec2(x, y) + 0.5f, map.size);
        return ray.origin + map.viewDepth[std::size_t(y) * map.size.x + x] * ray.direction;
    }
};

Camera looking(const glm::vec3& eye, const glm::vec3& target, float degrees, const glm::vec3& up = {0, 1, 0}) {
    Camera camera = Camera::lookAt(eye, target, up);
    camera.fovY = glm::radians(degrees);
    camera.near = 0.01f;
    camera.far = 1000;
    return camera;
}

Camera parallel(Camera camera, float height) {
    camera.orthographic = true;
    camera.orthoHeight = height;
    return camera;
}

struct Errors {
    double largest = 0, mean = 0, bias = 0;
    int count = 0;
};

/// Of the pixels whose place on the scene `exact` knows (a value below 0: not this one).
template <class Exact>
Errors compare(const Seen& seen, const HeightfieldSettings& settings, Exact&& exact) {
    std::vector<double> expected(seen.map.isCounted.size(), -1.0);
    std::vector<std::uint8_t> asked(expected.size(), 0);
    for (std::uint32_t y = 0; y < seen.map.size.y; ++y) {
        for (std::uint32_t x = 0; x < seen.map.size.x; ++x) {
            const std::size_t i = std::size_t(y) * seen.map.size.x + x;
            if (seen.map.isCounted[i]) expected[i] = exact(seen.positionAt(x, y));
            asked[i] = expected[i] >= 0;
        }
    }
    HeightfieldInput input = seen.input();
    input.isCounted = asked;
    const std::vector<float> map = traceHeightfield(input, settings);
    Errors errors;
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (!asked[i]) continue;
        const double off = double(map[i]) - expected[i];
        errors.largest = std::max(errors.largest, std::abs(off));
        errors.mean += std::abs(off);
        errors.bias += off;
        ++errors.count;
    }
    errors.mean /= std::max(1, errors.count);
    errors.bias /= std::max(1, errors.count);
    return errors;
}

void expectClose(const Errors& errors, int leastCount) {
    EXPECT_GT(errors.count, leastCount);
    EXPECT_LE(errors.largest, 0.01) << "mean " << errors.mean << ", bias " << errors.bias;
}

constexpr float kThicknesses[] = {0.5f, std::numeric_limits<float>::infinity()};

Scene corner(int walls) {
    Scene scene = whiteScene();
    scene.materials[0].doubleSided = true;
    addFloor(scene, 8);
    addWallX(scene, 0, 8, 8);
    if (walls > 1) addWallZ(scene, 0, 8, 8);
    return scene;
}

TEST(TruthHeightfield, PlanesAreOpenAtAnyTilt) {
    for (const float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
        Scene scene = whiteScene();
        addObject(scene, makePlane(glm::vec2(400), 4),
                  glm::rotate(glm::mat4(1), glm::radians(degrees), glm::vec3(0.6f, 0, 0.8f)));
        const Camera camera = looking({0, 6, 0}, {0, 0, 0}, 14, {0, 0, -1});
        for (const Camera& view : {camera, parallel(camera, 1.5f)}) {
            const Seen seen(scene, view, {24, 18});
            for (const float thickness : kThicknesses) {
                const auto errors = compare(seen, {.radius = 1, .thickness = thickness, .slices = 4},
                                            [](const glm::vec3&) { return 1.0; });
                EXPECT_GT(errors.count, 400);
                EXPECT_LE(errors.largest, 1e-3) << degrees << " " << view.orthographic << " " << thickness;
            }
        }
    }
}

TEST(TruthHeightfield, FloorAtAWall) {
    const Camera camera = looking({4, 4, 0.3f}, {0.4f, 0.4f, 0}, 40);
    for (const Camera& view : {camera, parallel(camera, 3.6f)}) {
        const Seen seen(corner(1), view, {48, 48});
        for (const float thickness : kThicknesses) {
            const auto errors = compare(seen, {.radius = 1, .thickness = thickness}, [](const glm::vec3& p) {
                const bool isFloor = p.y < 1e-4f && p.x > 0.1f && p.x < 1.1f && std::abs(p.z) < 0.3f;
                return isFloor ? 1 - segmentArea(double(p.x)) / kPi : -1;
            });
            expectClose(errors, 60);
        }
    }
}

TEST(TruthHeightfield, CornerOfARoom) {
    const Camera camera = looking({4, 3, 4}, {0.4f, 0.4f, 0.4f}, 40);
    const Seen seen(corner(2), camera, {64, 64});
    for (const float thickness : kThicknesses) {
        const auto errors = compare(seen, {.radius = 1, .thickness = thickness}, [](const glm::vec3& p) {
            const bool isFloor = p.y < 1e-4f && p.x > 0.1f && p.z > 0.1f && p.x < 1.1f && p.z < 1.1f;
            return isFloor ? cornerOpenness(double(p.x), double(p.z)) : -1;
        });
        expectClose(errors, 100);
    }
}

// Faces reach farther than the radius. At .05 of the radius from the edge the groove is as open as an infinite one.
TEST(TruthHeightfield, Grooves) {
    for (const float degrees : {60.0f, 90.0f, 120.0f}) {
        const double half = 0.5 * glm::radians(double(degrees));
        Scene scene = whiteScene();
        scene.materials[0].doubleSided = true;
        const glm::vec3 along(0, 0, 2), left(-2 * std::sin(half), 2 * std::cos(half), 0);
        const glm::vec3 right(-left.x, left.y, 0);
        addQuad(scene, -along, right - along, right + along, along);
        addQuad(scene, -along, left - along, left + along, along);
        const Camera camera = parallel(looking({0, 9, 0}, {0, 0, 0}, 40, {0, 0, -1}), 3);
        const Seen seen(scene, camera, {96, 96});
        for (const float thickness : kThicknesses) {
            const auto errors = compare(seen, {.radius = 1, .thickness = thickness}, [&](const glm::vec3& p) {
                const double distance = std::hypot(double(p.x), double(p.y));
                return distance > 0.04 && distance < 1.2 && std::abs(p.z) < 0.05f ? grooveOpenness(2 * half, distance)
                                                                                  : -1;
            });
            expectClose(errors, 20);
        }
    }
    EXPECT_NEAR(grooveOpenness(glm::half_pi<double>(), 1e-9), 0.5, 1e-6);
}

// A bowl of 70° from its lowest point to the rim: what is missing of the sphere is what is open, everywhere.
TEST(TruthHeightfield, InsideOfABowl) {
    Scene scene = whiteScene();
    scene.materials[0].doubleSided = true;
    const float rim = -std::cos(glm::radians(70.0f));
    Mesh bowl = makeSphere(1, 720);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < bowl.indices.size(); i += 3) {
        float top = -1;
        for (std::size_t c = 0; c < 3; ++c) top = std::max(top, bowl.vertices[bowl.indices[i + c]].position.y);
        if (top < rim + 1e-5f) kept.insert(kept.end(), bowl.indices.begin() + i, bowl.indices.begin() + i + 3);
    }
    bowl.indices = kept;
    addObject(scene, bowl);
    const Camera camera = looking({0, 12, 0}, {0, 0, 0}, 9.4f, {0, 0, -1});
    for (const Camera& view : {camera, parallel(camera, 2)}) {
        const Seen seen(scene, view, {192, 192});
        const auto errors = compare(seen, {.radius = 100, .slices = 32}, [&](const glm::vec3& p) {
            return p.x > 0 && p.x < 0.8f && std::abs(p.z) < 0.02f ? 0.5 * (1 - double(rim)) : -1;
        });
        expectClose(errors, 100);
    }
}

// A slab over the floor, seen from above, hides the floor: nothing below it can be measured, and what is seen of the
// slab is open. A screen full of it knows of no occlusion at all.
TEST(TruthHeightfield, WhatIsNotOnTheScreenDoesNotOcclude) {
    Scene scene = corner(1);
    const Camera camera = parallel(looking({1.2f, 4, 0}, {1.2f, 0, 0}, 40, {0, 0, -1}), 2);  // straight down: no wall
    const Seen seen(scene, camera, {24, 24});
    const auto errors = compare(seen, {.radius = 1}, [](const glm::vec3& p) { return p.x > 0.3f ? 1.0 : -1; });
    EXPECT_GT(errors.count, 300);
    EXPECT_LE(errors.largest, 1e-6);
}

// A thin board ten radii before a floor: neither darkens the other.
TEST(TruthHeightfield, RadiusLimits) {
    Scene scene = whiteScene();
    addFloor(scene, 40);
    addQuad(scene, {-1, 10, 1}, {1, 10, 1}, {1, 10, -1}, {-1, 10, -1});
    const Seen seen(scene, looking({0, 30, 0}, {0, 0, 0}, 20, {0, 0, -1}), {48, 48});
    for (const float thickness : kThicknesses) {
        const auto errors = compare(seen, {.radius = 1, .thickness = thickness}, [](const glm::vec3&) { return 1.0; });
        EXPECT_EQ(errors.count, 48 * 48);
        EXPECT_LE(errors.largest, 1e-4);
    }
}

// A rail over the floor, seen from one side: how much of the view below it the floor behind it keeps is a matter of
// what is taken to lie behind the rail.
TEST(TruthHeightfield, ThicknessIsWhatLiesBehind) {
    Scene scene = whiteScene();
    scene.materials[0].doubleSided = true;
    addFloor(scene, 8);
    addQuad(scene, {0, 0.4f, -8}, {0, 0.4f, 8}, {0, 0.5f, 8}, {0, 0.5f, -8});
    const Seen seen(scene, looking({4, 4, 0}, {0, 0.2f, 0}, 30), {48, 48});
    double thin = 0;
    for (const float thickness : {0.01f, 0.5f, std::numeric_limits<float>::infinity()}) {
        const std::vector<float> map = traceHeightfield(seen.input(), {.radius = 1, .thickness = thickness});
        double mean = 0;
        int count = 0;
        for (std::uint32_t y = 0; y < 48; ++y) {
            for (std::uint32_t x = 0; x < 48; ++x) {
                const glm::vec3 p = seen.positionAt(x, y);
                if (p.y > 1e-4f || p.x > -0.6f || p.x < -0.8f) continue;
                mean += static_cast<double>(map[y * 48 + x]);
                ++count;
            }
        }
        ASSERT_GT(count, 30);
        if (thickness < 0.1f) thin = mean / count;
        EXPECT_TRUE(thickness < 0.1f || mean / count < thin - 0.02) << thickness << ": " << mean / count;
    }
}

TEST(TruthHeightfield, ThreadsChangeNoBitAndMasksChooseThePixels) {
    const Seen seen(corner(2), looking({4, 3, 4}, {0.4f, 0.4f, 0.4f}, 40), {20, 16});
    HeightfieldSettings settings{.radius = 1, .slices = 4, .threads = 1};
    const std::vector<float> one = traceHeightfield(seen.input(), settings);
    settings.threads = 5;
    EXPECT_EQ(one, traceHeightfield(seen.input(), settings));
    HeightfieldInput some = seen.input();
    std::vector<std::uint8_t> mask(one.size(), 1);
    for (std::size_t i = 0; i < mask.size(); i += 3) mask[i] = 0;
    some.isCounted = mask;
    const std::vector<float> part = traceHeightfield(some, settings);
    for (std::size_t i = 0; i < mask.size(); ++i) EXPECT_EQ(part[i], mask[i] ? one[i] : 1.0f);
    settings.seed = 2;
    EXPECT_NE(one, traceHeightfield(seen.input(), settings));
}

TEST(TruthHeightfield, SkyIsOpenAndOccludesNothing) {
    Scene scene = whiteScene();
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    const Seen seen(scene, looking({0, 6, 3}, {0, 0, 0}, 30), {32, 32});
    EXPECT_LT(seen.map.countedCount(), 700u);
    const std::vector<float> map = traceHeightfield(seen.input(), {.radius = 0.5f, .slices = 8});
    for (const float value : map) EXPECT_NEAR(value, 1, 1e-5);
}

}  // namespace
}  // namespace crevice::test
