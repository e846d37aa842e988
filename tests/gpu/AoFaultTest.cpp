// The article's faults in its map, C1 to C9 of docs/stages/SsaoStage.md: each is measured on the form `article`, and is
// absent from the default form. Bounds that only say "clearly there" keep a margin to what was measured.
#include <set>

#include "AoFaultFixture.h"
#include "core/Format.h"

namespace crevice {
namespace {

TEST_F(AoFault, C01_RangeCheckIsInert) {
    const View view = viewOf(alongZ(20, 30), 128, 96);
    loadMap("article", radiusOne());
    renderer_->setScene(plateBeforeWall());
    const FloatMap depth = map(view, "viewDepth");
    // The plate darkens a wall that is ten radii behind it.
    EXPECT_LT(minWhere(map(view), depth, 19, 21), 0.7f);
    EXPECT_GE(minWhere(mapOf("default", plateBeforeWall(), view), depth, 19, 21), 1 - kByteStep);
    // With a radius below 1 the far plane decides how much: depths are divided by it, the radius is not.
    for (const char* form : {"article", "default"}) {
        std::vector<float> darkest;
        for (float far : {21.0f, 100.0f}) {
            View other = view;
            other.camera->far = far;
            const FloatMap ao = mapOf(form, plateBeforeWall(), other, {{"SsaoStage.material.radius", "0.2"}});
            darkest.push_back(minWhere(ao, depth, 19, 21));
        }
        if (form == std::string("article"))
            EXPECT_GT(darkest[0], darkest[1] + 0.1f);
        else
            EXPECT_EQ(darkest[0], darkest[1]);
    }
}

TEST_F(AoFault, C02_NoiseLiesInAPlaneOfTheWorld) {
    // On a floor (world normal y) every pixel's random vector, in the world's xy plane, projects to +x or -x: two turns
    // in all.
    const View view = viewOf(wallCamera(kWallHeight), 64, 96);
    const auto turns = [&](const std::string& form) {
        const FloatMap ao = mapOf(form, wallScene(), view);
        std::set<float> values;
        for (std::uint32_t x = 0; x < ao.width; ++x) values.insert(std::round(ao.at(x, 54) * 4096));
        return values.size();
    };
    EXPECT_LE(turns("article"), 4u);
    EXPECT_GE(turns("default"), 8);

    // The same picture of a world that lies on its side.
    const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(90.0f), glm::vec3(1, 0, 0));
    Scene turned = wallScene();
    for (Instance& instance : turned.instances) instance.world = turn * instance.world;
    View turnedView = view;
    turnedView.camera->view = view.camera->view * glm::inverse(turn);
    EXPECT_GT(meanDifference(mapOf("article", wallScene(), view), mapOf("article", turned, turnedView)), 0.02);
    EXPECT_LE(meanDifference(mapOf("default", wallScene(), view), mapOf("default", turned, turnedView)),
              0.2 * kByteStep);
}

TEST_F(AoFault, C03_NoBias) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0.2f, 0.8f, 0.56f}, 200);
    const View view = viewOf(alongZ(6, 30), 96, 72);
    // A flat floor occludes itself in dots.
    const FloatMap article = mapOf("article", scene, view);
    EXPECT_LT(article.mean(), 0.99);
    EXPECT_LT(article.min(), 0.9f);
    EXPECT_GE(mapOf("default", scene, view).min(), 1 - kByteStep);
}

TEST_F(AoFault, C04_SkyIsAPhantomAtTheOrigin) {
    // A box against the sky. The cleared position is the world's origin: before the box, or behind it.
    const auto scene = [](float z) {
        Scene result = emptyScene();
        addBox(result, {0, 0, z}, {2, 2, 2});
        return result;
    };
    const auto view = [](float z) {
        Camera camera = Camera::lookAt({0, 0, z + 15}, {0, 0, z});
        camera.fovY = glm::radians(15.0f);
        camera.near = 0.1f;
        camera.far = 100;
        return viewOf(camera, 96, 72);
    };
    loadMap("article", radiusOne());
    renderer_->setScene(scene(-10));
    const FloatMap depth = map(view(-10), "viewDepth");
    const FloatMap article = map(view(-10));
    EXPECT_LT(minWhere(article, depth, 0, 1e3f), 0.8f);
    EXPECT_GE(minWhere(mapOf("article", scene(20), view(20)), depth, 0, 1e3f), 1 - kByteStep);
    // Sky itself is occluded as well.
    EXPECT_LT(minWhere(article, depth, 1e8f, 2e9f), 1);
    for (float z : {-10.0f, 20.0f}) EXPECT_EQ(mapOf("default", scene(z), view(z)).min(), 1);
}

