// .scene files: nodes, cameras, lights in their units, shapes, materials, prefabs, and files that are wrong.
#include "CocosSceneFixture.h"

namespace crevice::cocos {
namespace {

TEST(CocosScene, TheDemosCameraHasItsExposure) {
    SceneFolder folder;
    const ImportedScene out = folder.load(withComponent(
        R"({ "__type__": "cc.Camera", "_projection": 1, "_fov": 30, "_fovAxis": 0, "_near": 1, "_far": 120, "_clearFlags": 7,
             "_color": { "__type__": "cc.Color", "r": 51, "g": 51, "b": 51, "a": 255 }, "_aperture": 19, "_shutter": 7, "_iso": 0 })",
        R"(, "_lpos": { "__type__": "cc.Vec3", "x": -5.256, "y": 20.829, "z": 36.484 },
             "_lrot": { "__type__": "cc.Quat", "x": 0, "y": 0.7071068, "z": 0, "w": 0.7071068 })"));
    ASSERT_EQ(out.scene.cameras.size(), 1u);
    const Camera& camera = out.scene.cameras[0];
    EXPECT_FALSE(camera.orthographic);
    EXPECT_NEAR(camera.fovY, 0.5235988, 1e-6);
    EXPECT_FLOAT_EQ(camera.near, 1);
    EXPECT_FLOAT_EQ(camera.far, 120);
    EXPECT_NEAR(camera.position().y, 20.829, 1e-4);
    // A quarter turn about y: -z becomes -x.
    const glm::vec3 forward = -glm::vec3(glm::inverse(camera.view)[2]);
    EXPECT_NEAR(forward.x, -1, 1e-5);
    // ev = log2(16² · 125); 0.8333 / 2^ev = 2.604e-5
    ASSERT_TRUE(out.scene.exposureEv);
    EXPECT_NEAR(exposureOf(*out.scene.exposureEv), 2.604e-5, 1e-8);
    ASSERT_TRUE(out.background);
    EXPECT_NEAR(out.background->x, 0.2, 1e-6);
}

TEST(CocosScene, OrthographicHeightIsHalfAndSuchCamerasComeLast) {
    SceneFolder folder;
    const ImportedScene out =
        folder.load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
        { "__type__": "cc.Node", "_name": "ui", "_components": [ { "__type__": "cc.Camera", "_projection": 0, "_orthoHeight": 5, "_clearFlags": 6, "_priority": -5 } ] },
        { "__type__": "cc.Node", "_name": "second", "_components": [ { "__type__": "cc.Camera", "_priority": 1 } ] },
        { "__type__": "cc.Node", "_name": "main", "_components": [ { "__type__": "cc.Camera", "_priority": 0, "_clearFlags": 6 } ] } ] } } ])");
    ASSERT_EQ(out.scene.cameras.size(), 3u);
    EXPECT_EQ(out.scene.cameras[0].name, "main");
    EXPECT_EQ(out.scene.cameras[1].name, "second");
    EXPECT_EQ(out.scene.cameras[2].name, "ui");
    EXPECT_TRUE(out.scene.cameras[2].orthographic);
    EXPECT_FLOAT_EQ(out.scene.cameras[2].orthoHeight, 10);
    EXPECT_FALSE(out.background);  // the main camera clears no colour
}

