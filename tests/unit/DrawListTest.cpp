// Draw lists: what is culled, in which order things are drawn, what is merged.
#include "scene/DrawList.h"

#include <algorithm>

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

// The rules written out slowly: every box against every plane, a stable sort of (depth, index), batches by first use.
DrawList slowList(const World& world, const DrawView& view, DrawFilter filter, DrawOrder order) {
    const InstanceTable table(world.scene);
    const Frustum frustum(view.viewProjection);
    std::vector<std::pair<float, std::uint32_t>> items;
    for (std::uint32_t i = 0; i < world.scene.instances.size(); ++i) {
        const bool blended = world.scene.materials[world.scene.instances[i].material].alphaMode == AlphaMode::Blend;
        if (filter != DrawFilter::All && blended != (filter == DrawFilter::Blend)) continue;
        if (!frustum.intersects(table.box(i))) continue;
        items.emplace_back(-(view.view * glm::vec4(table.box(i).centre(), 1)).z, i);
    }
    const bool nearFirst = order == DrawOrder::FrontToBack;
    std::stable_sort(items.begin(), items.end(),
                     [&](const auto& a, const auto& b) { return nearFirst ? a.first < b.first : a.first > b.first; });
    const auto batchFor = [&](std::uint32_t i) {
        const Instance& instance = world.scene.instances[i];
        return DrawBatch{.mesh = instance.mesh, .material = instance.material, .flipped = instance.flipped};
    };
    std::vector<std::pair<DrawBatch, Indices>> batches;
    for (const auto& [depth, i] : items) {
        auto found = std::find_if(batches.begin(), batches.end(), [&](auto& b) { return b.first == batchFor(i); });
        if (!nearFirst)
            found = !batches.empty() && batches.back().first == batchFor(i) ? batches.end() - 1 : batches.end();
        if (found == batches.end()) found = batches.insert(batches.end(), {batchFor(i), {}});
        found->second.push_back(i);
    }
    DrawList list;
    for (auto& [batch, members] : batches) {
        batch.firstInstance = std::uint32_t(list.instances.size());
        batch.instanceCount = std::uint32_t(members.size());
        list.batches.push_back(batch);
        list.instances.insert(list.instances.end(), members.begin(), members.end());
    }
    return list;
}

// Enough for the radix sort. Depths are multiples of 1/8 and the camera looks along -z, so equal depths are frequent
// and no sum is rounded.
TEST(DrawList, ThousandsOfObjectsFollowTheSameRules) {
    World world;
    std::uint32_t state = 1;
    const auto next = [&](std::uint32_t count) {
        state = state * 1664525u + 1013904223u;
        return (state >> 16) % count;
    };
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 place = glm::vec3(int(next(400)) - 200, int(next(400)) - 200, int(next(800)) - 700) / 8.0f;
        world.add(int(next(2)), int(next(4)), place, next(5) == 0);
    }
    const DrawView view{.view = world.camera.view, .viewProjection = world.camera.projection(1) * world.camera.view};
    for (const DrawFilter filter : {DrawFilter::Opaque, DrawFilter::Blend, DrawFilter::All})
        for (const DrawOrder order : {DrawOrder::FrontToBack, DrawOrder::BackToFront}) {
            const DrawList list = world.build(filter, order);
            EXPECT_GT(list.instances.size(), 600u);
            EXPECT_LT(list.instances.size(), 4000u) << "nothing is culled";
            EXPECT_EQ(list, slowList(world, view, filter, order));
            EXPECT_TRUE(order == DrawOrder::BackToFront || list.batches.size() <= 16u) << list.batches.size();
        }
}

TEST(DrawList, AHundredThousandInstancesOfTenMeshesAreTenBatches) {
    World world;
    world.scene.meshes.assign(10, makeBox({1, 1, 1}));
    for (int i = 0; i < 100000; ++i) world.add(i % 10, 0, {float(i % 300) - 150, 0, -float(i / 300) * 0.2f});
    EXPECT_EQ(world.build(DrawFilter::Opaque, DrawOrder::FrontToBack, false).batches.size(), 10u);
}

TEST(DrawList, InstancesOfEmptyMeshesAreNotDrawn) {
    World world;
    world.scene.meshes.push_back({});
    world.add(2, 0, {0, 0, -5});
    world.add(0, 0, {0, 0, -6});
    EXPECT_EQ(world.build(DrawFilter::All, DrawOrder::FrontToBack, false).instances, Indices{1});
    EXPECT_TRUE(InstanceTable(world.scene).box(0).empty);
}

}  // namespace
}  // namespace crevice
