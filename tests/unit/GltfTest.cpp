// glTF files small enough to read here: what they become, and how broken and hostile ones are refused.
#include <cmath>
#include <cstring>
#include <string>

#include "SceneTestTools.h"

namespace crevice {
namespace {

using test::contains;
using test::errorOf;
using test::Listener;
using test::TempFolder;

template <class T>
void append(std::vector<unsigned char>& bytes, std::initializer_list<T> values) {
    for (const T value : values) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(T));
        std::memcpy(&bytes[at], &value, sizeof(T));
    }
}

/// A glTF with one buffer of four corners of a square (bytes 0 … 47), indices 0 1 2 3 (u16, 48 … 55); parts can be
/// replaced.
struct Document {
    std::vector<unsigned char> bytes;
    std::string attributes = R"("POSITION": 0)", primitive = R"(, "indices": 1)";
    std::string views = R"({"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8})";
    std::string accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                               {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    std::string nodes = R"({"mesh": 0})", roots = "0", rest, uri;
    std::string version = "2.0";

    Document() {
        append<float>(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        append<std::uint16_t>(bytes, {0, 1, 2, 3});
    }
    std::string json(bool binary = false) const {
        const std::string data =
            uri.empty() ? "data:application/octet-stream;base64," + test::encodeBase64(bytes) : uri;
        return R"({"asset": {"version": ")" + version + R"("}, "scene": 0, "scenes": [{"nodes": [)" + roots + R"(]}],
"nodes": [)" + nodes +
               R"(],
"meshes": [{"name": "square", "primitives": [{"attributes": {)" +
               attributes + "}" + primitive + R"(}]}],
"accessors": [)" +
               accessors + R"(],
"bufferViews": [)" +
               views + R"(],
"buffers": [{"byteLength": )" +
               std::to_string(bytes.size()) + (binary ? "" : R"(, "uri": ")" + data + "\"") + "}]" + rest + "}";
    }
    std::string glb() const {
        std::string text = json(true);
        while (text.size() % 4) text += ' ';
        std::vector<unsigned char> head;
        append<std::uint32_t>(head, {0x46546c67, 2, std::uint32_t(12 + 8 + text.size() + 8 + bytes.size())});
        append<std::uint32_t>(head, {std::uint32_t(text.size()), 0x4e4f534a});
        std::string file(head.begin(), head.end());
        file += text;
        std::vector<unsigned char> chunk;
        append<std::uint32_t>(chunk, {std::uint32_t(bytes.size()), 0x004e4942});
        file.append(chunk.begin(), chunk.end());
        return file.append(bytes.begin(), bytes.end());
    }
    Scene load(Listener* listener = nullptr) const {
        const TempFolder folder;
        Listener own;
        return loadGltf(folder.write("test.gltf", json()), {.log = (listener ? *listener : own).log});
    }
    std::string error() const {
        return errorOf([&] { load(); });
    }
};

// A white-and-red picture of 2 × 1 pixels, 8-bit RGB.
constexpr const char* kPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4//8/ww0GAA/uA/13wAnYAAAAAElFTkSuQmCC";

TEST(Gltf, TriangleWithoutNormalsGetsFlatOnes) {
    const Scene scene = Document{}.load();
    ASSERT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 1u);
    const Mesh& mesh = scene.meshes[0];
    EXPECT_EQ(mesh.name, "square");
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_FALSE(mesh.hasTangents);
    for (const Vertex& vertex : mesh.vertices) {
        EXPECT_EQ(vertex.normal, glm::vec3(0, 0, 1));
        EXPECT_EQ(vertex.color, glm::vec4(1));
    }
    EXPECT_EQ(mesh.bounds.max, glm::vec3(1, 1, 0));
    EXPECT_EQ(scene.materials[scene.instances[0].material].metallic, 0);  // the default material
}

TEST(Gltf, StripsAndFansBecomeTriangleLists) {
    // Normals keep the vertices shared, so that the indices can be compared.
    Document document;
    document.attributes = R"("POSITION": 0, "NORMAL": 0)";
    document.accessors.replace(document.accessors.find(R"("count": 3)"), 10, R"("count": 4)");
    document.primitive = R"(, "indices": 1, "mode": 5)";
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
    document.primitive = R"(, "indices": 1, "mode": 6)";
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
    document.primitive = R"(, "mode": 6)";  // no indices
    EXPECT_EQ(document.load().meshes[0].indices, (std::vector<std::uint32_t>{1, 2, 0, 2, 3, 0}));
}

TEST(Gltf, PointsAndLinesAreSkippedWithANote) {
    Document document;
    Listener listener;
    document.primitive = R"(, "mode": 0)";
    EXPECT_TRUE(document.load(&listener).instances.empty());
    EXPECT_TRUE(contains(listener.text, "points and lines"));
}

TEST(Gltf, NormalisedColoursOfEveryTypeAndInterleaving) {
    Document document;
    document.bytes.clear();
    for (int i = 0; i < 3; ++i) {  // 20 bytes per vertex: position, colour u8 × 4, colour u16 (2 of 4)
        append<float>(document.bytes, {float(i), float(i == 1), 0});
        append<std::uint8_t>(document.bytes, {255, 51, 0, 102});
        append<std::int16_t>(document.bytes, {32767, -32768});
    }
    document.views =
        R"({"buffer": 0, "byteLength": 48, "byteStride": 16}, {"buffer": 0, "byteLength": 60, "byteStride": 20})";
    document.accessors = R"({"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
        {"bufferView": 1, "byteOffset": 12, "componentType": 5121, "normalized": true, "count": 3, "type": "VEC4"},
        {"bufferView": 1, "byteOffset": 16, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC2"})";
    document.attributes = R"("POSITION": 0, "COLOR_0": 1, "TEXCOORD_0": 2)";
    document.primitive = "";
    const Mesh mesh = document.load().meshes.at(0);
    EXPECT_EQ(mesh.vertices[1].position, glm::vec3(1, 1, 0));
    EXPECT_LT(glm::distance(mesh.vertices[1].color, glm::vec4(1, 0.2f, 0, 0.4f)), 1e-6f);
    EXPECT_EQ(mesh.vertices[2].uv0, glm::vec2(1, -1));
}

TEST(Gltf, SparseAccessorsOverwriteTheirBase) {
    Document document;
    append<float>(document.bytes, {9, 8, 7});
    document.views +=
        R"(, {"buffer": 0, "byteOffset": 52, "byteLength": 2}, {"buffer": 0, "byteOffset": 56, "byteLength": 12})";
    const auto withSparse = [&](const std::string& sparse) {
        document.accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": )" +
                             sparse + R"(}, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    };
    // Byte 52 holds the index 2.
    withSparse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_EQ(document.load().meshes[0].vertices[2].position, glm::vec3(9, 8, 7));
    withSparse(R"({"count": 2, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_TRUE(contains(document.error(), "accessors[0]: 'sparse.indices'")) << document.error();
    withSparse(R"({"count": 1})");
    EXPECT_TRUE(contains(document.error(), "accessors[0]: 'sparse' lacks")) << document.error();
    document.bytes[52] = 4;
    withSparse(R"({"count": 1, "indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}})");
    EXPECT_TRUE(contains(document.error(), "sparse index 4 at 0 is not below 'count' 4")) << document.error();
}

TEST(Gltf, EqualPrimitivesShareTheirMesh) {
    Document document;
    document.nodes = R"({"mesh": 0, "children": [1]}, {"mesh": 0, "translation": [0, 0, 5], "scale": [2, 2, 2]})";
    const Scene scene = document.load();
    EXPECT_EQ(scene.meshes.size(), 1u);
    ASSERT_EQ(scene.instances.size(), 2u);
    EXPECT_EQ(glm::vec3(scene.instances[1].world * glm::vec4(1, 0, 0, 1)), glm::vec3(2, 0, 5));
}

TEST(Gltf, NodesComposeMatricesAndTurns) {
    Document document;
    document.nodes = R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1], "children": [1]},
                        {"mesh": 0, "rotation": [0, 0.70710678, 0, 0.70710678]})";
    const Scene scene = document.load();
    const glm::vec3 moved(scene.instances[0].world * glm::vec4(1, 0, 0, 1));
    EXPECT_LT(glm::distance(moved, glm::vec3(10, 0, -1)), 1e-5f);
    EXPECT_FALSE(scene.instances[0].flipped);
}

TEST(Gltf, NegativeScaleIsMarkedAsFlipped) {
    Document document;
    document.nodes = R"({"mesh": 0, "scale": [-1, 1, 1]})";
    EXPECT_TRUE(document.load().instances[0].flipped);
    document.nodes = R"({"mesh": 0, "scale": [-1, -1, 1]})";
    EXPECT_FALSE(document.load().instances[0].flipped);
}

TEST(Gltf, CamerasAndLightsStandInTheWorld) {
    Document document;
    document.nodes = R"({"mesh": 0}, {"camera": 0, "translation": [1, 2, 3]}, {"camera": 1},
        {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [4, 5, 6], "rotation": [0, 1, 0, 0]})";
    document.roots = "0, 1, 2, 3";
    document.rest = R"(, "extensionsRequired": ["KHR_lights_punctual"], "cameras": [
        {"type": "perspective", "name": "wide", "perspective": {"yfov": 1.5, "znear": 0.25}},
        {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0, "zfar": 10}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "color": [1, 0.5, 0], "intensity": 20, "range": 9,
            "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}})";
    const Scene scene = document.load();
    ASSERT_EQ(scene.cameras.size(), 2u);
    EXPECT_EQ(scene.cameras[0].name, "wide");
    EXPECT_FLOAT_EQ(scene.cameras[0].fovY, 1.5f);
    EXPECT_FLOAT_EQ(scene.cameras[0].near, 0.25f);
    EXPECT_EQ(scene.cameras[0].far, 0);
    EXPECT_LT(glm::distance(scene.cameras[0].position(), {1, 2, 3}), 1e-6f);
    EXPECT_TRUE(scene.cameras[1].orthographic);
    EXPECT_FLOAT_EQ(scene.cameras[1].orthoHeight, 4);
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_EQ(scene.lights[0].type, LightType::Spot);
    EXPECT_EQ(scene.lights[0].position, glm::vec3(4, 5, 6));
    EXPECT_LT(glm::distance(scene.lights[0].direction, glm::vec3(0, 0, 1)), 1e-6f);  // turned half round from -z
    EXPECT_FLOAT_EQ(scene.lights[0].outerAngle, 0.5f);
    EXPECT_FLOAT_EQ(scene.lights[0].range, 9);
}

TEST(Gltf, MaterialsKeepTheirNumbersAndTextures) {
    Document document;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "extensionsUsed": ["KHR_materials_emissive_strength"],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0.5,
            "roughnessFactor": 0.25, "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0, "texCoord": 1}},
            "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9984}],
        "images": [{"uri": "data:image/png;base64,)" +
                    std::string(kPng) + R"("}])";
    const Scene scene = document.load();
    ASSERT_EQ(scene.materials.size(), 1u);
    const SceneMaterial& material = scene.materials[0];
    EXPECT_EQ(material.name, "paint");
    EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 1, 0.75f));
    EXPECT_EQ(material.emissive, glm::vec3(4, 2, 0));
    EXPECT_EQ(material.alphaMode, AlphaMode::Mask);
    EXPECT_EQ(material.alphaCutoff, 0.25f);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.metallicRoughnessMap.texcoord, 1);
    // One image, used as colour and as data.
    ASSERT_EQ(scene.textures.size(), 2u);
    EXPECT_TRUE(scene.textures[material.baseColorMap.texture].srgb);
    EXPECT_FALSE(scene.textures[material.metallicRoughnessMap.texture].srgb);
    const SamplerDesc expected{.wrapU = TextureWrap::Clamp,
                               .wrapV = TextureWrap::Mirror,
                               .linearMag = false,
                               .linearMin = false,
                               .mipmaps = true,
                               .linearMip = false};
    EXPECT_EQ(scene.textures[0].sampler, expected);
    const Image& image = scene.textures[0].image;
    ASSERT_EQ(image.format, Format::RGBA8);
    EXPECT_EQ(image.width, 2u);
    EXPECT_EQ(image.height, 1u);
}

