// The article's project runs unmodified in both G-buffer profiles and gives the pictures of our own form of it.
#include "CocosFixture.h"

#include <cmath>

namespace crevice {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Sizes are powers of two: texture coordinates of the quad's two triangles and of our one are then exact and equal, and
// with them the article's hash of their lowest bits.
constexpr std::uint32_t kWidth = 256, kHeight = 128;

struct Difference {
    double mean = 0;
    float most = 0;
    int beyond = 0;  ///< Pixels that differ by more than 1/255.
};

Difference differenceOf(const Image& a, const Image& b, int channels) {
    Difference result;
    for (std::uint32_t y = 0; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) {
            float most = 0;
            for (int c = 0; c < channels; ++c) most = std::max(most, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
            result.mean += double(most) / (double(a.width) * a.height);
            result.most = std::max(result.most, most);
            result.beyond += most > 1.001f / 255.0f ? 1 : 0;
        }
    }
    return result;
}

double meanOf(const Image& image) {
    double sum = 0;
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) sum += double(image.at(x, y).x);
    return sum / (double(image.width) * image.height);
}

struct Pictures {
    Image picture, occlusion;
};

class CocosArticle : public CocosTest {
protected:
    Pictures render() {
        View view = sized(kWidth, kHeight);
        view.keep = {"cc_ssaoMap"};
        Image picture = renderer_->render(view);
        return {std::move(picture), renderer_->target("cc_ssaoMap")};
    }
    /// Our own form of it, without the shadows and the smoothing that the project does not have.
    Pictures ours(const Scene& scene) {
        load("ssao-deferred", {{"form", "article"}, {"shadows", "false"}, {"fxaa", "false"}},
             {{"SsaoStage.material.radius", "1"}});
        renderer_->setScene(scene);
        return render();
    }
    Pictures cocos(const std::string& article, const Scene& scene) {
        loadArticle(article);
        renderer_->setScene(withEffects(scene));
        return render();
    }
    void save(const char* name, const Image& image) const {
        if (const char* folder = std::getenv("CREVICE_PICTURES"))
            writeImage(std::filesystem::path(folder) / name, image);
    }
};

/// The article's occlusion in our own dialect, for images without positions: they come from depth, and normals are
/// folded into the first two channels of `normals`.
std::string fromDepth(const std::string& camera, const std::string& normals) {
    return R"(
CCEffect %{
  techniques:
  - passes:
    - vert: fullscreen-vs
      frag: reference-fs
      rasterizerState: { cullMode: none }
      depthStencilState: { depthTest: false, depthWrite: false }
}%
CCProgram reference-fs %{
  precision highp float;
  )" + camera +
           R"(
  #include <ssao-constant>
  uniform sampler2D )" +
           normals + R"(;
  uniform sampler2D depth;
  in vec2 v_uv;
  layout(location = 0) out vec4 fragColor;

  float random(vec2 uv) { return fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453); }
  vec3 worldAt(vec2 uv) {
    vec3 ndc = vec3(uv * 2.0 - 1.0, texture(depth, uv).r);
    float w = cc_matProj[3][2] / (ndc.z + cc_matProj[2][2]);
    return (cc_matViewProjInv * vec4(ndc * w, w)).xyz;
  }
  vec3 normalAt(vec2 uv) {
    vec2 e = texture()" +
           normals + R"(, uv).xy;
    vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    if (n.z < 0.0) {
      n.xy = (1.0 - abs(n.yx)) * vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    }
    return normalize(n);
  }
  float depthOfWorld(vec3 p) { return -(cc_matView * vec4(p, 1.0)).z / cc_cameraNFLSInfo.y; }
  void main() {
    vec3 p = worldAt(v_uv);
    vec3 n = normalAt(v_uv);
    vec3 r = vec3(random(v_uv + vec2(0.0, 1.0)) * 2.0 - 1.0, random(v_uv + vec2(1.0, 0.0)) * 2.0 - 1.0, 0.0);
    vec3 t = r - n * dot(r, n);
    t = dot(t, t) > 0.0 ? t * inversesqrt(dot(t, t)) : vec3(1.0, 0.0, 0.0);
    mat3 frame = mat3(t, cross(n, t), n);
    float own = depthOfWorld(p);
    float occlusion = 0.0;
    for (int i = 0; i < 64; ++i) {
      vec3 s = p + frame * ssao_samples[i].xyz;
      vec4 clip = cc_matProj * cc_matView * vec4(s, 1.0);
      if (clip.w <= 0.0) {
        continue;
      }
      float stored = depthOfWorld(worldAt(clip.xy / clip.w * 0.5 + 0.5));
      float range = smoothstep(0.0, 1.0, 1.0 / max(abs(own - stored), 1e-9));
      occlusion += (stored <= depthOfWorld(s) ? 1.0 : 0.0) * range;
    }
    fragColor = vec4(1.0 - occlusion / 64.0);
  }
}%
)";
}

