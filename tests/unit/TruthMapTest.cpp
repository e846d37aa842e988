// Maps of whole pictures: camera rays, threads, seeds, what is solid and what is not, exclusion.
#include <algorithm>
#include <cstring>
#include <set>
#include <thread>

#include "TruthTools.h"
#include "truth/AlphaTest.h"
#include "truth/CameraRay.h"
#include "truth/Sampling.h"

namespace crevice::test {
namespace {

Camera cameraAbove(float height = 4) {
    Camera camera = Camera::lookAt({0, 10, 0}, {0, 0, 0}, {0, 0, -1});
    camera.orthographic = true;
    camera.orthoHeight = height;
    camera.near = 0.1f;
    camera.far = 50;
    return camera;
}

Scene wallScene() {
    Scene scene = whiteScene();
    addFloor(scene, 20);
    addWallX(scene, 0, 5, 20);
    return scene;
}

TEST(TruthMap, FloorAtAWallSeenByACamera) {
    const Scene scene = wallScene();
    const RayScene rays(scene);
    const glm::uvec2 size(32, 32);
    const AmbientMap map = traceAmbient(rays, cameraAbove(), size, {.terms = {{1}}, .samples = 256});
    double largest = 0;
    for (std::uint32_t x = 0; x < size.x; ++x) {
        const double k = std::abs((x + 0.5) / size.x - 0.5) * 4;
        double mean = 0;
        for (std::uint32_t y = 0; y < size.y; ++y)
            mean += static_cast<double>(map.layers[0].openness[y * size.x + x]) / size.y;
        largest = std::max(largest, std::abs(mean - (1 - segmentArea(k) / glm::pi<double>())));
    }
    EXPECT_LT(largest, 0.005);
    EXPECT_GT(map.layers[0].noise, 1e-4);
    EXPECT_LT(map.layers[0].noise, 0.02);
    EXPECT_EQ(map.countedCount(), 32u * 32u);
    EXPECT_NEAR(map.viewDepth[0], 10, 1e-5);
}

TEST(TruthMap, NoiseIsTheDistanceToTheTruth) {
    const Scene scene = wallScene();
    const RayScene rays(scene);
    const AmbientMap truth =
        traceAmbient(rays, cameraAbove(2), {24, 24}, {.terms = {{1}}, .samples = 16384, .seed = 9});
    double last = 1;
    for (const std::uint32_t samples : {16u, 64u, 256u}) {
        const AmbientMap map = traceAmbient(rays, cameraAbove(2), {24, 24}, {.terms = {{1}}, .samples = samples});
        double squares = 0;
        for (std::size_t i = 0; i < map.layers[0].openness.size(); ++i)
            squares += std::pow(static_cast<double>(map.layers[0].openness[i] - truth.layers[0].openness[i]), 2);
        const double rmse = std::sqrt(squares / static_cast<double>(map.layers[0].openness.size()));
        EXPECT_NEAR(map.layers[0].noise / rmse, 1, 0.2) << samples;
        EXPECT_LT(map.layers[0].noise,
                  0.5 * last);  // four times the rays: 1/2 for independent ones, these are spread better
        last = map.layers[0].noise;
    }
}

TEST(TruthMap, ThreadsChangeNoBitAndSeedsDo) {
    const Scene scene = wallScene();
    const RayScene rays(scene);
    AmbientSettings settings{.terms = {{1, findFalloff("linear")}}, .samples = 32, .threads = 1};
    const AmbientMap one = traceAmbient(rays, cameraAbove(), {37, 23}, settings);
    for (const unsigned threads : {2u, 3u, 8u, 40u}) {
        settings.threads = threads;
        const RayScene again(scene);
        const AmbientMap many = traceAmbient(again, cameraAbove(), {37, 23}, settings);
        EXPECT_EQ(one.layers[0].openness, many.layers[0].openness) << threads;
        EXPECT_EQ(one.viewDepth, many.viewDepth) << threads;
        EXPECT_EQ(one.layers[0].noise, many.layers[0].noise) << threads;
    }
    settings.seed = 2;
    EXPECT_NE(traceAmbient(rays, cameraAbove(), {37, 23}, settings).layers[0].openness, one.layers[0].openness);
}

TEST(TruthMap, ProgressRisesOnTheCallingThread) {
    const Scene scene = wallScene();
    std::vector<float> shares;
    const auto caller = std::this_thread::get_id();
    AmbientSettings settings{.terms = {{1}}, .samples = 2, .threads = 1};
    settings.progress = [&](float share) {
        EXPECT_EQ(std::this_thread::get_id(), caller);
        shares.push_back(share);
    };
    traceAmbient(RayScene(scene), cameraAbove(), {4, 8}, settings);
    ASSERT_EQ(shares.size(), 8u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LT(shares.back(), 1.0f);
}

TEST(TruthMap, SkyIsOpenAndDoesNotCount) {
    Scene scene = whiteScene();
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1});
    const AmbientMap map = traceAmbient(RayScene(scene), cameraAbove(4), {8, 8}, {.terms = {{1}}, .samples = 8});
    EXPECT_EQ(map.countedCount(), 16u);
    EXPECT_EQ(map.viewDepth[0], kSkyViewDepth);
    EXPECT_EQ(map.layers[0].openness[0], 1.0f);
    EXPECT_EQ(map.isCounted[0], 0);
    EXPECT_EQ(map.isCounted[8 * 4 + 4], 1);
    const AmbientMap empty = traceAmbient(RayScene(whiteScene()), cameraAbove(), {4, 4}, {});
    EXPECT_EQ(empty.countedCount(), 0u);
    EXPECT_EQ(empty.layers[0].noise, 0.0);
}

TEST(TruthMap, OtherSurfacesAreExcluded) {
    const Scene scene = wallScene();
    AmbientMap map = traceAmbient(RayScene(scene), cameraAbove(), {4, 4}, {.terms = {{1}}, .samples = 2});
    Image depth(4, 4, Format::R32F);
    std::memcpy(depth.pixels.data(), map.viewDepth.data(), depth.pixels.size());
    EXPECT_EQ(excludeOtherSurfaces(map, depth), 0u);
    const float moved[] = {10.005f, 10.02f, kSkyViewDepth};
    for (std::uint32_t x = 0; x < 3; ++x) std::memcpy(depth.pixel(x, 1), &moved[x], sizeof(float));
    EXPECT_EQ(excludeOtherSurfaces(map, depth), 2u);
    EXPECT_EQ(map.countedCount(), 14u);
    EXPECT_EQ(map.isCounted[4], 1);
    EXPECT_EQ(map.isCounted[5], 0);
}

TEST(TruthMap, BacksAreSolidButOnlyTwoSidedOnesAreSeen) {
    Scene scene = whiteScene();
    scene.materials.emplace_back().doubleSided = true;
    const auto seen = [&](int material, bool fromBehind) {
        Scene one = scene;
        addQuad(one, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, material);
        const float side = fromBehind ? -1.0f : 1.0f;
        const Ray ray{{0.1f, 2 * side, 0.2f}, {0, -side, 0}, 0, 5};
        const RayScene rays(one);
        EXPECT_TRUE(rays.isBlocked(ray));
        EXPECT_NEAR(rays.findDistance(ray), 2, 1e-6);
        const auto hit = rays.findVisible(ray);
        if (hit) {
            EXPECT_NEAR(hit->normal.y, side, 1e-6);
            EXPECT_NEAR(hit->geometricNormal.y, side, 1e-6);
        }
        return hit.has_value();
    };
    EXPECT_TRUE(seen(0, false));
    EXPECT_FALSE(seen(0, true));
    EXPECT_TRUE(seen(1, false));
    EXPECT_TRUE(seen(1, true));
}

TEST(TruthMap, MirroredAndScaledInstancesKeepTheirFronts) {
    for (const glm::vec3 scale : {glm::vec3(1, 1, 1), glm::vec3(-1, 1, 1), glm::vec3(2, 0.5f, -3)}) {
        Scene scene = whiteScene();
        addObject(scene, makeSphere(1, 64), glm::scale(glm::mat4(1), scale));
        const RayScene rays(scene);
        const auto hit = rays.findVisible({{0.3f * scale.x, 9, 0.2f * scale.z}, {0, -1, 0}, 0, 20});
        ASSERT_TRUE(hit);
        const glm::vec3 unit = hit->position / scale, expected = glm::normalize(unit / scale);
        EXPECT_GT(hit->position.y, 0);
        EXPECT_GT(glm::dot(hit->normal, expected), 0.999f);
        EXPECT_GT(glm::dot(hit->geometricNormal, expected), 0.99f);
    }
}

TEST(TruthMap, BlendedMaterialsAreNotThere) {
    Scene scene = whiteScene();
    scene.materials.emplace_back().alphaMode = AlphaMode::Blend;
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 1);
    const RayScene rays(scene);
    EXPECT_FALSE(rays.isBlocked({{0, 1, 0}, {0, -1, 0}, 0, 5}));
    EXPECT_FALSE(rays.findVisible({{0, 1, 0}, {0, -1, 0}, 0, 5}));
}

