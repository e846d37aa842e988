// Skins, morph targets and animations: vertices where the rules of the format put them.
#include <cmath>

#include "GltfTestTools.h"

namespace crevice {
namespace {

using test::append;
using test::contains;
using test::errorOf;
using Document = test::GltfText;
using test::Listener;
using test::TempFolder;

Scene loadWith(const Document& document, const std::string& animation, std::optional<float> time,
               const std::string& scene = {}) {
    const TempFolder folder;
    Listener listener;
    LoadOptions options{.log = listener.log};
    options.animation = animation;
    options.time = time;
    options.scene = scene;
    return loadGltf(folder.write("t.gltf", document.json()), options);
}

glm::vec3 originOf(const Scene& scene) { return glm::vec3(scene.instances.at(0).world[3]); }

/// Keys at 1 and 3 seconds. Values: 2 (or 6 for splines) vectors after them.
Document animated(const std::string& path, const std::string& interpolation, std::initializer_list<float> values,
                  const char* type = "VEC3") {
    Document document;
    append<float>(document.bytes, {1, 3});
    append<float>(document.bytes, values);
    const std::size_t width = std::string(type) == "VEC4" ? 4 : std::string(type) == "VEC3" ? 3 : 1;
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 8}, {"buffer": 0, "byteOffset": 64, "byteLength": )" +
        std::to_string(values.size() * 4) + "}";
    document.accessors +=
        R"(, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [1], "max": [3]},
        {"bufferView": 3, "componentType": 5126, "count": )" +
        std::to_string(values.size() / width) + R"(, "type": ")" + type + "\"}";
    document.rest =
        R"(, "animations": [{"name": "still", "channels": [{"sampler": 0, "target": {"path": "scale"}}], "samplers":
        [{"input": 2, "output": 3}]}, {"name": "go", "channels": [{"sampler": 0, "target": {"node": 0, "path": ")" +
        path + R"("}}], "samplers": [{"input": 2, "output": 3, "interpolation": ")" + interpolation + R"("}]}])";
    return document;
}

TEST(GltfPose, LinearKeysAndTheEnds) {
    const Document document = animated("translation", "LINEAR", {0, 0, 0, 4, 8, 0});
    EXPECT_EQ(originOf(document.load()), glm::vec3(0));  // the rest pose
    EXPECT_EQ(originOf(loadWith(document, "go", 1.5f)), glm::vec3(1, 2, 0));
    EXPECT_EQ(originOf(loadWith(document, "1", 2.0f)), glm::vec3(2, 4, 0));
    EXPECT_EQ(originOf(loadWith(document, "go", 0.0f)), glm::vec3(0));
    EXPECT_EQ(originOf(loadWith(document, "go", 99.0f)), glm::vec3(4, 8, 0));
    EXPECT_EQ(originOf(loadWith(document, "go", std::nullopt)), glm::vec3(0));
    const std::string error = errorOf([&] { loadWith(document, "fly", 1.0f); });
    EXPECT_TRUE(contains(error, "no animation 'fly'") && contains(error, "1 'go'")) << error;
}

TEST(GltfPose, StepsHoldAndSplinesBend) {
    const Document step = animated("translation", "STEP", {0, 0, 0, 4, 8, 0});
    EXPECT_EQ(originOf(loadWith(step, "go", 2.9f)), glm::vec3(0));
    EXPECT_EQ(originOf(loadWith(step, "go", 3.0f)), glm::vec3(4, 8, 0));
    // Half way with tangents 1 out of the first key and 0 into the second over 2 s: (0 + 4)/2 + 2 · 1 · (1/8).
    const Document spline =
        animated("translation", "CUBICSPLINE", {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0});
    EXPECT_LT(glm::distance(originOf(loadWith(spline, "go", 2.0f)), glm::vec3(2.25f, 0, 0)), 1e-6f);
}

