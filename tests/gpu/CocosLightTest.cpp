// Light under Cocos' profiles: shadow maps, lights one at a time, fog, environments. Effects are the tests' own in
// Cocos' dialect; every number follows from the scene.
#include "CocosRuntimeFixture.h"

#include <cstring>

namespace crevice {
namespace {

struct Version {
    const char* profile;
    const char* spotMap;
    const char* blocks;
};

constexpr const char* kBlocks33 = R"(
  #pragma builtin(global)
  layout(set = 0, binding = 1) uniform CCCamera {
    mat4 cc_matView; mat4 cc_matViewInv; mat4 cc_matProj; mat4 cc_matProjInv; mat4 cc_matViewProj; mat4 cc_matViewProjInv;
    vec4 cc_cameraPos; vec4 cc_screenScale; vec4 cc_exposure; vec4 cc_mainLitDir;
    vec4 cc_mainLitColor; vec4 cc_ambientSky; vec4 cc_ambientGround; vec4 cc_fogColor; vec4 cc_fogBase; vec4 cc_fogAdd;
  };
  #pragma builtin(global)
  layout(set = 0, binding = 2) uniform CCShadow {
    mat4 cc_matLightPlaneProj; mat4 cc_matLightView; mat4 cc_matLightViewProj; vec4 cc_shadowInvProjDepthInfo;
    vec4 cc_shadowProjDepthInfo; vec4 cc_shadowProjInfo; vec4 cc_shadowNFLSInfo; vec4 cc_shadowWHPBInfo;
    vec4 cc_shadowLPNNInfo; vec4 cc_shadowColor;
  };
  #pragma builtin(local)
  layout(set = 2, binding = 0) uniform CCLocal { mat4 cc_matWorld; mat4 cc_matWorldIT; vec4 cc_lightingMapUVParam; };
)";

constexpr const char* kShadow36 = R"(
  #pragma builtin(global)
  layout(set = 0, binding = 2) uniform CCShadow {
    mat4 cc_matLightView; mat4 cc_matLightViewProj; vec4 cc_shadowInvProjDepthInfo; vec4 cc_shadowProjDepthInfo;
    vec4 cc_shadowProjInfo; vec4 cc_shadowNFLSInfo; vec4 cc_shadowWHPBInfo; vec4 cc_shadowLPNNInfo; vec4 cc_shadowColor;
    vec4 cc_planarNDInfo;
  };
)";

/// Chunks of a mini engine, in our own words: a vertex program, a caster, and the two ways to look up a map.
constexpr const char* kPrograms = R"(
CCProgram vs %{
  precision highp float;
  #include <blocks>
  in vec3 a_position;
  out vec3 v_world;
  vec4 vert () {
    v_world = (cc_matWorld * vec4(a_position, 1.0)).xyz;
    return cc_matViewProj * vec4(v_world, 1.0);
  }
}%
CCProgram caster-vs %{
  precision highp float;
  #include <blocks>
  in vec3 a_position;
  out vec2 v_depth;
  vec4 vert () {
    vec4 clip = cc_matLightViewProj * cc_matWorld * vec4(a_position, 1.0);
    v_depth = clip.zw;
    return clip;
  }
}%
CCProgram caster-fs %{
  precision highp float;
  in vec2 v_depth;
  vec4 frag () { return vec4(v_depth.x / v_depth.y * 0.5 + 0.5, 1.0, 1.0, 1.0); }
}%
CCProgram lookup %{
  float lookup (sampler2D map, vec4 clip) {
    vec3 at = clip.xyz / clip.w * 0.5 + 0.5;
    float lit = step(at.z, textureLod(map, at.xy, 0.0).x);
    vec3 outside = step(at, vec3(0.0)) + step(vec3(1.0), at);
    return dot(outside, vec3(1.0)) == 0.0 ? lit : 1.0;
  }
}%
)";

