// Nodes, cameras, lights and buffers of glTF as they are seen.
#include "GltfModelFixture.h"

namespace crevice {
namespace {

class GltfSceneDraw : public GltfPictureTest {
protected:
    static ModelText square(const std::string& nodeMembers, const std::string& material = {}) {
        ModelText model;
        model.rectangleMesh({0.25f, -0.5f}, {1.25f, 0.5f}, model.unlit("", material));
        model.root("\"mesh\": 0" + nodeMembers);
        return model;
    }
    /// A dull white wall at z = 0 and one light.
    Image wallLitBy(const std::string& light) {
        ModelText model;
        const int material = model.add("materials", R"({"pbrMetallicRoughness": {"metallicFactor": 0}})");
        model.rectangleMesh(glm::vec2(-2), glm::vec2(2), material);
        model.root("\"mesh\": 0");
        model.root(R"("translation": [0, 0, 2], "extensions": {"KHR_lights_punctual": {"light": 0}})");
        model.top = R"(, "extensions": {"KHR_lights_punctual": {"lights": [)" + light + "]}}";
        Scene scene = sceneOf(model);
        for (Light& each : scene.lights) each.castsShadow = false;
        return pictureOf(std::move(scene));
    }
};

TEST_F(GltfSceneDraw, MirroredNodesShowTheirFronts) {
    const Image plain = pictureOf(square(""));
    expectSeen(plain, 0.75f, 0, kWhite);
    const Image mirrored = pictureOf(square(R"(, "scale": [-1, 1, 1])"));
    expectSeen(mirrored, -0.75f, 0, kWhite);
    expectSeen(mirrored, 0.75f, 0, kNothing);
    // Two mirrors make a turn; mirrored along z it looks away.
    expectSeen(pictureOf(square(R"(, "scale": [-1, -1, 1])")), -0.75f, 0, kWhite);
    expectSeen(pictureOf(square(R"(, "scale": [1, 1, -1])")), 0.75f, 0, kNothing);
    expectSeen(pictureOf(square(R"(, "scale": [1, 1, -1])", R"(, "doubleSided": true)")), 0.75f, 0, kWhite);
    // The same by a matrix, and below a mirrored parent.
    expectSeen(pictureOf(square(R"(, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])")), -0.75f, 0,
               kWhite);
}

TEST_F(GltfSceneDraw, CamerasStandBelowTheirParents) {
    ModelText model = square("");
    // The parent stands at x = 10 and is turned a quarter about y: its camera, 1 higher, looks along -x; right is -z.
    model.add("cameras", R"({"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 1, "zfar": 30}})");
    model.root(R"("translation": [10, 0, 0], "rotation": [0, 0.70710678, 0, 0.70710678], "children": [2])");
    model.node(R"("camera": 0, "translation": [0, 1, 0])");
    Scene scene = sceneOf(model);
    // The square faces +x here and stands from z = -1.25 to -0.25.
    scene.instances[0].world = glm::rotate(glm::mat4(1), glm::radians(90.0f), glm::vec3(0, 1, 0));
    ASSERT_EQ(scene.cameras.size(), 1u);
    const View view = viewOf(scene.cameras[0], 64, 64);
    renderer_->setScene(scene);
    load("deferred");
    const Image picture = radiance(view);
    // 4 units are 64 pixels: z = -0.75 is 12 pixels right of the middle, y = 0 is 16 below it.
    EXPECT_EQ(picture.at(44, 48).x, 1);
    EXPECT_EQ(picture.at(20, 48).x, 0);
    EXPECT_EQ(picture.at(44, 38).x, 0);  // y = 0.625: above the square
    EXPECT_EQ(picture.at(44, 42).x, 1);
}

TEST_F(GltfSceneDraw, PerspectiveCamerasSeeTheirFieldOfView) {
    ModelText model = square("");
    model.add("cameras", R"({"type": "perspective", "perspective": {"yfov": 1.57079633, "znear": 0.1}})");
    model.root(R"("camera": 0, "translation": [0.75, 0, 1])");
    const Scene scene = sceneOf(model);
    const View view = viewOf(scene.cameras.at(0), 64, 64);
    renderer_->setScene(scene);
    load("deferred");
    const Image picture = radiance(view);
    // One away, 90 degrees: from -1 to 1; the square has half of that.
    EXPECT_EQ(picture.at(32, 32).x, 1);
    EXPECT_EQ(picture.at(17, 17).x, 1);
    EXPECT_EQ(picture.at(14, 32).x, 0);
    EXPECT_EQ(picture.at(32, 49).x, 0);
}

