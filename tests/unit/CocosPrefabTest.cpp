// Prefabs inside of prefabs, what instances change, hang in and take away, and instances of models.
#include <fmt/format.h>
#include "CocosSceneFixture.h"

#include "cocos/files/NamedUuid.h"
#include "cocos/files/Uuid.h"
#include "core/Image.h"

namespace crevice::cocos {
namespace {

constexpr const char* kInner = "31ff50d1-0000-4000-8000-000000f1736b";
constexpr const char* kOuter = "32ff50d1-0000-4000-8000-000000f1736b";

std::string place(float x, float y, float z) {
    return R"({ "__type__": "cc.Vec3", "x": )" + std::to_string(x) + R"(, "y": )" + std::to_string(y) + R"(, "z": )" +
           std::to_string(z) + " }";
}

std::string target(std::initializer_list<const char*> ids) {
    std::string list;
    for (const char* id : ids) list += (list.empty() ? "\"" : ", \"") + std::string(id) + "\"";
    return R"({ "__type__": "cc.TargetInfo", "localID": [ )" + list + " ] }";
}

std::string change(std::initializer_list<const char*> ids, const std::string& path, const std::string& value) {
    return R"({ "__type__": "CCPropertyOverrideInfo", "targetInfo": )" + target(ids) + R"(, "propertyPath": [ )" +
           path + R"( ], "value": )" + value + " }";
}

/// A node that stands for a prefab whose root has `rootId`.
std::string instance(const std::string& asset, const std::string& rootId, const std::string& id,
                     const std::string& changes, const std::string& more = "") {
    return R"({ "__type__": "cc.Node", "_prefab": { "__type__": "cc.PrefabInfo", "fileId": ")" + rootId +
           R"(", "asset": { "__uuid__": ")" + asset +
           R"(" }, "instance": { "__type__": "cc.PrefabInstance", "fileId": ")" + id + R"(", "propertyOverrides": [ )" +
           changes + " ]" + more + " } } }";
}

std::string prefab(const std::string& rootId, const std::string& children) {
    return R"([ { "__type__": "cc.Prefab", "data": { "__id__": 1 } }, { "__type__": "cc.Node", "_name": "root", "_children": [ )" +
           children + R"( ], "_prefab": { "__type__": "cc.PrefabInfo", "fileId": ")" + rootId +
           R"(", "instance": null } } ])";
}

std::string scene(const std::string& children) {
    return R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [ )" + children +
           " ] } } ]";
}

/// inner.prefab: a root and in it one sphere "ball"; outer.prefab: a root and in it an instance of inner at x = 10.
struct PrefabFolder : SceneFolder {
    PrefabFolder() {
        write("project/inner.prefab.meta", meta(kInner, "prefab"));
        write(
            "project/inner.prefab",
            prefab(
                "innerRoot",
                R"({ "__type__": "cc.Node", "_name": "ball", "_prefab": { "__type__": "cc.PrefabInfo", "fileId": "ball" },
                "_components": [ { "__type__": "cc.MeshRenderer", "_mesh": { "__uuid__": ")" +
                    kSphere +
                    R"(" }, "_materials": [ null ], "_shadowCastingMode": 1, "__prefab": { "fileId": "look" } } ] })"));
        write("project/outer.prefab.meta", meta(kOuter, "prefab"));
        write("project/outer.prefab",
              prefab("outerRoot", instance(kInner, "innerRoot", "first",
                                           change({"innerRoot"}, "\"_lpos\"", place(10, 0, 0)) + "," +
                                               change({"ball"}, "\"_lpos\"", place(0, 1, 0)))));
    }
    static glm::vec3 at(const ImportedScene& out, std::size_t i) { return out.scene.instances.at(i).world[3]; }
    static std::string materialOf(const ImportedScene& out, std::size_t i) {
        return out.scene.materials.at(std::size_t(out.scene.instances.at(i).material)).name;
    }
};