class CocosLight : public CocosRuntime {
protected:
    static Version version(bool v33) {
        return v33 ? Version{"cocos-3.3", "cc_spotLightingMap", kBlocks33}
                   : Version{"cocos-3.6", "cc_spotShadowMap", kCamera};
    }
    void writeEngine(bool v33) const {
        std::filesystem::create_directories(folder_ / "project/assets/chunks");
        writeFileAtomically(folder_ / "project/assets/chunks/blocks.chunk",
                            std::string(version(v33).blocks) + (v33 ? "" : kShadow36));
    }
    /// An effect with these passes; `base` and `added` give the colour of its programs base-fs and add-fs.
    void writeLit(const std::string& name, const std::string& passes, const std::string& base,
                  const std::string& added = "vec4(0.0)", const std::string& declarations = "") const {
        const std::string head = "  precision highp float;\n  #include <blocks>\n  #include <lookup>\n" + declarations +
                                 "  in vec3 v_world;\n  vec4 frag () { return ";
        writeCocos(name, "CCEffect %{\n  techniques:\n  - passes:\n" + passes + "}%\n" + kPrograms +
                             "CCProgram base-fs %{\n" + head + base + "; }\n}%\nCCProgram add-fs %{\n" + head + added +
                             "; }\n}%\n");
    }
    /// A forward pipeline with maps of 512 texels for the sun and one spot light.
    void loadForward(bool v33, const std::string& more = {}) {
        const Version v = version(v33);
        renderer_->effects().addFrontEnd(std::make_unique<cocos::CocosEffects>(
            cocos::Roots{.chunks = {}, .project = folder_ / "project", .engine = {}}));
        const auto map = [](const std::string& name, const char* format) {
            return "\"" + name + R"(": {"format": ")" + format + R"(", "size": [512, 512], "clear": [1, 1, 1, 1]}, )";
        };
        loadDocument(std::string(R"({"profile": ")") + v.profile + R"(", "output": "finalColor", "targets": {)" +
                     map("cc_shadowMap", "R32F") + map(v.spotMap, "R32F") +
                     R"("shadowDepth": {"format": "D32F", "size": [512, 512], "clear": 1},
                        "spotShadowDepth": {"format": "D32F", "size": [512, 512], "clear": 1},
                        "finalColor": {"format": "RGBA8"}, "depth": {"format": "D32F", "clear": 1}}, )" +
                     more + R"("flows": [{"flow": "Main", "stages": [
                        {"stage": "ShadowStage", "name": "Spot", "params": {"light": "spot"}}, {"stage": "ShadowStage"},
                        {"stage": "ForwardStage", "writes": ["finalColor"]}]}]})");
    }
    /// A wall at z = 0 and a block in front of it at (x, 0, 2), drawn with one effect.
    Scene wallAndBlock(const std::string& effect, float x = 0) {
        Scene scene = darkScene();
        scene.materials[0].effect = MaterialEffect{.effect = effect, .technique = 0, .passes = {}};
        addWall(scene, 10);
        addBlock(scene, {x, 0, 2}, glm::vec3(1));
        return scene;
    }
    /// Of the point (x, y) of the wall: 8 world units are seen, 64 pixels wide and high.
    float redAt(const Scene& scene, float x, float y = 0) {
        renderer_->setScene(scene);
        const Image image = renderer_->render(viewOf(frontCamera(8), 64, 64));
        return image.at(std::uint32_t((x / 8 + 0.5f) * 64), std::uint32_t((0.5f - y / 8) * 64)).x;
    }
    static constexpr const char* kCasting =
        "    - { vert: 'vs:vert', frag: 'base-fs:frag' }\n"
        "    - { vert: 'caster-vs:vert', frag: 'caster-fs:frag', phase: "
        "shadow-caster, rasterizerState: { cullMode: front } }\n";
    static constexpr const char* kAdding =
        "    - { vert: 'vs:vert', frag: 'add-fs:frag', phase: forward-add, depthStencilState: { depthFunc: equal, "
        "depthWrite: false }, blendState: { targets: [ { blend: true, blendSrc: one, blendDst: one } ] } }\n";
    static constexpr float kStep = 1.01f / 255;
    /// Luminance of a sphere times its squared radius over the squared distance: candela over distance².
    void writeAdded() const {
        writeLit(
            "added", std::string("    - { vert: 'vs:vert', frag: 'base-fs:frag' }\n") + kAdding,
            "vec4(vec3(0.125), 1.0)",
            "vec4(cc_lightColor[0].rgb * cc_lightColor[0].w * cc_lightSizeRangeAngle[0].x * "
            "cc_lightSizeRangeAngle[0].x / dot(cc_lightPos[0].xyz - v_world, cc_lightPos[0].xyz - v_world), 0.0)",
            "  #pragma builtin(local)\n  layout(set = 2, binding = 1) uniform CCForwardLight { vec4 cc_lightPos[1]; "
            "vec4 cc_lightColor[1]; vec4 cc_lightSizeRangeAngle[1]; vec4 cc_lightDir[1]; };\n");
    }
};

