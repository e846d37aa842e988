// What users of other engines complain of, for every technique: black close-ups, far occlusion that pops, cameras that
// make it crawl, glass and leaves, far planes, dotted lines.
#include "AoComplaintsFixture.h"

namespace crevice {
namespace {

constexpr float kPi = 3.14159265f;

// --- Distance -------------------------------------------------------------------------------------------------------

constexpr std::uint32_t kRows = 192;
constexpr float kFovY = 40 * kPi / 180;

/// Looks at the floor beside the wall from where a length of 1 appears `pixels` long.
View fromWhereItAppears(float pixels) {
    const float distance = 0.5f * kRows / std::tan(0.5f * kFovY) / pixels;
    const glm::vec3 spot(0.4f, 0, 0);
    Camera camera = Camera::lookAt(spot + distance * glm::normalize(glm::vec3(1, 1, 0.4f)), spot);
    camera.fovY = kFovY;
    camera.near = 0.01f * distance;
    camera.far = 100 * distance;
    return viewOf(camera, kRows, kRows);
}

TEST_P(AoComplaints, TheSameSpotKeepsItsOcclusionFromAnyDistance) {
    loadMaps(1);
    renderer_->setScene(wallScene(4000));
    const auto ofSpot = [&](float pixels) {
        const View view = fromWhereItAppears(pixels);
        return meanWhere(view, map(view, "viewDepth"), open(view), [&](const glm::vec3& p) {
            // Wide enough for a few pixels of the farthest view.
            return p.x > 0.3f && p.x < 0.5f && std::abs(p.y) < 0.01f && std::abs(p.z) < std::max(1.0f, 40 / pixels);
        });
    };
    const std::vector<float> sizes = {8, 12, 16, 24, 32, 48};
    std::vector<double> values;
    for (const float pixels : sizes) {
        values.push_back(ofSpot(pixels));
        RecordProperty("at" + std::to_string(int(pixels)), std::to_string(values.back()));
    }
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    EXPECT_LT(*most, 0.92) << "the spot is occluded";
    EXPECT_LE(*most - *least, 0.05);
    double before = values[0];
    for (const float pixels : {5.0f, 3.5f, 2.5f, 1.5f, 0.9f}) {
        const double value = ofSpot(pixels);
        RecordProperty("far" + std::to_string(pixels), std::to_string(value));
        EXPECT_GE(value, before - 0.02) << pixels;
        before = value;
    }
    EXPECT_GE(before, 0.99);
}

// --- Movement -------------------------------------------------------------------------------------------------------

Scene boxesOnFloor() {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, 40);
    addSquare(scene, {0, 0, -2}, {0.2f, 0, 1}, 40);
    addBox(scene, {-0.5f, 0.4f, 0}, {0.8f, 0.8f, 0.8f});
    addBox(scene, {0.6f, 0.7f, -0.6f}, {0.5f, 1.4f, 0.5f});
    addBox(scene, {0.3f, 0.1f, 0.7f}, {1.2f, 0.05f, 0.1f});
    return scene;
}

Camera boxesCamera(const glm::vec3& shift = glm::vec3(0)) {
    Camera camera = Camera::lookAt(glm::vec3(1.6f, 1.9f, 3.4f) + shift, glm::vec3(0, 0.4f, 0) + shift);
    camera.fovY = kFovY;
    camera.near = 0.1f;
    camera.far = 200;
    return camera;
}

TEST_P(AoComplaints, AHundredthOfAPixelChangesNextToNothing) {
    loadMaps(0.6f);
    renderer_->setScene(boxesOnFloor());
    const View still = viewOf(boxesCamera(), 160, 120);
    const glm::mat4 toWorld = glm::inverse(still.camera->view);
    const float pixel = 2 * std::tan(0.5f * kFovY) / 120 * 4;  // world units at the boxes
    for (const glm::vec2 step : {glm::vec2(0.01f, 0), glm::vec2(0.007f, -0.007f)}) {
        const glm::vec3 shift = glm::vec3(toWorld * glm::vec4(step * pixel, 0, 0));
        const FloatMap a = open(still), b = open(viewOf(boxesCamera(shift), 160, 120));
        EXPECT_NE(a.values, b.values);
        const double change = meanDifference(a, b);
        RecordProperty("change" + std::to_string(step.y), std::to_string(change * 255));
        EXPECT_LT(change, 2 * kByteStep);
    }
}

// --- Resolution -----------------------------------------------------------------------------------------------------

TEST_P(AoComplaints, TwiceTheResolutionIsTheSamePicture) {
    loadMaps(0.6f);
    renderer_->setScene(boxesOnFloor());
    const FloatMap small = open(viewOf(boxesCamera(), 240, 180)), large = open(viewOf(boxesCamera(), 480, 360));
    // Blocks of 12 x 12 pixels of the small one: what is left when the noise is averaged.
    double sum = 0;
    for (std::uint32_t y = 0; y < 15; ++y)
        for (std::uint32_t x = 0; x < 20; ++x) {
            double a = 0, b = 0;
            for (std::uint32_t v = 0; v < 12; ++v) a += small.rowMean(y * 12 + v, x * 12, x * 12 + 12) / 12;
            for (std::uint32_t v = 0; v < 24; ++v) b += large.rowMean(y * 24 + v, x * 24, x * 24 + 24) / 24;
            sum += std::abs(a - b);
        }
    RecordProperty("difference", std::to_string(sum / 300));
    EXPECT_LE(sum / 300, 0.01);
}

// --- Glass, leaves ---------------------------------------------------------------------------------------------------

TEST_P(AoComplaints, GlassIsNeitherDarkenedNorDarkens) {
    Scene scene = boxesOnFloor();
    const std::size_t solid = scene.instances.size();
    SceneMaterial glass;
    glass.baseColor = {0.2f, 0.7f, 0.4f, 1};
    glass.metallic = 0;
    glass.doubleSided = true;
    glass.alphaMode = AlphaMode::Blend;
    scene.materials.push_back(glass);
    addSquare(scene, {0.1f, 0.5f, 0.5f}, {0.3f, 0.2f, 1}, 1, 1);
    Scene bare = scene;
    bare.instances.resize(solid);
    const View view = viewOf(boxesCamera(), 160, 120);
    const auto picture = [&](const Scene& which, const Options& how) {
        load("ao-deferred", how, {{"cc_lighting_resultMap.format", "RGBA32F"}});
        renderer_->setScene(which);
        return target(view, "cc_lighting_resultMap");
    };
    const Options on = options(0.6f), off{{"ao", "off"}};
    const Image with = picture(scene, on);
    const FloatMap openness = map(view, "cc_ssaoBlurMap");
    const Image without = picture(scene, off), behind = picture(bare, off);
    picture(bare, on);
    EXPECT_EQ(map(view, "cc_ssaoBlurMap").values, openness.values) << "glass does not occlude";
    int seen = 0, occluded = 0;
    for (std::uint32_t y = 0; y < with.height; ++y)
        for (std::uint32_t x = 0; x < with.width; ++x) {
            if (without.at(x, y) == behind.at(x, y)) continue;
            ++seen;
            occluded += openness.at(x, y) < 0.8f;
            // Blending may round.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(with.at(x, y)[c], without.at(x, y)[c], 1e-6f) << x << ',' << y;
        }
    EXPECT_GT(seen, 500);
    EXPECT_GT(occluded, 50) << "what is behind the glass is dark";
}

TEST_P(AoComplaints, LeavesOccludeByTheirMask) {
    // A board that stands off a wall: its upper half is cut away by the mask.
    const auto board = [](bool isMasked) {
        Scene scene = emptyScene();
        addSquare(scene, {0, 0, 0}, {0, 0, 1}, 40);
        SceneTexture texture;
        texture.image = Image(2, 64, Format::RGBA8);
        for (std::uint32_t y = 0; y < 64; ++y)
            for (std::uint32_t x = 0; x < 2; ++x)
                for (int c = 0; c < 4; ++c) texture.image.pixel(x, y)[c] = std::byte(c == 3 && y < 32 ? 0 : 255);
        texture.sampler.wrapU = texture.sampler.wrapV = TextureWrap::Clamp;
        texture.sampler.mipmaps = false;
        scene.textures.push_back(texture);
        SceneMaterial leaf = scene.materials[0];
        leaf.alphaMode = AlphaMode::Mask;
        leaf.baseColorMap = {0, 0};
        scene.materials.push_back(leaf);
        // Corners of the board; v runs from its top to its bottom.
        Mesh mesh;
        const float top = isMasked ? 1.0f : 0.0f;
        for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, top), glm::vec2(-1, top)}) {
            Vertex vertex;
            vertex.position = {corner.x, corner.y, 0};
            vertex.uv0 = {0.5f * corner.x + 0.5f, 0.5f - 0.5f * corner.y};
            mesh.vertices.push_back(vertex);
        }
        mesh.indices = {0, 1, 2, 0, 2, 3};
        addObject(scene, mesh, translated({0, 0, 0.3f}), isMasked ? 1 : 0);
        return scene;
    };
    Camera camera = Camera::lookAt({0.5f, 0.4f, 6}, {0, 0, 0});
    camera.fovY = kFovY;
    camera.near = 0.1f;
    camera.far = 100;
    const View view = viewOf(camera, 160, 120);
    loadMaps(0.6f);
    renderer_->setScene(board(true));
    const FloatMap masked = open(view);
    renderer_->setScene(board(false));
    const FloatMap cut = open(view);
    EXPECT_LT(cut.min(), 0.9f) << "the board occludes the wall";
    RecordProperty("difference", std::to_string(meanDifference(masked, cut) * 255));
    EXPECT_LE(meanDifference(masked, cut), 0.1 * kByteStep);
}

