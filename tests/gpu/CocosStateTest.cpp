// Stencils, states and pictures of full-screen stages, and posed meshes under Cocos' profiles.
#include "CocosRuntimeFixture.h"

#include <cstring>

#include "core/Files.h"
#include "scene/GltfLoader.h"

namespace crevice {
namespace {

class CocosState : public CocosRuntime {
protected:
    static constexpr float kStep = 1.01f / 255;

    /// Green where `mask` is drawn, in a picture of 16 x 16 that `red` covers wholly behind it.
    Image renderMasked(const MaterialPass& red) {
        Scene scene = darkScene();
        scene.materials[0].effect = MaterialEffect{.effect = "mask", .technique = 0, .passes = {}};
        scene.materials.push_back(scene.materials[0]);
        scene.materials[1].effect = MaterialEffect{.effect = "masked", .technique = 0, .passes = {red}};
        addWall(scene, 2);
        addWall(scene, 10, {0, 0, -1}, 1);
        renderer_->setScene(scene);
        return renderer_->render(viewOf(frontCamera(), 16, 16));
    }
};

TEST_F(CocosState, StencilTestsKeepWhatTheyMask) {
    const std::string free = "depthTest: false, depthWrite: false, ";
    writeSurface("mask",
                 "    - { vert: 'vs:vert', frag: 'fs:frag', priority: 100, depthStencilState: { " + free +
                     "stencilTestFront: true, stencilPassOpFront: replace, stencilRefFront: 5, stencilTestBack: true, "
                     "stencilPassOpBack: replace, stencilRefBack: 5 } }\n",
                 "", "vec4(0.0, 1.0, 0.0, 1.0)");
    writeSurface("masked",
                 "    - { vert: 'vs:vert', frag: 'fs:frag', depthStencilState: { " + free +
                     "stencilTestFront: true, stencilFuncFront: not_equal, stencilRefFront: 5, stencilTestBack: true, "
                     "stencilFuncBack: not_equal, stencilRefBack: 5 } }\n",
                 "", "vec4(1.0, 0.0, 0.0, 1.0)");
    loadCocos(forward());
    const glm::vec4 red(1, 0, 0, 1), green(0, 1, 0, 1), black(0, 0, 0, 1);
    const auto states = [](const char* text) {
        return MaterialPass{.defines = {}, .states = parseJson(text, "states"), .properties = {}};
    };
    // 2 of 4 world units are masked.
    Image image = renderMasked(states("{}"));
    EXPECT_EQ(image.at(8, 8), green);
    EXPECT_EQ(image.at(1, 8), red);
    EXPECT_EQ(image.at(8, 14), red);
    // A material's overrides, by Cocos' numbers: `equal` is 2. And without the bits that differ, nothing is masked.
    image = renderMasked(states(R"({"depthStencilState": {"stencilFuncFront": 2, "stencilFuncBack": 2}})"));
    EXPECT_EQ(image.at(8, 8), red);
    EXPECT_EQ(image.at(1, 8), black);
    image = renderMasked(states(R"({"depthStencilState": {"stencilReadMaskFront": 2, "stencilReadMaskBack": 2}})"));
    EXPECT_EQ(image.at(8, 8), green);  // 0 is not unlike 0: red is nowhere, the mask's own colour stays
    EXPECT_EQ(image.at(1, 8), black);
    image = renderMasked(states(R"({"depthStencilState": {"stencilTestFront": false, "stencilTestBack": false}})"));
    EXPECT_EQ(image.at(8, 8), red);
    EXPECT_EQ(image.at(1, 8), red);
}

TEST_F(CocosState, FullScreenStagesTakeStatesAndPictures) {
    Image picture(2, 2, Format::RGBA8);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t rgba[4] = {51, 102, 204, 255};
        std::memcpy(picture.pixels.data() + i * 4, rgba, sizeof rgba);
    }
    const std::string file = (folder_ / "noise.png").string();
    writeImage(file, picture);
    writeCocos("sum",
               "CCEffect %{\n  techniques:\n  - passes:\n    - vert: quad-vs:vert\n      frag: test-fs:frag\n"
               "      properties: { noise: { value: black } }\n"
               "      depthStencilState: { depthTest: false, depthWrite: false }\n}%\n" +
                   std::string(kQuadVertex) +
                   "CCProgram test-fs %{\n  precision highp float;\n  in vec2 v_uv;\n  uniform sampler2D noise;\n"
                   "  vec4 frag () { return vec4(texture(noise, v_uv).rgb + 0.2, 1.0); }\n}%\n");
    const std::string stage = R"({"stage": "FullscreenStage", "effect": "sum", "writes": ["finalColor"])";
    const std::string added =
        R"(, "states": {"blendState": {"targets": [{"blend": true, "blendSrc": "one", "blendDst": 1}]}})";
    loadCocos(stage + R"(, "material": {"noise": ")" + file + R"("}}, )" + stage + R"(, "name": "Second")" + added +
              "}");
    renderer_->setScene(darkScene());
    const glm::vec4 sum = renderer_->render(sized(8, 8)).at(3, 5);
    EXPECT_NEAR(sum.x, 0.2 + 0.2 + 0.2, 2 * kStep);  // the picture's and both constants
    EXPECT_NEAR(sum.y, 0.4 + 0.2 + 0.2, 2 * kStep);
    EXPECT_NEAR(sum.z, 1, kStep);
}

/// Two squares of one unit at the origin: one is skinned to a joint at x = 1.25, one morphed by -1.25.
void writePosed(const std::filesystem::path& folder) {
    std::string bytes;
    const auto add = [&](const auto& values) { bytes.append(reinterpret_cast<const char*>(values), sizeof values); };
    const float corners[12] = {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0.5f, 0.5f, 0, -0.5f, 0.5f, 0};
    const std::uint8_t joints[16] = {};
    const float weights[16] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    const float moves[12] = {-1.25f, 0, 0, -1.25f, 0, 0, -1.25f, 0, 0, -1.25f, 0, 0};
    const std::uint16_t indices[6] = {0, 1, 2, 0, 2, 3};
    add(corners), add(joints), add(weights), add(moves), add(indices);
    writeFileAtomically(folder / "posed.bin", bytes);
    writeFileAtomically(folder / "posed.gltf", R"({ "asset": { "version": "2.0" }, "scene": 0,
      "scenes": [ { "nodes": [ 0, 1, 2 ] } ],
      "nodes": [ { "mesh": 0, "skin": 0 }, { "translation": [ 1.25, 0, 0 ] }, { "mesh": 1, "weights": [ 1 ] } ],
      "skins": [ { "joints": [ 1 ] } ], "materials": [ { "name": "m" } ],
      "meshes": [
        { "primitives": [ { "attributes": { "POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2 }, "indices": 4, "material": 0 } ] },
        { "primitives": [ { "attributes": { "POSITION": 0 }, "targets": [ { "POSITION": 3 } ], "indices": 4, "material": 0 } ] } ],
      "accessors": [
        { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [ -0.5, -0.5, 0 ], "max": [ 0.5, 0.5, 0 ] },
        { "bufferView": 1, "componentType": 5121, "count": 4, "type": "VEC4" },
        { "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4" },
        { "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC3", "min": [ -1.25, 0, 0 ], "max": [ -1.25, 0, 0 ] },
        { "bufferView": 4, "componentType": 5123, "count": 6, "type": "SCALAR" } ],
      "bufferViews": [ { "buffer": 0, "byteLength": 48 }, { "buffer": 0, "byteOffset": 48, "byteLength": 16 },
        { "buffer": 0, "byteOffset": 64, "byteLength": 64 }, { "buffer": 0, "byteOffset": 128, "byteLength": 48 },
        { "buffer": 0, "byteOffset": 176, "byteLength": 12 } ],
      "buffers": [ { "byteLength": 188, "uri": "posed.bin" } ] })");
}

TEST_F(CocosState, SkinsAndMorphsArePosedBeforeTheEffectSeesThem) {
    writePosed(folder_);
    // The engine's own branches stay off: they would pose a second time, with joints that are zeroes.
    writeSurface("posed", "    - { vert: 'vs:vert', frag: 'fs:frag' }\n",
                 "  #if CC_USE_SKINNING\n  in vec4 a_joints;\n  in vec4 a_weights;\n  #endif\n"
                 "  vec4 tint () {\n    #if CC_USE_SKINNING || CC_USE_MORPH\n    return vec4(1.0, 0.0, 0.0, 1.0);\n"
                 "    #else\n    return vec4(0.0, 1.0, 0.0, 1.0);\n    #endif\n  }\n",
                 "tint()");
    loadCocos(forward());
    Scene scene = loadGltf(folder_ / "posed.gltf", {.log = log_});
    for (SceneMaterial& material : scene.materials)
        material.effect = MaterialEffect{.effect = "posed", .technique = 0, .passes = {}};
    scene.exposureEv = 0;
    renderer_->setScene(scene);
    const Image image = renderer_->render(viewOf(frontCamera(), 16, 16));  // 4 units in each direction
    const glm::vec4 green(0, 1, 0, 1), black(0, 0, 0, 1);
    EXPECT_EQ(image.at(13, 8), green);  // x = 1.375
    EXPECT_EQ(image.at(3, 8), green);   // x = -1.125
    EXPECT_EQ(image.at(8, 8), black);
}

}  // namespace
}  // namespace crevice