TEST(GltfPose, RotationsTakeTheShorterWay) {
    // From no turn to a quarter about z, written with the opposite sign: half way is an eighth, not five eighths.
    const float s = std::sqrt(0.5f);
    const Document document = animated("rotation", "LINEAR", {0, 0, 0, 1, 0, 0, -s, -s}, "VEC4");
    const glm::vec3 x(loadWith(document, "go", 2.0f).instances[0].world[0]);
    EXPECT_LT(glm::distance(x, glm::vec3(s, s, 0)), 1e-5f);
}

// Appendix C: at a quarter of the way (sin(3a/4) v1 + s sin(a/4) v2) / sin a; here a = 60 degrees between quaternions,
// a turn by 120 about z, of which a quarter is 30.
TEST(GltfPose, RotationsTurnEvenly) {
    const float s = std::sqrt(0.75f), r = std::sqrt(0.5f);
    for (const float sign : {1.0f, -1.0f}) {
        const Document document = animated("rotation", "LINEAR", {0, 0, 0, 1, 0, 0, sign * s, sign * 0.5f}, "VEC4");
        EXPECT_LT(glm::distance(glm::vec3(loadWith(document, "go", 1.5f).instances[0].world[0]), glm::vec3(s, 0.5f, 0)),
                  1e-6f);
    }
    // Splines are not evened: without tangents half way is the mean, made a unit quaternion.
    const Document spline = animated("rotation", "CUBICSPLINE",
                                     {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, r, r, 0, 0, 0, 0}, "VEC4");
    EXPECT_LT(glm::distance(glm::vec3(loadWith(spline, "go", 2.0f).instances[0].world[0]), glm::vec3(r, r, 0)), 1e-6f);
    // At a quarter 27/32 and 5/32 of the two: the quaternion (0, 0, 5r, 27 + 5r), whose angle is not 22.5 degrees.
    const float half = std::atan2(5 * r, 27 + 5 * r);
    EXPECT_LT(glm::distance(glm::vec3(loadWith(spline, "go", 1.5f).instances[0].world[0]),
                            glm::vec3(std::cos(2 * half), std::sin(2 * half), 0)),
              1e-6f);
}

// Both tangents of the segment, in units per second: at t = 1/4 of 2 s the weights are 27/32 and 5/32 of the values,
// 2 · 9/64 of the tangent out of the first key and -2 · 3/64 of that into the second.
TEST(GltfPose, TangentsCountByTheSecond) {
    const Document spline =
        animated("translation", "CUBICSPLINE", {99, 99, 99, 32, 0, 0, 0, 32, 0, 0, 0, 32, 0, 64, 64, 99, 99, 99});
    EXPECT_EQ(originOf(loadWith(spline, "go", 1.5f)), glm::vec3(27, 10 + 9, 10 - 3));
    EXPECT_EQ(originOf(loadWith(spline, "go", 1.0f)), glm::vec3(32, 0, 0));
    EXPECT_EQ(originOf(loadWith(spline, "go", 3.0f)), glm::vec3(0, 64, 64));
}

Document morphing() {
    Document document = animated("weights", "LINEAR", {0, 1}, "SCALAR");
    append<float>(document.bytes, {0, 0, 2, 0, 0, 2, 0, 0, 2, 0, 0, 2});
    document.views += R"(, {"buffer": 0, "byteOffset": 72, "byteLength": 48})";
    document.accessors += R"(, {"bufferView": 4, "componentType": 5126, "count": 4, "type": "VEC3"})";
    document.primitive = R"(, "indices": 1, "targets": [{"POSITION": 4}])";
    return document;
}

TEST(GltfPose, MorphTargetsMoveVertices) {
    Document document = morphing();
    EXPECT_EQ(document.load().meshes.at(0).vertices[1].position, glm::vec3(1, 0, 0));
    EXPECT_EQ(loadWith(document, "go", 1.5f).meshes.at(0).vertices[1].position, glm::vec3(1, 0, 0.5f));
    document.nodes = R"({"mesh": 0, "weights": [0.25]}, {"mesh": 0, "weights": [1]})";
    document.roots = "0, 1";
    const Scene scene = document.load();
    ASSERT_EQ(scene.meshes.size(), 2u);  // each with weights of its own
    EXPECT_EQ(scene.meshes[0].vertices[2].position, glm::vec3(1, 1, 0.5f));
    EXPECT_EQ(scene.meshes[1].vertices[2].position, glm::vec3(1, 1, 2));
}