TEST_F(GltfSceneDraw, SpotLightsFadeBetweenTheirCones) {
    const char* point = R"({"type": "point", "intensity": 20})";
    const Image spot = wallLitBy(
        R"({"type": "spot", "intensity": 20, "spot": {"innerConeAngle": 0.2617994, "outerConeAngle": 0.5235988}})");
    const Image open = wallLitBy(point);
    EXPECT_GT(seen(open, 0, 0).x, 0.5f);
    EXPECT_NEAR(seen(spot, 0, 0).x, seen(open, 0, 0).x, 2 * kHalfUnit * seen(open, 0, 0).x);
    EXPECT_EQ(seen(spot, 1.3f, 0).x, 0);  // beyond 30 degrees, which are at 1.155
    // KHR_lights_punctual: the square of the share between the cones' cosines.
    const float x = 0.84375f;  // the middle of pixel 45
    const float cosine = 2 / std::sqrt(4 + x * x + 0.03125f * 0.03125f);
    const float share = (cosine - std::cos(0.5235988f)) / (std::cos(0.2617994f) - std::cos(0.5235988f));
    EXPECT_NEAR(seen(spot, x, 0.01f).x / seen(open, x, 0.01f).x, share * share, 0.005f);
    // A white matte wall of albedo 1 under 20 candela at 2 units receives 5 lux; it sends back less than 5 / pi of it
    // as diffuse light, and some of it mirrored.
    EXPECT_NEAR(seen(open, 0, 0).x, 5 / 3.14159265f, 0.1f);
}

TEST_F(GltfSceneDraw, LightsHaveTheirUnits) {
    // One lux straight on: a white dielectric sends back (1 - 0.04) / pi diffuse and 0.04 / (4 pi) mirrored at
    // roughness 1, where D = 1 / pi and V = 1 / 4.
    const float expected = (0.96f + 0.04f / 4) / 3.14159265f;
    EXPECT_NEAR(seen(wallLitBy(R"({"type": "directional", "intensity": 1})"), 0, 0).x, expected, 0.002f);
    EXPECT_NEAR(seen(wallLitBy(R"({"type": "directional", "intensity": 10, "color": [0.5, 1, 1]})"), 0, 0).x,
                5 * expected, 0.01f);
    // A point light of 4 candela, 2 away; with a range of 2 it ends just there.
    const float corner = 0.03125f;  // of the pixel's middle
    EXPECT_NEAR(seen(wallLitBy(R"({"type": "point", "intensity": 4})"), corner, corner).x, expected, 0.002f);
    EXPECT_NEAR(seen(wallLitBy(R"({"type": "point", "intensity": 4, "range": 2})"), corner, corner).x, 0, 0.001f);
}

TEST_F(GltfSceneDraw, InstancesAreTurnedAndScaled) {
    ModelText model;
    model.rectangleMesh({-0.75f, -0.125f}, {0.75f, 0.125f}, model.unlit(""));
    const int places = model.accessor("VEC3", std::vector<float>{0, 1.5f, 0, -1, -0.5f, 0, 1, -0.5f, 0});
    // Quarter turns as normalised shorts.
    const int turns =
        model.accessor("VEC4", std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767},
                       ", \"normalized\": true");
    const int scales = model.accessor("VEC3", std::vector<float>{1, 1, 1, 1, 1, 1, 0.5f, 4, 1});
    model.root("\"mesh\": 0, \"extensions\": {\"EXT_mesh_gpu_instancing\": {\"attributes\": {\"TRANSLATION\": " +
               std::to_string(places) + ", \"ROTATION\": " + std::to_string(turns) +
               ", \"SCALE\": " + std::to_string(scales) + "}}}");
    const Image picture = pictureOf(model);
    expectSeen(picture, 0.6f, 1.5f, kWhite, "as it is");
    expectSeen(picture, -1, 0.1f, kWhite, "upright");
    expectSeen(picture, -0.6f, -0.5f, kNothing, "upright");
    expectSeen(picture, 1.3f, -0.1f, kWhite, "short and thick");
    expectSeen(picture, 1.5f, -0.5f, kNothing, "short and thick");
}