// --- Far planes, small radii ----------------------------------------------------------------------------------------

TEST_P(AoComplaints, OpenCountryIsNotBlackUpToAHundredKilometres) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, 400000);
    addBox(scene, {0, 0.5f, 0}, {1, 1, 1});
    Camera camera = Camera::lookAt({3, 1.8f, 6}, {0, 0.8f, 0});
    camera.fovY = kFovY;
    camera.near = 0.1f;
    camera.far = 100000;
    const View view = viewOf(camera, 160, 120);
    for (const float radius : {1.0f, 300.0f}) {
        loadMaps(radius);
        renderer_->setScene(scene);
        const FloatMap openness = open(view), depth = map(view, "viewDepth");
        float least = 1, farthest = 0;
        for (std::uint32_t y = 0; y < depth.height; ++y)
            for (std::uint32_t x = 0; x < depth.width; ++x) {
                ASSERT_FALSE(std::isnan(openness.at(x, y)));
                const float d = depth.at(x, y);
                if (d < 1e8f) farthest = std::max(farthest, d);
                // The box occludes what is near it, however large the radius: no farther than ten times its size.
                if (d > 20) least = std::min(least, openness.at(x, y));
            }
        EXPECT_GT(farthest, 1000);
        RecordProperty("least" + std::to_string(int(radius)), std::to_string(least));
        EXPECT_GE(least, 0.9f) << radius;
    }
}