TEST_F(CocosLight, ReceiversSeeTheMainLightsMap) {
    for (const bool v33 : {true, false}) {
        renderer_ = makeRenderer();
        writeEngine(v33);
        writeLit(
            "shadowed", kCasting,
            "vec4(vec3(0.5 * mix(1.0, mix(lookup(cc_shadowMap, cc_matLightViewProj * vec4(v_world, 1.0)), 1.0, "
            "cc_shadowNFLSInfo.w), cc_mainLitDir.w)), 1.0)",
            "vec4(0.0)",
            "  #if CC_RECEIVE_SHADOW && CC_SHADOW_TYPE == 2\n  #pragma builtin(global)\n  layout(set = 0, binding = " +
                std::string(v33 ? "3" : "4") + ") uniform sampler2D cc_shadowMap;\n  #endif\n");
        loadForward(v33);
        // The light falls at 45 degrees towards +x: what is 2 in front of the wall darkens it 2 to the right.
        Scene scene = wallAndBlock("shadowed");
        scene.lights.push_back(directional({1, 0, -1}, 1));
        scene.lights[0].castsShadow = true;
        EXPECT_NEAR(redAt(scene, 2), 0, kStep) << v33;
        EXPECT_NEAR(redAt(scene, 2, 0.3f), 0, kStep) << v33;
        EXPECT_NEAR(redAt(scene, -2), 0.5, kStep) << v33;
        EXPECT_NEAR(redAt(scene, 2, 1), 0.5, kStep) << v33;  // above it
        EXPECT_NEAR(redAt(scene, -1), 0.5, kStep) << v33;
        scene.lights[0].shadow = LightShadow{.saturation = 0.75f};
        EXPECT_NEAR(redAt(scene, 2), 0.125, kStep) << v33;
        scene.instances[1].castsShadow = false;
        EXPECT_NEAR(redAt(scene, 2), 0.5, kStep) << v33;
        scene.instances[1].castsShadow = true;
        scene.lights[0].castsShadow = false;
        EXPECT_NEAR(redAt(scene, 2), 0.5, kStep) << v33;
    }
}

TEST_F(CocosLight, ForwardLightsAreAddedOneAtATime) {
    for (const bool v33 : {true, false}) {
        renderer_ = makeRenderer();
        writeEngine(v33);
        writeAdded();
        loadForward(v33);
        Scene scene = darkScene();
        scene.materials[0].effect = MaterialEffect{.effect = "added", .technique = 0, .passes = {}};
        addWall(scene, 3, {-2, 0, 0});
        addWall(scene, 3, {2, 0, 0});
        EXPECT_NEAR(redAt(scene, 2), 0.125, kStep) << v33;
        scene.lights.push_back(pointLight({2.0625f, -0.0625f, 1}, 0.25f, 1.5f));
        EXPECT_NEAR(redAt(scene, 2), 0.375, kStep) << v33;
        EXPECT_NEAR(redAt(scene, -2), 0.125, kStep) << v33;  // out of reach, and so not drawn: there is no window here
        for (int i = 0; i < 11; ++i) scene.lights.push_back(pointLight({-1.9375f, -0.0625f, 2}, 0.125f, 3));
        // Twelve lights, two more than the block of deferred shading has: 11 x 0.125 / 4 from those.
        EXPECT_NEAR(redAt(scene, -2), 0.125 + 11 * 0.125 / 4, 11 * kStep / 2) << v33;
    }
}

TEST_F(CocosLight, AnObjectTakesOneSliceHoweverManyLightsReachIt) {
    writeEngine(false);
    writeAdded();
    loadForward(false);
    Scene scene = darkScene();
    scene.materials[0].effect = MaterialEffect{.effect = "added", .technique = 0, .passes = {}};
    for (int i = 0; i < 144; ++i) addWall(scene, 0.6f, {0.6f * float(i % 12) - 3.3f, 0.6f * float(i / 12) - 3.3f, 0});
    // 144 x 128 draws, all in view, are more than the 16384 slices of a frame. Each light adds 1 of 255 to the point
    // below it.
    for (int i = 0; i < 128; ++i) scene.lights.push_back(pointLight({0.5625f, 0.4375f, 1}, 1 / 255.0f, 20));
    EXPECT_NEAR(redAt(scene, 0.5f, 0.5f), 0.125 + 128 / 255.0, kStep);
}