TEST_F(AoFault, C05_NoiseDependsOnTheDevicesSine) {
    loadMap("article", radiusOne());
    EXPECT_GE(countFunction(variantOf("SsaoStage").fragment, kSin), 1);
    loadMap("default", radiusOne());
    EXPECT_EQ(
        countFunction(variantOf("SsaoStage").fragment, kSin) + countFunction(variantOf("SsaoStage").fragment, kCos), 0);

    // What that means: Vulkan allows a sine to be 2^-11 off. The article's hash makes another number of it everywhere;
    // the default's noise has no function in it, and losing the last bit of every product moves it by less than .01 of
    // a turn.
    double hashMoved = 0, gradientMoved = 0;
    const auto moved = [](double a, double b) {
        const double d = std::abs(a - b);
        return std::min(d, 1 - d);
    };
    const auto fraction = [](double v) { return v - std::floor(v); };
    for (int y = 0; y < 720; y += 7) {
        for (int x = 0; x < 1280; x += 7) {
            const double sine = std::sin(12.9898 * (x + 0.5) / 1280 + 78.233 * (y + 0.5) / 720);
            hashMoved =
                std::max(hashMoved, moved(fraction(sine * 43758.5453), fraction((sine + 0x1p-11) * 43758.5453)));
            const float inexact =
                std::nextafter(0.06711056f * static_cast<float>(x) + 0.00583715f * static_cast<float>(y), 1e9f);
            const float inner = 52.9829189f * (inexact - std::floor(inexact));
            const double exact = 52.9829189 * fraction(0.06711056 * x + 0.00583715 * y);
            gradientMoved = std::max(gradientMoved, moved(fraction(exact), fraction(inner)));
        }
    }
    EXPECT_GT(hashMoved, 0.3);
    EXPECT_LT(gradientMoved, 0.01);
}

TEST_F(AoFault, C06_MatrixProductsPerSample) {
    loadMap("article", radiusOne());
    EXPECT_GE(countInstruction(variantOf("SsaoStage").fragment, kMatrixTimesMatrix), 1);
    EXPECT_GE(countInstruction(variantOf("SsaoStage").fragment, kMatrixTimesVector), 3);
    loadMap("default", radiusOne());
    EXPECT_EQ(countInstruction(variantOf("SsaoStage").fragment, kMatrixTimesMatrix), 0);
    // The normal's turn into view space, once per pixel.
    EXPECT_EQ(countInstruction(variantOf("SsaoStage").fragment, kMatrixTimesVector), 1);
}

TEST_F(AoFault, C07_ReadsEightBytesPerSample) {
    const auto bytes = [&](const std::string& target) {
        return formatInfo(renderer_->pipeline().program().desc().findTarget(target)->format).bytesPerPixel;
    };
    renderer_->setScene(wallScene());  // the plan needs one
    loadMap("article", radiusOne());
    EXPECT_TRUE(reads("SsaoStage", "cc_gbuffer_positionMap"));
    EXPECT_EQ(bytes("cc_gbuffer_positionMap"), 8);
    loadMap("default", radiusOne());
    EXPECT_FALSE(reads("SsaoStage", "cc_gbuffer_positionMap"));
    EXPECT_TRUE(reads("SsaoStage", "viewDepth"));
    EXPECT_EQ(bytes("viewDepth"), 4);
    // The one sampled texture is the normal, read once per pixel; everything else is depth, read as an image.
    EXPECT_EQ(countInstruction(variantOf("SsaoStage").fragment, kSampleImplicit), 1);
    EXPECT_EQ(countInstruction(variantOf("SsaoStage").fragment, kImageRead), 2);
}

