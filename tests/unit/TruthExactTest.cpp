// Ray-traced openness against closed formulas. A cosine-weighted hemisphere is a unit disc seen from above, so that
// most of them are areas of its parts, over pi. Stand-in errors: rays start 1e-4 of the radius (at most 2.5e-7 of the
// scene's diagonal) above the surface, which is far below 1e-4 where no other error is named.
#include "TruthTools.h"

namespace crevice::test {
namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kOffsetError = 1e-4;
constexpr float kInfinite = 1e6f;  // longer than any of the scenes

Scene wall() {  // exact for radius 1: both planes reach farther
    Scene scene = whiteScene();
    addFloor(scene, 5);
    addWallX(scene, 0, 5, 5);
    return scene;
}

TEST(TruthExact, PlaneIsOpenAtAnyTilt) {
    for (const float degrees : {0.0f, 30.0f, 60.0f, 80.0f}) {
        const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(degrees), glm::vec3(0.6f, 0, 0.8f));
        Scene scene = whiteScene();
        addObject(scene, makePlane(glm::vec2(20), 4), turn);
        const RayScene rays(scene);
        for (const glm::vec3 place : {glm::vec3(0), glm::vec3(1.7f, 0, -3.1f), glm::vec3(5, 0, 5)}) {
            const glm::vec3 normal(turn * glm::vec4(0, 1, 0, 0)), at(turn * glm::vec4(place, 1));
            const auto hit = rays.findVisible({at + 3.0f * normal, -normal, 0, 10});
            ASSERT_TRUE(hit);
            for (const float radius : {0.01f, 1.0f, kInfinite})
                EXPECT_EQ(traceOpenness(rays, *hit, {.terms = {{radius}}, .samples = 512}, 1).front().mean(), 1.0)
                    << degrees;
        }
    }
}

TEST(TruthExact, FloorAtAWall) {
    for (const double k : {0.02, 0.2, 0.5, 0.9, 1.1}) {
        const auto point = pointAt({float(k), 0, 0}, {0, 1, 0});
        expectOpenness(estimateOpenness(wall(), point, 1), 1 - segmentArea(k) / kPi, kOffsetError);
    }
    EXPECT_NEAR(1 - segmentArea(0.2) / kPi, 0.6265, 5e-5);
    EXPECT_NEAR(1 - segmentArea(0.5) / kPi, 0.8045, 5e-5);
}

TEST(TruthExact, FloorAtAWallOfFiniteHeight) {
    const double d = 1, height = 2;
    Scene scene = whiteScene();
    addWallX(scene, 0, float(height), 2000);  // ends cut off: about (d / 2000)² of the hemisphere
    expectOpenness(estimateOpenness(scene, pointAt({float(d), 0, 0}, {0, 1, 0}), kInfinite),
                   1 - 0.5 * (1 - d / std::hypot(d, height)), 2e-3);
}

TEST(TruthExact, LinearAndQuadraticFalloff) {
    const double k = 0.3, root = std::sqrt(1 - k * k);
    const auto point = pointAt({float(k), 0, 0}, {0, 1, 0});
    const double linear = 1 - (segmentArea(k) / kPi - 2 * k / kPi * (std::log((1 + root) / k) - root));
    const double quadratic = 1 - ((1 + 2 * k * k) * std::acos(k) - 3 * k * root) / kPi;
    EXPECT_NEAR(linear, 0.8638, 5e-5);
    EXPECT_NEAR(quadratic, 0.7977, 5e-5);
    expectOpenness(estimateOpenness(wall(), point, 1, "linear"), linear, kOffsetError);
    expectOpenness(estimateOpenness(wall(), point, 1, "quadratic"), quadratic, kOffsetError);
}

TEST(TruthExact, CornerOfARoom) {
    Scene scene = wall();
    addWallZ(scene, 0, 5, 5);
    EXPECT_NEAR(cornerOpenness(0.2, 0.3), 0.4264, 5e-5);
    EXPECT_NEAR(cornerOpenness(0.5, 0.5), 0.6341, 5e-5);
    for (const auto& [k1, k2] : {std::pair{0.2, 0.3}, {0.5, 0.5}, {0.8, 0.7}}) {
        expectOpenness(estimateOpenness(scene, pointAt({float(k1), 0, float(k2)}, {0, 1, 0}), 1),
                       cornerOpenness(k1, k2), kOffsetError);
    }
}

