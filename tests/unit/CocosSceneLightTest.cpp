// Lights, fog, sky and shadows of Cocos' scenes, and where skinned meshes stand.
#include "CocosSceneFixture.h"

namespace crevice::cocos {
namespace {

TEST(CocosScene, FogOfEveryTypeIsRead) {
    SceneFolder folder;
    const auto fog = [&](const std::string& fields) {
        return folder
            .load(withComponent(
                R"({ "__type__": "cc.UITransform" })", "",
                R"({ "__type__": "cc.SceneGlobals", "fog": { "__type__": "cc.FogInfo", "_enabled": true, )" + fields +
                    "} }"))
            .scene.fog;
    };
    const Fog linear = fog(R"("_type": 0, "_fogStart": 2, "_fogEnd": 40)");
    EXPECT_EQ(linear.type, FogType::Linear);
    EXPECT_EQ(linear.start, 2);
    EXPECT_EQ(linear.end, 40);
    const Fog exponential = fog(R"("_type": 1, "_fogDensity": 0.5, "_fogAtten": 8)");
    EXPECT_EQ(exponential.type, FogType::Exp);
    EXPECT_FLOAT_EQ(exponential.density, 0.25f);
    EXPECT_EQ(exponential.attenuation, 4);
    const Fog layered = fog(R"("_type": 3, "_fogTop": 7, "_fogRange": 3, "_fogAtten": 8)");
    EXPECT_EQ(layered.type, FogType::Layered);
    EXPECT_EQ(layered.top, 7);
    EXPECT_EQ(layered.range, 3);
    EXPECT_EQ(layered.attenuation, 8);
}

TEST(CocosScene, ShadowsAreOnWhereSceneAndLightAndRendererSaySo) {
    SceneFolder folder;
    const auto sun = [&](const std::string& fields, const std::string& shadows) {
        const std::string globals =
            R"({ "__type__": "cc.SceneGlobals", "shadows": { "__type__": "cc.ShadowsInfo", )" + shadows + "} }";
        return folder.load(withComponent(R"({ "__type__": "cc.DirectionalLight")" + fields + "}", "", globals))
            .scene.lights.at(0);
    };
    const std::string maps = R"("_enabled": true, "_type": 1)";
    EXPECT_TRUE(sun("", maps).castsShadow);
    EXPECT_FALSE(sun(R"(, "_shadowEnabled": false)", maps).castsShadow);
    EXPECT_FALSE(sun("", R"("_enabled": false, "_type": 1)").castsShadow);
    EXPECT_FALSE(sun("", R"("_enabled": true, "_type": 0)").castsShadow);
    EXPECT_TRUE(contains(folder.notes, "left out: planar shadows"));
    // Numbers of the light from 3.4 on, of the scene before.
    const Light own =
        sun(R"(, "_shadowPcf": 2, "_shadowBias": 0.1, "_shadowSaturation": 0.75)", maps + R"(, "_pcf": 1)");
    ASSERT_TRUE(own.shadow);
    EXPECT_EQ(own.shadow->pcf, 2);
    EXPECT_FLOAT_EQ(own.shadow->bias, 0.1f);
    EXPECT_FLOAT_EQ(own.shadow->saturation, 0.75f);
    const Light common = sun("", maps + R"(, "_pcf": 1, "_bias": 0.02, "_normalBias": 0.5)");
    ASSERT_TRUE(common.shadow);
    EXPECT_EQ(common.shadow->pcf, 1);
    EXPECT_FLOAT_EQ(common.shadow->normalBias, 0.5f);
    EXPECT_FALSE(sun("", maps).shadow);

    const auto ball = [&](const std::string& fields) {
        std::string text = renderer(kSphere, R"([ { "__uuid__": ")" + std::string(kPaint) + R"(" } ])");
        text.insert(text.rfind('}'), fields);
        return folder.load(withComponent(text)).scene;
    };
    EXPECT_FALSE(ball("").instances.at(0).castsShadow);  // off by default
    EXPECT_TRUE(ball(R"(, "_shadowCastingMode": 1)").instances.at(0).castsShadow);
    const Scene plain = ball(R"(, "_shadowReceivingMode": 0)");
    const MaterialEffect& effect = *plain.materials.at(std::size_t(plain.instances.at(0).material)).effect;
    EXPECT_FALSE(effect.passes.at(0).defines.find("CC_RECEIVE_SHADOW")->boolean());
}

TEST(CocosScene, ASkyThatLightsIsTheEnvironment) {
    SceneFolder folder;
    writeImage(folder.folder.path() / "project/sky.exr", Image(8, 4, Format::RGBA32F));
    folder.write("project/sky.exr.meta",
                 R"({"importer":"image","uuid":"30ff50d1-0000-4000-8000-000000f1736b","subMetas":{
        "b47c0":{"importer":"erp-texture-cube","uuid":"30ff50d1-0000-4000-8000-000000f1736b@b47c0"}}})");
    const auto sky = [&](const std::string& fields) {
        return folder
            .load(withComponent(R"({ "__type__": "cc.UITransform" })", "",
                                R"({ "__type__": "cc.SceneGlobals",
            "ambient": { "__type__": "cc.AmbientInfo", "_skyIllumHDR": 12000 },
            "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true,
                         "_envmapHDR": { "__uuid__": "30ff50d1-0000-4000-8000-000000f1736b@b47c0" }, )" +
                                    fields + "} }"))
            .scene.environment;
    };
    const auto lit = sky(R"("_envLightingType": 2)");
    ASSERT_TRUE(lit);
    EXPECT_EQ(lit->intensity, 12000);
    EXPECT_EQ(lit->radiance.width, 8u);
    EXPECT_TRUE(lit->lights);
    EXPECT_FALSE(sky(R"("_envLightingType": 0)")->lights);  // the hemisphere alone lights
}

