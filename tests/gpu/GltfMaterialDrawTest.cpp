// Materials of glTF as they are seen: vertex colours, alpha, samplers, coordinates, both sides of a surface.
#include "GltfModelFixture.h"

namespace crevice {
namespace {

class GltfMaterialDraw : public GltfPictureTest {
protected:
    static Image texels(std::initializer_list<glm::u8vec4> colors) {
        Image image(static_cast<std::uint32_t>(colors.size()), 1, Format::RGBA8);
        std::size_t at = 0;
        for (const glm::u8vec4& color : colors)
            for (int c = 0; c < 4; ++c) image.pixels[at++] = static_cast<std::byte>(color[c]);
        return image;
    }
    static Image whiteAndRed() { return texels({{255, 255, 255, 255}, {255, 0, 0, 255}}); }
    static constexpr const char* kNearest = "\"magFilter\": 9728, \"minFilter\": 9728";
    static constexpr glm::vec3 kRed{1, 0, 0};

    /// The square from -1 to 1 with the same coordinates at each corner, unlit, its texture as `info` says.
    ModelText textured(const Image& image, const std::string& sampler, const glm::vec2& uv,
                       const std::string& info = {}, const glm::vec2& otherUv = glm::vec2(0)) const {
        ModelText model;
        std::vector<float> first, second;
        for (int corner = 0; corner < 4; ++corner) {
            first.insert(first.end(), {uv.x, uv.y});
            second.insert(second.end(), {otherUv.x, otherUv.y});
        }
        const int texture = model.texture(image, sampler);
        const std::string attributes = "\"POSITION\": " + std::to_string(model.rectangle(glm::vec2(-1), glm::vec2(1))) +
                                       ", \"TEXCOORD_0\": " + std::to_string(model.accessor("VEC2", first)) +
                                       ", \"TEXCOORD_1\": " + std::to_string(model.accessor("VEC2", second));
        const int material = model.unlit("\"baseColorTexture\": {\"index\": " + std::to_string(texture) + info + "}");
        model.mesh(ModelText::primitive(attributes, model.rectangleIndices(), material));
        model.root("\"mesh\": 0");
        return model;
    }
    static std::string transform(const std::string& members) {
        return ", \"extensions\": {\"KHR_texture_transform\": {" + members + "}}";
    }
    /// Two squares in one mesh, the second of them 1 farther away, with a colour each (RGBA).
    static ModelText twoSquares(const std::string& material, const glm::vec4& nearColor, const glm::vec4& farColor,
                                bool farIsTurned) {
        ModelText model;
        std::vector<float> places = ModelText::corners(glm::vec2(-1), glm::vec2(1), 1);
        const std::vector<float> behind =
            farIsTurned ? ModelText::corners({1, -1}, {-1, 1}, 0) : ModelText::corners({-1, -1}, {1, 1}, 0);
        places.insert(places.end(), behind.begin(), behind.end());
        std::vector<float> colors;
        for (int corner = 0; corner < 8; ++corner)
            for (int c = 0; c < 4; ++c) colors.push_back((corner < 4 ? nearColor : farColor)[c]);
        const std::string attributes = "\"POSITION\": " + std::to_string(model.accessor("VEC3", places)) +
                                       ", \"COLOR_0\": " + std::to_string(model.accessor("VEC4", colors));
        model.mesh(ModelText::primitive(attributes, model.rectangleIndices(2), model.unlit("", material)));
        model.root("\"mesh\": 0");
        return model;
    }
};

TEST_F(GltfMaterialDraw, VertexColoursOfEveryFormatMultiplyTheFactor) {
    // (0.2, 0.4, 0.6) in each format, in the four quarters of the picture.
    ModelText model;
    std::vector<int> colors;
    std::vector<float> vec3, vec4;
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint16_t> words;
    for (int corner = 0; corner < 4; ++corner) {
        vec3.insert(vec3.end(), {0.2f, 0.4f, 0.6f});
        vec4.insert(vec4.end(), {0.2f, 0.4f, 0.6f, 1});
        bytes.insert(bytes.end(), {51, 102, 153, 255});
        words.insert(words.end(), {13107, 26214, 39321, 65535});
    }
    colors = {model.accessor("VEC3", vec3), model.accessor("VEC4", vec4),
              model.accessor("VEC4", bytes, ", \"normalized\": true"),
              model.accessor("VEC4", words, ", \"normalized\": true")};
    const int material = model.unlit("\"baseColorFactor\": [0.5, 1, 1, 1]"), indices = model.rectangleIndices();
    std::string primitives;
    for (int i = 0; i < 4; ++i) {
        const glm::vec2 low(i % 2 - 1, i / 2 - 1);
        primitives +=
            (i ? ", " : "") + ModelText::primitive("\"POSITION\": " + std::to_string(model.rectangle(low, low + 1.0f)) +
                                                       ", \"COLOR_0\": " + std::to_string(colors[std::size_t(i)]),
                                                   indices, material);
    }
    model.mesh(primitives);
    model.root("\"mesh\": 0");
    for (const char* pipeline : {"deferred", "forward"}) {
        const Image picture = pictureOf(sceneOf(model), pipeline);
        for (int i = 0; i < 4; ++i)
            expectSeen(picture, float(i % 2) - 0.5f, float(i / 2) - 0.5f, {0.1f, 0.4f, 0.6f},
                       pipeline + std::to_string(i));
    }
}

TEST_F(GltfMaterialDraw, TheCutoffItselfIsKept) {
    struct Case {
        const char *alpha, *cutoff;
        bool kept;
    };
    for (const Case& c : {Case{"0.5", "", true}, Case{"0.49", "", false}, Case{"0.75", ", \"alphaCutoff\": 0.75", true},
                          Case{"0", ", \"alphaCutoff\": 0", true}, Case{"1", ", \"alphaCutoff\": 1.1", false}}) {
        ModelText model;
        const std::string factor = "\"baseColorFactor\": [1, 1, 1, " + std::string(c.alpha) + "]";
        model.rectangleMesh(glm::vec2(-1), glm::vec2(1),
                            model.unlit(factor, ", \"alphaMode\": \"MASK\"" + std::string(c.cutoff)));
        model.root("\"mesh\": 0");
        expectSeen(pictureOf(model), 0, 0, c.kept ? kWhite : kNothing, std::string(c.alpha) + c.cutoff);
    }
}

// Exporters say BLEND of whole models: nothing of them may shine through.
TEST_F(GltfMaterialDraw, BlendedButOpaqueModelsHideWhatIsBehind) {
    const char* material = R"(, "alphaMode": "BLEND", "doubleSided": true)";
    for (const char* pipeline : {"deferred", "forward"}) {
        const ModelText opaque = twoSquares(material, {1, 0, 0, 1}, {0, 1, 0, 1}, false);
        const Scene scene = sceneOf(opaque);
        EXPECT_EQ(scene.materials[0].alphaMode, AlphaMode::Opaque);
        expectSeen(pictureOf(scene, pipeline), 0, 0, kRed, pipeline);
    }
    // One transparent vertex, factor or texel is enough to blend.
    EXPECT_EQ(sceneOf(twoSquares(material, {1, 0, 0, 1}, {0, 1, 0, 0.99f}, false)).materials[0].alphaMode,
              AlphaMode::Blend);
    for (const std::uint8_t alpha : {std::uint8_t(254), std::uint8_t(255)}) {
        ModelText model = textured(texels({{255, 255, 255, 255}, {255, 255, 255, alpha}}), kNearest, {0.25f, 0.5f});
        const int material1 = model.unlit("\"baseColorTexture\": {\"index\": 0}", ", \"alphaMode\": \"BLEND\"");
        model.rectangleMesh(glm::vec2(-1), glm::vec2(1), material1);
        model.root("\"mesh\": 1");
        EXPECT_EQ(sceneOf(model).materials[1].alphaMode, alpha == 255 ? AlphaMode::Opaque : AlphaMode::Blend);
    }
}

TEST_F(GltfMaterialDraw, FarSidesAreSeenThroughNearOnes) {
    const char* material = R"(, "alphaMode": "BLEND", "doubleSided": true)";
    for (const char* pipeline : {"deferred", "forward"}) {
        // The far square shows its back, as a closed model's does, and stands second in the mesh.
        const ModelText glass = twoSquares(material, {1, 0, 0, 0.5f}, {0, 1, 0, 0.5f}, true);
        expectSeen(pictureOf(sceneOf(glass), pipeline), 0, 0, {0.5f, 0.25f, 0}, pipeline);
        Scene scene = sceneOf(glass);
        scene.instances[0].world = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1));
        scene.instances[0].flipped = true;
        expectSeen(pictureOf(scene, pipeline), 0, 0, {0.5f, 0.25f, 0}, pipeline + std::string(" mirrored"));
    }
}