TEST_F(CocosLight, ASpotLightsMapComesWithItsPass) {
    for (const bool v33 : {true, false}) {
        renderer_ = makeRenderer();
        writeEngine(v33);
        writeLit(
            "spotted", std::string(kCasting) + kAdding, "vec4(vec3(0.125), 1.0)",
            "vec4(vec3(cc_lightColor[0].w * cc_lightSizeRangeAngle[0].x * cc_lightSizeRangeAngle[0].x * "
            "mix(1.0, lookup(" +
                std::string(version(v33).spotMap) +
                ", cc_matLightViewProj * vec4(v_world, 1.0)), cc_lightSizeRangeAngle[0].w)), 0.0)",
            "  #pragma builtin(local)\n  layout(set = 2, binding = 1) uniform CCForwardLight { vec4 cc_lightPos[1]; "
            "vec4 cc_lightColor[1]; vec4 cc_lightSizeRangeAngle[1]; vec4 cc_lightDir[1]; };\n"
            "  #pragma builtin(global)\n  layout(set = 0, binding = " +
                std::string(v33 ? "5" : "6") + ") uniform sampler2D " + version(v33).spotMap + ";\n");
        loadForward(v33);
        // From (0, 0, 4) past the block at (1, 0, 2) to (2, 0, 0).
        Scene scene = wallAndBlock("spotted", 1);
        scene.lights.push_back(spotLight({0, 0, 4}, {0, 0, 0}, 0.5f, 0.9f, 1));
        scene.lights[0].castsShadow = true;
        scene.lights[0].range = 20;
        EXPECT_NEAR(redAt(scene, 2.2f), 0.125, kStep) << v33;
        EXPECT_NEAR(redAt(scene, -2), 0.625, kStep) << v33;
        scene.lights[0].castsShadow = false;
        EXPECT_NEAR(redAt(scene, 2.2f), 0.625, kStep) << v33;
        // A second light has no map: it adds its 0.25 behind the block, too.
        scene.lights[0].castsShadow = true;
        scene.lights.push_back(spotLight({0, 0, 4}, {0, 0, 0}, 0.25f, 0.9f, 1));
        scene.lights[1].castsShadow = true;
        EXPECT_NEAR(redAt(scene, 2.2f), 0.375, kStep) << v33;
    }
}

TEST_F(CocosLight, FogOfTheSceneIsMixedIn) {
    writeEngine(false);
    // The engine's formulas: a white wall seen from 5 units away.
    writeLit(
        "foggy", "    - { vert: 'vs:vert', frag: 'base-fs:frag' }\n",
        "vec4(mix(cc_fogColor.rgb, vec3(1.0), clear()), 1.0)", "vec4(0.0)",
        "  float thickness () { return max(5.0 - cc_fogBase.x, 0.0) / cc_fogAdd.z * 4.0 * cc_fogBase.z; }\n"
        "  float clear () {\n"
        "    #if CC_USE_FOG == 0\n    return clamp((cc_fogBase.y - 5.0) / (cc_fogBase.y - cc_fogBase.x), 0.0, 1.0);\n"
        "    #elif CC_USE_FOG == 1\n    return exp(-thickness());\n"
        "    #elif CC_USE_FOG == 2\n    return exp(-thickness() * thickness());\n"
        "    #elif CC_USE_FOG == 3\n    return cc_fogAdd.x + cc_fogAdd.y;\n"
        "    #else\n    return 1.0;\n    #endif\n  }\n");
    loadForward(false);
    Scene scene = darkScene();
    scene.materials[0].effect = MaterialEffect{.effect = "foggy", .technique = 0, .passes = {}};
    addWall(scene, 10);
    const auto red = [&](FogType type) {
        scene.fog = {.type = type,
                     .color = glm::vec3(0.2f),
                     .start = 1,
                     .end = 9,
                     .density = 0.25f,
                     .top = 0.25f,
                     .range = 0.5f};
        return redAt(scene, 0);
    };
    EXPECT_NEAR(red(FogType::None), 1, kStep);
    EXPECT_NEAR(red(FogType::Linear), 0.6, kStep);               // half
    EXPECT_NEAR(red(FogType::Exp), 0.2 + 0.8 * 0.36788, kStep);  // e^-1
    EXPECT_NEAR(red(FogType::Exp2), 0.2 + 0.8 * 0.36788, kStep);
    EXPECT_NEAR(red(FogType::Layered), 0.8, kStep);
    scene.exposureEv = *scene.exposureEv + 1;  // light of the fog is exposed as all other light is
    EXPECT_NEAR(red(FogType::Linear), 0.55, kStep);
}