TEST(CocosScene, LightsKeepTheirUnits) {
    SceneFolder folder;
    const auto light = [&](const std::string& fields) {
        return folder.load(withComponent("{" + fields + "}")).scene.lights.at(0);
    };
    const Light sun = light(
        R"("__type__": "cc.DirectionalLight", "_illuminanceHDR": 65000, "_color": { "__type__": "cc.Color", "r": 255, "g": 51, "b": 0, "a": 255 })");
    EXPECT_EQ(sun.type, LightType::Directional);
    EXPECT_FLOAT_EQ(sun.intensity, 65000);
    EXPECT_NEAR(sun.color.g, 0.2, 1e-6);
    EXPECT_NEAR(sun.direction.z, -1, 1e-6);
    EXPECT_FLOAT_EQ(light(R"("__type__": "cc.DirectionalLight", "_illuminance": 100)").intensity, 100);
    // 1700 lm from a sphere: 1700 / (4 pi) candela, whatever its radius.
    const Light sphere = light(R"("__type__": "cc.SphereLight", "_size": 0.15, "_range": 2)");
    EXPECT_EQ(sphere.type, LightType::Point);
    EXPECT_NEAR(sphere.intensity, 1700 / (4 * 3.14159265), 1e-2);
    EXPECT_FLOAT_EQ(sphere.range, 2);
    EXPECT_FLOAT_EQ(sphere.size, 0.15f);
    EXPECT_NEAR(light(R"("__type__": "cc.SphereLight", "_size": 2, "_luminanceHDR": 10)").intensity, 40 * 3.14159265,
                1e-3);
    const Light spot = light(R"("__type__": "cc.SpotLight", "_size": 1, "_luminance": 7, "_spotAngle": 60)");
    EXPECT_EQ(spot.type, LightType::Spot);
    EXPECT_NEAR(spot.intensity, 7 * 3.14159265, 1e-4);
    EXPECT_NEAR(spot.outerAngle, 0.5235988, 1e-6);  // half of the cone
}

TEST(CocosScene, WithoutHdrTheSmallNumbersCount) {
    SceneFolder folder;
    const ImportedScene out = folder.load(
        withComponent(R"({ "__type__": "cc.DirectionalLight", "_illuminanceHDR": 5, "_illuminanceLDR": 1.5 })", "",
                      R"({ "__type__": "cc.SceneGlobals", "_skybox": { "__type__": "cc.SkyboxInfo", "_useHDR": false },
             "ambient": { "__type__": "cc.AmbientInfo", "_skyColorLDR": { "__type__": "cc.Vec4", "x": 1, "y": 1, "z": 1 }, "_skyIllumLDR": 0.5 } })"));
    const double exposure = exposureOf(*out.scene.exposureEv);
    EXPECT_NEAR(out.scene.lights.at(0).intensity * exposure, 1.5, 1e-4);
    ASSERT_TRUE(out.scene.ambient);
    EXPECT_NEAR(out.scene.ambient->sky.x * exposure, 0.5, 1e-4);
}

TEST(CocosScene, AmbientAndFogAreRead) {
    SceneFolder folder;
    const ImportedScene out =
        folder.load(withComponent(R"({ "__type__": "cc.UITransform" })", "", R"({ "__type__": "cc.SceneGlobals",
        "ambient": { "__type__": "cc.AmbientInfo", "_skyColor": { "__type__": "cc.Color", "r": 255, "g": 255, "b": 0, "a": 255 }, "_skyIllum": 20000,
                     "_groundAlbedo": { "__type__": "cc.Vec4", "x": 0.2, "y": 0.2, "z": 0.2 } },
        "_skybox": { "__type__": "cc.SkyboxInfo", "_enabled": true },
        "fog": { "__type__": "cc.FogInfo", "_enabled": true, "_type": 2, "_fogDensity": 0.5, "_fogColor": { "__type__": "cc.Color", "r": 255, "g": 0, "b": 0, "a": 255 } } })"));
    ASSERT_TRUE(out.scene.ambient);
    EXPECT_EQ(out.scene.ambient->sky, glm::vec3(20000, 20000, 0));
    EXPECT_NEAR(out.scene.ambient->ground.x, 4000, 1e-2);
    EXPECT_EQ(out.scene.fog.type, FogType::Exp2);
    EXPECT_FLOAT_EQ(out.scene.fog.density, 0.4f);  // 0.5 x 4 / 5: what distances are divided by is 5 by default
    EXPECT_NEAR(out.scene.fog.color.r * exposureOf(*out.scene.exposureEv), 1, 1e-5);
    EXPECT_EQ(out.scene.fog.color.g, 0);
    EXPECT_TRUE(contains(folder.notes, "the sky is left out: it has no picture")) << folder.notes;
    EXPECT_FALSE(contains(folder.notes, "UITransform"));
}

