// learnopengl: the chapter's faults are in the article form as predicted and gone from the default form
// (docs/ao/learnopengl.md).
#include "AoKernelFixture.h"
#include "stages/SsaoKernel.h"

namespace crevice {
namespace {

using AoLearnOpenGl = AoKernelTest;

/// The target that the chapter has as half floats, in full: what remains is the method.
const StageSet kFullPositions{"aoViewPosition.format", "RGBA32F"};

/// Mean darkness of the columns right of the plate's silhouette.
double darknessBeside(const FloatMap& map) {
    double sum = 0;
    for (std::uint32_t y = 0; y < map.height; ++y)
        for (std::uint32_t x = map.width / 2; x < map.width; ++x) sum += 1 - map.at(x, y);
    return sum / (0.5 * map.width * map.height);
}

TEST_F(AoLearnOpenGl, L1_FlatSurfacesOccludeThemselves) {
    // No bias: a texel's depth is that of its centre, up to half a pixel from the sample, and half of them are nearer.
    const View view = viewOf(alongZ(10, 20), 96, 72);
    const FloatMap article = rawMap("learnopengl", "article", leaningPlane(60), view, {kFullPositions});
    EXPECT_LT(article.mean(), 0.95);
    EXPECT_LT(article.min(), 0.85f);
    EXPECT_GE(rawMap("learnopengl", "high", leaningPlane(60), view).min(), 1 - kByteStep);
}

TEST_F(AoLearnOpenGl, L2_HalfFloatsMakeSteps) {
    // At a distance of 40 the positions are rounded to 1/32, a third of this radius: a wall that leans becomes a stair.
    const View view = viewOf(alongZ(40, 0.5f), 96, 72);
    const Options small = {{"radius", "0.1"}};
    const FloatMap article = rawMap("learnopengl", "article", leaningPlane(20), view, {}, small);
    const FloatMap inFull = rawMap("learnopengl", "article", leaningPlane(20), view, {kFullPositions}, small);
    EXPECT_LT(article.mean(), inFull.mean() - 0.02);
    EXPECT_GE(rawMap("learnopengl", "high", leaningPlane(20), view, {}, small).min(), 1 - kByteStep);
}

TEST_F(AoLearnOpenGl, L3_RangeCheckNeverEnds) {
    // smoothstep(R / distance): 1 at one radius, 1/2 at two, 5/32 at four. Seen in parallel, plates at these distances
    // hide the same points.
    const View view = viewOf(parallelAlongZ(4), 64, 48);
    std::vector<double> article;
    for (float gap : {1.0f, 2.0f, 4.0f})
        article.push_back(darknessBeside(rawMap("learnopengl", "article", halfPlate(gap), view, {kFullPositions})));
    ASSERT_GT(article[0], 0.01);
    EXPECT_NEAR(article[1] / article[0], 0.5, 0.01);
    EXPECT_NEAR(article[2] / article[0], 0.15625, 0.01);
    for (float gap : {2.0f, 4.0f})
        EXPECT_EQ(darknessBeside(rawMap("learnopengl", "high", halfPlate(gap), view)), 0) << gap;
}

TEST_F(AoLearnOpenGl, L4_SkyIsNearerThanAnything) {
    // Where nothing was drawn the position is 0, which is at the eye: it weighs smoothstep(R / distance of the
    // surface).
    Scene scene = emptyScene();
    addSquare(scene, {-10, 0, 0}, {0, 0, 1}, 20);
    const auto beside = [&](const std::string& quality, float distance) {
        Camera camera = parallelAlongZ(4);
        camera = Camera::lookAt({0, 0, distance}, {0, 0, 0});
        camera.orthographic = true;
        camera.orthoHeight = 4;
        camera.near = 0.1f;
        camera.far = 30;
        const FloatMap ao = rawMap("learnopengl", quality, scene, viewOf(camera, 64, 48), {});
        double sum = 0;
        for (std::uint32_t y = 0; y < 48; ++y) sum += (1 - ao.at(31, y)) / 48;
        return sum;
    };
    EXPECT_GT(beside("article", 2), 0.1);
    EXPECT_NEAR(beside("article", 4) / beside("article", 2), 0.15625 / 0.5, 0.02);
    EXPECT_EQ(beside("high", 2), 0);
}

TEST_F(AoLearnOpenGl, L8_BlurIsHalfAPixelOffAndCrossesEdges) {
    // One bright pixel: the mean of two before and one behind moves it by half a pixel.
    writeFragment("ao-impulse", "", "    ivec2 p = ivec2(gl_FragCoord.xy); result = p == ivec2(30, 20) ? 0.0 : 1.0;",
                  "float");
    loadTechnique("learnopengl", "article",
                  {{"AoArticle.effect", "ao-impulse"},
                   {"cc_ssaoBlurMap.format", "R32F"},
                   {"AoArticle.material", "{}"},
                   {"AoArticle.reads", "{}"}});
    renderer_->setScene(wallScene());
    const FloatMap article = map(viewOf(wallCamera(kWallHeight), 64, 48), "cc_ssaoBlurMap");
    double weight = 0, x = 0, y = 0;
    for (std::uint32_t row = 0; row < 48; ++row) {
        for (std::uint32_t column = 0; column < 64; ++column) {
            const double dark = 1 - article.at(column, row);
            weight += dark, x += dark * column, y += dark * row;
        }
    }
    EXPECT_NEAR(weight, 1, 1e-5);
    EXPECT_NEAR(x / weight, 30.5, 1e-4);
    EXPECT_NEAR(y / weight, 20.5, 1e-4);

    // A plate that is dark before a wall that is not: up to three of the four columns of the mean lie beyond the
    // silhouette.
    writeFragment("ao-step", "  uniform sampler2D viewDepth;",
                  "    result = texture(viewDepth, v_uv).r < 6.0 ? 0.0 : 1.0;", "float");
    loadTechnique("learnopengl", "article",
                  {{"AoArticle.effect", "ao-step"},
                   {"cc_ssaoBlurMap.format", "R32F"},
                   {"AoArticle.material", "{}"},
                   {"AoArticle.reads", "{}"}});
    renderer_->setScene(halfPlate(5));
    const FloatMap step = map(viewOf(parallelAlongZ(4), 64, 48), "cc_ssaoBlurMap");
    const float expected[] = {0, 0.25f, 0.5f, 0.75f, 1};
    for (std::uint32_t i = 0; i < 5; ++i) EXPECT_NEAR(step.at(30 + i, 24), expected[i], 1e-5f) << i;
}

TEST_F(AoLearnOpenGl, L9_BorderIsClamped) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 0.7071f, 0.7071f}, 200);
    const View view = viewOf(alongZ(30, 8), 96, 96);
    const auto band = [](const FloatMap& ao, std::uint32_t from, std::uint32_t to) {
        double sum = 0;
        for (std::uint32_t y = from; y < to; ++y) sum += ao.rowMean(y) / (to - from);
        return sum;
    };
    const FloatMap article = rawMap("learnopengl", "article", scene, view, {kFullPositions});
    EXPECT_LT(band(article, 0, 4), band(article, 40, 60) - 0.03);
    EXPECT_GE(rawMap("learnopengl", "high", scene, view).min(), 1 - kByteStep);
}