TEST(CocosPrefab, InsideOfPrefabsTheOuterInstanceCounts) {
    PrefabFolder folder;
    const std::string paint = R"({ "__uuid__": ")" + std::string(kPaint) + "\" }";
    const ImportedScene out =
        folder.load(scene(instance(kOuter, "outerRoot", "a", change({"outerRoot"}, "\"_lpos\"", place(0, 0, 5))) + "," +
                          instance(kOuter, "outerRoot", "b",
                                   change({"first", "ball"}, "\"_lpos\"", place(0, 2, 0)) + "," +
                                       change({"first", "look"}, R"("_materials", "0")", paint) + "," +
                                       change({"first", "innerRoot"}, "\"_lpos\"", place(20, 0, 0)))));
    ASSERT_EQ(out.scene.instances.size(), 2u) << folder.notes;
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(10, 1, 5));
    EXPECT_NE(PrefabFolder::materialOf(out, 0), "paint");
    EXPECT_EQ(PrefabFolder::at(out, 1), glm::vec3(20, 2, 0));
    EXPECT_EQ(PrefabFolder::materialOf(out, 1), "paint");
    EXPECT_FALSE(contains(folder.notes, "left out: changes")) << folder.notes;
}

TEST(CocosPrefab, InstancesHangNodesAndComponentsIntoPrefabsAndTakeSomeAway) {
    PrefabFolder folder;
    const std::string cube = renderer(std::string(kPrimitivesUuid) + "@a804a", "[ null ]");
    const std::string mounted =
        R"(, "mountedChildren": [ { "__type__": "cc.MountedChildrenInfo", "targetInfo": )" + target({"first", "ball"}) +
        R"(, "nodes": [ { "__type__": "cc.Node", "_name": "hat", "_lpos": )" + place(0, 0, 3) +
        R"(, "_components": [ )" + cube +
        R"( ] } ] } ], "mountedComponents": [ { "__type__": "cc.MountedComponentsInfo", "targetInfo": )" +
        target({"outerRoot"}) + R"(, "components": [ { "__type__": "cc.SphereLight" } ] } ], "removedComponents": [ )" +
        target({"first", "look"}) + " ]";
    const ImportedScene out = folder.load(
        scene(instance(kOuter, "outerRoot", "a", change({"outerRoot"}, "\"_lpos\"", place(0, 0, 5)), mounted)));
    ASSERT_EQ(out.scene.instances.size(), 1u) << folder.notes;  // the ball's renderer is gone
    EXPECT_EQ(out.scene.instances[0].name, "hat");
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(10, 1, 8));
    ASSERT_EQ(out.scene.lights.size(), 1u);
    EXPECT_EQ(out.scene.lights[0].position, glm::vec3(0, 0, 5));
    EXPECT_FALSE(contains(folder.notes, "left out")) << folder.notes;
}

TEST(CocosPrefab, WhatIsHungInBelongsToTheFileOfTheInstance) {
    // The node that outer.prefab hangs below the ball has a fileId there: the scene changes it through the way to it.
    PrefabFolder folder;
    const std::string hat =
        R"({ "__type__": "cc.Node", "_name": "hat", "_prefab": { "fileId": "hat" }, "_components": [ )" +
        renderer(kSphere, "[ null ]") + " ] }";
    folder.write("project/outer.prefab",
                 prefab("outerRoot", instance(kInner, "innerRoot", "first", "",
                                              R"(, "mountedChildren": [ { "targetInfo": )" + target({"ball"}) +
                                                  R"(, "nodes": [ )" + hat + " ] } ]")));
    const ImportedScene out =
        folder.load(scene(instance(kOuter, "outerRoot", "a", change({"first", "hat"}, "\"_lpos\"", place(0, 7, 0)))));
    ASSERT_EQ(out.scene.instances.size(), 2u) << folder.notes;
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(0));
    EXPECT_EQ(PrefabFolder::at(out, 1), glm::vec3(0, 7, 0));
}

TEST(CocosPrefab, ValuesMayBeObjectsOfTheFileAndListsMayChangeTheirLength) {
    PrefabFolder folder;
    const ImportedScene out =
        folder.load(R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [ )" +
                    instance(kInner, "innerRoot", "a",
                             change({"innerRoot"}, "\"_lpos\"", R"({ "__id__": 1 })") + "," +
                                 change({"look"}, R"("_materials", "length")", "0") + "," +
                                 change({"look"}, R"("_shadowCastingMode")", "0") + "," +
                                 change({"look"}, R"("node")", R"({ "__id__": 0 })")) +
                    " ] } }, " + place(4, 0, 0) + " ]");
    ASSERT_EQ(out.scene.instances.size(), 1u) << folder.notes;
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(4, 0, 0));
    EXPECT_FALSE(out.scene.instances[0].castsShadow);
    EXPECT_TRUE(contains(folder.notes, "left out: changes inside of prefabs\n")) << folder.notes;  // the last of them
}