TEST_F(CocosLight, TheEnvironmentIsACubeOfRootsAndAFactor) {
    Image panorama(64, 32, Format::RGBA32F);
    for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 64; ++x) {
            const float up = y < 16 ? 0.5f : 0.0f;                  // light from above only
            const float ahead = x >= 16 && x < 48 ? 0.75f : 0.25f;  // green from the half around +x
            const float texel[4] = {up, ahead, 0, 1};
            std::memcpy(panorama.pixels.data() + (std::size_t(y) * 64 + x) * sizeof texel, texel, sizeof texel);
        }
    }
    int looks = 0;
    for (const bool v33 : {true, false}) {
        renderer_ = makeRenderer();
        writeEngine(v33);
        const auto look = [&](const std::string& map, const std::string& direction, const std::string& level) {
            const std::string texel = "textureLod(" + map + ", " + direction + ", " + level + ").rgb";
            const std::string effect = "mirror" + std::to_string(looks++);
            writeLit(
                effect, "    - { vert: 'vs:vert', frag: 'base-fs:frag' }\n",
                "vec4(" + texel + " * " + texel + " * cc_ambientSky.w, 1.0)", "vec4(0.0)",
                "  #if CC_USE_IBL == 1 && CC_IBL_CONVOLUTED\n  #pragma builtin(global)\n  layout(set = 0, binding = " +
                    std::string(v33 ? "4" : "5") +
                    ") uniform samplerCube cc_environment;\n  #if CC_USE_DIFFUSEMAP\n  #pragma builtin(global)\n  "
                    "layout(set = 0, binding = 7) uniform samplerCube cc_diffuseMap;\n  #endif\n  #endif\n");
            loadForward(v33);
            Scene scene = darkScene();
            scene.materials[0].effect = MaterialEffect{.effect = effect, .technique = 0, .passes = {}};
            addWall(scene, 10);
            scene.environment = makeEnvironment(panorama, "half", log_);
            scene.environment->intensity = 2;
            scene.environment->rotation = 1.5707963f;  // brings the panorama's +x to -z
            renderer_->setScene(scene);
            return renderer_->render(viewOf(frontCamera(8), 16, 16)).at(8, 8);
        };
        EXPECT_NEAR(look("cc_environment", "vec3(0.0, 1.0, 0.0)", "0.0").x, 1, 2 * kStep) << v33;
        EXPECT_NEAR(look("cc_environment", "vec3(0.0, -1.0, 0.0)", "0.0").x, 0, kStep) << v33;
        EXPECT_NEAR(look("cc_environment", "vec3(0.0, 0.0, 1.0)", "0.0").y, 0.5, 2 * kStep) << v33;
        EXPECT_NEAR(look("cc_environment", "vec3(0.0, 0.0, -1.0)", "0.0").y, 1, 2 * kStep) << v33;  // 1.5, clamped
        // The last level is as dull as can be; between its two halves it sees the mean of 1.5 and 0.5.
        EXPECT_NEAR(look("cc_environment", "vec3(1.0, 0.0, 0.0)", "cc_ambientGround.w - 1.0").x, 0.5, 6 * kStep) << v33;
        if (v33) continue;
        EXPECT_NEAR(look("cc_diffuseMap", "vec3(1.0, 0.0, 0.0)", "0.0").x, 0.5, 2 * kStep);
        EXPECT_NEAR(look("cc_diffuseMap", "vec3(0.0, 1.0, 0.0)", "0.0").x, 1, 2 * kStep);
    }
}

}  // namespace
}  // namespace crevice
