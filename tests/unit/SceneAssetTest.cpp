// Scene documents: what they become, and where their mistakes are pointed out.
#include "scene/SceneAsset.h"

#include "SceneTestTools.h"

namespace crevice {
namespace {

using test::contains;
using test::errorOf;

Scene read(const std::string& text) {
    const test::Listener listener;
    return readSceneAsset(parseJson(text, "s.scene.json"), ".", {.log = listener.log});
}

std::string errorIn(const std::string& text) {
    return errorOf([&] { read(text); });
}

glm::vec3 origin(const Instance& instance) { return glm::vec3(instance.world[3]); }

TEST(SceneAsset, EveryPrimitiveMakesAMesh) {
    const Scene scene = read(R"({"objects": [{"primitive": "box"}, {"primitive": "plane"}, {"primitive": "sphere"},
        {"primitive": "cylinder"}, {"primitive": "torus"}, {"primitive": "wedge"}, {"primitive": "arch"},
        {"primitive": "lathe", "profile": [[1, 0], [0.5, 1]]}]})");
    ASSERT_EQ(scene.meshes.size(), 8u);
    for (const Mesh& mesh : scene.meshes) EXPECT_FALSE(mesh.indices.empty()) << mesh.name;
    EXPECT_EQ(scene.instances.size(), 8u);
    EXPECT_EQ(scene.materials.size(), 1u);  // one default for all
}

TEST(SceneAsset, EqualPrimitivesShareOneMesh) {
    const Scene scene =
        read(R"({"objects": [{"primitive": "box", "size": [1, 2, 3]}, {"primitive": "box", "size": [1, 2, 3]},
                                             {"primitive": "box", "size": [1, 2, 4]}]})");
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_EQ(scene.instances[0].mesh, scene.instances[1].mesh);
}

TEST(SceneAsset, ArraysAndInstancesMultiply) {
    const Scene scene = read(R"({"objects": [{"primitive": "box", "position": [10, 0, 0],
        "array": {"count": [2, 1, 3], "step": [5, 0, 1]},
        "instances": [[0, 1, 0], {"position": [0, 2, 0], "scale": 2}]}]})");
    ASSERT_EQ(scene.instances.size(), 12u);
    EXPECT_EQ(origin(scene.instances[0]), glm::vec3(10, 1, 0));
    EXPECT_EQ(origin(scene.instances[1]), glm::vec3(10, 2, 0));
    EXPECT_EQ(origin(scene.instances[2]), glm::vec3(15, 1, 0));
    EXPECT_EQ(origin(scene.instances[11]), glm::vec3(15, 2, 2));
    EXPECT_EQ(scene.instances[1].world[0][0], 2);
}

TEST(SceneAsset, GroupsPlaceTheirObjects) {
    const Scene scene =
        read(R"({"objects": [{"position": [0, 0, 10], "rotation": [0, 90, 0], "instances": [[0, 0, 0], [0, 5, 0]],
        "objects": [{"primitive": "box", "position": [1, 0, 0]}, {"primitive": "sphere"}]}]})");
    ASSERT_EQ(scene.instances.size(), 4u);
    EXPECT_EQ(scene.meshes.size(), 2u);
    EXPECT_LT(glm::distance(origin(scene.instances[0]), glm::vec3(0, 0, 9)), 1e-5f);
    EXPECT_LT(glm::distance(origin(scene.instances[1]), glm::vec3(0, 5, 9)), 1e-5f);
}

TEST(SceneAsset, RotationIsAboutXThenYThenZ) {
    const Scene scene = read(R"({"objects": [{"primitive": "box", "rotation": [90, 90, 0]}]})");
    // x turns y to z, then y turns z to x.
    EXPECT_LT(glm::distance(glm::vec3(scene.instances[0].world * glm::vec4(0, 1, 0, 0)), glm::vec3(1, 0, 0)), 1e-5f);
}

TEST(SceneAsset, MirroredObjectsAreFlipped) {
    EXPECT_TRUE(read(R"({"objects": [{"primitive": "wedge", "scale": [1, 1, -1]}]})").instances[0].flipped);
}

TEST(SceneAsset, ReadsCamerasLightsAndAir) {
    const Scene scene =
        read(R"({"name": "hall", "camera": {"name": "a", "eye": [1, 2, 3], "fov": 60, "near": 0.5, "far": 50},
        "cameras": [{"orthoHeight": 4}],
        "lights": [{"type": "spot", "position": [0, 3, 0], "direction": [0, -2, 0], "innerAngle": 10, "outerAngle": 30, "range": 8,
                    "intensity": 100, "castsShadow": false}],
        "ambient": {"sky": [0.1, 0.2, 0.3]}, "fog": {"type": "linear", "start": 5, "end": 20},
        "sky": {"zenith": [0, 0, 1]}, "exposure": 1.5})");
    EXPECT_EQ(scene.name, "hall");
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_LT(glm::distance(scene.cameras[0].position(), {1, 2, 3}), 1e-5f);
    EXPECT_FLOAT_EQ(scene.cameras[0].fovY, glm::radians(60.0f));
    EXPECT_EQ(scene.cameras[0].far, 50);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::Spot);
    EXPECT_EQ(scene.lights[0].direction, glm::vec3(0, -1, 0));
    EXPECT_FLOAT_EQ(scene.lights[0].outerAngle, glm::radians(30.0f));
    EXPECT_FALSE(scene.lights[0].castsShadow);
    EXPECT_EQ(scene.ambient->sky, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(scene.fog.type, FogType::Linear);
    EXPECT_EQ(scene.fog.end, 20);
    EXPECT_TRUE(scene.sky.enabled);
    EXPECT_EQ(scene.exposureEv, 1.5f);
    EXPECT_FALSE(read(R"({"exposure": "auto"})").exposureEv);
}

