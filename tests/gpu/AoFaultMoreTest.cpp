// The article's faults C10 to C15 of docs/stages/SsaoStage.md: in lighting, far from the origin, in kernel, blur and
// border.
#include "AoFaultFixture.h"

namespace crevice {
namespace {

Scene litByASun() {
    Scene scene = cornerScene();
    scene.ambient = Ambient{};
    Light sun;
    sun.direction = glm::normalize(glm::vec3(-0.6f, -1, -0.5f));
    sun.intensity = 2;
    scene.lights = {sun};
    return scene;
}

View cornerView() {
    Camera camera = Camera::lookAt({4, 4, 3}, {0.2f, 0.2f, 0.2f});
    camera.near = 0.1f;
    camera.far = 60;
    return viewOf(camera, 96, 72);
}

TEST_F(AoFault, C10_DarkensDirectLightAndMetal) {
    Scene metal = litByASun();
    metal.materials[0].metallic = 1;
    for (const Scene& scene : {litByASun(), metal}) {
        const FloatMap without = lightingOf({{"ssao", "false"}}, scene, cornerView());
        EXPECT_LT(lightingOf({{"form", "article"}}, scene, cornerView()).mean(), 0.96 * without.mean());
        EXPECT_EQ(lightingOf({{"applyTo", "ambient"}}, scene, cornerView()).values, without.values);
    }
}

TEST_F(AoFault, C11_CountsCrevicesTwice) {
    // The material's own occlusion map says the same as the screen: the article's lighting multiplies the two.
    Scene plain = cornerScene();
    Scene mapped = plain;
    SceneTexture texture;
    texture.image = Image(1, 1, Format::RGBA8);
    for (int i = 0; i < 4; ++i) texture.image.pixels[i] = std::byte{150};
    mapped.textures.push_back(texture);
    mapped.materials[0].occlusionMap = {0, 0};

    const FloatMap material = lightingOf({{"ssao", "false"}}, mapped, cornerView());
    for (const Options& options : {Options{{"form", "article"}}, Options{{"applyTo", "ambient"}}}) {
        const FloatMap screen = lightingOf(options, plain, cornerView());
        const FloatMap both = lightingOf(options, mapped, cornerView());
        float worst = 1;
        for (std::size_t i = 0; i < both.values.size(); ++i)
            worst = std::min(worst, both.values[i] / std::min(material.values[i], screen.values[i]));
        if (options.contains("form"))
            EXPECT_LT(worst, 0.8f);
        else
            EXPECT_GT(worst, 0.999f);
    }
}

TEST_F(AoFault, C12_HalfFloatPositionsFarFromTheOrigin) {
    const glm::vec3 away(2000, 0, 1500);
    Scene scene = cornerScene();
    Scene moved = scene;
    for (Instance& instance : moved.instances) instance.world = translated(away) * instance.world;
    View view = cornerView();
    View movedView = view;
    movedView.camera->view = view.camera->view * translated(-away);
    EXPECT_GT(meanDifference(mapOf("article", scene, view), mapOf("article", moved, movedView)), 0.1);
    EXPECT_LE(meanDifference(mapOf("default", scene, view), mapOf("default", moved, movedView)), kByteStep);
}

TEST_F(AoFault, C13_KernelIsLeftToChance) {
    // One formula with both kernels, beside a wall: how far a pixel is from the mean of all seeds and turns.
    renderer_->setScene(wallScene());
    const View view = viewOf(wallCamera(kWallHeight), 64, 96);
    const auto spread = [&](const std::string& kernel) {
        constexpr int kSeeds = 8;
        double sum = 0, squares = 0;
        for (int seed = 0; seed < kSeeds; ++seed) {
            const FloatMap ao = mapOf("default", wallScene(), view,
                                      {{"SsaoStage.params.seed", std::to_string(seed)},
                                       {"SsaoStage.params.samples", "64"},
                                       {"SsaoStage.material.power", "1"},
                                       {"SsaoStage.params.kernel", kernel}});
            for (std::uint32_t x = 0; x < 64; ++x) {
                const double v = ao.at(x, 54);
                sum += v / (64 * kSeeds), squares += v * v / (64 * kSeeds);
            }
        }
        return std::sqrt(std::max(0.0, squares - sum * sum));
    };
    const double article = spread("article");
    const double stratified = spread("stratified");
    EXPECT_GT(article, 1.7 * stratified);
    load("ao-only", {{"form", "article"}});
    EXPECT_EQ(stage("SsaoStage").desc->params.find("kernel")->string(), "article");
}

TEST_F(AoFault, C14_BlursWhileLightingAndOverEdges) {
    renderer_->setScene(plateBeforeWall());
    load("ssao-deferred", {{"form", "article"}});
    EXPECT_TRUE(reads("LightingStage", "cc_ssaoMap"));
    EXPECT_FALSE(useOf("SsaoBlurX").enabled);
    load("ssao-deferred");
    EXPECT_FALSE(reads("LightingStage", "cc_ssaoMap"));
    EXPECT_TRUE(reads("LightingStage", "cc_ssaoBlurMap"));
    EXPECT_TRUE(useOf("SsaoBlurX").enabled && useOf("SsaoBlurY").enabled);

    // A map that is 0 on the plate and 1 on the wall behind it: the wall must stay as bright as it is far from the
    // plate.
    writeEffect("ao-step", R"(CCEffect %{
  techniques:
  - passes:
    - { vert: fullscreen-vs, frag: step-fs, properties: { radius: { value: 1.0 } },
        rasterizerState: { cullMode: none }, depthStencilState: { depthTest: false, depthWrite: false } }
}%
CCProgram step-fs %{
  precision highp float;
  uniform Properties { float radius; };
  uniform sampler2D viewDepth;
  in vec2 v_uv;
  layout(location = 0) out float openness;
  void main() {
    openness = texture(viewDepth, v_uv).r < 15.0 * radius ? 0.0 : 1.0;
  }
}%
)");
    const View view = viewOf(alongZ(20, 30), 128, 96);
    load("ao-only");
    renderer_->setScene(plateBeforeWall());
    const FloatMap depth = map(view, "viewDepth");
    const std::vector<StageSet> step = {{"SsaoStage.effect", "ao-step"}};
    const FloatMap article = lightingOf({{"form", "article"}}, plateBeforeWall(), view, step);
    const FloatMap plain = lightingOf({{"applyTo", "ambient"}}, plateBeforeWall(), view, step);
    EXPECT_LT(minWhere(article, depth, 19, 21), 0.85f * article.at(2, 2));
    EXPECT_GT(minWhere(plain, depth, 19, 21), 0.99f * plain.at(2, 2));
}

TEST_F(AoFault, C15_BorderIsClamped) {
    // A floor that fills the frame: beyond the upper border the article reads the border's texels, which are nearer
    // than the floor would be there. (Its other half, points behind the camera, is guarded in our article form too: it
    // is undefined.)
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 0.7071f, 0.7071f}, 200);
    Camera camera = alongZ(30, 8);
    const View view = viewOf(camera, 96, 96);
    const auto band = [](const FloatMap& ao, std::uint32_t from, std::uint32_t to) {
        double sum = 0;
        for (std::uint32_t y = from; y < to; ++y) sum += ao.rowMean(y) / (to - from);
        return sum;
    };
    const FloatMap article = mapOf("article", scene, view);
    EXPECT_LT(band(article, 0, 6), band(article, 40, 60) - 0.05);
    EXPECT_GE(mapOf("default", scene, view).min(), 1 - kByteStep);
}

}  // namespace
}  // namespace crevice