TEST(Gltf, MissingAndBrokenImagesAreWhiteWithAWarning) {
    for (const char* image : {R"({"uri": "none.png"})", R"({"uri": "data:image/png;base64,iVBORw0KGgo="})",
                              R"({"bufferView": 0, "mimeType": "image/png"})"}) {
        Document document;
        Listener listener;
        document.primitive = R"(, "indices": 1, "material": 0)";
        document.rest =
            R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [)" +
            std::string(image) + "]";
        const Scene scene = document.load(&listener);
        ASSERT_EQ(scene.textures.size(), 1u);
        EXPECT_EQ(scene.textures[0].image.at(0, 0), glm::vec4(1));
        EXPECT_TRUE(contains(listener.text, "images[0]")) << listener.text;
        EXPECT_TRUE(contains(listener.text, "shown white")) << listener.text;
    }
}

TEST(Gltf, HugePicturesAreNotDecoded) {
    // A PNG header that claims 2^31 - 1 pixels a side.
    std::vector<unsigned char> png = {0x89, 'P',  'N',  'G',  '\r', '\n', 0x1a, '\n', 0,    0, 0, 13, 'I', 'H', 'D',
                                      'R',  0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff, 8, 6, 0,  0,   0};
    Document document;
    Listener listener;
    document.primitive = R"(, "indices": 1, "material": 0)";
    document.rest = R"(, "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}],
        "images": [{"uri": "data:image/png;base64,)" +
                    test::encodeBase64(png) + R"("}])";
    EXPECT_EQ(document.load(&listener).textures.at(0).image.width, 1u);
    EXPECT_TRUE(contains(listener.text, "2147483647 x 2147483647")) << listener.text;
}

