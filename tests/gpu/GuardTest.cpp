// The guard on the GPU: the picture shows the same, sizes are the frame's, and occluders outside of it count.
#include <array>

#include "FrameFixture.h"

namespace crevice {
namespace {

/// Rasterisers interpolate from a corner of the target: 2^-24 for each of the up to 600 pixels of the widest one here.
constexpr float kDepthRounding = 4e-5f;
constexpr float kNormalRounding = 2e-3f;  ///< of a half float, twice
/// Rasterisers snap corners to 1/256 of a pixel: at a silhouette, a pixel may show the other side.
constexpr std::size_t kMostSnapped = 3;

class GuardFrame : public FrameTest {
protected:
    void loadGuarded(int percent, Options options = {}) {
        options["guard"] = std::to_string(percent);
        load("ao-deferred", options);
    }
    std::array<Image, 2> geometry(const View& view) {
        View keeping = view;
        keeping.keep = {"viewDepth", "cc_gbuffer_normalMap"};
        renderer_->render(keeping);
        return {renderer_->target("viewDepth"), renderer_->target("cc_gbuffer_normalMap")};
    }
    /// Looks into the shipped scene from its side.
    static View sideView(bool orthographic, glm::vec2 lensShift, std::uint32_t width, std::uint32_t height) {
        Camera camera = Camera::lookAt({3, 2, 4}, {0, 0.6f, 0});
        camera.orthographic = orthographic;
        camera.orthoHeight = 3;
        camera.lensShift = lensShift;
        return viewOf(camera, width, height);
    }
};

/// Pixels whose depth differs by more than rounding, or whose normal does.
std::size_t countUnlike(const std::array<Image, 2>& a, const std::array<Image, 2>& b) {
    std::size_t count = 0;
    for (std::uint32_t y = 0; y < a[0].height; ++y) {
        for (std::uint32_t x = 0; x < a[0].width; ++x) {
            const float d = a[0].at(x, y).x, e = b[0].at(x, y).x;
            const float turn = glm::distance(glm::vec3(a[1].at(x, y)), glm::vec3(b[1].at(x, y)));
            count += std::abs(d - e) > kDepthRounding * d || turn > kNormalRounding ? 1 : 0;
        }
    }
    return count;
}

TEST_F(GuardFrame, GeometryStaysInItsPixels) {
    renderer_->setScene(shippedScene("default"));
    std::vector<View> views;
    for (const bool orthographic : {false, true})
        for (const glm::vec2 shift : {glm::vec2(0), glm::vec2(0.4f, -0.25f)})
            views.push_back(sideView(orthographic, shift, 160, 90));
    std::vector<std::array<Image, 2>> plain;
    loadGuarded(0, {{"ao", "off"}});
    for (const View& view : views) plain.push_back(geometry(view));
    for (const int percent : {10, 100}) {
        loadGuarded(percent, {{"ao", "off"}});
        for (std::size_t i = 0; i < views.size(); ++i) {
            const auto guarded = geometry(views[i]);
            ASSERT_EQ(guarded[0].width, 160u);
            ASSERT_EQ(guarded[0].height, 90u);
            EXPECT_LE(countUnlike(plain[i], guarded), kMostSnapped) << percent << " %, view " << i;
        }
    }
}

/// Looks at the wall z = 0, of which a square of 4 is seen; past its right edge, a beam stands out from the wall.
class GuardBeam : public GuardFrame {
protected:
    void SetUp() override {
        GuardFrame::SetUp();
        Scene scene = darkScene();
        addWall(scene, 40);
        addBlock(scene, {2.4f, 0, 0.5f}, {0.4f, 40, 1});
        scene.lights.push_back(directional({0.3f, -0.4f, -1}, 2));
        renderer_->setScene(std::move(scene));
    }
    static View frame() { return viewOf(frontCamera(4), 64, 64); }
    const Options options_{{"radius", "1"}, {"resolution", "half"}};
};

TEST_F(GuardBeam, OccludersBeyondTheEdgeCount) {
    const auto openness = [&](int percent) {
        loadGuarded(percent, {{"radius", "1"}});
        return target(frame(), "cc_ssaoBlurMap");
    };
    const Image plain = openness(0), guarded = openness(25);
    for (std::uint32_t y = 0; y < 64; ++y) {
        EXPECT_GE(plain.at(61, y).x, 0.99f) << y;
        EXPECT_LE(guarded.at(61, y).x, 0.9f) << y;   // Three pixels from the edge, a quarter of a unit from the beam.
        EXPECT_GE(guarded.at(20, y).x, 0.99f) << y;  // Farther away than the radius.
    }
}

TEST_F(GuardBeam, FrameIsCutFromTheLargerOne) {
    const std::vector<std::string> targets{
        "cc_gbuffer_normalMap",  "viewDepth",  "cc_ssaoMap",  "aoPacked", "cc_ssaoBlurMap",
        "cc_lighting_resultMap", "finalColor", "cc_shadowMap"};
    const auto render = [&](int percent, View view) {
        loadGuarded(percent, options_);
        view.keep = targets;
        std::vector<Image> images{renderer_->render(view)};
        for (const std::string& name : targets) images.push_back(renderer_->target(name));
        return images;
    };
    // Guard 50 of a square frame doubles its sides: the projection is the larger camera's to the bit.
    const std::vector<Image> guarded = render(50, frame());
    const std::vector<Image> larger = render(0, viewOf(frontCamera(8), 128, 128));
    for (std::size_t i = 0; i < guarded.size(); ++i) {
        const std::string name = i == 0 ? "the picture" : targets[i - 1];
        const bool fixed = name == "cc_shadowMap", half = name == "cc_ssaoMap" || name == "aoPacked";
        const std::uint32_t side = fixed ? larger[i].width : half ? 32 : 64;
        const std::uint32_t border = fixed ? 0 : side / 2;
        ASSERT_EQ(guarded[i].width, side) << name;
        ASSERT_EQ(guarded[i].height, fixed ? larger[i].height : side) << name;
        EXPECT_EQ(guarded[i], cropped(larger[i], glm::uvec2(border), {guarded[i].width, guarded[i].height})) << name;
    }
}

/// What a combination of options and sets keeps of a frame.
std::vector<Image> kept(Renderer& renderer, View view) {
    view.keep = {"cc_ssaoMap", "aoPacked", "cc_ssaoBlurMap", "cc_lighting_resultMap"};
    std::vector<Image> images{renderer.render(view)};
    for (const std::string& name : view.keep) images.push_back(renderer.target(name));
    return images;
}

/// Stages without "reach": everything in front of them is drawn over the whole guard.
std::vector<StageSet> noReach(const std::string& technique) {
    std::vector<std::string> stages{"AoDenoise1",    "AoDenoise2",       "AoDenoise3", "AoResolve",
                                    "LightingStage", "PostProcessStage", "Fxaa"};
    if (technique == "gtao" || technique == "vbao") stages.emplace_back("AoBent");
    std::vector<StageSet> sets;
    for (const std::string& stage : stages) sets.push_back({stage + ".reach", "null"});
    return sets;
}

std::uint32_t drawnBeyond(Renderer& renderer, const std::string& stage) {
    const FramePlan& plan = renderer.pipeline().program().plan();
    for (const PlannedStage& planned : plan.stages)
        if (plan.uses[planned.use].stage == stage) return planned.beyond;
    ADD_FAILURE() << "no stage " << stage;
    return 0;
}

// Drawing no more of the guard than is read changes no bit of what is seen.
TEST_F(GuardFrame, WhatIsLeftOutIsNotMissed) {
    renderer_->setScene(shippedScene("default"));
    const View view = sideView(false, {0, 0}, 91, 53);
    const std::vector<Options> cases{
        {{"ao", "vbao"}, {"quality", "high"}},
        {{"ao", "gtao"}, {"quality", "high"}, {"bentNormals", "true"}},
        {{"ao", "gtao"}, {"quality", "fast"}, {"denoiser", "edge-packed"}, {"passes", "2"}},
        {{"ao", "vbao"}, {"quality", "medium"}, {"denoiser", "atrous"}, {"passes", "3"}},
        {{"ao", "vbao"}, {"quality", "high"}, {"denoiser", "atrous"}, {"passes", "3"}, {"fxaa", "false"}},
        {{"ao", "hbao"}, {"quality", "high"}, {"denoiser", "box"}, {"resolution", "half"}},
        {{"ao", "cocos"}, {"quality", "medium"}, {"denoiser", "gaussian"}},
        {{"ao", "cocos"}, {"quality", "article"}},
    };
    for (Options options : cases) {
        std::string name;
        for (const auto& [key, value] : options) name += key + "=" + value + " ";
        options["guard"] = "80";  // 44 pixels
        load("ao-deferred", options, noReach(options["ao"]));
        const std::vector<Image> all = kept(*renderer_, view);
        EXPECT_EQ(drawnBeyond(*renderer_, "LightingStage"), kWholeGuard) << name;
        load("ao-deferred", options);
        const std::vector<Image> less = kept(*renderer_, view);
        const bool fxaa = !options.contains("fxaa");
        EXPECT_EQ(drawnBeyond(*renderer_, "LightingStage"), fxaa ? 13u : 1u) << name;
        if (options["quality"] != "article") {
            // At most the 13 of lighting, 2 of the upsampling and 1 of the odd frame, and 4 + 2 + 1 texels of the
            // a-trous passes.
            EXPECT_LE(drawnBeyond(*renderer_, "AoMain"), 30u) << name;
            EXPECT_GT(drawnBeyond(*renderer_, "AoMain"), drawnBeyond(*renderer_, "LightingStage")) << name;
        }
        EXPECT_EQ(drawnBeyond(*renderer_, "GbufferStage"), kWholeGuard) << name;
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], less[i]) << name << i;
    }
}