TEST_F(GltfMaterialDraw, SamplersRepeatMirrorAndClamp) {
    struct Case {
        const char* wrap;
        float u;
        bool red;  // texels: white below 0.5, red above
    };
    for (const Case& c : {Case{"", 1.25f, false}, Case{"", 1.75f, true}, Case{"", -0.25f, true},
                          Case{", \"wrapS\": 33071", 1.25f, true}, Case{", \"wrapS\": 33071", -0.75f, false},
                          Case{", \"wrapS\": 33648", 1.25f, true}, Case{", \"wrapS\": 33648", 1.75f, false},
                          Case{", \"wrapS\": 33648", -0.25f, false}})
        expectSeen(pictureOf(textured(whiteAndRed(), std::string(kNearest) + c.wrap, {c.u, 0.5f})), 0, 0,
                   c.red ? kRed : kWhite, std::string(c.wrap) + " " + std::to_string(c.u));
    // Without a sampler: repeated, and smooth.
    expectSeen(pictureOf(textured(whiteAndRed(), "", {1.25f, 0.5f})), 0, 0, kWhite, "no sampler");
    expectSeen(pictureOf(textured(whiteAndRed(), "", {1.5f, 0.5f})), 0, 0, {1, 0.5f, 0.5f}, "no sampler, between");
}