TEST(CocosScene, NodesMultiplyAndInactiveOnesAreGone) {
    SceneFolder folder;
    const std::string ball = renderer(kSphere, "[]");
    const ImportedScene out =
        folder.load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
        { "__type__": "cc.Node", "_lpos": { "__type__": "cc.Vec3", "x": 10, "y": 0, "z": 0 }, "_lscale": { "__type__": "cc.Vec3", "x": 2, "y": 2, "z": 2 },
          "_children": [ { "__type__": "cc.Node", "_name": "a", "_lpos": { "__type__": "cc.Vec3", "x": 1, "y": 2, "z": 3 }, "_components": [)" +
                    ball + R"(] } ] },
        { "__type__": "cc.Node", "_active": false, "_components": [)" +
                    ball + R"(] },
        { "__type__": "cc.Node", "_components": [ { "__type__": "cc.MeshRenderer", "_enabled": false, "_mesh": { "__uuid__": ")" +
                    kSphere + R"(" } } ] },
        { "__type__": "cc.Node", "_lscale": { "__type__": "cc.Vec3", "x": -1, "y": 1, "z": 1 }, "_components": [)" +
                    ball + "] } ] } } ]");
    ASSERT_EQ(out.scene.instances.size(), 2u);
    EXPECT_EQ(out.scene.instances[0].name, "a");
    EXPECT_EQ(glm::vec3(out.scene.instances[0].world[3]), glm::vec3(12, 4, 6));
    EXPECT_FALSE(out.scene.instances[0].flipped);
    EXPECT_TRUE(out.scene.instances[1].flipped);
    EXPECT_EQ(out.scene.meshes.size(), 1u);  // shared
}

TEST(CocosScene, MaterialsBecomeEffects) {
    SceneFolder folder;
    const ImportedScene out =
        folder.load(withComponent(renderer(kSphere, std::string(R"([ { "__uuid__": ")") + kPaint + R"(" } ])")));
    const SceneMaterial& material = out.scene.materials.at(std::size_t(out.scene.instances.at(0).material));
    EXPECT_EQ(material.name, "paint");
    ASSERT_TRUE(material.effect);
    EXPECT_EQ(material.effect->effect, "builtin-standard");
    ASSERT_EQ(material.effect->passes.size(), 2u);
    EXPECT_EQ(material.effect->passes[0].properties.toJson(-1), R"({"metallic":0.25,"mainColor":[0,0.8,1,1]})");
    EXPECT_EQ(material.effect->passes[1].properties.toJson(-1), R"({"mainColor":[0,0.8,1,1]})");
}

TEST(CocosScene, ThePlainFormIsForOurOwnEffects) {
    SceneFolder folder;
    const ImportedScene out =
        folder.load(withComponent(renderer(kSphere, std::string(R"([ { "__uuid__": ")") + kPaint + R"(" } ])")),
                    MaterialForm::Plain);
    const SceneMaterial& material = out.scene.materials.at(std::size_t(out.scene.instances.at(0).material));
    EXPECT_FALSE(material.effect);
    EXPECT_NEAR(material.baseColor.g, 0.64, 1e-5);  // 0.8 squared
    EXPECT_FLOAT_EQ(material.metallic, 0.25f);
    EXPECT_FLOAT_EQ(material.roughness, 0.8f);
}

TEST(CocosScene, MeshesOfModelsAreFoundByTheirNumber) {
    SceneFolder folder;
    const ImportedScene out =
        folder.load(withComponent(renderer(std::string(kModel) + "@bbbbb", "[ null ]"),
                                  R"(, "_lpos": { "__type__": "cc.Vec3", "x": 0, "y": 7, "z": 0 })"));
    ASSERT_EQ(out.scene.instances.size(), 1u);
    EXPECT_EQ(glm::vec3(out.scene.instances[0].world[3]), glm::vec3(0, 7, 0));  // the file's own node does not count
    const SceneMaterial& material = out.scene.materials.at(std::size_t(out.scene.instances[0].material));
    EXPECT_EQ(material.name, "m1");
    ASSERT_TRUE(material.effect);  // translated as the editor's importer does
    EXPECT_EQ(material.effect->passes.at(0).properties.find("mainColor")->toJson(-1), "[1,1,1,1]");
    const ImportedScene other = folder.load(withComponent(
        renderer(std::string(kModel) + "@aaaaa", std::string(R"([ { "__uuid__": ")") + kModel + R"(@ccccc" } ])")));
    EXPECT_EQ(other.scene.materials.at(std::size_t(other.scene.instances.at(0).material)).name, "m1");
}

TEST(CocosScene, ModelsGetTangentsAsTheirMetaSays) {
    // The editor's words: 0 and 1 add none; 2, the default, and 3 do. A material of the scene may need them.
    for (const auto& [setting, expected] : {std::pair("", true), std::pair(R"("userData":{"tangents":1},)", false),
                                            std::pair(R"("userData":{"tangents":2},)", true)}) {
        SceneFolder folder;
        const std::filesystem::path meta = folder.folder.path() / "project/m.gltf.meta";
        folder.write("project/m.gltf.meta", "{" + std::string(setting) + readText(meta).substr(1));
        const ImportedScene out = folder.load(withComponent(renderer(std::string(kModel) + "@bbbbb", "[ null ]")));
        ASSERT_EQ(out.scene.instances.size(), 1u);
        EXPECT_EQ(out.scene.meshes.at(std::size_t(out.scene.instances[0].mesh)).hasTangents, expected) << setting;
    }
}

TEST(CocosScene, APrefabOfAModelIsPlacedWhole) {
    SceneFolder folder;
    const ImportedScene out = folder.load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } },
      { "__type__": "cc.Scene", "_children": [ { "__id__": 2 } ] },
      { "__type__": "cc.Node", "_prefab": { "__id__": 3 } },
      { "__type__": "cc.PrefabInfo", "fileId": "root", "asset": { "__uuid__": ")" +
                                          std::string(kModel) + R"(@ddddd" }, "instance": { "__id__": 4 } },
      { "__type__": "cc.PrefabInstance", "propertyOverrides": [ { "__id__": 5 }, { "__id__": 6 }, { "__id__": 7 } ] },
      { "__type__": "CCPropertyOverrideInfo", "targetInfo": { "__id__": 8 }, "propertyPath": [ "_lpos" ], "value": { "__type__": "cc.Vec3", "x": 1, "y": 2, "z": 3 } },
      { "__type__": "CCPropertyOverrideInfo", "targetInfo": { "__id__": 8 }, "propertyPath": [ "_name" ], "value": "suit" },
      { "__type__": "CCPropertyOverrideInfo", "targetInfo": { "__id__": 9 }, "propertyPath": [ "_lpos" ], "value": { "__type__": "cc.Vec3", "x": 9, "y": 9, "z": 9 } },
      { "__type__": "cc.TargetInfo", "localID": [ "root" ] }, { "__type__": "cc.TargetInfo", "localID": [ "inner" ] } ])");
    ASSERT_EQ(out.scene.instances.size(), 2u);
    EXPECT_EQ(glm::vec3(out.scene.instances[0].world[3]), glm::vec3(1, 2, 3));
    EXPECT_EQ(glm::vec3(out.scene.instances[1].world[3]), glm::vec3(6, 2, 3));
    EXPECT_TRUE(contains(folder.notes, "left out: changes inside of prefabs")) << folder.notes;
}

TEST(CocosScene, APrefabFileIsRead) {
    SceneFolder folder;
    const std::string uuid = "30ff50d1-0000-4000-8000-000000f1736b";
    folder.write("project/p.prefab.meta", SceneFolder::meta(uuid, "prefab"));
    folder.write("project/p.prefab", R"([ { "__type__": "cc.Prefab", "data": { "__id__": 1 } },
      { "__type__": "cc.Node", "_children": [ { "__id__": 2 } ], "_prefab": null },
      { "__type__": "cc.Node", "_name": "in", "_components": [)" +
                                         renderer(kSphere, "[]") + "] } ]");
    const ImportedScene out =
        folder.load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
      { "__type__": "cc.Node", "_prefab": { "__type__": "cc.PrefabInfo", "fileId": "root", "asset": { "__uuid__": ")" +
                    uuid + R"(" },
        "instance": { "__type__": "cc.PrefabInstance", "propertyOverrides": [ { "targetInfo": { "localID": [ "root" ] }, "propertyPath": [ "_lpos" ],
          "value": { "__type__": "cc.Vec3", "x": 4, "y": 0, "z": 0 } } ] } } } ] } } ])");
    ASSERT_EQ(out.scene.instances.size(), 1u);
    EXPECT_EQ(out.scene.instances[0].name, "in");
    EXPECT_EQ(glm::vec3(out.scene.instances[0].world[3]), glm::vec3(4, 0, 0));
}