/// What a frame of a document shows, whole and in what it keeps.
std::vector<Image> shown(Renderer& renderer, View view, const std::vector<std::string>& keep) {
    view.keep = keep;
    std::vector<Image> images{renderer.render(view)};
    for (const std::string& name : keep) images.push_back(renderer.target(name));
    return images;
}

// The same for back faces, for a picture of the occlusion alone, and for a pipeline whose occlusion says no reach.
TEST_F(GuardFrame, NothingElseIsMissedEither) {
    renderer_->setScene(shippedScene("default"));
    const View view = sideView(false, {0, 0}, 160, 90);
    struct Case {
        std::string pipeline;
        Options options;
        Sets reach, none;
        std::string nearest;  ///< A stage that draws less than the whole guard.
        std::vector<std::string> keep;
    };
    Sets noDebug;
    for (const char* stage : {"AoDenoise1", "AoDenoise2", "AoDenoise3", "AoResolve", "DebugView"})
        noDebug.push_back({std::string(stage) + ".reach", "null"});
    const std::vector<Case> cases{
        {"ao-deferred",
         {{"ao", "vbao"}, {"quality", "high"}, {"backFaces", "true"}, {"guard", "50"}},
         {},
         noReach("vbao"),
         "AoMain",
         {"cc_ssaoMap", "cc_ssaoBlurMap"}},
        {"ao-views",
         {{"ao", "gtao"}, {"quality", "medium"}, {"guard", "50"}},
         {},
         noDebug,
         "AoMain",
         {"cc_ssaoBlurMap"}},
        {"ssao-deferred",
         {},
         {{"guard", "50"}, {"LightingStage.reach", "0"}, {"SsaoBlurX.reach", "2"}, {"SsaoBlurY.reach", "2"}},
         {{"guard", "50"}, {"PostProcessStage.reach", "null"}, {"Fxaa.reach", "null"}},
         "SsaoStage",
         {"cc_ssaoBlurMap", "cc_lighting_resultMap"}},
    };
    for (const Case& c : cases) {
        load(c.pipeline, c.options, c.none);
        const std::vector<Image> all = shown(*renderer_, view, c.keep);
        EXPECT_EQ(drawnBeyond(*renderer_, c.nearest), kWholeGuard) << c.pipeline;
        load(c.pipeline, c.options, c.reach);
        const std::vector<Image> less = shown(*renderer_, view, c.keep);
        EXPECT_LT(drawnBeyond(*renderer_, c.nearest), 48u) << c.pipeline;
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], less[i]) << c.pipeline << ' ' << i;
    }
}