// A texture of two columns, left opaque and right clear: rays pass the right half.
TEST(TruthMap, MasksHaveHoles) {
    Scene scene = whiteScene();
    SceneTexture texture;
    texture.image = Image(2, 1, Format::RGBA8);
    std::memset(texture.image.pixels.data(), 255, texture.image.pixels.size());
    texture.image.pixel(1, 0)[3] = std::byte{0};
    texture.sampler.linearMag = false;
    scene.textures.push_back(texture);
    SceneMaterial mask;
    mask.alphaMode = AlphaMode::Mask;
    mask.baseColorMap.texture = 0;
    scene.materials.push_back(mask);
    addQuad(scene, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, 1);
    const RayScene rays(scene);
    for (const float x : {-0.9f, -0.1f, 0.1f, 0.9f}) {
        const Ray ray{{x, 1, 0.3f}, {0, -1, 0}, 0, 5};
        EXPECT_EQ(rays.isBlocked(ray), x < 0) << x;
        EXPECT_EQ(rays.findVisible(ray).has_value(), x < 0) << x;
        EXPECT_EQ(std::isfinite(rays.findDistance(ray)), x < 0) << x;
    }
}

TEST(TruthMap, AlphaIsFilteredAndWrapped) {
    SceneTexture texture;
    texture.image = Image(2, 1, Format::RGBA8);
    texture.image.pixel(0, 0)[3] = std::byte{255};
    EXPECT_NEAR(sampleAlpha(texture, {0.25f, 0.5f}), 1, 1e-6);
    EXPECT_NEAR(sampleAlpha(texture, {0.5f, 0.5f}), 0.5, 1e-6);
    EXPECT_NEAR(sampleAlpha(texture, {0, 0.5f}), 0.5, 1e-6);  // repeats
    EXPECT_NEAR(sampleAlpha(texture, {-3.75f, 7.5f}), 1, 1e-6);
    texture.sampler.wrapU = TextureWrap::Clamp;
    EXPECT_NEAR(sampleAlpha(texture, {0, 0.5f}), 1, 1e-6);
    EXPECT_NEAR(sampleAlpha(texture, {9, 0.5f}), 0, 1e-6);
    texture.sampler.wrapU = TextureWrap::Mirror;
    EXPECT_NEAR(sampleAlpha(texture, {1.25f, 0.5f}), 0, 1e-6);
    EXPECT_NEAR(sampleAlpha(texture, {1.75f, 0.5f}), 1, 1e-6);
    EXPECT_TRUE(std::isfinite(sampleAlpha(texture, {NAN, INFINITY})));
}

