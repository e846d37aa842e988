// Subpass inputs: what a tiler reads from its tile is read here from the image, at the same pixel.
#include "CocosRuntimeFixture.h"

namespace crevice {
namespace {

using testing::HasSubstr;

class CocosSubpass : public CocosRuntime {
protected:
    /// A pattern that differs from pixel to pixel, then `reader` of it.
    void loadReader(const std::string& fragment, const std::string& more = {}) {
        writeFullscreen("pattern", "  vec4 frag () { return vec4(gl_FragCoord.xy / 255.0, 0.25, 1.0); }\n");
        writeFullscreen("reader", fragment);
        renderer_->effects().addFrontEnd(std::make_unique<cocos::CocosEffects>(
            cocos::Roots{.chunks = {}, .project = folder_ / "project", .engine = {}}));
        loadDocument(
            R"({"profile": "cocos-3.6", "output": "finalColor", "targets": {"finalColor": {"format": "RGBA8"}, )"
            R"("pattern": {"format": "RGBA8"}}, )" +
            more +
            R"("flows": [{"flow": "Main", "stages": [{"stage": "FullscreenStage", "name": "First", "effect": "pattern", )"
            R"("writes": ["pattern"]}, {"stage": "FullscreenStage", "effect": "reader", "writes": ["finalColor"], )"
            R"("reads": {"tile": "pattern"}}]}]})");
        renderer_->setScene(darkScene());
    }
    void expectPattern() {
        const Image image = renderer_->render(sized(16, 8));
        for (std::uint32_t y = 0; y < 8; ++y) {
            for (std::uint32_t x = 0; x < 16; ++x) {
                const glm::vec4 texel = image.at(x, y) * 255.0f;
                EXPECT_NEAR(texel.x, float(x) + 0.5f, 0.6f) << x << ' ' << y;
                EXPECT_NEAR(texel.y, float(y) + 0.5f, 0.6f) << x << ' ' << y;
                EXPECT_NEAR(texel.z, 0, 0.1f) << x << ' ' << y;  // the reader takes the blue away
            }
        }
    }
};

TEST_F(CocosSubpass, InputsAreReadAtTheirPixel) {
    loadReader(
        "  layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput tile;\n"
        "  vec4 frag () { return subpassLoad(tile) * vec4(1.0, 1.0, v_uv.x * 0.0, 1.0); }\n");
    expectPattern();
}

TEST_F(CocosSubpass, InputsOfPragmasToo) {
    loadReader(
        "  #pragma subpassColor in tile\n"
        "  vec4 frag () { return subpassLoad(tile) * vec4(1.0, 1.0, v_uv.x * 0.0, 1.0); }\n");
    expectPattern();
}

TEST_F(CocosSubpass, FunctionsTakeInputs) {
    loadReader(
        "  layout(input_attachment_index = 0) uniform highp subpassInput tile;\n"
        "  vec4 read(subpassInput from) { return subpassLoad(from); }\n"
        "  vec4 frag () { return read(tile) * vec4(1.0, 1.0, v_uv.x * 0.0, 1.0); }\n");
    expectPattern();
}

TEST_F(CocosSubpass, TheDocumentsMacroTurnsTheBranchForTilersOn) {
    const std::string both =
        "  #if CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT\n"
        "  layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput tile;\n"
        "  vec4 frag () { return vec4(subpassLoad(tile).xy, 0.0 * v_uv.x, 1.0); }\n"
        "  #else\n  layout(binding = 0) uniform sampler2D tile;\n"
        "  vec4 frag () { return vec4(1.0, texture(tile, v_uv).yz, 1.0); }\n  #endif\n";
    loadReader(both);
    EXPECT_EQ(renderer_->render(sized(16, 8)).at(3, 3).x, 1.0f);
    loadReader(both, R"("macros": {"CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT": true}, )");
    expectPattern();
}

TEST_F(CocosSubpass, OnesOfSeveralSamplesAreAnError) {
    try {
        loadReader(
            "  layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInputMS tile;\n"
            "  vec4 frag () { return subpassLoad(tile, 0) + vec4(v_uv, 0.0, 0.0); }\n");
        renderer_->render(sized(4, 4));
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("'tile' is a subpass input"));
    }
}

/// The engine's own lighting has both branches from 3.4 on: they draw the same picture.
TEST_F(CocosSubpass, DeferredLightingOfTilersIsThatOfDesktops) {
    const auto pictureWith = [&](const char* profile) {
        renderer_ = makeRenderer();
        loadArticle("article-v36", {{"LightingStage.effect", "pipeline/deferred-lighting"}},
                    "\"profile\": \"cocos-3.6\"", profile);
        renderer_->setScene(withEffects(cloister()));
        const Image picture = renderer_->render(sized(128, 64));
        takeWarnings();
        return picture;
    };
    const Image desktop = pictureWith("\"profile\": \"cocos-3.6\"");
    const Image tiler =
        pictureWith(R"("profile": "cocos-3.6", "macros": { "CC_DEVICE_CAN_BENEFIT_FROM_INPUT_ATTACHMENT": true })");
    EXPECT_EQ(desktop, tiler);
    EXPECT_GT(desktop.at(64, 40).x, 0.05f);
}

}  // namespace
}  // namespace crevice