/// A chain of effects that read exactly as far as they say, through targets of half and a quarter of the frame's size.
class GuardChain : public GuardFrame {
protected:
    void SetUp() override {
        GuardFrame::SetUp();
        Scene scene = darkScene();
        addWall(scene, 1);
        renderer_->setScene(std::move(scene));
        writeFragment("pattern", "", R"(
    ivec2 p = ivec2(gl_FragCoord.xy);
    result = vec4(0.25 + float((p.x * 37 + p.y * 91 + p.x * p.y * 13) & 127) / 170.0);)");
        writeFragment("halve", "uniform sampler2D from;", R"(
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
      ivec2 p = 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1);
      sum += texelFetch(from, min(p, textureSize(from, 0) - 1), 0);
    }
    result = 0.25 * sum;)");
        // By coordinates from 0 to 1, one pixel of what is written to each side.
        writeFragment("around", "uniform sampler2D from; uniform sampler2D sized;", R"(
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 9; ++i)
      sum += texture(from, v_uv + vec2(i % 3 - 1, i / 3 - 1) / vec2(textureSize(sized, 0)));
    result = sum / 9.0;)");
    }
    static std::string stage(const std::string& name, const std::string& effect, const std::string& reads,
                             const std::string& writes, const std::string& reach) {
        return R"({ "stage": "FullscreenStage", "name": ")" + name + R"(", "effect": ")" + effect + R"(", "reads": {)" +
               reads + R"(}, "writes": [")" + writes + R"("])" + reach + " }";
    }
    /// Full, half, half, full; or down to a quarter.
    static std::string chain(bool quarter, bool reach) {
        const std::string none = reach ? R"(, "reach": 0)" : "", one = reach ? R"(, "reach": 1)" : "";
        std::string stages = stage("A", "pattern", "", "a", none) + "," +
                             stage("H", "halve", R"("from": "a")", "h", none) + "," +
                             stage("I", "around", R"("from": "h", "sized": "h")", "i", one) + ",";
        if (quarter) stages += stage("Q", "halve", R"("from": "i")", "q", none) + ",";
        stages +=
            stage("O", "around", quarter ? R"("from": "q", "sized": "a")" : R"("from": "i", "sized": "a")", "o", one);
        return R"({ "name": "chain", "output": "o", "guard": 80, "targets": {
            "a": { "format": "RGBA16F" }, "h": { "format": "RGBA16F", "scale": 0.5 }, "i": { "like": "h" },)" +
               std::string(quarter ? R"("q": { "format": "RGBA16F", "scale": 0.25 },)" : "") +
               R"("o": { "format": "RGBA16F" } },
            "flows": [ { "flow": "F", "stages": [)" +
               stages + "] } ] }";
    }
};