TEST_F(AoLearnOpenGl, L11_TendsToTheLimitOfItsKernel) {
    // 1.25 radii away nothing is left of the wall: what is dark there is the floor's occlusion of itself (L1).
    const std::vector<float> distances = {0.1f, 0.2f, 0.3f, 0.5f, 1.25f};
    const std::vector<double> limits = {0.834, 0.920, 0.960, 0.991, 1};
    const std::vector<double> article = besideWall("learnopengl", "article", distances, {kFullPositions}, 16);
    const std::vector<double> remedied = besideWall("learnopengl", "ultra", distances, {}, 3);
    EXPECT_GT(article[4], 0.95);
    EXPECT_EQ(remedied[4], 1);
    for (std::size_t i = 0; i < 4; ++i) {
        const double exact = exactWall(distances[i]);
        EXPECT_NEAR(article[i] + (1 - article[4]), limits[i], 0.01) << distances[i];
        EXPECT_LT(std::abs(remedied[i] - exact), 0.5 * std::abs(article[i] - exact))
            << distances[i] << ' ' << remedied[i];
    }
}

TEST_F(AoLearnOpenGl, L13_LightingReadsTheBlurredMap) {
    loadTechnique("learnopengl", "article");
    renderer_->setScene(wallScene());
    EXPECT_TRUE(reads("LightingStage", "cc_ssaoBlurMap"));
    EXPECT_FALSE(reads("LightingStage", "cc_ssaoMap"));
    EXPECT_EQ(useOf("AoArticleBlur").enabled, true);
    EXPECT_FALSE(useOf("AoResolve").enabled);
}