TEST(CocosPrefab, OneThatIsAPartOfItselfIsAnError) {
    PrefabFolder folder;
    folder.write("project/inner.prefab", prefab("innerRoot", instance(kOuter, "outerRoot", "loop", "")));
    const std::string text = folder.errors(scene(instance(kOuter, "outerRoot", "a", "")));
    EXPECT_TRUE(contains(text, "inner.prefab:1:")) << text;
    EXPECT_TRUE(contains(text, "outer.prefab' is a part of itself")) << text;
}

TEST(CocosPrefab, TwoOfEachInsideOfEachOtherAreBounded) {
    PrefabFolder folder;
    const auto uuid = [](int i) { return fmt::format("35ff50d1-0000-4000-8000-0000000000{:02x}", i); };
    for (int i = 0; i < 40; ++i) {
        folder.write(fmt::format("project/p{}.prefab.meta", i), SceneFolder::meta(uuid(i), "prefab"));
        const std::string next =
            i < 39 ? instance(uuid(i + 1), "r", "a", "") + "," + instance(uuid(i + 1), "r", "b", "") : "";
        folder.write(fmt::format("project/p{}.prefab", i), prefab("r", next));
    }
    EXPECT_TRUE(contains(folder.errors(scene(instance(uuid(0), "r", "s", ""))), "more than 1000000 nodes"));
}

TEST(CocosPrefab, OneThatCannotBeReadIsSaidOnce) {
    PrefabFolder folder;
    folder.write("project/inner.prefab", R"([ { "__type__": "cc.Prefab", "data": { "__id__": 9 } } ])");
    const std::string text =
        folder.errors(scene(instance(kInner, "innerRoot", "a", "") + "," + instance(kInner, "innerRoot", "b", "")));
    const auto first = text.find("'data' is object 9, but this file has 1");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("'data' is object 9", first + 1), std::string::npos) << text;
}

// Of the editor's importer of glTF: 'm0', 'm0/a0', … are the paths, and the ids are theirs in its namespace, computed
// with Python's uuid module.
constexpr const char* kRootId = "a3e2Mtie5ea5wJXWJuRsS1";
constexpr const char* kFirstId = "55hvNBI9Vdb4QG9AKlE5WL";
constexpr const char* kSecondId = "0ajMH4pcVW5KloKRkwrgQM";
constexpr const char* kSecondLookId = "b8QkzC+L5SfqhBkfBbKVXp";

TEST(CocosPrefab, InstancesOfModelsChangeWhatIsInThem) {
    PrefabFolder folder;
    const std::string model = std::string(kModel) + "@ddddd";
    const std::string paint = R"({ "__uuid__": ")" + std::string(kPaint) + "\" }";
    const std::string hung = R"(, "mountedChildren": [ { "targetInfo": )" + target({kSecondId}) +
                             R"(, "nodes": [ { "__type__": "cc.Node", "_name": "sword", "_components": [ )" +
                             renderer(kSphere, "[ null ]") + " ] } ] } ]";
    const ImportedScene out =
        folder.load(scene(instance(model, kRootId, "x",
                                   change({kRootId}, "\"_lpos\"", place(0, 0, 1)) + "," +
                                       change({kSecondId}, "\"_lpos\"", place(0, 9, 0)) + "," +
                                       change({kSecondLookId}, R"("_materials", "0")", paint) + "," +
                                       change({kSecondLookId}, R"("_shadowCastingMode")", "1") + "," +
                                       change({kFirstId}, "\"_lscale\"", place(2, 2, 2)),
                                   hung) +
                          "," + instance(model, kRootId, "y", change({kFirstId}, "\"_active\"", "false"))));
    ASSERT_EQ(out.scene.instances.size(), 4u) << folder.notes;
    EXPECT_EQ(out.scene.instances[0].name, "a");
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(0, 0, 1));
    EXPECT_EQ(out.scene.instances[0].world[0].x, 2);
    EXPECT_EQ(PrefabFolder::materialOf(out, 0), "m0");
    EXPECT_EQ(PrefabFolder::at(out, 1), glm::vec3(0, 9, 1));
    EXPECT_EQ(PrefabFolder::materialOf(out, 1), "paint");
    EXPECT_FALSE(out.scene.instances[0].castsShadow);
    EXPECT_TRUE(out.scene.instances[1].castsShadow);
    EXPECT_EQ(out.scene.instances[2].name, "sword");
    EXPECT_EQ(PrefabFolder::at(out, 2), glm::vec3(0, 9, 1));
    EXPECT_EQ(PrefabFolder::at(out, 3), glm::vec3(5, 0, 0));  // of the other instance, where the model has it
    EXPECT_EQ(PrefabFolder::materialOf(out, 3), "m1");
    EXPECT_FALSE(contains(folder.notes, "left out")) << folder.notes;
}