TEST(Gltf, AccessorsAreCheckedAgainstTheirBytes) {
    const auto errorWith = [](const std::string& accessor) {
        Document document;
        document.accessors = accessor + R"(, {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
        return document.error();
    };
    const auto expect = [&](const std::string& accessor, const std::string& message) {
        const std::string error = errorWith(accessor);
        EXPECT_TRUE(contains(error, "accessors[0]: " + message)) << error;
        EXPECT_TRUE(contains(error, "test.gltf:4:")) << error;
    };
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 5, "type": "VEC3"})", "the range of 5 elements");
    expect(R"({"bufferView": 0, "byteOffset": 4, "componentType": 5126, "count": 4, "type": "VEC3"})",
           "the range of 4");
    expect(R"({"bufferView": 0, "byteOffset": 9007199254740000, "componentType": 5126, "count": 4, "type": "VEC3"})",
           "the range");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 4611686018427387905, "type": "VEC3"})",
           "'count' is not");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 9007199254740000, "type": "VEC3"})", "'count'");
    expect(R"({"componentType": 5126, "count": 900719925474099, "type": "VEC3"})", "'count'");
    expect(R"({"bufferView": 9, "componentType": 5126, "count": 4, "type": "VEC3"})", "the range names bufferViews[9]");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": -1, "type": "VEC3"})", "'count' is not");
    expect(R"({"bufferView": 0, "componentType": 5126, "count": 0, "type": "VEC3"})", "'count' is 0");
    expect(R"({"bufferView": 0, "componentType": 5124, "count": 4, "type": "VEC3"})", "'componentType' 5124");
}