TEST_F(AoLearnOpenGl, PowerBendsTheArticlesVisibility) {
    const View view = viewOf(wallCamera(kWallHeight), 48, 60);
    const FloatMap plain = rawMap("learnopengl", "article", wallScene(), view);
    const FloatMap squared = rawMap("learnopengl", "article", wallScene(), view, {}, {{"power", "2"}});
    ASSERT_LT(plain.min(), 0.9f);
    for (std::size_t i = 0; i < plain.values.size(); ++i)
        ASSERT_NEAR(squared.values[i], plain.values[i] * plain.values[i], 1e-5f);
}

/// docs/ao/learnopengl.md for one pixel, written again on the processor.
double openness(const Image& positions, const Image& normals, const glm::mat4& view, const glm::mat4& projection,
                const std::vector<glm::vec4>& kernel, std::uint32_t x, std::uint32_t y) {
    const auto pcg = [](std::uint32_t value) {
        const std::uint32_t state = value * 747796405u + 2891336453u;
        const std::uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
        return (word >> 22u) ^ word;
    };
    const auto noise = [&](std::uint32_t column, std::uint32_t row) {
        return double(pcg(column + pcg(row)) >> 8u) / 16777216.0;
    };
    const glm::dvec4 centre(positions.at(x, y));
    if (centre.w <= 0) return 1;
    const glm::dvec3 n = glm::normalize(glm::dmat3(view) * glm::dvec3(normals.at(x, y)));
    const glm::dvec3 random(2 * noise(x & 3u, y & 3u) - 1, 2 * noise(x & 3u, (y & 3u) + 4u) - 1, 0);
    const glm::dvec3 t = glm::normalize(random - n * glm::dot(random, n));
    const glm::dmat3 frame(t, glm::cross(n, t), n);
    double occlusion = 0;
    for (const glm::vec4& k : kernel) {
        const glm::dvec3 sample = glm::dvec3(centre) + frame * glm::dvec3(k);
        const glm::dvec4 clip = glm::dmat4(projection) * glm::dvec4(sample, 1);
        if (clip.w <= 0) continue;
        const glm::dvec2 uv = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
        const auto texel = [](double share, std::uint32_t size) {
            return static_cast<std::uint32_t>(std::clamp(std::floor(share * size), 0.0, size - 1.0));
        };
        const double z = -double(positions.at(texel(uv.x, positions.width), texel(uv.y, positions.height)).w);
        const double r = std::clamp(1 / std::max(std::abs(centre.z - z), 1e-9), 0.0, 1.0);
        occlusion += (z >= sample.z ? 1.0 : 0.0) * r * r * (3 - 2 * r);
    }
    return 1 - occlusion / static_cast<double>(kernel.size());
}

