// Every word and number of Cocos' header tables (cocos-formats 1.2, 1.3), written down one by one.
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/reflection/Reflection.h"

namespace crevice::cocos {
namespace {

/// The state of a pass with these lines, 6 spaces deep.
RenderState stateOf(const std::string& lines) {
    CocosBench bench;
    bench.folder.write("p/assets/effects/t.effect",
                       "CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n" + lines + "}%\n");
    Problems problems;
    const EffectAsset asset = bench.parse(problems);
    problems.throwIfErrors();
    return asset.techniques.at(0).passes.at(0).state;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// A word, in capitals too, and its number give the same.
template <class Read>
void expectWords(const std::vector<std::string>& words, Read read) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        EXPECT_EQ(int(read(words[i])), int(i)) << words[i];
        EXPECT_EQ(int(read(upper(words[i]))), int(i)) << upper(words[i]);
        EXPECT_EQ(int(read(std::to_string(i))), int(i)) << i;
    }
}

TEST(CocosWords, ComparisonsStencilOperationsFactorsAndCulling) {
    expectWords({"never", "less", "equal", "less_equal", "greater", "not_equal", "greater_equal", "always"},
                [](const std::string& word) {
                    return stateOf("      depthStencilState: { depthFunc: " + word + " }\n").depthFunc;
                });
    expectWords(
        {"zero", "keep", "replace", "incr", "decr", "invert", "incr_wrap", "decr_wrap"}, [](const std::string& word) {
            return stateOf("      depthStencilState: { stencilZFailOpBack: " + word + " }\n").stencilBack.zFailOp;
        });
    expectWords({"zero", "one", "src_alpha", "dst_alpha", "one_minus_src_alpha", "one_minus_dst_alpha", "src_color",
                 "dst_color", "one_minus_src_color", "one_minus_dst_color", "src_alpha_saturate", "constant_color",
                 "one_minus_constant_color", "constant_alpha", "one_minus_constant_alpha"},
                [](const std::string& word) {
                    return stateOf("      blendState: { targets: [ { blendDstAlpha: " + word + " } ] }\n")
                        .blendTargets.at(0)
                        .dstAlpha;
                });
    expectWords({"add", "sub", "rev_sub", "min", "max"}, [](const std::string& word) {
        return stateOf("      blendState: { targets: [ { blendAlphaEq: " + word + " } ] }\n")
            .blendTargets.at(0)
            .alphaOp;
    });
    expectWords({"none", "front", "back"}, [](const std::string& word) {
        return stateOf("      rasterizerState: { cullMode: " + word + " }\n").cullMode;
    });
}

TEST(CocosWords, BlendTargetsHaveTheEnginesDefaults) {
    const BlendTarget target = stateOf("      blendState: { targets: [ {} ] }\n").blendTargets.at(0);
    EXPECT_FALSE(target.blend);
    EXPECT_EQ(target.src, BlendFactor::One);
    EXPECT_EQ(target.dst, BlendFactor::Zero);
    EXPECT_EQ(target.op, BlendOp::Add);
    EXPECT_EQ(target.srcAlpha, BlendFactor::One);
    EXPECT_EQ(target.dstAlpha, BlendFactor::Zero);
    EXPECT_EQ(target.alphaOp, BlendOp::Add);
    EXPECT_EQ(target.colorMask, 15);
}

TEST(CocosWords, ColourMasksAreSumsOrLetters) {
    const std::pair<const char*, int> cases[] = {{"none", 0}, {"r", 1}, {"g", 2},    {"b", 4},    {"a", 8},
                                                 {"all", 15}, {"5", 5}, {"0xf", 15}, {"\"a\"", 8}};
    for (const auto& [word, mask] : cases) {
        const RenderState state =
            stateOf("      blendState: { targets: [ { blendColorMask: " + std::string(word) + " } ] }\n");
        EXPECT_EQ(state.blendTargets.at(0).colorMask, mask) << word;
    }
}

TEST(CocosWords, PrimitivesThatAreDrawn) {
    const std::pair<const char*, Topology> cases[] = {
        {"point_list", Topology::PointList},         {"line_list", Topology::LineList},
        {"LINE_STRIP", Topology::LineStrip},         {"triangle_list", Topology::TriangleList},
        {"triangle_strip", Topology::TriangleStrip}, {"Triangle_Fan", Topology::TriangleFan}};
    for (const auto& [word, topology] : cases)
        EXPECT_EQ(stateOf("      primitive: " + std::string(word) + "\n").topology, topology) << word;
    for (const char* other : {"line_loop", "line_list_adjacency", "quad_patch_list"})
        EXPECT_EQ(stateOf("      primitive: " + std::string(other) + "\n").topology, Topology::TriangleList) << other;
}

/// A place in the list of names is the number.
TEST(CocosWords, PrimitivesMayBeNumbers) {
    EXPECT_EQ(stateOf("      primitive: 0\n").topology, Topology::PointList);
    EXPECT_EQ(stateOf("      primitive: 1\n").topology, Topology::LineList);
    EXPECT_EQ(stateOf("      primitive: 2\n").topology, Topology::LineStrip);
    EXPECT_EQ(stateOf("      primitive: 3\n").topology, Topology::TriangleList);  // line_loop is not drawn
    EXPECT_EQ(stateOf("      primitive: 7\n").topology, Topology::TriangleList);
    EXPECT_EQ(stateOf("      primitive: 8\n").topology, Topology::TriangleStrip);
    EXPECT_EQ(stateOf("      primitive: 9\n").topology, Topology::TriangleFan);
    EXPECT_EQ(stateOf("      primitive: 13\n").topology, Topology::TriangleList);
    EXPECT_THROW(stateOf("      primitive: 14\n"), Error);
    EXPECT_THROW(stateOf("      primitive: -1\n"), Error);
    EXPECT_THROW(stateOf("      primitive: 1.5\n"), Error);
}

TEST(CocosWords, NumbersBeyondATableAreErrors) {
    EXPECT_THROW(stateOf("      depthStencilState: { depthFunc: 8 }\n"), Error);
    EXPECT_THROW(stateOf("      rasterizerState: { cullMode: -1 }\n"), Error);
    EXPECT_THROW(stateOf("      blendState: { targets: [ { blendSrc: 1.5 } ] }\n"), Error);
    EXPECT_THROW(stateOf("      primitive: hexagon\n"), Error);
}

/// min | mag << 2 | mip << 4 | u << 6 | v << 8 | w << 10 | anisotropy << 12: filters none 0 … anisotropic 3, addresses
/// wrap 0, mirror 1, clamp 2, border 3. Defaults: linear, linear, none, wrap. The engine takes 0 for "not given".
TEST(CocosWords, SamplerWords) {
    const int base = 2 + (2 << 2);
    const auto hash = [](const std::string& words) { return samplerHash(parseYaml("{ " + words + " }", "w")); };
    const int anisotropy = int(hash("")) - base;
    EXPECT_EQ(hash("minFilter: none"), base + anisotropy);
    EXPECT_EQ(hash("minFilter: Point"), base - 1 + anisotropy);
    EXPECT_EQ(hash("magFilter: anisotropic"), base + (1 << 2) + anisotropy);
    EXPECT_EQ(hash("mipFilter: linear"), base + (2 << 4) + anisotropy);
    EXPECT_EQ(hash("addressU: mirror"), base + (1 << 6) + anisotropy);
    EXPECT_EQ(hash("addressV: clamp"), base + (2 << 8) + anisotropy);
    EXPECT_EQ(hash("addressW: BORDER"), base + (3 << 10) + anisotropy);
    EXPECT_EQ(hash("maxAnisotropy: 4"), base + (4 << 12));
}

}  // namespace
}  // namespace crevice::cocos
