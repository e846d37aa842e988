// What uniforms hold that a material does or does not set (cocos-formats 3.2, steps 4 to 6).
#include <cstring>

#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "effect/Material.h"

namespace crevice::cocos {
namespace {

class CocosUniforms : public testing::Test {
protected:
    void effect(const std::string& members, const std::string& properties, const std::string& use) {
        bench.effect("void main() { gl_Position = vec4(0.0); }\n",
                     "layout(location = 0) out vec4 color;\nuniform Constants {\n" + members +
                         "};\nvoid main() { color = " + use + "; }\n",
                     "", "      properties:\n" + properties);
        keepCompilerWarm();
        material.reset();
        library.emplace(AssetRoots({bench.folder.path() / "none"}), Log(LogLevel::Error),
                        EffectLibrary::Options{.useDiskCache = false});
        library->addFrontEnd(std::make_unique<CocosEffects>(bench.roots()));
        VariantRequest request;
        request.effect = "t";
        material.emplace(library->get(request, {}), Material::LinearRule::AsGiven);
    }
    void set(const std::string& json) {
        Problems problems;
        material->apply(parseJson(json, "m"), problems);
        problems.throwIfErrors();
    }
    float at(std::size_t index) const {
        float value = 0;
        std::memcpy(&value, material->blocks().at(0).bytes.data() + index * sizeof(float), sizeof value);
        return value;
    }
    std::vector<float> from(std::size_t first, std::size_t count) const {
        std::vector<float> values;
        for (std::size_t i = 0; i < count; ++i) values.push_back(at(first + i));
        return values;
    }

    CocosBench bench;
    std::optional<EffectLibrary> library;  // owns what the material refers to
    std::optional<Material> material;
};

TEST_F(CocosUniforms, MatricesAreIdentitiesOthersZeroes) {
    effect("  vec4 a; mat4 m; mat4 n[2];\n", "        b: { value: 1 }\n", "m * a + n[1] * a");
    EXPECT_EQ(from(0, 4), (std::vector<float>{0, 0, 0, 0}));
    for (std::size_t matrix = 0; matrix < 3; ++matrix)
        for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(at(4 + 16 * matrix + i), i % 5 == 0 ? 1.0f : 0.0f) << matrix;
}

TEST_F(CocosUniforms, PartsOfAVectorAreSetApart) {
    effect("  vec4 params; vec4 tiling;\n",
           "        roughness: { value: 0.8, target: params.y }\n        metallic: { value: 0.6, target: params.z }\n"
           "        offset: { value: [5, 6], target: tiling.zw }\n",
           "params + tiling");
    EXPECT_EQ(from(0, 8), (std::vector<float>{0, 0.8f, 0.6f, 0, 0, 0, 5, 6}));
    set(R"({ "metallic": 0.25, "offset": [1, 2] })");
    EXPECT_EQ(from(0, 8), (std::vector<float>{0, 0.8f, 0.25f, 0, 0, 0, 1, 2}));
}

TEST_F(CocosUniforms, ArraysTakeADefaultEverywhereAndValuesInOrder) {
    effect("  vec4 weights[3];\n", "        weights: { value: [1, 2, 3, 4] }\n", "weights[0] + weights[2]");
    EXPECT_EQ(from(0, 12), (std::vector<float>{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4}));
    set(R"({ "weights": [5, 6, 7, 8, 9, 10, 11, 12] })");
    EXPECT_EQ(from(0, 12), (std::vector<float>{5, 6, 7, 8, 9, 10, 11, 12, 1, 2, 3, 4}));
    set(R"({ "weights": [0,0,0,0, 0,0,0,0, 0,0,0,0, 7,7,7,7] })");  // more than there are
    EXPECT_EQ(from(0, 12), std::vector<float>(12, 0.0f));
}

TEST_F(CocosUniforms, WhatDoesNotFitIsCutOffAndTooLittleAnError) {
    effect("  vec4 tint; float strength;\n", "        tint: { value: [1, 1, 1, 1] }\n        strength: { value: 1 }\n",
           "tint * strength");
    set(R"({ "strength": [0.5, 9] })");
    EXPECT_EQ(from(0, 5), (std::vector<float>{1, 1, 1, 1, 0.5f}));
    EXPECT_THROW(set(R"({ "tint": [1, 2] })"), Error);
}

TEST_F(CocosUniforms, DefaultsAndValuesAreTakenAsTheyAre) {
    effect("  vec4 tint;\n", "        tint: { value: [0.5, 0.25, 1, 0.5], linear: true }\n", "tint");
    EXPECT_EQ(from(0, 4), (std::vector<float>{0.5f, 0.25f, 1, 0.5f}));  // squaring is the runtime's, of materials
}

}  // namespace
}  // namespace crevice::cocos