TEST(CocosPrefab, MaterialsThatTheEditorExtractedAreThose) {
    PrefabFolder folder;
    folder.write("project/m.gltf.meta", R"({"importer":"gltf","uuid":")" + std::string(kModel) +
                                            R"(","subMetas":{"ddddd":{"importer":"gltf-scene","uuid":")" + kModel +
                                            R"(@ddddd"}},"userData":{"assetFinder":{"materials":[")" + kModel +
                                            R"(@ccccc",")" + kPaint + "\"]}}}");
    const ImportedScene out = folder.load(scene(instance(std::string(kModel) + "@ddddd", kRootId, "x", "")));
    ASSERT_EQ(out.scene.instances.size(), 2u) << folder.notes;
    EXPECT_EQ(PrefabFolder::materialOf(out, 0), "m0");
    EXPECT_EQ(PrefabFolder::materialOf(out, 1), "paint");
}

TEST(CocosPrefab, NamesOfNodesAreMadeDifferentAndMatricesAreTakenApart) {
    // Children of one node that share a name, or have none, get one of the importer's; -1 mirrors x.
    PrefabFolder folder;
    folder.write("project/m.gltf", R"({ "asset": { "version": "2.0" }, "scenes": [ { "nodes": [ 0 ] } ], "nodes": [
      { "children": [ 1, 2, 3 ] }, { "mesh": 0, "name": "leaf" }, { "mesh": 0, "name": "leaf" },
      { "mesh": 0, "matrix": [ -2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1 ] } ],
      "meshes": [ { "primitives": [ { "attributes": { "POSITION": 0 } } ] } ],
      "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [ 0, 0, 0 ], "max": [ 1, 1, 0 ] } ],
      "bufferViews": [ { "buffer": 0, "byteLength": 36 } ], "buffers": [ { "byteLength": 36, "uri": "m.bin" } ] })");
    const auto id = [](const std::string& path) {
        return compressUuid(namedUuid("8fa06a75-f07a-44d4-82cf-d08c3c986599", path));
    };
    const std::string second = id("m0/Node-00/leaf(__autogen 1)1"), third = id("m0/Node-00/(__autogen 2)2");
    const ImportedScene out = folder.load(scene(instance(std::string(kModel) + "@ddddd", kRootId, "x",
                                                         change({second.c_str()}, "\"_lpos\"", place(0, 1, 0)) + "," +
                                                             change({third.c_str()}, R"("_lpos", "y")", "7"))));
    ASSERT_EQ(out.scene.instances.size(), 3u) << folder.notes;
    EXPECT_EQ(PrefabFolder::at(out, 0), glm::vec3(0));
    EXPECT_EQ(PrefabFolder::at(out, 1), glm::vec3(0, 1, 0));
    EXPECT_EQ(PrefabFolder::at(out, 2), glm::vec3(1, 7, 3));
    EXPECT_NEAR(out.scene.instances[2].world[0].x, -2, 1e-5);
    EXPECT_NEAR(out.scene.instances[2].world[1].y, 2, 1e-5);
    EXPECT_TRUE(out.scene.instances[2].flipped);
    EXPECT_FALSE(contains(folder.notes, "left out")) << folder.notes;
}