TEST_F(AoFault, C06_C07_CostManyTimesAsMuch) {
    // Time of the pass on the device, the best of some frames. Measured: .11 to .14; asserted: half.
    const auto best = [&](const std::string& form) {
        loadMap(form, radiusOne({{"SsaoStage.params.bake", "on"}}));
        renderer_->setScene(wallScene());
        double milliseconds = 1e9;
        for (int frame = 0; frame < 3; ++frame) {
            renderer_->render(viewOf(wallCamera(kWallHeight), 320, 180));
            for (const StageTime& time : renderer_->pipeline().stageTimes())
                if (time.stage == "SsaoStage") milliseconds = std::min(milliseconds, time.milliseconds);
        }
        return milliseconds;
    };
    const double article = best("article");
    ASSERT_GT(article, 0) << "the device has no timestamps";
    ASSERT_LT(article, 1e8);
    EXPECT_LT(best("default"), 0.5 * article);
}

TEST_F(AoFault, C08_DeclaresOtherAttachmentsThanItUses) {
    // The article's render pass declares RGBA8 for an R8 texture, with a depth attachment that nobody uses. Here a pass
    // is made from the target itself, so that the two cannot differ: what the article declares is what it would cost.
    load("ao-only", {{"form", "article"}});
    EXPECT_EQ(variantOf("SsaoStage").info.outputs.at(0).type, "vec4");
    load("ao-only");
    EXPECT_EQ(variantOf("SsaoStage").info.outputs.at(0).type, "float");

    std::uint64_t bytes[2] = {};
    const char* formats[2] = {"R8", "RGBA8"};
    for (int i = 0; i < 2; ++i) {
        load("ao-only", {{"view", "raw"}}, radiusOne({{"cc_ssaoMap.format", formats[i]}}));
        renderer_->setScene(wallScene());
        renderer_->render(viewOf(wallCamera(kWallHeight), 256, 256));
        bytes[i] = renderer_->pipeline().targetBytes();
    }
    EXPECT_GE(bytes[1] - bytes[0], 3u * 256 * 256);
    const StageUse& use = useOf("SsaoStage");
    ASSERT_EQ(use.writes.size(), 1u);
    EXPECT_EQ(use.writes[0].kind, WriteKind::Color);
    load("ssao-deferred");
    EXPECT_EQ(renderer_->pipeline().program().desc().findTarget("cc_ssaoMap")->format, Format::R8);
}

TEST_F(AoFault, C09_TextureCoordinatesIgnoreTheBackEndsY) {
    // uv = ndc / 2 + 1/2 is right where clip space and textures agree about up, as here. Where they do not (Metal), the
    // article's line reads the picture upside down: the same line with that sign.
    std::string text = readText(std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "effects" / "ssao-article.effect");
    const std::string line = "clip.xy / clip.w * 0.5 + 0.5";
    ASSERT_NE(text.find(line), std::string::npos);
    text.replace(text.find(line), line.size(), "clip.xy / clip.w * vec2(0.5, -0.5) + 0.5");
    writeEffect("article-other-y", text);

    // The wall's foot lies above the middle of the frame.
    const std::uint32_t rows = 96;
    const View view = viewOf(wallCamera(kWallHeight, {0.8f, 0, 0}), 64, rows);
    const double foot = (0.5 - 0.8 / 1.41421356 / kWallHeight) * rows;
    const auto darkest = [&](const FloatMap& ao) {
        std::uint32_t best = 0;
        for (std::uint32_t y = 1; y < rows; ++y)
            if (ao.rowMean(y) < ao.rowMean(best)) best = y;
        return best + 0.5;
    };
    EXPECT_GT(std::abs(darkest(mapOf("article", wallScene(), view, {{"SsaoStage.effect", "article-other-y"}})) - foot),
              8);
    EXPECT_LT(std::abs(darkest(mapOf("article", wallScene(), view)) - foot), 3);

    // The default form takes every sign from the projection: upright, upside down, through a shifted lens.
    EXPECT_LT(std::abs(darkest(mapOf("default", wallScene(), view)) - foot), 3);
    View upsideDown = view;
    upsideDown.camera->view = glm::rotate(glm::mat4(1), glm::radians(180.0f), glm::vec3(0, 0, 1)) * view.camera->view;
    EXPECT_LT(std::abs(darkest(mapOf("default", wallScene(), upsideDown)) - (rows - foot)), 3);
    View shifted = view;
    shifted.camera->lensShift = {0, 0.25f};
    const double moved = mapOf("default", wallScene(), shifted).height * 0.25 / 2;
    EXPECT_LT(std::abs(std::abs(darkest(mapOf("default", wallScene(), shifted)) - foot) - moved), 3);
}

}  // namespace
}  // namespace crevice