TEST(Gltf, BufferViewsAreCheckedAgainstTheirBuffer) {
    Document document;
    document.views = R"({"buffer": 0, "byteLength": 49, "byteOffset": 8}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[0]: 'byteOffset' 8 and 'byteLength' 49 reach beyond"))
        << document.error();
    document.views = R"({"buffer": 0, "byteLength": 48}, {"buffer": 3, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[1]: 'buffer'")) << document.error();
    document.views = R"({"buffer": 0, "byteLength": 1e300}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "bufferViews[0]: 'byteLength'")) << document.error();
    document.views = R"({"buffer": 0, "byteLength": 48, "byteStride": 8}, {"buffer": 0, "byteLength": 8})";
    EXPECT_TRUE(contains(document.error(), "'byteStride' 8 is less than")) << document.error();
}

TEST(Gltf, IndicesMustNameVertices) {
    Document document;
    document.bytes[52] = 4;  // the third index
    EXPECT_TRUE(contains(document.error(), "accessors[1]: index 4 at 2 is not below the 4 vertices"))
        << document.error();
}

TEST(Gltf, AttributesMustAgreeInCountAndType) {
    Document document;
    document.attributes = R"("POSITION": 0, "TEXCOORD_0": 1)";
    EXPECT_TRUE(contains(document.error(), "accessors[1]: 'count' is 3, but POSITION")) << document.error();
    document.attributes = R"("POSITION": 0, "TEXCOORD_0": 0)";
    EXPECT_TRUE(contains(document.error(), "accessors[0]: 'type' does not fit TEXCOORD_0")) << document.error();
    document.attributes = R"("POSITION": 7)";
    EXPECT_TRUE(contains(document.error(), "accessors[7]")) << document.error();
}