TEST(CocosNamedUuid, AreThoseOfTheStandards) {
    const auto hex = [](std::string_view text) {
        std::string digits;
        for (const std::uint8_t byte : sha1(text)) digits += fmt::format("{:02x}", byte);
        return digits;
    };
    // FIPS 180's two examples, and nothing at all.
    EXPECT_EQ(hex("abc"), "a9993e364706816aba3e25717850c26c9cd0d89d");
    EXPECT_EQ(hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "84983e441c3bd26ebaae4aa1f95129e5e54670f1");
    EXPECT_EQ(hex(""), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
    // Python's uuid.uuid5(uuid.NAMESPACE_DNS, 'python.org'), as its manual prints it.
    EXPECT_EQ(namedUuid("6ba7b810-9dad-11d1-80b4-00c04fd430c8", "python.org"), "886313e1-3b8a-5372-9b90-0c9aee199e5d");
    const std::string whole = "fc991dd7-0033-4b80-9d41-c8a86a702e59";
    EXPECT_EQ(normalizeUuid(compressUuid(whole)), whole);
    EXPECT_EQ(compressUuid(whole).size(), 22u);
}

TEST(CocosScene, TexturesInsideOfModelsAreThePicturesThatTheyName) {
    SceneFolder folder;
    const std::string picture = "33ff50d1-0000-4000-8000-000000f1736b";
    Image red(2, 1, Format::RGBA8);
    writeImage(folder.folder.path() / "project/red.png", red);
    folder.write("project/red.png.meta", SceneFolder::meta(picture, "image"));
    for (const std::string& named : {std::string("db://assets/red.png"), picture + "@6c48a"}) {
        folder.write(
            "project/m.gltf.meta",
            R"({"importer":"gltf","uuid":")" + std::string(kModel) +
                R"(","subMetas":{"e39f7":{"importer":"texture","uuid":")" + kModel +
                R"(@e39f7","userData":{"wrapModeS":"clamp-to-edge","isUuid":false,"imageUuidOrDatabaseUri":")" + named +
                "\"}}}}");
        folder.write("project/paint.mtl",
                     R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": ")" + std::string(kStandard) +
                         R"(" }, "_props": [ { "mainTexture": { "__uuid__": ")" + kModel + R"(@e39f7" } } ] })");
        folder.notes.clear();
        const ImportedScene out =
            folder.load(withComponent(renderer(kSphere, R"([ { "__uuid__": ")" + std::string(kPaint) + "\" } ]")));
        ASSERT_EQ(out.scene.textures.size(), 1u) << named << folder.notes;
        EXPECT_EQ(out.scene.textures[0].name, "red.png");
        EXPECT_EQ(out.scene.textures[0].image.width, 2u);
        EXPECT_EQ(out.scene.textures[0].sampler.wrapU, TextureWrap::Clamp);
    }
}

TEST(CocosScene, PicturesInsideOfGlbAreRead) {
    SceneFolder folder;
    Image wide(3, 1, Format::RGBA8);
    writeImage(folder.folder.path() / "three.png", wide);
    std::string picture = readText(folder.folder.path() / "three.png"),
                json = R"({"asset":{"version":"2.0"},"images":[{"bufferView":0}],
        "bufferViews":[{"buffer":0,"byteOffset":4,"byteLength":)" +
                       std::to_string(picture.size()) + R"(}],"buffers":[{"byteLength":)" +
                       std::to_string(picture.size() + 4) + "}]}";
    picture.insert(0, "skip");
    const auto word = [](std::size_t value) {
        std::string bytes;
        for (int shift = 0; shift < 32; shift += 8) bytes += char(value >> shift & 255);
        return bytes;
    };
    const auto chunk = [&](std::string data, const char* kind, char fill) {
        while (data.size() % 4 != 0) data += fill;
        return word(data.size()) + std::string(kind, 4) + data;
    };
    const std::string chunks = chunk(json, "JSON", ' ') + chunk(picture, "BIN\0", '\0');
    folder.write("project/e.glb", "glTF" + word(2) + word(12 + chunks.size()) + chunks);
    const std::string uuid = "34ff50d1-0000-4000-8000-000000f1736b";
    const auto read = [&](int number) {
        folder.write("project/e.glb.meta",
                     R"({"importer":"gltf","uuid":")" + uuid + R"(","subMetas":{
          "e39f7":{"importer":"texture","uuid":")" +
                         uuid + R"(@e39f7","userData":{"isUuid":true,"imageUuidOrDatabaseUri":")" + uuid + R"(@1e1d0"}},
          "1e1d0":{"importer":"gltf-embeded-image","uuid":")" +
                         uuid + R"(@1e1d0","userData":{"gltfIndex":)" + std::to_string(number) + "}}}}");
        folder.write("project/paint.mtl",
                     R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": ")" + std::string(kStandard) +
                         R"(" }, "_props": [ { "mainTexture": { "__uuid__": ")" + uuid + R"(@e39f7" } } ] })");
        folder.notes.clear();
        return folder.load(withComponent(renderer(kSphere, R"([ { "__uuid__": ")" + std::string(kPaint) + "\" } ]")))
            .scene;
    };
    const Scene good = read(0);
    ASSERT_EQ(good.textures.size(), 1u) << folder.notes;
    EXPECT_EQ(good.textures[0].image.width, 3u);
    EXPECT_TRUE(read(1).textures.empty());
    EXPECT_TRUE(contains(folder.notes, "picture 1 of 'e.glb' is not in its binary chunk")) << folder.notes;
}

