// Draw lists: what is culled, in which order things are drawn, what is merged.
#include "scene/DrawList.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/Primitives.h"

namespace crevice {
namespace {

// Unit boxes (mesh 0) and spheres (mesh 1) along -z; materials 0 and 1 are opaque, 2 is masked, 3 blends.
struct World {
    Scene scene;
    Camera camera = Camera::lookAt({0, 0, 0}, {0, 0, -1});

    World() {
        scene.meshes = {makeBox({1, 1, 1}), makeSphere(0.5f, 8)};
        scene.materials.resize(4);
        scene.materials[2].alphaMode = AlphaMode::Mask;
        scene.materials[3].alphaMode = AlphaMode::Blend;
        camera.near = 0.1f;
        camera.far = 100;
    }
    void add(int mesh, int material, const glm::vec3& position, bool flipped = false) {
        Instance instance;
        instance.mesh = mesh;
        instance.material = material;
        instance.world = glm::translate(glm::mat4(1), position);
        instance.flipped = flipped;
        scene.instances.push_back(instance);
    }
    DrawList build(DrawFilter filter, DrawOrder order, bool cull = true) const {
        const DrawView view{.view = camera.view, .viewProjection = camera.projection(1) * camera.view, .cull = cull};
        return buildDrawList(InstanceTable(scene), view, filter, order);
    }
};

using Indices = std::vector<std::uint32_t>;

TEST(DrawList, OpaqueIsOneBatchPerMeshAndMaterialNearestFirst) {
    World world;
    world.add(0, 0, {0, 0, -30});  // 0
    world.add(1, 0, {0, 0, -10});  // 1
    world.add(0, 0, {0, 0, -5});   // 2
    world.add(0, 1, {0, 0, -20});  // 3
    world.add(1, 0, {0, 0, -7});   // 4
    const DrawList list = world.build(DrawFilter::Opaque, DrawOrder::FrontToBack);
    EXPECT_EQ(list.instances, (Indices{2, 0, 4, 1, 3}));
    const std::vector<DrawBatch> expected = {{.mesh = 0, .material = 0, .firstInstance = 0, .instanceCount = 2},
                                             {.mesh = 1, .material = 0, .firstInstance = 2, .instanceCount = 2},
                                             {.mesh = 0, .material = 1, .firstInstance = 4, .instanceCount = 1}};
    EXPECT_EQ(list.batches, expected);
}

TEST(DrawList, BlendedIsStrictlyBackToFrontAndMergesNeighboursOnly) {
    World world;
    world.add(0, 3, {0, 0, -5});   // 0
    world.add(0, 3, {0, 0, -6});   // 1
    world.add(1, 3, {0, 0, -8});   // 2
    world.add(0, 3, {0, 0, -10});  // 3
    const DrawList list = world.build(DrawFilter::Blend, DrawOrder::BackToFront);
    EXPECT_EQ(list.instances, (Indices{3, 2, 1, 0}));
    const std::vector<DrawBatch> expected = {{.mesh = 0, .material = 3, .firstInstance = 0, .instanceCount = 1},
                                             {.mesh = 1, .material = 3, .firstInstance = 1, .instanceCount = 1},
                                             {.mesh = 0, .material = 3, .firstInstance = 2, .instanceCount = 2}};
    EXPECT_EQ(list.batches, expected);
}

TEST(DrawList, EqualDepthsKeepTheirIndexOrderBothWays) {
    World world;
    world.add(1, 0, {1, 0, -5});
    world.add(0, 0, {0, 0, -5});
    world.add(1, 0, {-1, 0, -5});
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::FrontToBack).instances, (Indices{0, 2, 1}));
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::BackToFront).instances, (Indices{0, 1, 2}));
}

TEST(DrawList, FiltersByAlphaMode) {
    World world;
    for (int material = 0; material < 4; ++material) world.add(0, material, {0, 0, -5.0f - float(material)});
    EXPECT_EQ(world.build(DrawFilter::Opaque, DrawOrder::FrontToBack).instances, (Indices{0, 1, 2}));
    EXPECT_EQ(world.build(DrawFilter::Blend, DrawOrder::FrontToBack).instances, (Indices{3}));
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::FrontToBack).instances, (Indices{0, 1, 2, 3}));
}

TEST(DrawList, CullsWhatLiesOutsideEveryPlane) {
    World world;
    world.add(0, 0, {0, 0, -5});    // seen
    world.add(0, 0, {0, 0, 5});     // behind
    world.add(0, 0, {0, 0, -200});  // beyond far
    world.add(0, 0, {-50, 0, -5});  // left
    world.add(0, 0, {50, 0, -5});   // right
    world.add(0, 0, {0, 50, -5});   // above
    world.add(0, 0, {0, -50, -5});  // below
    world.add(0, 0, {0, 0, 0.3f});  // around the camera
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::FrontToBack).instances, (Indices{7, 0}));
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::FrontToBack, false).instances.size(), 8u);
}

TEST(DrawList, MirroredInstancesAreDrawnApart) {
    World world;
    world.add(0, 0, {0, 0, -5}, true);
    world.add(0, 0, {0, 0, -6}, false);
    world.add(0, 0, {0, 0, -7}, true);
    const DrawList list = world.build(DrawFilter::Opaque, DrawOrder::FrontToBack);
    ASSERT_EQ(list.batches.size(), 2u);
    EXPECT_TRUE(list.batches[0].flipped);
    EXPECT_FALSE(list.batches[1].flipped);
    EXPECT_EQ(list.instances, (Indices{0, 2, 1}));
}

TEST(DrawList, EmptySceneGivesEmptyList) {
    const World world;
    EXPECT_TRUE(world.build(DrawFilter::All, DrawOrder::FrontToBack).batches.empty());
}

TEST(DrawList, InstanceBoundsAreInWorldSpace) {
    World world;
    world.add(0, 0, {3, 0, 0});
    world.scene.instances[0].world = glm::scale(world.scene.instances[0].world, {2, 4, -6});
    const InstanceTable table(world.scene);
    EXPECT_EQ(table.box(0).min, glm::vec3(2, -2, -3));
    EXPECT_EQ(table.box(0).max, glm::vec3(4, 2, 3));
}

}  // namespace
}  // namespace crevice