TEST(CocosScene, InstancesOfAPrefabChangeWhatIsInIt) {
    SceneFolder folder;
    const std::string uuid = "30ff50d1-0000-4000-8000-000000f1736b";
    folder.write("project/p.prefab.meta", SceneFolder::meta(uuid, "prefab"));
    folder.write("project/p.prefab", R"([ { "__type__": "cc.Prefab", "data": { "__id__": 1 } },
      { "__type__": "cc.Node", "_name": "root", "_children": [ { "__id__": 2 }, { "__id__": 5 } ],
        "_prefab": { "__type__": "cc.PrefabInfo", "fileId": "root" } },
      { "__type__": "cc.Node", "_name": "in", "_components": [ { "__id__": 3 } ], "_prefab": { "__id__": 4 } },
      { "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": ")" +
                                         kSphere + R"(" }, "_materials": [ null ],
        "__prefab": { "__type__": "cc.CompPrefabInfo", "fileId": "look" } },
      { "__type__": "cc.PrefabInfo", "fileId": "inner" },
      { "__type__": "cc.Node", "_name": "other", "_prefab": { "__type__": "cc.PrefabInfo", "fileId": "gone" }, "_components": [ )" +
                                         renderer(kSphere, "[]") + "] } ]");
    const auto change = [](const char* id, const std::string& path, const std::string& value) {
        return R"({ "targetInfo": { "localID": [ ")" + std::string(id) + R"(" ] }, "propertyPath": [ )" + path +
               R"( ], "value": )" + value + " }";
    };
    const auto instance = [&](const std::string& changes) {
        return R"({ "__type__": "cc.Node", "_prefab": { "__type__": "cc.PrefabInfo", "fileId": "root", "asset": { "__uuid__": ")" +
               uuid + R"(" }, "instance": { "__type__": "cc.PrefabInstance", "propertyOverrides": [ )" + changes +
               " ] } } }";
    };
    const ImportedScene out = folder.load(
        R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [ )" +
        instance(change("inner", R"("_lpos")", R"({ "__type__": "cc.Vec3", "x": 0, "y": 3, "z": 0 })") + "," +
                 change("look", R"("_materials", "0")", R"({ "__uuid__": ")" + std::string(kPaint) + "\" }") + "," +
                 change("gone", R"("_active")", "false")) +
        "," + instance(change("root", R"("_lpos", "x")", "1") + "," + change("nobody", R"("_active")", "false")) +
        "] } } ]");
    ASSERT_EQ(out.scene.instances.size(), 3u) << folder.notes;
    EXPECT_EQ(glm::vec3(out.scene.instances[0].world[3]), glm::vec3(0, 3, 0));
    EXPECT_EQ(out.scene.materials.at(std::size_t(out.scene.instances[0].material)).name, "paint");
    // The second instance has the prefab as it is.
    EXPECT_EQ(glm::vec3(out.scene.instances[1].world[3]), glm::vec3(0, 0, 0));
    EXPECT_NE(out.scene.materials.at(std::size_t(out.scene.instances[1].material)).name, "paint");
    EXPECT_EQ(out.scene.instances[2].name, "other");
    EXPECT_TRUE(contains(folder.notes, "left out: changes inside of prefabs, 2 times")) << folder.notes;
}