// Faces reach 1000 times as far as the point is from the groove: what is missing is at most 1e-3 of the hemisphere.
TEST(TruthExact, GrooveIsEquallyOpenEverywhere) {
    for (const float degrees : {60.0f, 90.0f, 120.0f}) {
        const float angle = glm::radians(degrees);
        Scene scene = whiteScene();
        const glm::vec3 far(1000 * std::cos(angle), 1000 * std::sin(angle), 0), along(0, 0, 1000);
        addQuad(scene, glm::vec3(0) - along, along, far + along, far - along);
        for (const float d : {0.5f, 1.0f}) {
            expectOpenness(estimateOpenness(scene, pointAt({d, 0, 0}, {0, 1, 0}), kInfinite),
                           std::pow(std::sin(0.5 * double(angle)), 2), 1e-3);
        }
    }
}

// The other face cuts a cap off the ball of the radius; faces reach farther.
TEST(TruthExact, GrooveWithARadius) {
    EXPECT_NEAR(grooveOpenness(glm::radians(60.0), 0.3), 0.4090, 5e-5);
    EXPECT_NEAR(grooveOpenness(glm::radians(60.0), 0.9), 0.8019, 5e-5);
    EXPECT_NEAR(grooveOpenness(glm::radians(120.0), 0.3), 0.8753, 5e-5);
    for (const float degrees : {60.0f, 90.0f, 120.0f, 150.0f}) {
        const float angle = glm::radians(degrees);
        Scene scene = whiteScene();
        const glm::vec3 far(4 * std::cos(angle), 4 * std::sin(angle), 0), along(0, 0, 4);
        addQuad(scene, -along, along, far + along, far - along);
        for (const float d : {0.1f, 0.3f, 0.9f}) {
            expectOpenness(estimateOpenness(scene, pointAt({d, 0, 0}, {0, 1, 0}), 1),
                           grooveOpenness(double(angle), double(d)), kOffsetError);
        }
    }
}

// A sphere is convex: only the floor below it occludes it. The floor ends 4000 radii away, at an angle of 5e-4.
TEST(TruthExact, SphereAboveAFloor) {
    Scene scene = whiteScene();
    addObject(scene, makeSphere(1, 256), glm::translate(glm::mat4(1), glm::vec3(0, 1, 0)));
    addFloor(scene, 4000);
    for (const float c : {0.8f, 0.3f, 0.0f, -0.5f, -0.9f}) {
        const glm::vec3 normal(std::sqrt(1 - c * c), c, 0);
        expectOpenness(estimateOpenness(scene, pointAt(glm::vec3(0, 1, 0) + 1.0005f * normal, normal), kInfinite),
                       0.5 * (1 + double(c)), 1e-3);
    }
}

// A sheet without thickness occludes to both sides alike, whichever way it faces.
TEST(TruthExact, ThinSheet) {
    const double d = 0.5, height = 1;
    Scene scene = whiteScene();
    addWallX(scene, 0, float(height), 2000);
    for (const float side : {-1.0f, 1.0f}) {
        expectOpenness(estimateOpenness(scene, pointAt({side * float(d), 0, 0}, {0, 1, 0}), kInfinite),
                       1 - 0.5 * (1 - d / std::hypot(d, height)), 1e-3);
    }
}