TEST_F(GuardChain, SmallTargetsAndOddFramesMissNothing) {
    for (const bool quarter : {false, true}) {
        for (const glm::uvec2 size : {glm::uvec2(64, 36), glm::uvec2(63, 35), glm::uvec2(65, 33), glm::uvec2(62, 37)}) {
            const View view = viewOf(frontCamera(4), size.x, size.y);
            loadDocument(chain(quarter, false));
            const Image all = target(view, "o");
            EXPECT_EQ(drawnBeyond(*renderer_, "A"), kWholeGuard);
            loadDocument(chain(quarter, true));
            const Image less = target(view, "o");
            EXPECT_LT(drawnBeyond(*renderer_, "A"), 24u) << "less than the guard of at least 28 pixels";
            EXPECT_EQ(all, less) << size.x << 'x' << size.y << (quarter ? " through a quarter" : " through a half");
        }
    }
}

// The part is really cut off: a stage that says too little finds the clear value beside the frame, and nowhere else.
TEST_F(GuardBeam, WhatIsNotDrawnIsCleared) {
    const Options options{{"ao", "vbao"},  {"quality", "high"}, {"guard", "25"},
                          {"radius", "1"}, {"fxaa", "false"},   {"denoiser", "box"}};
    load("ao-deferred", options);
    const Image right = target(frame(), "cc_ssaoBlurMap");
    load("ao-deferred", options,
         {{"AoDenoise1.reach", "0"}, {"AoResolve.reach", "0"}, {"PostProcessStage.reach", "0"}});
    EXPECT_EQ(drawnBeyond(*renderer_, "AoMain"), 0u);
    const Image wrong = target(frame(), "cc_ssaoBlurMap");
    std::size_t atBorder = 0;
    for (std::uint32_t y = 0; y < 64; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const bool inside = x >= 2 && y >= 2 && x < 62 && y < 62;  // the box's reach
            if (inside) {
                ASSERT_EQ(right.at(x, y), wrong.at(x, y)) << x << ',' << y;
            }
            atBorder += !inside && right.at(x, y) != wrong.at(x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(atBorder, 20u);
}

TEST_F(GuardBeam, SizesChangeFromFrameToFrame) {
    loadGuarded(10, options_);
    for (const glm::uvec2 size : {glm::uvec2(64, 64), glm::uvec2(50, 33), glm::uvec2(33, 50)}) {
        const View view = viewOf(frontCamera(4), size.x, size.y);
        const Image half = target(view, "cc_ssaoMap");
        EXPECT_EQ(glm::uvec2(half.width, half.height), (size + 1u) / 2u);
        const Image full = target(view, "viewDepth");
        EXPECT_EQ(glm::uvec2(full.width, full.height), size);
        EXPECT_NEAR(full.at(size.x / 2, size.y / 2).x, 5, 1e-4f);
    }
}

TEST_F(GuardBeam, FrameAboveTheLimitNamesTheGuard) {
    loadGuarded(100);
    const std::uint32_t side = renderer_->device().limits().maxImageDimension2D;
    const Image before = renderer_->render(frame());
    try {
        renderer_->render(viewOf(frontCamera(4), side, 8));
        FAIL() << "rendered";
    } catch (const Error& error) {
        const std::string text = formatError(error);
        EXPECT_NE(text.find("pixels with the guard, and '"), std::string::npos) << text;
        EXPECT_NE(text.find("note: the guard renders 100 % of the frame's height more on each side"), std::string::npos)
            << text;
        EXPECT_NE(text.find("help: lower the pipeline's 'guard'"), std::string::npos) << text;
    }
    EXPECT_EQ(renderer_->render(frame()), before) << "the renderer goes on";
}

}  // namespace
}  // namespace crevice