TEST_F(GltfMaterialDraw, TransformsTurnCounterClockwiseAndNameTheirSet) {
    const auto middle = [&](const glm::vec2& uv, const std::string& info, const glm::vec2& other = glm::vec2(0)) {
        return pictureOf(textured(whiteAndRed(), kNearest, uv, info, other));
    };
    // By a quarter the new u is v; by minus a quarter it is -v, which repeats.
    expectSeen(middle({0.25f, 0.75f}, ""), 0, 0, kWhite);
    expectSeen(middle({0.25f, 0.75f}, transform("\"rotation\": 1.57079633")), 0, 0, kRed);
    expectSeen(middle({0.25f, 0.25f}, transform("\"rotation\": 1.57079633")), 0, 0, kWhite);
    expectSeen(middle({0.25f, 0.25f}, transform("\"rotation\": -1.57079633")), 0, 0, kRed);
    // Scaled first, then shifted: 0.25 -> 0.5 -> 0.9.
    expectSeen(middle({0.25f, 0.5f}, transform("\"scale\": [2, 1], \"offset\": [0.4, 0]")), 0, 0, kRed);
    // The extension's set goes before the texture's own.
    expectSeen(middle({0.25f, 0}, ", \"texCoord\": 0" + transform("\"texCoord\": 1"), {0.75f, 0}), 0, 0, kRed);
    expectSeen(middle({0.25f, 0}, ", \"texCoord\": 1" + transform("\"texCoord\": 0"), {0.75f, 0}), 0, 0, kWhite);
    expectSeen(middle({0.25f, 0}, ", \"texCoord\": 1", {0.75f, 0}), 0, 0, kRed);
}

// Four textures that read four sets; what is given off is read from one of them, the only one that points to white.
TEST_F(GltfMaterialDraw, FourSetsOfCoordinatesAreKeptApart) {
    constexpr int kNumbers[] = {0, 2, 3, 7};
    for (const char* pipeline : {"deferred", "forward"})
        for (int wanted = 0; wanted < 4; ++wanted) {
            ModelText model;
            std::string attributes = "\"POSITION\": " + std::to_string(model.rectangle(glm::vec2(-1), glm::vec2(1)));
            std::string material;
            const char* readers[] = {"normalTexture", "occlusionTexture"};
            const int texture = model.texture(whiteAndRed(), kNearest);
            for (int set = 0, other = 0; set < 4; ++set) {
                const float u = set == wanted ? 0.25f : 0.75f;
                const std::string number = std::to_string(kNumbers[set]);
                attributes += ", \"TEXCOORD_" + number + "\": " +
                              std::to_string(model.accessor("VEC2", std::vector<float>{u, 0, u, 0, u, 0, u, 0}));
                const std::string info = ": {\"index\": " + std::to_string(texture) + ", \"texCoord\": " + number + "}";
                if (set == wanted)
                    material += ", \"emissiveTexture\"" + info;
                else if (other < 2)
                    material += std::string(", \"") + readers[other++] + "\"" + info;
                else
                    material += ", \"pbrMetallicRoughness\": {\"baseColorTexture\"" + info + "}";
            }
            model.add("materials", "{\"emissiveFactor\": [1, 1, 1]" + material + "}");
            model.mesh(ModelText::primitive(attributes, model.rectangleIndices(), 0));
            model.root("\"mesh\": 0");
            expectSeen(pictureOf(sceneOf(model), pipeline), 0, 0, kWhite, pipeline + std::to_string(wanted));
        }
}

