// Real glTF models give the triangle counts their list names, and broken ones are refused.
#include <algorithm>

#include "SceneTestTools.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

fs::path scenesFolder() {
#ifdef CREVICE_SCENES_DIR
    return CREVICE_SCENES_DIR;
#else
    return fs::path("..") / "shared" / "scenes";
#endif
}

class GltfModels : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::is_directory(scenesFolder()))
            GTEST_SKIP() << "no folder of test scenes: set CREVICE_SCENES at configuration";
    }
    Scene load(const std::string& name) { return loadGltf(scenesFolder() / name, {.log = listener_.log}); }
    test::Listener listener_;
};

TEST_F(GltfModels, HaveTheTrianglesOfTheirList) {
    const std::pair<const char*, std::size_t> kExpected[] = {{"atrium/atrium.gltf", 277248},
                                                             {"dungeon_hall/dungeon_hall.gltf", 65877},
                                                             {"FlightHelmet/FlightHelmet.gltf", 94722},
                                                             {"BoomBox/BoomBox.gltf", 6036},
                                                             {"zdm2_arena/zdm2.glb", 58772},
                                                             {"dutch_ship/dutch_ship_medium_1k.gltf", 69162},
                                                             {"garage/garage.gltf", 11358},
                                                             {"cornell_box/CornellBox.glb", 36},
                                                             {"sparse_box/box_sparse.glb", 12},
                                                             {"khr_Fox/Fox.glb", 576}};
    for (const auto& [name, triangles] : kExpected) EXPECT_EQ(test::triangleCount(load(name)), triangles) << name;
}

TEST_F(GltfModels, InstancesShareTheirMeshes) {
    const Scene scene = load("dungeon_hall/dungeon_hall.gltf");
    EXPECT_EQ(scene.meshes.size(), 19u);
    EXPECT_EQ(scene.instances.size(), 182u);
}

TEST_F(GltfModels, LightsOfTheSpecificationsSample) {
    const Scene scene = load("cameras_lights_khr/lights.gltf");
    // Three lights and two cameras are defined, but nodes hold only two lights and no camera.
    ASSERT_EQ(scene.lights.size(), 2u);
    EXPECT_EQ(scene.lights[0].type, LightType::Point);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(0, 22, 0));
    EXPECT_EQ(scene.lights[0].intensity, 20);
    EXPECT_EQ(scene.lights[1].type, LightType::Directional);
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_TRUE(test::contains(listener_.text, "2 cameras are defined"));
}

TEST_F(GltfModels, SparseBoxIsAUnitBox) {
    for (const char* name : {"sparse_box/box_sparse.gltf", "sparse_box/box_sparse.glb"}) {
        const Aabb box = load(name).bounds();
        EXPECT_EQ(box.min, glm::vec3(-0.5f)) << name;
        EXPECT_EQ(box.max, glm::vec3(0.5f)) << name;
    }
}

TEST_F(GltfModels, UrisWithSpacesAndPercentCodes) {
    for (const char* name : {"uri_spaces/CubeImageUriSpaces.gltf", "uri_spaces/CubeImageUriMultipleSpaces.gltf"}) {
        const Scene scene = load(name);
        ASSERT_EQ(scene.textures.size(), 1u) << name;
        EXPECT_EQ(scene.textures[0].image.width, 2u) << name;
    }
    EXPECT_EQ(listener_.text, "");
}

// Skins are shown in the pose of their file: the fox stands on its feet, 79 units high.
TEST_F(GltfModels, SkinnedModelsStand) {
    const Aabb box = load("khr_Fox/Fox.glb").bounds();
    EXPECT_NEAR(box.min.y, 0, 0.5f);
    EXPECT_NEAR(box.max.y, 79, 0.5f);
}

TEST_F(GltfModels, EveryOtherModelLoadsAndBadOnesThrow) {
    int good = 0, bad = 0;
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(scenesFolder()))
        if (entry.path().extension() == ".gltf" || entry.path().extension() == ".glb") files.push_back(entry.path());
    for (const fs::path& path : files) {
        const std::string error = test::errorOf([&] {
            const Scene scene = loadGltf(path, {.log = listener_.log});
            for (const Instance& instance : scene.instances) {
                ASSERT_LT(std::size_t(instance.mesh), scene.meshes.size());
                ASSERT_LT(std::size_t(instance.material), scene.materials.size());
            }
        });
        const bool mustFail = path.parent_path().filename() == "bad_bounds_tinygltf";
        EXPECT_EQ(error != "no error", mustFail) << path << ": " << error;
        ++(mustFail ? bad : good);
    }
    EXPECT_GE(good, 50);
    EXPECT_GE(bad, 4);
}

}  // namespace
}  // namespace crevice