TEST(Gltf, PositionsMustBeFinite) {
    Document document;
    const float nan = std::nanf("");
    std::memcpy(document.bytes.data() + 4, &nan, sizeof nan);
    EXPECT_TRUE(contains(document.error(), "not a finite number")) << document.error();
}

TEST(Gltf, NodeCyclesAndDepthAreRefused) {
    Document document;
    document.nodes = R"({"children": [1]}, {"children": [0], "mesh": 0})";
    EXPECT_TRUE(contains(document.error(), "nodes[0]: has two parents or is its own ancestor")) << document.error();
    document.nodes = R"({"children": [5]})";
    EXPECT_TRUE(contains(document.error(), "nodes[5]")) << document.error();
    document.nodes.clear();
    for (int i = 0; i < 300; ++i) document.nodes += R"({"children": [)" + std::to_string(i + 1) + "]}, ";
    document.nodes += R"({"mesh": 0})";
    EXPECT_TRUE(contains(document.error(), "nested deeper than 256")) << document.error();
}

TEST(Gltf, RequiredExtensionsAreNamedOptionalOnesNoted) {
    Document document;
    document.rest =
        R"(, "extensionsUsed": ["KHR_draco_mesh_compression"], "extensionsRequired": ["KHR_draco_mesh_compression"])";
    EXPECT_TRUE(contains(document.error(), "requires the extension 'KHR_draco_mesh_compression'")) << document.error();
    document.rest = R"(, "extensionsUsed": ["KHR_texture_transform"])";
    Listener listener;
    EXPECT_EQ(document.load(&listener).instances.size(), 1u);
    EXPECT_TRUE(contains(listener.text, "'KHR_texture_transform'")) << listener.text;
}

TEST(Gltf, VersionOneIsRefusedByName) {
    Document document;
    document.version = "1.0";
    EXPECT_TRUE(contains(document.error(), "glTF 1.0")) << document.error();
    document.version = "3.0";
    EXPECT_TRUE(contains(document.error(), "'asset.version'")) << document.error();
}