TEST_F(GltfMaterialDraw, EmissiveStrengthIsRadiance) {
    ModelText model;
    const int material = model.add("materials", R"({"emissiveFactor": [0.5, 0.25, 0],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}})");
    model.rectangleMesh(glm::vec2(-1), glm::vec2(1), material);
    model.root("\"mesh\": 0");
    expectSeen(pictureOf(model), 0, 0, {4, 2, 0});
}

// Half a turn about y: tangent and normal point the other way, the bitangent does not. The back face is lit with the
// whole mapped normal reversed (glTF 2.0, 3.9.6): as an unturned surface whose map leans the other way along y.
TEST_F(GltfMaterialDraw, BumpsOfBackFacesAreReversed) {
    for (const bool withTangents : {true, false}) {
        glm::vec3 found[2];
        for (const bool turned : {false, true}) {
            ModelText model;
            // (0.6, ±0.4, 0.7), not of unit length.
            const int texture = model.texture(texels({{204, turned ? 76 : 179, 217, 255}}));
            std::vector<float> normals, tangents;
            for (int corner = 0; corner < 4; ++corner) {
                normals.insert(normals.end(), {0, 0, 1});
                tangents.insert(tangents.end(), {1, 0, 0, 1});
            }
            std::string attributes = "\"POSITION\": " + std::to_string(model.rectangle(glm::vec2(-1), glm::vec2(1))) +
                                     ", \"NORMAL\": " + std::to_string(model.accessor("VEC3", normals)) +
                                     ", \"TEXCOORD_0\": " +
                                     std::to_string(model.accessor("VEC2", std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}));
            if (withTangents) attributes += ", \"TANGENT\": " + std::to_string(model.accessor("VEC4", tangents));
            const int material =
                model.add("materials", R"({"doubleSided": true, "pbrMetallicRoughness": {"metallicFactor": 0},
                "normalTexture": {"index": )" +
                                           std::to_string(texture) + "}}");
            model.mesh(ModelText::primitive(attributes, model.rectangleIndices(), material));
            model.root(turned ? "\"mesh\": 0, \"rotation\": [0, 1, 0, 0]" : "\"mesh\": 0");
            Scene scene = sceneOf(model);
            scene.lights = {directional({-0.6f, -0.3f, -1}, 3)};
            found[turned] = seen(pictureOf(std::move(scene)), 0.1f, 0.1f);
        }
        EXPECT_GT(found[0].x, 0.3f);
        EXPECT_NEAR(found[0].x, found[1].x, 4 * kHalfUnit) << (withTangents ? "tangents" : "derivatives");
    }
}

// Appendix B.3.5: half metal is half of what the metal and half of what the dielectric sends to the viewer.
TEST_F(GltfMaterialDraw, HalfMetalsAreTheMeanOfBoth) {
    const auto wall = [&](const char* metallic) {
        ModelText model;
        const int material = model.add("materials",
                                       R"({"pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.4, 0.2, 1],
            "roughnessFactor": 0.5, "metallicFactor": )" +
                                           std::string(metallic) + "}}");
        model.rectangleMesh(glm::vec2(-1), glm::vec2(1), material);
        model.root("\"mesh\": 0");
        return sceneOf(model);
    };
    const Log silent(LogLevel::Error);
    Image white(16, 8, Format::RGBA32F);
    const std::vector<float> ones(16 * 8 * 4, 1.0f);
    std::memcpy(white.pixels.data(), ones.data(), white.pixels.size());
    for (const char* pipeline : {"deferred", "forward"}) {
        for (const bool fromAllAround : {false, true}) {
            std::vector<glm::vec3> found;
            for (const char* metallic : {"0", "0.5", "1"}) {
                Scene scene = wall(metallic);
                if (fromAllAround)
                    scene.environment = makeEnvironment(white, "white", silent);
                else
                    scene.lights = {directional({-0.6f, -0.3f, -1}, 3)};
                found.push_back(seen(pictureOf(std::move(scene), pipeline), 0.1f, 0.1f));
            }
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(found[1][c], (found[0][c] + found[2][c]) / 2, 4 * kHalfUnit) << pipeline << ' ' << c;
                EXPECT_GT(found[0][c], 0.05f) << pipeline;
                EXPECT_GT(found[2][c], 0.05f) << pipeline;
            }
        }
    }
}

}  // namespace
}  // namespace crevice