TEST(SceneAsset, ReadsMaterials) {
    const Scene scene =
        read(R"({"materials": {"glass": {"baseColor": [0.5, 0.25, 1], "alpha": 0.5, "alphaMode": "blend"}},
                                 "objects": [{"primitive": "box", "material": "glass"}]})");
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].baseColor, glm::vec4(0.5f, 0.25f, 1, 0.5f));
    EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::Blend);
    EXPECT_EQ(scene.materials[0].metallic, 0);
}

TEST(SceneAsset, MistakesHavePlacesAndNearNames) {
    const std::string error = errorIn(R"({
  "materials": {"stone": {"rougness": 1}},
  "objects": [
    {"primitive": "spehre"},
    {"primitive": "box", "material": "stome"},
    {"primitive": "sphere", "size": [1, 1, 1]},
    {"primitive": "sphere", "radius": -1},
    {"material": "stone"},
    {"primitive": "box", "scale": 0}
  ],
  "lights": {"type": "point"},
  "camrea": {}
})");
    for (const char* part : {"s.scene.json:2:27",
                             "'rougness'",
                             "'roughness'",
                             "s.scene.json:4:19",
                             "'spehre'",
                             "did you mean 'sphere'?",
                             "s.scene.json:5:38",
                             "no material 'stome'",
                             "did you mean 'stone'?",
                             "s.scene.json:6:29",
                             "'size'",
                             "s.scene.json:7:39",
                             "'radius'",
                             "s.scene.json:8:5",
                             "neither 'primitive' nor 'objects'",
                             "s.scene.json:9:35",
                             "'scale' may not be 0",
                             "s.scene.json:11:13",
                             "'lights' must be a list",
                             "s.scene.json:12:3",
                             "'camrea'",
                             "'camera'"})
        EXPECT_TRUE(contains(error, part)) << part << "\nin\n" << error;
}

TEST(SceneAsset, LimitsAreKept) {
    EXPECT_TRUE(contains(errorIn(R"({"objects": [{"primitive": "box", "array": {"count": [1000, 1000, 1000]}}]})"),
                         "more than 1000000"));
    // Many groups with nothing in them take time as well; where none stands there is none to walk over.
    std::string groups = R"({"objects": [], "array": {"count": [100, 100, 100]}})";
    for (int i = 0; i < 4; ++i) groups += ", " + groups;
    EXPECT_TRUE(contains(errorIn(R"({"objects": [)" + groups + "]}"), "stand more than 4000000 times together"));
    EXPECT_EQ(errorIn(R"({"objects": [{"objects": [)" + groups + R"(], "instances": []}, {"primitive": "box"}]})"),
              "no error");
    std::string nested = R"({"primitive": "box"})";
    for (int i = 0; i < 20; ++i) nested = R"({"objects": [)" + nested + "]}";
    EXPECT_TRUE(contains(errorIn(R"({"objects": [)" + nested + "]}"), "nested deeper than 16"));
}

TEST(SceneAsset, NamesAGltfInItsOwnFolderOnly) {
    const test::TempFolder folder;
    const test::Listener listener;
    const std::string gltf = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}]})";
    folder.write("outside.gltf", gltf);
    folder.write("scenes/models/inside.gltf", gltf);
    const auto load = [&](const std::string& name, bool allowOutside) {
        return loadScene(
            folder.write("scenes/a.scene.json", R"({"gltf": ")" + name + R"(", "objects": [{"primitive": "box"}]})"),
            {.log = listener.log, .allowOutside = allowOutside});
    };
    EXPECT_EQ(load("models/inside.gltf", false).instances.size(), 1u);
    EXPECT_TRUE(contains(errorOf([&] { load("../outside.gltf", false); }), "lies outside the scene's folder"));
    EXPECT_EQ(load("../outside.gltf", true).instances.size(), 1u);
    EXPECT_TRUE(contains(errorOf([&] { load("none.gltf", false); }), "a.scene.json:1:10: error: no file 'none.gltf'"));
}

TEST(SceneAsset, OtherFilesAreNoScenes) {
    const test::Listener listener;
    EXPECT_TRUE(contains(errorOf([&] { loadScene("x.obj", {.log = listener.log}); }), ".gltf, .glb or .scene.json"));
}

TEST(SceneAsset, FieldTablesHaveHelpForEveryField) {
    const std::vector<SceneFieldTable> tables = sceneFieldTables();
    EXPECT_GE(tables.size(), 15u);
    for (const SceneFieldTable& table : tables)
        for (const ParamRow& row : table.rows) EXPECT_FALSE(row.help.empty()) << table.name << "." << row.key;
}

#if defined(CREVICE_TEST_SOURCE_DIR)
TEST(SceneAsset, ShippedScenesLoadAndAreSmall) {
    const std::filesystem::path folder = std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "assets/scenes";
    test::Listener listener;
    for (const char* name : {"default.scene.json", "crease.scene.json"}) {
        const Scene scene = loadScene(folder / name, {.log = listener.log});
        EXPECT_FALSE(scene.cameras.empty()) << name;
        EXPECT_FALSE(scene.lights.empty()) << name;
        EXPECT_TRUE(scene.ambient) << name;
        EXPECT_LT(std::filesystem::file_size(folder / name), 40000u) << name;
        EXPECT_FALSE(scene.bounds().empty) << name;
    }
    EXPECT_EQ(listener.text, "");
}
#endif

}  // namespace
}  // namespace crevice