TEST(TruthMap, CameraRaysLandOnTheirPixels) {
    const glm::uvec2 size(64, 36);
    for (const bool orthographic : {false, true}) {
        Camera camera = Camera::lookAt({1, 2, 3}, {-2, 0.5f, -4}, {0.1f, 1, 0});
        camera.orthographic = orthographic;
        camera.orthoHeight = 5;
        camera.lensShift = {0.3f, -0.2f};
        camera.near = 0.5f;
        camera.far = 100;
        const glm::mat4 toClip = camera.projection(64.0f / 36) * camera.view;
        for (const glm::vec2 pixel : {glm::vec2(0.5f), glm::vec2(63.5f, 0.5f), glm::vec2(20.25f, 30.75f)}) {
            const Ray ray = makeCameraRay(camera, pixel, size);
            const glm::vec3 point = ray.origin + 7.0f * ray.direction;
            const glm::vec4 clip = toClip * glm::vec4(point, 1);
            const glm::vec2 found = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(size);
            EXPECT_NEAR(found.x, pixel.x, 1e-3);
            EXPECT_NEAR(found.y, pixel.y, 1e-3);
            EXPECT_NEAR(-(camera.view * glm::vec4(point, 1)).z, 7, 1e-5);
        }
    }
}

// Every elementary interval of 64 points of a (0,2)-sequence holds exactly one, scrambled or not.
TEST(TruthMap, PointsAreSpreadLikeSobols) {
    for (const std::uint32_t seed : {0u, 1u, 77u}) {
        for (std::uint32_t columns = 1; columns <= 64; columns *= 2) {
            std::set<std::uint32_t> cells;
            const std::uint32_t rows = 64 / columns;
            for (std::uint32_t i = 0; i < 64; ++i) {
                const glm::vec2 p = scrambledSobol(i, seed);
                ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                cells.insert(std::uint32_t(p.x * float(columns)) * rows + std::uint32_t(p.y * float(rows)));
            }
            EXPECT_EQ(cells.size(), 64u) << seed << " " << columns;
        }
    }
    EXPECT_NE(scrambledSobol(0, 1), scrambledSobol(0, 2));
}

}  // namespace
}  // namespace crevice::test