// A sphere of 512 facets around is inscribed: its silhouette lies up to 2e-5 of the radius too far inside.
TEST(TruthExact, FloorBelowASphere) {
    const double r = 1;
    Scene scene = whiteScene();
    addObject(scene, makeSphere(float(r), 512), glm::translate(glm::mat4(1), glm::vec3(0, r, 0)));
    const auto exact = [&](double x, double radius) {
        const double distance = std::hypot(x, r);
        const double c = (distance * distance + radius * radius - r * r) / (2 * distance * radius);
        if (radius >= x) return 1 - std::pow(r / distance, 3);
        return radius <= distance - r ? 1 : 1 - r / distance * (1 - c * c);
    };
    EXPECT_NEAR(exact(1, 50), 0.6464, 5e-5);
    EXPECT_NEAR(exact(2, 1.6), 0.9287, 5e-5);
    EXPECT_NEAR(exact(0.5, 0.3), 0.3353, 5e-5);
    for (const auto& [x, radius] : {std::pair{1.0, 50.0}, {2.0, 50.0}, {2.0, 1.6}, {0.5, 0.3}, {2.0, 1.2}}) {
        expectOpenness(estimateOpenness(scene, pointAt({float(x), 0, 0}, {0, 1, 0}), float(radius)), exact(x, radius),
                       3e-4);
    }
}

TEST(TruthExact, FloorOfACanyon) {
    const double d1 = 0.4, d2 = 0.6, depth = 1;
    Scene scene = whiteScene();
    addWallX(scene, float(-d1), float(depth), 1000);
    addWallX(scene, float(d2), float(depth), 1000);
    expectOpenness(estimateOpenness(scene, pointAt({0, 0, 0}, {0, 1, 0}), kInfinite),
                   0.5 * (d1 / std::hypot(d1, depth) + d2 / std::hypot(d2, depth)), 1e-3);
}

/// View factor of a rectangle X by Y in units of its height, from the point below one of its corners.
double rectangleFactor(double x, double y) {
    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    return (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry)) / (2 * kPi);
}

TEST(TruthExact, FloorOfAnOpenBox) {
    const double a = 1, b = 1.5, height = 1;
    Scene scene = whiteScene();
    for (const float side : {-1.0f, 1.0f}) {
        addWallX(scene, side * float(a), float(height), float(b));
        addWallZ(scene, side * float(b), float(height), float(a));
    }
    EXPECT_NEAR(4 * rectangleFactor(a, b), 0.6351, 5e-5);
    expectOpenness(estimateOpenness(scene, pointAt({0, 0, 0}, {0, 1, 0}), kInfinite), 4 * rectangleFactor(a, b),
                   kOffsetError);
    const double x = 0.3, z = -0.5;
    expectOpenness(estimateOpenness(scene, pointAt({float(x), 0, float(z)}, {0, 1, 0}), kInfinite),
                   rectangleFactor(a - x, b - z) + rectangleFactor(a + x, b - z) + rectangleFactor(a - x, b + z) +
                       rectangleFactor(a + x, b + z),
                   kOffsetError);
}

TEST(TruthExact, InsideOfASphereAndOfABowl) {
    Scene sphere = whiteScene();
    addObject(sphere, makeSphere(1, 512));
    Mesh half = makeSphere(1, 512);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < half.indices.size(); i += 3) {
        float top = -1;
        for (std::size_t c = 0; c < 3; ++c) top = std::max(top, half.vertices[half.indices[i + c]].position.y);
        if (top < 1e-6f) kept.insert(kept.end(), half.indices.begin() + i, half.indices.begin() + i + 3);
    }
    half.indices = kept;
    Scene bowl = whiteScene();
    addObject(bowl, half);
    // Points sit 1e-4 inside the facets, which lie up to 4e-5 inside the sphere.
    for (const glm::vec3 place : {glm::vec3(0.05f, -1, 0.02f), glm::vec3(0.8f, -0.6f, 0.1f)}) {
        const glm::vec3 outwards = glm::normalize(place);
        const auto point = pointAt((1 - 1e-4f) * outwards, -outwards);
        expectOpenness(estimateOpenness(sphere, point, 0.6f), 1 - 0.3 * 0.3, 5e-4);
        expectOpenness(estimateOpenness(bowl, point, kInfinite), 0.5, 5e-4);
    }
}

TEST(TruthExact, FloorBelowASlab) {
    Scene scene = whiteScene();
    const double height = 0.6;
    addObject(scene, makePlane(glm::vec2(10)), glm::translate(glm::mat4(1), glm::vec3(0, height, 0)));
    expectOpenness(estimateOpenness(scene, pointAt({0, 0, 0}, {0, 1, 0}), 1), height * height, kOffsetError);
}

}  // namespace
}  // namespace crevice::test