TEST(GltfPose, SkinsBlendTheirJoints) {
    Document document;
    append<std::uint8_t>(document.bytes, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    append<float>(document.bytes, {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 56, "byteLength": 16}, {"buffer": 0, "byteOffset": 72, "byteLength": 64})";
    document.accessors += R"(, {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC4"},
        {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC4"})";
    document.attributes = R"("POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3)";
    // The node's own place does not count; joint 1 stands 10 higher.
    document.nodes = R"({"mesh": 0, "skin": 0, "translation": [7, 7, 7]}, {}, {"translation": [0, 10, 0]})";
    document.roots = "0, 1, 2";
    document.rest = R"(, "skins": [{"joints": [1, 2]}])";
    const Scene scene = document.load();
    const auto& vertices = scene.meshes.at(0).vertices;
    EXPECT_EQ(scene.instances[0].world, glm::mat4(1));
    EXPECT_EQ(vertices[0].position, glm::vec3(0, 0, 0));
    EXPECT_EQ(vertices[1].position, glm::vec3(1, 5, 0));
    EXPECT_EQ(vertices[2].position, glm::vec3(1, 11, 0));
    document.rest = R"(, "skins": [{"joints": [1]}])";
    EXPECT_TRUE(contains(document.error(), "names joint 1, the skin has 1")) << document.error();
}

TEST(GltfPose, ScenesAreChosenByNameOrIndex) {
    Document document;
    document.nodes = R"({"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]})";
    document.scenes = R"(, {"name": "other", "nodes": [1]})";
    EXPECT_EQ(originOf(loadWith(document, "", std::nullopt)), glm::vec3(0));
    EXPECT_EQ(originOf(loadWith(document, "", std::nullopt, "other")), glm::vec3(5, 0, 0));
    EXPECT_EQ(originOf(loadWith(document, "", std::nullopt, "1")), glm::vec3(5, 0, 0));
    EXPECT_TRUE(contains(errorOf([&] { loadWith(document, "", std::nullopt, "2"); }), "no scene '2'"));
}

TEST(GltfPose, FaultsThatDoNoHarmAreWarningsOrErrorsWhenStrict) {
    const auto check = [](const Document& document, const std::string& message) {
        Listener listener;
        EXPECT_EQ(document.load(&listener).instances.size(), 1u);
        EXPECT_TRUE(contains(listener.text, message)) << listener.text;
        const TempFolder folder;
        LoadOptions options{.log = listener.log, .strict = true};
        const std::string error = errorOf([&] { loadGltf(folder.write("t.gltf", document.json()), options); });
        EXPECT_NE(error, "no error") << message;
    };
    Document document;
    document.accessors.replace(document.accessors.find("\"VEC3\""), 6, R"("VEC3", "min": [0, 0, 0], "max": [1, 2, 0])");
    check(document, "accessors[0]: 'max' says 2, the data 1");
    document = Document();
    document.bytes.insert(document.bytes.begin(), 1);
    document.views =
        R"({"buffer": 0, "byteOffset": 1, "byteLength": 48}, {"buffer": 0, "byteOffset": 49, "byteLength": 8})";
    check(document, "accessors[0]: it begins at byte 1, not at a multiple of 4");
    document = Document();
    document.nodes = R"({"mesh": 0, "rotation": [0, 0, 0, 0.5]})";
    check(document, "nodes[0]: its 'rotation' is not of unit length");
    // Accessors that nobody reads.
    document = Document();
    document.accessors += R"(, {"bufferView": 0, "componentType": 5120, "count": 1, "type": "VEC9"})";
    check(document, "accessors[2]: 'type' is 'VEC9'");
    document = Document();
    document.accessors += R"(, {"bufferView": 0, "componentType": 5999, "count": 1, "type": "SCALAR"})";
    check(document, "accessors[2]: 'componentType' 5999 is unknown");
}

}  // namespace
}  // namespace crevice