constexpr const char* kCamera36 = R"(layout(std140) uniform CCCamera {
    mat4 cc_matView; mat4 cc_matViewInv; mat4 cc_matProj; mat4 cc_matProjInv; mat4 cc_matViewProj; mat4 cc_matViewProjInv;
    vec4 cc_cameraPos; vec4 cc_surfaceTransform; vec4 cc_screenScale; vec4 cc_exposure; vec4 cc_mainLitDir;
    vec4 cc_mainLitColor; vec4 cc_ambientSky; vec4 cc_ambientGround; vec4 cc_fogColor; vec4 cc_fogBase; vec4 cc_fogAdd;
    vec4 cc_nearFar; vec4 cc_viewPort;
  };)";

TEST_F(CocosArticle, OcclusionIsThatOfOurEffectOnTheSameGbuffer) {
    writeEffect("from-depth", fromDepth(kCamera36, "gbufferNormal"));
    for (const std::string article : kBoth) {
        const bool v33 = article == "article-v33";
        const std::string stage = std::string(R"({"stage": "FullscreenStage", "name": "Reference", "effect": ")") +
                                  (v33 ? "ssao-article" : "from-depth") + R"(", "writes": ["reference"]}, )";
        renderer_ = makeRenderer();
        loadArticle(article, {}, "{ \"stage\": \"LightingStage\"", stage + "{ \"stage\": \"LightingStage\"",
                    R"("reference": { "format": "RGBA8" }, )");
        renderer_->setScene(withEffects(cloister()));
        View view = sized(kWidth, kHeight);
        view.keep = {"cc_ssaoMap", "reference"};
        renderer_->render(view);
        takeWarnings();
        const Difference difference = differenceOf(renderer_->target("cc_ssaoMap"), renderer_->target("reference"), 1);
        EXPECT_EQ(difference.beyond, 0) << article << ' ' << difference.most * 255;
        EXPECT_LT(meanOf(renderer_->target("reference")), 0.95);
    }
}

TEST_F(CocosArticle, OfVersion33IsOurArticleForm) {
    const Pictures reference = ours(cloister());
    const Pictures here = cocos("article-v33", cloister());
    save("v33.png", here.picture);
    save("v33-ao.png", here.occlusion);
    save("ours.png", reference.picture);
    EXPECT_LT(meanOf(here.occlusion), 0.95);  // there is occlusion to compare
    EXPECT_GT(meanOf(here.picture), 0.1);
    EXPECT_EQ(differenceOf(here.occlusion, reference.occlusion, 1).beyond, 0);
    EXPECT_EQ(differenceOf(here.picture, reference.picture, 3).beyond, 0);
    EXPECT_LT(differenceOf(here.picture, reference.picture, 3).mean, 0.1 / 255);
}