TEST(CocosScene, ComponentsMayHaveTheirNamesOfBefore) {
    SceneFolder folder;
    const std::string model =
        R"({ "__type__": "cc.ModelComponent", "_mesh": { "__uuid__": ")" + kSphere + R"(" }, "_materials": [] })";
    EXPECT_EQ(folder.load(withComponent(model)).scene.instances.size(), 1u);
    const ImportedScene light = folder.load(withComponent(R"({ "__type__": "cc.SphereLightComponent", "_size": 2 })"));
    ASSERT_EQ(light.scene.lights.size(), 1u);
    EXPECT_EQ(light.scene.lights[0].type, LightType::Point);
    EXPECT_EQ(folder.load(withComponent(R"({ "__type__": "cc.CameraComponent" })")).scene.cameras.size(), 1u);
    const std::string box = renderer(std::string(kPrimitivesUuid) + "@box.mesh", "[]");
    EXPECT_EQ(folder.load(withComponent(box)).scene.instances.size(), 1u);
}

TEST(CocosScene, LayersThatTheFirstCameraDoesNotSeeAreLeftOut) {
    SceneFolder folder;
    const auto drawn = [&](const std::string& visibility, const std::string& layer) {
        folder.notes.clear();
        return folder
            .load(withComponent(
                renderer(kSphere, "[]") + R"(, { "__type__": "cc.Camera")" + visibility + "}",
                R"(, "_children": [ { "__type__": "cc.Node", "_components": [ { "__id__": 4 } ] } ])" + layer))
            .scene.instances.size();
    };
    EXPECT_EQ(drawn("", R"(, "_layer": 8)"), 1u);
    EXPECT_EQ(drawn(R"(, "_visibility": 24)", R"(, "_layer": 8)"), 1u);
    EXPECT_EQ(drawn(R"(, "_visibility": 16)", R"(, "_layer": 8)"), 0u);
    EXPECT_TRUE(contains(folder.notes, "left out: renderers on layers that the first camera does not see"))
        << folder.notes;
    EXPECT_EQ(drawn(R"(, "_visibility": 1822425087)", ""), 1u);         // the editor's number sees the usual layer
    EXPECT_EQ(drawn(R"(, "_visibility": 0)", R"(, "_layer": 1)"), 1u);  // 1.x
}

TEST(CocosScene, MaterialsInsideOfOtherModelsAreLeftOut) {
    SceneFolder folder;
    folder.write("project/f.fbx", "");
    folder.write("project/f.fbx.meta", R"({"importer":"fbx","uuid":")" + std::string(kInner) +
                                           R"(","subMetas":{"eeeee":{"importer":"gltf-material","uuid":")" + kInner +
                                           R"(@eeeee"}}})");
    const ImportedScene out =
        folder.load(withComponent(renderer(kSphere, R"([ { "__uuid__": ")" + std::string(kInner) + "@eeeee\" } ]")));
    EXPECT_EQ(out.scene.instances.size(), 1u);
    EXPECT_TRUE(contains(folder.notes, "left out: materials of models that are not glTF")) << folder.notes;
}

}  // namespace
}  // namespace crevice::cocos
