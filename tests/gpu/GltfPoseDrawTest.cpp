// Skins, morph targets and animations as they are seen: a bent part is where its joint has put it, and lit as it lies.
#include "GltfModelFixture.h"

namespace crevice {
namespace {

/// A quarter turn about z, counter-clockwise.
constexpr const char* kQuarter = "0, 0, 0.70710678, 0.70710678";

class GltfPoseDraw : public GltfPictureTest {
protected:
    /// A bar from y = -1 to 1, half a unit wide: its lower half hangs on joint 0, its upper one on joint 1, both
    /// matrices take the joints' rest places (0, -1) and (0, 0) away.
    struct Bar {
        ModelText model;
        int mesh = 0, matrices = 0;
        Bar() {
            std::vector<float> places = ModelText::corners({-0.25f, -1}, {0.25f, 0});
            const std::vector<float> upper = ModelText::corners({-0.25f, 0}, {0.25f, 1});
            places.insert(places.end(), upper.begin(), upper.end());
            std::vector<std::uint8_t> joints;
            std::vector<float> weights;
            for (std::uint8_t corner = 0; corner < 8; ++corner) {
                for (const int joint : {corner / 4, 0, 0, 0}) joints.push_back(static_cast<std::uint8_t>(joint));
                for (const float weight : {1.0f, 0.0f, 0.0f, 0.0f}) weights.push_back(weight);
            }
            const std::string attributes = "\"POSITION\": " + std::to_string(model.accessor("VEC3", places)) +
                                           ", \"JOINTS_0\": " + std::to_string(model.accessor("VEC4", joints)) +
                                           ", \"WEIGHTS_0\": " + std::to_string(model.accessor("VEC4", weights));
            mesh = model.mesh(ModelText::primitive(attributes, model.rectangleIndices(2), model.unlit("")));
            matrices = model.accessor("MAT4", std::vector<float>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1,  //
                                                                 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        }
        /// Its node, with a place that must not count.
        void place(const std::string& more = {}) {
            model.root("\"mesh\": " + std::to_string(mesh) +
                       ", \"skin\": 0, \"translation\": [7, 7, 7], \"scale\": [3, 1, 1]" + more);
        }
        std::string withMatrices() const { return ", \"inverseBindMatrices\": " + std::to_string(matrices); }
    };
    static void expectBentLeft(const Image& picture, const std::string& what) {
        expectSeen(picture, 0, -0.75f, kWhite, what);  // the lower half stays
        expectSeen(picture, -0.75f, 0.1f, kWhite, what);
        expectSeen(picture, 0, 0.75f, kNothing, what);
        expectSeen(picture, 0.75f, 0, kNothing, what);
    }
    static void expectStraight(const Image& picture, const std::string& what) {
        expectSeen(picture, 0, -0.75f, kWhite, what);
        expectSeen(picture, 0, 0.75f, kWhite, what);
        expectSeen(picture, -0.75f, 0.1f, kNothing, what);
    }
    /// A lit white square that faces +z, with the vertices' own normals.
    static int litSquare(ModelText& model, const glm::vec3& normal, const std::string& more) {
        const int position = model.rectangle(glm::vec2(-1), glm::vec2(1));
        std::vector<float> normals;
        for (int corner = 0; corner < 4; ++corner) normals.insert(normals.end(), {normal.x, normal.y, normal.z});
        const std::string attributes = "\"POSITION\": " + std::to_string(position) +
                                       ", \"NORMAL\": " + std::to_string(model.accessor("VEC3", normals));
        const int dull = model.add("materials", R"({"pbrMetallicRoughness": {"metallicFactor": 0}})");
        return model.mesh(ModelText::primitive(attributes, model.rectangleIndices(), dull, more));
    }
    /// Lit from the upper left: no direction looks like another.
    glm::vec3 litMiddle(const ModelText& model) {
        Scene scene = sceneOf(model);
        scene.lights = {directional({0.4f, -0.3f, -1}, 3)};
        return seen(pictureOf(std::move(scene)), 0.1f, 0.1f);
    }
};

TEST_F(GltfPoseDraw, AJointThatTurnsBendsItsPart) {
    for (const bool child : {true, false}) {  // joint 1 below joint 0, or a root of its own
        Bar bar;
        bar.model.top = ", \"skins\": [{\"joints\": [0, 1]" + bar.withMatrices() + "}]";
        bar.model.root("\"translation\": [0, -1, 0]" + std::string(child ? ", \"children\": [1]" : ""));
        const std::string turned = "\"rotation\": [" + std::string(kQuarter) + "]";
        if (child)
            bar.model.node(turned + ", \"translation\": [0, 1, 0]");
        else
            bar.model.root(turned);
        bar.place();
        expectBentLeft(pictureOf(bar.model), child ? "child" : "root");
    }
}

TEST_F(GltfPoseDraw, WithoutMatricesPlacesOfJointsAreAdded) {
    Bar bar;
    bar.model.top = ", \"skins\": [{\"joints\": [0, 1]}]";
    bar.model.root("\"translation\": [0, -1, 0]");
    bar.model.root("\"translation\": [1, 0, 0]");
    bar.place();
    const Image picture = pictureOf(bar.model);
    expectSeen(picture, 0, -1.5f, kWhite);
    expectSeen(picture, 0, -0.5f, kNothing);
    expectSeen(picture, 1, 0.5f, kWhite);
    expectSeen(picture, 0, 0.5f, kNothing);
}

TEST_F(GltfPoseDraw, AnimatedJointsBendInTime) {
    for (const char* interpolation : {"LINEAR", "STEP"}) {
        Bar bar;
        bar.model.top = ", \"skins\": [{\"joints\": [0, 1]" + bar.withMatrices() + "}]";
        bar.model.root("\"translation\": [0, -1, 0], \"children\": [1]");
        bar.model.node("\"translation\": [0, 1, 0]");
        bar.place();
        const int times = bar.model.accessor("SCALAR", std::vector<float>{1, 3});
        const int turns = bar.model.accessor("VEC4", std::vector<float>{0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f});
        bar.model.top +=
            ", \"animations\": [{\"channels\": [{\"sampler\": 0, \"target\": {\"node\": 1, \"path\": \"rotation\"}}],"
            " \"samplers\": [{\"input\": " +
            std::to_string(times) + ", \"output\": " + std::to_string(turns) + ", \"interpolation\": \"" +
            interpolation + "\"}]}]";
        expectStraight(pictureOf(bar.model), "rest");
        expectStraight(pictureOf(bar.model, {.time = 0.5f}), "before the first key");
        expectBentLeft(pictureOf(bar.model, {.time = 3}), interpolation);
        const Image between = pictureOf(bar.model, {.time = 2});
        if (interpolation == std::string("STEP"))
            expectStraight(between, interpolation);
        else
            expectSeen(between, -0.5f, 0.5f, kWhite, "an eighth of a turn");
    }
}

TEST_F(GltfPoseDraw, EightJointsMoveOneVertex) {
    ModelText model;
    const int position = model.rectangle({-1.25f, -0.25f}, {-0.75f, 0.25f});
    std::vector<std::uint16_t> first, second;
    std::vector<float> eighths(16, 0.125f);
    for (int corner = 0; corner < 4; ++corner) {
        first.insert(first.end(), {0, 0, 0, 0});
        second.insert(second.end(), {1, 1, 1, 1});
    }
    const int weights = model.accessor("VEC4", eighths);
    const std::string attributes = "\"POSITION\": " + std::to_string(position) +
                                   ", \"JOINTS_0\": " + std::to_string(model.accessor("VEC4", first)) +
                                   ", \"JOINTS_1\": " + std::to_string(model.accessor("VEC4", second)) +
                                   ", \"WEIGHTS_0\": " + std::to_string(weights) +
                                   ", \"WEIGHTS_1\": " + std::to_string(weights);
    model.mesh(ModelText::primitive(attributes, model.rectangleIndices(), model.unlit("")));
    model.top = ", \"skins\": [{\"joints\": [0, 1]}]";
    model.root("");
    model.root("\"translation\": [2, 0, 0]");
    model.root("\"mesh\": 0, \"skin\": 0");
    const Image picture = pictureOf(model);  // half of 2 from joint 1
    expectSeen(picture, 0, 0, kWhite);
    expectSeen(picture, -1, 0, kNothing);
    expectSeen(picture, 1, 0, kNothing);
}

TEST_F(GltfPoseDraw, SkinsShareMatricesMeshesAndJoints) {
    Bar bar;
    const std::string ends = bar.withMatrices() + "}";
    bar.model.top = ", \"skins\": [{\"joints\": [0, 1]" + ends + ", {\"joints\": [2, 1], \"skeleton\": 2" + ends + "]";
    bar.model.root("\"translation\": [-1, -1, 0]");
    bar.model.root("\"translation\": [-1, 0, 0], \"scale\": [0.5, 0.5, 1]");  // of both skins
    bar.model.root("\"translation\": [1, -1, 0]");
    bar.place();
    bar.model.root("\"mesh\": 0, \"skin\": 1");
    const Image picture = pictureOf(bar.model);
    expectSeen(picture, -1, -0.5f, kWhite, "skin 0, joint 0");
    expectSeen(picture, 1, -0.5f, kWhite, "skin 1, joint 0");
    expectSeen(picture, -1, 0.4f, kWhite, "the upper half at half size");
    expectSeen(picture, -1, 0.6f, kNothing, "the upper half at half size");
    expectSeen(picture, -1.2f, 0.2f, kNothing, "the upper half at half size");
    expectSeen(picture, 1, 0.4f, kNothing, "no upper half there");
}

TEST_F(GltfPoseDraw, BentPartsAreLitAsTheyLie) {
    // 50 degrees about y, once by the joint and once by a node.
    const std::string turn = "\"rotation\": [0, 0.42261826, 0, 0.90630779]";
    ModelText plain;
    litSquare(plain, {0, 0, 1}, "");
    plain.root("\"mesh\": 0, " + turn);
    const glm::vec3 expected = litMiddle(plain);

    ModelText skinned;
    std::vector<std::uint8_t> joints(16, 0);
    std::vector<float> weights;
    for (int corner = 0; corner < 4; ++corner) weights.insert(weights.end(), {1, 0, 0, 0});
    const int position = skinned.rectangle(glm::vec2(-1), glm::vec2(1));
    const int normal = skinned.accessor("VEC3", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    skinned.mesh(ModelText::primitive(
        "\"POSITION\": " + std::to_string(position) + ", \"NORMAL\": " + std::to_string(normal) +
            ", \"JOINTS_0\": " + std::to_string(skinned.accessor("VEC4", joints)) +
            ", \"WEIGHTS_0\": " + std::to_string(skinned.accessor("VEC4", weights)),
        skinned.rectangleIndices(), skinned.add("materials", R"({"pbrMetallicRoughness": {"metallicFactor": 0}})")));
    skinned.top = ", \"skins\": [{\"joints\": [0]}]";
    skinned.root(turn);
    skinned.root("\"mesh\": 0, \"skin\": 0");
    const glm::vec3 found = litMiddle(skinned);
    EXPECT_GT(expected.x, 0.1f);
    EXPECT_NEAR(found.x, expected.x, 2 * kHalfUnit);
}

TEST_F(GltfPoseDraw, MorphTargetsMoveWhatIsSeen) {
    for (const char* weights : {"[1, 0]", "[0.5, 1]"}) {
        ModelText model;
        const int position = model.rectangle({-1.5f, -0.25f}, {-1, 0.25f});
        const int right = model.accessor("VEC3", std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0});
        const int up = model.accessor("VEC3", std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
        const std::string targets = ", \"targets\": [{\"POSITION\": " + std::to_string(right) +
                                    "}, {\"POSITION\": " + std::to_string(up) + "}]";
        model.mesh(ModelText::primitive("\"POSITION\": " + std::to_string(position), model.rectangleIndices(),
                                        model.unlit(""), targets),
                   ", \"weights\": [0, 0]");
        model.root("\"mesh\": 0, \"weights\": " + std::string(weights));
        const Image picture = pictureOf(model);
        const bool half = weights == std::string("[0.5, 1]");
        expectSeen(picture, half ? -0.25f : 0.75f, half ? 1 : 0, kWhite, weights);
        expectSeen(picture, half ? 0.75f : -0.25f, half ? 0 : 1, kNothing, weights);
        expectSeen(picture, -1.25f, 0, kNothing, weights);
    }
}

TEST_F(GltfPoseDraw, MorphWeightsFollowSplines) {
    ModelText model;
    const int position = model.rectangle({-1.25f, -0.25f}, {-0.75f, 0.25f});
    const int right = model.accessor("VEC3", std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
    model.mesh(ModelText::primitive("\"POSITION\": " + std::to_string(position), model.rectangleIndices(),
                                    model.unlit(""), ", \"targets\": [{\"POSITION\": " + std::to_string(right) + "}]"));
    model.root("\"mesh\": 0");
    const int times = model.accessor("SCALAR", std::vector<float>{0, 2});
    // Half way: (0 + 1) / 2 + (2 s) (4 - 0) / 8 = 1.5. In-tangent, value, out-tangent of each key.
    const int values = model.accessor("SCALAR", std::vector<float>{0, 0, 4, 0, 1, 0});
    model.top =
        ", \"animations\": [{\"channels\": [{\"sampler\": 0, \"target\": {\"node\": 0, \"path\": \"weights\"}}],"
        " \"samplers\": [{\"input\": " +
        std::to_string(times) + ", \"output\": " + std::to_string(values) + ", \"interpolation\": \"CUBICSPLINE\"}]}]";
    expectSeen(pictureOf(model, {.time = 1}), 0.5f, 0, kWhite);
    expectSeen(pictureOf(model, {.time = 1}), -1, 0, kNothing);
    expectSeen(pictureOf(model, {.time = 9}), 0, 0, kWhite);
    expectSeen(pictureOf(model), -1, 0, kWhite);
}

TEST_F(GltfPoseDraw, MorphedNormalsAreLit) {
    const glm::vec3 tilted(0.6f, 0, 0.8f);
    ModelText plain;
    litSquare(plain, tilted, "");
    plain.root("\"mesh\": 0");
    ModelText straight;
    litSquare(straight, {0, 0, 1}, "");
    straight.root("\"mesh\": 0");

    ModelText morphed;
    std::vector<float> change;
    for (int corner = 0; corner < 4; ++corner) change.insert(change.end(), {2 * 0.6f, 0, 2 * -0.2f});
    const int target = morphed.accessor("VEC3", change);
    litSquare(morphed, {0, 0, 1}, ", \"targets\": [{\"NORMAL\": " + std::to_string(target) + "}]");
    morphed.root("\"mesh\": 0, \"weights\": [0.5]");
    const float expected = litMiddle(plain).x;
    EXPECT_NEAR(litMiddle(morphed).x, expected, 2 * kHalfUnit);
    EXPECT_GT(std::abs(litMiddle(straight).x - expected), 0.05f);
}

}  // namespace
}  // namespace crevice