TEST_F(CocosArticle, OfVersion36IsThatFromDepth) {
    // Our article form with what 3.6 has in place of positions: depth, and folded normals, which the surfaces of this
    // test write where positions would be.
    copyEffect(
        "standard", "folded", "positionOut = vec4(surface.positionWorld, surface.roughness);",
        "vec3 n = surface.normalWorld;\n"
        "    vec2 folded = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));\n"
        "    if (n.z <= 0.0) {\n"
        "      folded = (1.0 - abs(folded.yx)) * vec2(folded.x >= 0.0 ? 1.0 : -1.0, folded.y >= 0.0 ? 1.0 : -1.0);\n"
        "    }\n"
        "    positionOut = vec4(folded, 0.0, surface.roughness);");
    writeEffect("from-depth", fromDepth("#include <cc-camera>", "cc_gbuffer_positionMap"));
    load(
        "ssao-deferred", {{"form", "article"}, {"shadows", "false"}, {"fxaa", "false"}},
        {{"GbufferStage.effect", "folded"}, {"SsaoStage.effect", "from-depth"}, {"SsaoStage.material.radius", "null"}});
    renderer_->setScene(cloister());
    const Pictures reference = render();
    const Pictures here = cocos("article-v36", cloister());
    save("v36.png", here.picture);
    save("v36-ao.png", here.occlusion);
    EXPECT_LT(meanOf(here.occlusion), 0.95);
    EXPECT_GT(meanOf(here.picture), 0.1);
    EXPECT_EQ(differenceOf(here.occlusion, reference.occlusion, 1).beyond, 0);
    EXPECT_EQ(differenceOf(here.picture, reference.picture, 3).beyond, 0);
    // D16: the lighting's sampler is the material's, and nobody gives it one.
    EXPECT_THAT(takeWarnings(),
                Contains(HasSubstr("'cc_ssaoMap' of effect 'pipeline/ssao-lighting' belongs to the material")));
    // D14: the queue behind the lighting has the phase "".
    EXPECT_THAT(importWarnings_, Contains(HasSubstr("draws nothing: its phases are ['']")));
}

TEST_F(CocosArticle, OcclusionReachesTheLightingOnlyByTheFallbackInVersion36) {
    Scene scene = cloister();
    const Pictures with = cocos("article-v36", scene);
    takeWarnings();
    renderer_ = makeRenderer();
    loadArticle("article-v36", {}, "\"profile\": \"cocos-3.6\"",
                "\"profile\": \"cocos-3.6\", \"fallbacks\": { \"globalSamplers\": false }");
    renderer_->setScene(withEffects(scene));
    const Pictures without = render();
    takeWarnings();
    // Without it the lighting takes the checker of 221 and 85 for the map, as Cocos does: another picture.
    EXPECT_EQ(differenceOf(with.occlusion, without.occlusion, 1).beyond, 0);
    EXPECT_GT(differenceOf(with.picture, without.picture, 3).beyond, 1000);
}

TEST_F(CocosArticle, FollowsTheFramesSizeAndEachCameraHasItsOwnOcclusion) {
    // D20, and the article's "editor preview is wrong": one target for all cameras, never made anew.
    for (const char* article : kBoth) {
        renderer_ = makeRenderer();
        loadArticle(article);
        renderer_->setScene(withEffects(cloister()));
        View large = sized(128, 64), small = sized(64, 64);
        small.camera = Camera::lookAt({0, 2, -2}, {2, 1, -9});
        large.keep = small.keep = {"cc_ssaoMap"};
        const Image first = renderer_->render(large);
        renderer_->render(small);
        EXPECT_EQ(renderer_->target("cc_ssaoMap").width, 64u);
        EXPECT_EQ(renderer_->render(large), first) << article;
        EXPECT_EQ(renderer_->target("cc_ssaoMap").width, 128u);
        takeWarnings();
    }
}

TEST_F(CocosArticle, BlendedObjectsFollowTheLighting) {
    Scene scene = darkScene();
    scene.materials[0].emissive = {0.2f, 0, 0};
    addWall(scene, 10);
    SceneMaterial glass = scene.materials[0];
    glass.emissive = {0, 0.3f, 0};
    glass.alphaMode = AlphaMode::Blend;
    loadArticle("article-v33");
    View view{.width = 16, .height = 16};
    view.camera = Camera::lookAt({0, 0, 5}, {0, 0, 0});
    const auto centre = [&](float alpha) {
        Scene with = scene;
        glass.baseColor = {0, 0, 0, alpha};
        with.materials.push_back(glass);
        addWall(with, 4, {0, 0, 1}, 1);
        renderer_->setScene(withEffects(with));
        return renderer_->render(view).at(8, 8);
    };
    const glm::vec4 behind = centre(0), glassOnly = centre(1), half = centre(0.5f);
    EXPECT_GT(behind.x, 0.2f);
    EXPECT_LT(behind.y, 0.01f);
    EXPECT_GT(glassOnly.y, 0.2f);
    EXPECT_LT(glassOnly.x, 0.01f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(half[c], 0.5f * (behind[c] + glassOnly[c]), 1.5f / 255) << c;
    takeWarnings();
}

}  // namespace
}  // namespace crevice