TEST(CocosScene, OtherComponentsAreOneNoteAKind) {
    SceneFolder folder;
    folder.load(
        R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [ { "__type__": "cc.Node", "_components": [
        { "__type__": "cc.ParticleSystem" }, { "__type__": "cc.ParticleSystem" }, { "__type__": "cc.Label" } ] } ] } } ])");
    EXPECT_TRUE(contains(folder.notes, "left out: cc.ParticleSystem, 2 times")) << folder.notes;
    EXPECT_TRUE(contains(folder.notes, "left out: cc.Label\n"));
}

TEST(CocosScene, WrongFilesAreErrors) {
    SceneFolder folder;
    EXPECT_TRUE(
        contains(folder.errors(R"([ { "__type__": "cc.Material" } ])"), "this is no scene: its type is 'cc.Material'"));
    EXPECT_TRUE(contains(folder.errors(R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 9 } } ])"),
                         "'scene' is object 9"));
    EXPECT_TRUE(contains(folder.errors(R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } },
        { "__type__": "cc.Scene", "_children": [ { "__id__": 1 } ] } ])"),
                         "this node is one of its own children"));
    EXPECT_TRUE(contains(folder.errors(withComponent(R"({ "__type__": "cc.Camera", "_fov": "wide" })")),
                         "'_fov' must be a number, not a string"));
    EXPECT_TRUE(contains(folder.errors(withComponent(R"({ "__type__": "cc.Camera" })", R"(, "_lpos": 5)")),
                         "'_lpos' must be a vector or a colour"));
    EXPECT_TRUE(contains(folder.errors(withComponent(renderer("40ff50d1-0000-4000-8000-000000f1736b", "[]"))),
                         "of the mesh of 'thing'"));
    EXPECT_TRUE(contains(folder.errors(withComponent(renderer(std::string(kPrimitivesUuid) + "@00000", "[]"))),
                         "is none of the built-in meshes"));
    EXPECT_TRUE(contains(folder.errors(withComponent(
                             renderer(kSphere, R"([ { "__uuid__": "40ff50d1-0000-4000-8000-000000f1736b" } ])"))),
                         "of the material of 'thing'"));
    EXPECT_TRUE(contains(folder.errors(withComponent(renderer(kSphere, "[ 5 ]"))),
                         "a material of 'thing' must be an asset or null"));
    std::string deep = R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } })";
    for (int i = 1; i < 400; ++i)
        deep += R"(, { "__type__": "cc.Node", "_children": [ { "__id__": )" + std::to_string(i + 1) + " } ] }";
    EXPECT_TRUE(
        contains(folder.errors(deep + R"(, { "__type__": "cc.Node" } ])"), "nodes nested deeper than 256 levels"));
}

TEST(CocosScene, WhatTwoWalksSeeIsSaidOnce) {
    SceneFolder folder;
    const std::string text = folder.errors(withComponent(R"({ "__type__": "cc.Camera" })", R"(, "_lpos": 5)"));
    const auto first = text.find("'_lpos' must be a vector or a colour");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("'_lpos' must be", first + 1), std::string::npos) << text;
    EXPECT_TRUE(contains(folder.errors(R"([ { "__type__": "cc.SceneAsset" } ])"),
                         "'scene' of this 'cc.SceneAsset' is missing"));
}

TEST(CocosScene, TwoOfEachChildIsBounded) {
    SceneFolder folder;
    std::string wide = R"([ { "__type__": "cc.SceneAsset", "scene": { "__id__": 1 } })";
    for (int i = 1; i < 60; ++i) {
        const std::string next = std::to_string(i + 1);
        wide += R"(, { "__type__": "cc.Node", "_children": [ { "__id__": )" + next + R"( }, { "__id__": )" + next +
                " } ] }";
    }
    EXPECT_TRUE(contains(folder.errors(wide + R"(, { "__type__": "cc.Node" } ])"), "more than 1000000 nodes"));
}

}  // namespace
}  // namespace crevice::cocos