TEST_P(AoComplaints, NoDotsAndBandsAtATinyRadiusAndFullStrength) {
    // A ball of many facets with smooth normals on a plane that is seen flat: nothing occludes but their contact.
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 1, 0}, 400);
    addObject(scene, makeSphere(1, 128), translated({0, 1, 0}));
    Camera camera = Camera::lookAt({0.3f, 1.6f, 6}, {0, 0.9f, 0});
    camera.fovY = kFovY;
    camera.near = 0.1f;
    camera.far = 1000;
    const View view = viewOf(camera, 160, 160);
    for (const float radius : {0.04f, 0.1f, 0.25f}) {
        loadMaps(radius, {{"intensity", "4"}, {"power", "2"}});
        renderer_->setScene(scene);
        const FloatMap openness = open(view), depth = map(view, "viewDepth");
        std::size_t dark = 0, counted = 0;
        double sum = 0;
        for (std::uint32_t y = 0; y < depth.height; ++y)
            for (std::uint32_t x = 0; x < depth.width; ++x) {
                if (depth.at(x, y) > 1e8f) continue;
                const glm::vec3 p = worldAt(view, depth, x, y);
                if (glm::length(glm::vec2(p.x, p.z)) < 1.2f && p.y < 0.5f) continue;  // the contact
                ++counted;
                dark += openness.at(x, y) < 0.9f;
                sum += openness.at(x, y);
            }
        RecordProperty("dark" + std::to_string(radius), std::to_string(dark) + " of " + std::to_string(counted) +
                                                            ", mean " + std::to_string(sum / double(counted)));
        EXPECT_LE(dark, counted / 500) << radius;
        EXPECT_GE(sum / double(counted), 0.99) << radius;
    }
}

INSTANTIATE_TEST_SUITE_P(All, AoComplaints, testing::ValuesIn(everyAoCase()), nameOfAoCase);

}  // namespace
}  // namespace crevice