TEST_F(AoLearnOpenGl, ArticleToTheLetter) {
    constexpr std::uint32_t kWidth = 80, kHeight = 60;
    Scene scene = cornerScene(30);
    addBox(scene, {1.1f, 0.55f, 0.7f}, {0.9f, 1.1f, 0.8f});
    Camera camera = Camera::lookAt({5.5f, 4.2f, 4.4f}, {0.9f, 0.5f, 0.8f});
    camera.fovY = glm::radians(40.0f);
    camera.lensShift = {0.35f, -0.25f};
    camera.near = 0.5f;
    camera.far = 50;
    loadTechnique("learnopengl", "article", {{"AoArticle.params.seed", "5"}});
    renderer_->setScene(scene);
    View view = viewOf(camera, kWidth, kHeight);
    view.keep = {"cc_ssaoMap", "aoViewPosition", "cc_gbuffer_normalMap", "viewDepth"};
    renderer_->render(view);
    const FloatMap ao(renderer_->target("cc_ssaoMap"));
    const Image positions = renderer_->target("aoViewPosition");
    const Image normals = renderer_->target("cc_gbuffer_normalMap");
    const Image depth = renderer_->target("viewDepth");
    std::vector<glm::vec4> kernel(64);
    makeSsaoKernel(SsaoKernelKind::LearnOpenGl, 5, kernel);
    const glm::mat4 projection = camera.projection(float(kWidth) / float(kHeight));
    ASSERT_LT(ao.mean(), 0.98);
    int equal = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        for (std::uint32_t x = 0; x < kWidth; ++x) {
            // The chapter's alpha is the linear depth that our G-buffer holds, as a half float; its z is the same
            // number.
            ASSERT_NEAR(positions.at(x, y).w, depth.at(x, y).x, depth.at(x, y).x * 0x1p-10f);
            ASSERT_EQ(positions.at(x, y).w, -positions.at(x, y).z);
            equal += std::abs(openness(positions, normals, camera.view, projection, kernel, x, y) - ao.at(x, y)) <=
                     kByteStep;
        }
    }
    EXPECT_GE(equal, 0.99 * kWidth * kHeight);
}

TEST_F(AoLearnOpenGl, BlinnPhongHasAnAmbientTermOfItsOwn) {
    // Without light: 0.3 of the openness, whatever the colour. With light, occlusion leaves the light alone.
    Scene scene = wallScene();
    scene.materials[0].baseColor = {0.2f, 0.5f, 0.1f, 1};
    scene.ambient = Ambient{};
    const View view = viewOf(wallCamera(kWallHeight), 48, 60);
    const auto lit = [&](const Scene& content, const char* intensity) {
        loadTechnique("learnopengl", "article",
                      {{"LightingStage.effect", "blinn-phong-lighting"},
                       {"LightingStage.defines", "{}"},
                       {"AoArticle.material.power", intensity},
                       {"cc_lighting_resultMap.format", "RGBA32F"},
                       {"cc_ssaoBlurMap.format", "R32F"}});
        renderer_->setScene(content);
        return target(view, "cc_lighting_resultMap");
    };
    const Image dark = lit(scene, "1");
    const FloatMap openness = map(view, "cc_ssaoBlurMap");
    ASSERT_LT(openness.min(), 0.9f);
    const float perExposure = dark.at(0, 0).x / openness.at(0, 0) / 0.3f;
    for (std::uint32_t y = 0; y < 60; ++y)
        for (std::uint32_t x = 0; x < 48; ++x)
            for (int channel = 0; channel < 3; ++channel)
                ASSERT_NEAR(dark.at(x, y)[channel], 0.3f * openness.at(x, y) * perExposure, 1e-4f * perExposure);
    Light sun;
    sun.direction = glm::normalize(glm::vec3(-0.6f, -1, -0.5f));
    sun.intensity = 2;
    scene.lights = {sun};
    const Image weak = lit(scene, "1"), strong = lit(scene, "4");
    const FloatMap weakOpenness(target(view, "cc_ssaoBlurMap"));
    double changed = 0;
    for (std::uint32_t y = 0; y < 60; ++y) {
        for (std::uint32_t x = 0; x < 48; ++x) {
            const float difference = weak.at(x, y).x - strong.at(x, y).x;
            // Exactly the ambient term changes: the same in every channel.
            ASSERT_NEAR(difference, weak.at(x, y).y - strong.at(x, y).y, 1e-3f * perExposure);
            changed = std::max(changed, double(difference));
        }
    }
    EXPECT_GT(changed, 0.02 * perExposure);
}

}  // namespace
}  // namespace crevice