TEST_F(GltfSceneDraw, SparsePositionsWithoutABase) {
    ModelText model;
    const std::uint8_t named[] = {1, 2, 3};
    const int indices = model.view(named, sizeof named);
    const float moved[] = {1, 0, 0, 1, 1, 0, 0, 1, 0};
    const int values = model.view(moved, sizeof moved);
    const int position = model.add(
        "accessors", "{" + ModelText::accessorText<float>("VEC3", 4) +
                         R"(, "sparse": {"count": 3, "indices": {"bufferView": )" + std::to_string(indices) +
                         R"(, "componentType": 5121}, "values": {"bufferView": )" + std::to_string(values) + "}}}");
    model.mesh(
        ModelText::primitive("\"POSITION\": " + std::to_string(position), model.rectangleIndices(), model.unlit("")));
    model.root("\"mesh\": 0");
    const Image picture = pictureOf(model);
    expectSeen(picture, 0.1f, 0.1f, kWhite);
    expectSeen(picture, 0.9f, 0.9f, kWhite);
    expectSeen(picture, -0.1f, 0.5f, kNothing);
}

TEST_F(GltfSceneDraw, InterleavedAttributesOfOddStrides) {
    // 12 bytes of position, 4 of colour, 12 unused: a stride of 28.
    ModelText model;
    const std::vector<float> places = ModelText::corners(glm::vec2(-1), glm::vec2(1));
    std::vector<unsigned char> bytes(4 * 28, 0xee);
    for (std::size_t corner = 0; corner < 4; ++corner) {
        std::memcpy(&bytes[corner * 28], &places[3 * corner], 12);
        const unsigned char color[] = {255, 0, 51, 255};
        std::memcpy(&bytes[corner * 28 + 12], color, 4);
    }
    const std::string from =
        "{\"bufferView\": " + std::to_string(model.view(bytes.data(), bytes.size(), ", \"byteStride\": 28"));
    const int position = model.add("accessors", from + ", " + ModelText::accessorText<float>("VEC3", 4) + "}");
    const int color = model.add("accessors", from + ", \"byteOffset\": 12, \"normalized\": true, " +
                                                 ModelText::accessorText<std::uint8_t>("VEC4", 4) + "}");
    model.mesh(
        ModelText::primitive("\"POSITION\": " + std::to_string(position) + ", \"COLOR_0\": " + std::to_string(color),
                             model.rectangleIndices(), model.unlit("")));
    model.root("\"mesh\": 0");
    const Image picture = pictureOf(model);
    expectSeen(picture, 0.9f, -0.9f, {1, 0, 0.2f});
    expectSeen(picture, -0.9f, 0.9f, {1, 0, 0.2f});
}

TEST_F(GltfSceneDraw, PrimitivesOfOneMeshHaveTheirOwnModes) {
    ModelText model;
    const int material = model.unlit("");
    const auto positions = [&](std::initializer_list<float> numbers) {
        return "\"POSITION\": " + std::to_string(model.accessor("VEC3", std::vector<float>(numbers)));
    };
    // Through the middles of pixels, which lie at odd multiples of 1/32.
    const float p = 1.03125f;
    std::string primitives = ModelText::primitive(positions({p, p, 0}), -1, material, ", \"mode\": 0");
    primitives += ", " + ModelText::primitive(positions({-p, p, 0, -0.28125f, p, 0}), -1, material, ", \"mode\": 3");
    primitives +=
        ", " + ModelText::primitive(positions({-1, -1, 0, 0, -1, 0, -1, 0, 0, 0, 0, 0}), -1, material, ", \"mode\": 5");
    primitives += ", " + ModelText::primitive(positions({0, -1, 0, 1, -1, 0, 1, -0.5f, 0}), -1, material);
    model.mesh(primitives);
    model.root("\"mesh\": 0");
    const Image picture = pictureOf(model);
    expectSeen(picture, p, p, kWhite, "point");
    expectSeen(picture, p + 0.0625f, p, kNothing, "beside the point");
    expectSeen(picture, -0.71875f, p, kWhite, "line");
    expectSeen(picture, -0.71875f, p - 0.125f, kNothing, "below the line");
    expectSeen(picture, -0.1f, -0.1f, kWhite, "strip");
    expectSeen(picture, -0.9f, -0.9f, kWhite, "strip");
    expectSeen(picture, 0.9f, -0.8f, kWhite, "triangle");
    expectSeen(picture, 0.2f, -0.6f, kNothing, "above the triangle");
}

}  // namespace
}  // namespace crevice
