// Packed texels: what goes in comes out, within the steps that the chunk names; both projections.
#include "AoDenoiseFixture.h"

namespace crevice {
namespace {

/// The G-buffer and one full-screen effect.
std::string document(const std::string& effect) {
    return R"({ "extends": "ao-only", "output": "made",
  "targets": { "made": { "format": "RGBA32F" } },
  "edits": [ { "remove": "SsaoStage" }, { "remove": "SsaoBlurX" }, { "remove": "SsaoBlurY" }, { "remove": "DebugView" },
    { "insert": { "flow": "TestFlow", "stages": [
      { "stage": "FullscreenStage", "name": "Make", "effect": ")" +
           effect + R"(", "writes": ["made"] } ] }, "after": "GbufferFlow" } ] })";
}

class AoDenoisePack : public AoDenoiseTest {
protected:
    /// `expression` of PackedAo p and float depth, for depths from 1e-6 (left) to 1e9 (right) and openness 0 (top)
    /// to 1.
    Image packed(bool orthographic, const std::string& weight, const std::string& expression) {
        const std::string effect = newName();
        writeFragment(effect, "  #include <ao-packed>",
                      "    vec2 t = (gl_FragCoord.xy - 0.5) * vec2(1.0 / 255.0, 1.0 / 255.0);\n"
                      "    float depth = pow(10.0, mix(-6.0, 9.0, t.x));\n"
                      "    PackedAo p = unpackAo(packAo(t.y, " +
                          weight + ", depth));\n    result = " + expression + ";",
                      "vec4");
        loadDocument(document(effect));
        renderer_->setScene(emptyScene());
        return target(viewOf(tiltCamera(0, orthographic), 256, 256), "made");
    }
};

TEST_F(AoDenoisePack, KeepsOpennessWeightAndDepth) {
    for (const bool orthographic : {false, true}) {
        const Image image = packed(orthographic, "1.0", "vec4(p.openness, p.weight, p.depth, depth)");
        for (std::uint32_t y = 0; y < 256; ++y) {
            for (std::uint32_t x = 0; x < 256; ++x) {
                const glm::vec4 p = image.at(x, y);
                ASSERT_NEAR(p.x, static_cast<float>(y) / 255, 1e-6f);
                ASSERT_NEAR(p.y, 1, 0.5 * 2.5 / 31 + 1e-6);
                ASSERT_NEAR(p.z / p.w, 1, 1.0 / 8192) << "depth " << p.w;
            }
        }
        EXPECT_LT(image.at(0, 0).w, 1.01e-6f);
        EXPECT_GT(image.at(255, 0).w, 0.99e9f);
    }
}

TEST_F(AoDenoisePack, DepthHasNoBias) {
    const Image image = packed(false, "1.0", "vec4(p.depth / depth - 1.0)");
    double sum = 0;
    for (std::uint32_t x = 0; x < 256; ++x) sum += image.at(x, 0).x;
    EXPECT_NEAR(sum / 256, 0, 1e-5);
}

TEST_F(AoDenoisePack, EveryWeightIsKeptAndNoneIsNothing) {
    const Image image = packed(false, "t.y * 2.5", "vec4(p.weight, t.y * 2.5, 0.0, 0.0)");
    for (std::uint32_t y = 0; y < 256; ++y) {
        const glm::vec4 p = image.at(7, y);
        EXPECT_GT(p.x, 0);
        EXPECT_NEAR(p.x, std::max(p.y, 2.5f / 31), 0.5 * 2.5 / 31 + 1e-6);
    }
}

TEST_F(AoDenoisePack, ClampsWhatDoesNotFit) {
    const std::string all = "1.0";
    const Image image = packed(false, all,
                               "vec4(packedOpenness(packAo(-0.5, 1.0, 1.0)), packedOpenness(packAo(1.5, 1.0, 1.0)), "
                               "packedWeight(packAo(0.5, 100.0, 1.0)), packedWeight(0u))");
    const glm::vec4 p = image.at(3, 3);
    EXPECT_EQ(p.x, 0);
    EXPECT_EQ(p.y, 1);
    EXPECT_NEAR(p.z, 2.5, 1e-6);
    EXPECT_EQ(p.w, 0) << "what is read beside the image counts";
    const Image depths =
        packed(false, all,
               "vec4(packedDepth(packAo(0.5, 1.0, 1e-20)), packedDepth(packAo(0.5, 1.0, 1e30)), "
               "packedIsSky(packAo(0.5, 1.0, 1e9)) ? 1.0 : 0.0, packedIsSky(packAo(0.5, 1.0, 1e8)) ? 1.0 : 0.0)");
    EXPECT_NEAR(depths.at(3, 3).x * 4.2e9, 1, 1e-3);
    EXPECT_NEAR(depths.at(3, 3).y / 4.294967e9, 1, 1e-3);
    EXPECT_EQ(depths.at(3, 3).z, 1);
    EXPECT_EQ(depths.at(3, 3).w, 0);
}

}  // namespace
}  // namespace crevice