TEST(CocosScene, ASkyThatCannotBeReadIsLeftOut) {
    SceneFolder folder;
    folder.write("project/sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n");
    folder.write("project/sky.hdr.meta",
                 R"({"importer":"image","uuid":"30ff50d1-0000-4000-8000-000000f1736b","subMetas":{}})");
    const auto loaded = folder.load(withComponent(R"({ "__type__": "cc.UITransform" })", "",
                                                  R"({ "__type__": "cc.SceneGlobals",
            "fog": { "__type__": "cc.FogInfo", "_enabled": true, "_type": 4 },
            "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true, "_envLightingType": 2,
                         "_envmapHDR": { "__uuid__": "30ff50d1-0000-4000-8000-000000f1736b" } } })"));
    EXPECT_FALSE(loaded.scene.environment);
    EXPECT_EQ(loaded.scene.fog.type, FogType::None);  // 4 is no fog
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: ")) << folder.notes;
}

TEST(CocosScene, ShadowMapsHaveTheScenesSize) {
    SceneFolder folder;
    const auto sizeWith = [&](const std::string& shadows) {
        return folder
            .load(withComponent(R"({ "__type__": "cc.DirectionalLight", "_csmLevel": 4 })", "",
                                R"({ "shadows": { "__type__": "cc.ShadowsInfo", )" + shadows + "} }"))
            .shadowMap;
    };
    const std::string size = R"("_size": { "__type__": "cc.Vec2", "x": 512, "y": 256 })";
    EXPECT_EQ(sizeWith(R"("_enabled": true, "_type": 1, )" + size), glm::uvec2(512, 256));
    EXPECT_TRUE(contains(folder.notes, "left out: cascades of shadow maps")) << folder.notes;
    folder.notes.clear();
    EXPECT_FALSE(sizeWith(R"("_enabled": false, "_type": 1, )" + size));
    EXPECT_FALSE(sizeWith(R"("_enabled": true, "_type": 0, )" + size));  // planar
    EXPECT_FALSE(contains(folder.notes, "cascades")) << folder.notes;
    EXPECT_FALSE(sizeWith(R"("_enabled": true, "_type": 1)"));
    EXPECT_FALSE(sizeWith(R"("_enabled": true, "_type": 1, "_size": { "__type__": "cc.Vec2", "x": 1e9, "y": 0 })"));
    EXPECT_FALSE(sizeWith(R"("_enabled": true, "_type": 1, "_size": 2)"));
}

TEST(CocosScene, SkinnedMeshesStandWhereTheirRootIs) {
    SceneFolder folder;
    const std::string place = R"("_lpos": { "__type__": "cc.Vec3", "x": 10, "y": 0, "z": 0 })";
    const auto load = [&](const std::string& type) {
        return folder
            .load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } },
            { "__type__": "cc.Scene", "_children": [ { "__id__": 2 } ] },
            { "__type__": "cc.Node", "_name": "root", )" +
                  place + R"(, "_children": [ { "__id__": 3 } ] },
            { "__type__": "cc.Node", "_name": "body", )" +
                  place + R"(, "_components": [ { "__id__": 4 } ] },
            { "__type__": ")" +
                  type + R"(", "_skinningRoot": { "__id__": 2 }, "_mesh": { "__uuid__": ")" + kModel +
                  R"(@aaaaa" } } ])")
            .scene.instances.at(0)
            .world[3]
            .x;
    };
    EXPECT_EQ(load("cc.SkinnedMeshRenderer"), 10);
    EXPECT_EQ(load("cc.MeshRenderer"), 20);
}

}  // namespace
}  // namespace crevice::cocos