TEST(Gltf, BuffersAreReadOnlyFromTheScenesFolder) {
    const TempFolder folder;
    const Document bytes;
    const std::string content(bytes.bytes.begin(), bytes.bytes.end());
    folder.write("secret.bin", content);
    folder.write("scene/a b.bin", content + "more than is used");
    Document document;
    Listener listener;
    const auto load = [&](const std::string& uri) {
        document.uri = uri;
        return loadGltf(folder.write("scene/test.gltf", document.json()), {.log = listener.log});
    };
    EXPECT_EQ(load("a%20b.bin").instances.size(), 1u);
    for (const char* outside : {"../secret.bin", "x/../../secret.bin", "%2e%2e/secret.bin", "/etc/hostname"}) {
        const std::string error = errorOf([&] { load(outside); });
        EXPECT_TRUE(contains(error, "buffers[0]: ")) << error;
        EXPECT_TRUE(contains(error, "lies outside the scene's folder")) << error;
    }
    std::filesystem::create_symlink(folder.path() / "secret.bin", folder.path() / "scene/link.bin");
    EXPECT_TRUE(contains(errorOf([&] { load("link.bin"); }), "lies outside"));
    EXPECT_TRUE(contains(errorOf([&] { load("none.bin"); }), "buffers[0]: cannot read 'none.bin'"));
    folder.write("scene/short.bin", content.substr(1));
    EXPECT_TRUE(contains(errorOf([&] { load("short.bin"); }), "'short.bin' has 55 bytes, 'byteLength' says 56"));
    EXPECT_EQ(loadGltf(folder.write("scene/test.gltf", (document.uri = "../secret.bin", document.json())),
                       {.log = listener.log, .allowedRoots = {folder.path()}})
                  .instances.size(),
              1u);
}

TEST(Gltf, BinaryFilesLoadAndEveryTruncationIsAnError) {
    const TempFolder folder;
    const std::string whole = Document{}.glb();
    Listener listener;
    const auto load = [&](std::string_view content) {
        return loadGltf(folder.write("t.glb", content), {.log = listener.log});
    };
    EXPECT_EQ(test::triangleCount(load(whole)), 1u);
    for (std::size_t length = 0; length < whole.size(); ++length)
        ASSERT_NE(errorOf([&] { load(std::string_view(whole).substr(0, length)); }), "no error") << length;
    std::string old = whole;
    old[4] = 1;
    EXPECT_TRUE(contains(errorOf([&] { load(old); }), "glTF 1.0"));
}

TEST(Gltf, LimitsAreKept) {
    const TempFolder folder;
    Listener listener;
    Document document;
    const auto errorWith = [&](const LoadLimits& limits) {
        return errorOf(
            [&] { loadGltf(folder.write("t.gltf", document.json()), {.log = listener.log, .limits = limits}); });
    };
    EXPECT_EQ(errorWith({}), "no error");
    EXPECT_TRUE(contains(errorWith({.maxVertices = 3}), "more than 3 vertices")) << errorWith({.maxVertices = 3});
    EXPECT_TRUE(contains(errorWith({.maxInstances = 0}), "more than 0 instances"));
    EXPECT_NE(errorWith({.maxFileBytes = 100}), "no error");
}

// Any change of one byte ends in a scene or in an Error, never otherwise.
TEST(Gltf, MutatedFilesLoadOrAreRefused) {
    const TempFolder folder;
    Listener listener;
    Document document;
    document.accessors +=
        R"(, {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}})";
    document.attributes = R"("POSITION": 2)";
    document.rest =
        R"(, "materials": [{"alphaMode": "BLEND"}], "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])";
    std::uint32_t state = 12345;
    const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
    int loaded = 0, refused = 0;
    for (const std::string& whole : {document.json(), document.glb()})
        for (int i = 0; i < 1500; ++i) {
            std::string content = whole;
            constexpr char kLetters[] = "0123456789-[]{}\",:.eE \xff\x80n";
            content[random() % content.size()] = kLetters[random() % (sizeof kLetters - 1)];
            const auto path = folder.write(whole[0] == '{' ? "m.gltf" : "m.glb", content);
            errorOf([&] { loadGltf(path, {.log = listener.log}); }) == "no error" ? ++loaded : ++refused;
        }
    EXPECT_GT(loaded, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace crevice
