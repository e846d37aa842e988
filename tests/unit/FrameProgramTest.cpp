// From a document to a plan: reads found in shaders, numbers and layouts read out of what was compiled.
#include <gmock/gmock.h>

#include "EffectTestTools.h"
#include "FrameTools.h"

namespace crevice {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

class FrameProgramTest : public testing::Test {
protected:
    /// Every compiled shader of a program.
    static std::vector<const EffectVariant*> variantsOf(const FrameProgram& program) {
        std::vector<const EffectVariant*> variants;
        for (const StageProgram& stage : program.stages()) {
            for (const DrawProgram& draw : stage.draws) variants.push_back(draw.variant);
            for (const QueueProgram& queue : stage.queues)
                for (const SurfaceProgram& surface : queue.surfaces)
                    if (surface.variant) variants.push_back(surface.variant);
        }
        return variants;
    }
    static const ShaderResource& resource(const EffectVariant& variant, const std::string& name) {
        const ShaderResource* found = variant.info.find(name);
        if (!found) throw Error("no resource " + name + " in " + variant.name);
        return *found;
    }
    static void expectMembers(const ShaderResource& block,
                              const std::vector<std::pair<std::string, std::uint32_t>>& members, std::uint32_t size) {
        EXPECT_EQ(block.size, size) << block.name;
        ASSERT_EQ(block.members.size(), members.size()) << block.name;
        for (std::size_t i = 0; i < members.size(); ++i) {
            EXPECT_EQ(block.members[i].name, members[i].first) << block.name;
            EXPECT_EQ(block.members[i].offset, members[i].second) << block.members[i].name;
        }
    }
    ProgramBench bench_;
};

TEST_F(FrameProgramTest, ReadsFollowTheShader) {
    ASSERT_TRUE(bench_.copyEffect("ssao-lighting", "unread", "texture(cc_ssaoBlurMap, uv).r", "1.0"));
    ASSERT_TRUE(bench_.copyEffect("ssao-lighting-article", "unread-article",
                                  "texture(cc_ssaoMap, uv + vec2(x - 2, y - 2) * tapStep).r", "1.0"));
    const auto lighting = [&](const std::string& form, const std::vector<StageSet>& sets) {
        auto program = bench_.load("ssao-deferred", {{"form", form}}, sets);
        program->prepare(nullptr);
        return readsOf(*program, "LightingStage");
    };
    EXPECT_THAT(lighting("default", {}), Contains("cc_ssaoBlurMap"));
    EXPECT_THAT(lighting("default", {{"LightingStage.effect", "unread"}}), Not(Contains("cc_ssaoBlurMap")));
    EXPECT_THAT(lighting("article", {}), Contains("cc_ssaoMap"));
    EXPECT_THAT(lighting("article", {{"LightingStage.effect", "unread-article"}}), Not(Contains("cc_ssaoMap")));
    // The other way round: one line in an effect is a read, and nobody wires it.
    ASSERT_TRUE(bench_.copyEffect("deferred-lighting", "reading",
                                  "void applyScreenOcclusion(inout Surface surface, vec2 uv) {",
                                  "uniform sampler2D cc_ssaoMap;\n  void applyScreenOcclusion(inout Surface surface, "
                                  "vec2 uv) {\n    surface.visibility *= texture(cc_ssaoMap, uv).r;"));
    const std::vector<StageSet> reading{{"LightingStage.effect", "reading"},
                                        {"LightingStage.defines.APPLY_TO", "null"}};
    EXPECT_THAT(lighting("article", reading), Contains("cc_ssaoMap"));
    // A declaration alone is no read.
    ASSERT_TRUE(bench_.copyEffect("deferred-lighting", "declaring", "void applyScreenOcclusion",
                                  "uniform sampler2D cc_ssaoMap;\n  void applyScreenOcclusion"));
    EXPECT_THAT(lighting("article", {{"LightingStage.effect", "declaring"}}), Not(Contains("cc_ssaoMap")));
}

TEST_F(FrameProgramTest, AReadMovesTheTransition) {
    auto program = bench_.load("ssao-deferred");
    program->prepare(nullptr);
    for (const PlannedStage& stage : program->plan().stages) {
        if (program->plan().uses[stage.use].stage != "LightingStage") continue;
        EXPECT_THAT(stage.before, Contains(Transition{"cc_ssaoBlurMap", TargetState::Color, TargetState::Sampled}));
    }
}

/// A sun and a spot light: what every shadow map is for.
void addShadowedLights(Scene& scene) {
    scene.lights.resize(2);
    scene.lights[1].type = LightType::Spot;
}

TEST_F(FrameProgramTest, ASceneBringsItsMaterialsReads) {
    auto program = bench_.load("deferred");
    program->prepare(nullptr);
    EXPECT_TRUE(readsOf(*program, "TransparentStage").empty());
    Scene scene = twoMaterials();
    program->prepare(&scene);
    EXPECT_TRUE(readsOf(*program, "TransparentStage").empty()) << "no light, no shadow";
    addShadowedLights(scene);
    program->prepare(&scene);
    EXPECT_THAT(readsOf(*program, "TransparentStage"), UnorderedElementsAre("cc_shadowMap", "cc_spotLightingMap"));
    EXPECT_TRUE(readsOf(*program, "GbufferStage").empty());
}

TEST_F(FrameProgramTest, TheNumbersOfTheContractStandInEveryShader) {
    const BindingMap contract = contractBindings();
    Scene scene = twoMaterials();
    addShadowedLights(scene);
    std::set<std::string> seen;
    for (const char* form : {"default", "article"}) {
        for (const char* bake : {"on", "off"}) {
            auto program = bench_.load("ssao-deferred", {{"form", form}}, {{"SsaoStage.params.bake", bake}});
            program->prepare(&scene);
            for (const auto& [name, slot] : contract) EXPECT_EQ(program->globals().bindings().at(name), slot) << name;
            for (const EffectVariant* variant : variantsOf(*program)) {
                for (const ShaderResource& resource : variant->info.resources) {
                    const auto known = contract.find(resource.name);
                    if (known == contract.end()) {
                        EXPECT_EQ(resource.slot.set, 1u) << variant->name << ' ' << resource.name;
                        continue;
                    }
                    seen.insert(resource.name);
                    EXPECT_EQ(resource.slot, known->second) << variant->name << ' ' << resource.name;
                }
            }
            const ShaderResource& kernel = resource(*stageOf(*program, "SsaoStage").draws[0].variant, "CCSsao");
            EXPECT_EQ(kernel.slot, (BindingSlot{0, 12})) << form << ' ' << bake;
            EXPECT_TRUE(kernel.active) << form << ' ' << bake;
        }
    }
    for (const char* name : {"CCGlobal", "CCCamera", "CCShadow", "cc_ssaoMap", "cc_ssaoBlurMap", "CCPunctualLights"})
        EXPECT_TRUE(seen.contains(name)) << name;
    EXPECT_FALSE(seen.contains("CCLocal"));  // shipped effects take instance attributes
}

TEST_F(FrameProgramTest, BlocksAreLaidOutAsCocosHasThem) {
    // Every member at its offset: profile 3.3.1.
    bench_.folder.write("effects/chunks/all-blocks.chunk",
                        "#include <cc-global>\n#include <cc-camera>\n#include <cc-shadow>\n#include <cc-local>\n"
                        "#include <ssao-constant>\n"
                        "layout(std140) uniform CCForwardLight {\n  vec4 cc_lightPos[10];\n  vec4 cc_lightColor[10];\n"
                        "  vec4 cc_lightSizeRangeAngle[10];\n  vec4 cc_lightDir[10];\n};\n");
    bench_.fragment("blocks", "#include <all-blocks>",
                    "result = cc_time + cc_cameraPos + cc_shadowColor + cc_lightingMapUVParam + ssao_samples[3] + "
                    "cc_lightDir[0];");
    auto program = bench_.load("ssao-deferred", {},
                               {{"LightingStage.effect", "blocks"}, {"LightingStage.defines.APPLY_TO", "null"}});
    const EffectVariant& variant = *stageOf(*program, "LightingStage").draws[0].variant;
    expectMembers(resource(variant, "CCGlobal"), {{"cc_time", 0}, {"cc_screenSize", 16}, {"cc_nativeSize", 32}}, 48);
    expectMembers(resource(variant, "CCCamera"),
                  {{"cc_matView", 0},
                   {"cc_matViewInv", 64},
                   {"cc_matProj", 128},
                   {"cc_matProjInv", 192},
                   {"cc_matViewProj", 256},
                   {"cc_matViewProjInv", 320},
                   {"cc_cameraPos", 384},
                   {"cc_screenScale", 400},
                   {"cc_exposure", 416},
                   {"cc_mainLitDir", 432},
                   {"cc_mainLitColor", 448},
                   {"cc_ambientSky", 464},
                   {"cc_ambientGround", 480},
                   {"cc_fogColor", 496},
                   {"cc_fogBase", 512},
                   {"cc_fogAdd", 528}},
                  544);
    expectMembers(resource(variant, "CCShadow"),
                  {{"cc_matLightPlaneProj", 0},
                   {"cc_matLightView", 64},
                   {"cc_matLightViewProj", 128},
                   {"cc_shadowInvProjDepthInfo", 192},
                   {"cc_shadowProjDepthInfo", 208},
                   {"cc_shadowProjInfo", 224},
                   {"cc_shadowNFLSInfo", 240},
                   {"cc_shadowWHPBInfo", 256},
                   {"cc_shadowLPNNInfo", 272},
                   {"cc_shadowColor", 288}},
                  304);
    expectMembers(resource(variant, "CCLocal"),
                  {{"cc_matWorld", 0}, {"cc_matWorldIT", 64}, {"cc_lightingMapUVParam", 128}}, 144);
    expectMembers(resource(variant, "CCForwardLight"),
                  {{"cc_lightPos", 0}, {"cc_lightColor", 160}, {"cc_lightSizeRangeAngle", 320}, {"cc_lightDir", 480}},
                  64 * 10);
    expectMembers(resource(variant, "CCSsao"), {{"cc_cameraNFLSInfo", 0}, {"ssao_samples", 16}}, 1040);
    EXPECT_EQ(resource(variant, "CCSsao").members[1].arrayCount, 64u);
    EXPECT_EQ(resource(variant, "CCLocal").slot, (BindingSlot{2, 0}));
    EXPECT_EQ(resource(variant, "CCForwardLight").slot, (BindingSlot{2, 1}));
}

TEST_F(FrameProgramTest, OptionsChangeNoNumber) {
    const auto numbers = [&](std::map<std::string, std::string> options) {
        return bench_.load("ssao-deferred", std::move(options))->globals().bindings();
    };
    const BindingMap all = numbers({});
    EXPECT_EQ(numbers({{"ssao", "false"}}), all);
    EXPECT_EQ(numbers({{"shadows", "false"}, {"fxaa", "false"}}), all);
    EXPECT_EQ(numbers({{"form", "article"}}), all);
    // A child keeps the numbers of its parent.
    const auto parent = bench_.load("deferred");
    for (const auto& [name, slot] : parent->globals().bindings()) EXPECT_EQ(all.at(name), slot) << name;
}

constexpr const char* kHead = R"({ "name": "t", "output": "out", "targets": { "out": { "format": "RGBA8" }, )";

TEST_F(FrameProgramTest, AStageThatSamplesWhatItWritesIsRefused) {
    const std::vector<Problem> problems = bench_.problemsOf(std::string(kHead) + R"("a": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "A", "effect": "copy", "reads": { "inputMap": "out" }, "writes": ["out"] }
      ] } ] })");
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].message, "'A' reads and writes 'out'");
}

TEST_F(FrameProgramTest, AStageThatSamplesBeforeTheFirstWriteIsRefused) {
    const std::vector<Problem> problems = bench_.problemsOf(std::string(kHead) + R"("a": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "a" }, "writes": ["out"] },
        { "stage": "FullscreenStage", "name": "Fill", "effect": "copy", "reads": { "inputMap": "out" }, "writes": ["a"] }
      ] } ] })");
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].message, "'Show' reads 'a' before 'Fill' writes it");
    EXPECT_THAT(problems[0].help, HasSubstr("place 'Fill' before 'Show'"));
}

TEST_F(FrameProgramTest, AllMistakesComeInOneRun) {
    bench_.fragment("plain", "", "result = vec4(1.0);");
    const std::vector<Problem> problems = bench_.problemsOf(std::string(kHead) + R"("a": { "format": "RGBA8" } },
      "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "A", "effect": "plain", "material": { "strength": 1 }, "writes": ["a"] },
        { "stage": "FullscreenStage", "name": "B", "effect": "plain", "reads": { "nothing": "a" }, "writes": ["out"] },
        { "stage": "ComputeStage", "name": "C", "effect": "plain", "writes": ["out"] }
      ] } ] })");
    std::vector<std::string> messages;
    for (const Problem& problem : problems) messages.push_back(problem.message);
    EXPECT_THAT(messages, Contains(HasSubstr("strength")));
    EXPECT_THAT(messages, Contains(HasSubstr("'reads' of stage 'B' names 'nothing'")));
    EXPECT_THAT(messages, Contains("effect 'plain' of stage 'C' has no compute program"));
}

/// A stage whose block is smaller than the effect's.
class ShortBlock final : public RenderStage {
public:
    void declare(StageIo& io) override {
        io.color("out");
        io.block<glm::vec4>("CCMine");
        io.fullscreen("mine");
    }
    void render(FrameContext&) override {}
};

TEST_F(FrameProgramTest, ABlockOfAnotherSizeNamesBothPlaces) {
    bench_.registry.add<ShortBlock>("ShortBlock", {.priority = {}, .help = "t"});
    bench_.fragment("mine", "uniform CCMine { vec4 one; vec4 two; };", "result = one + two;");
    const std::vector<Problem> problems =
        bench_.problemsOf(std::string(kHead) + R"("a": { "format": "RGBA8" } }, "flows": [ { "flow": "F", "stages": [
        { "stage": "ShortBlock" } ] } ] })");
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].message, "block 'CCMine' has 32 bytes in effect 'mine' and 16 bytes in the pipeline");
    EXPECT_THAT(problems[0].where.file, HasSubstr("mine.effect"));
    ASSERT_EQ(problems[0].remarks.size(), 1u);
    EXPECT_EQ(problems[0].remarks[0].where.file, "test.json");
}

TEST_F(FrameProgramTest, ReadsListedByHandAreChecked) {
    const auto listing = [](const char* reads) {
        return std::string(kHead) + R"("a": { "format": "RGBA8" } }, "flows": [ { "flow": "F", "stages": [
        { "stage": "FullscreenStage", "name": "Fill", "effect": "white", "writes": ["a"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "reader", "reads": )" +
               reads + R"(, "writes": ["out"] } ] } ] })";
    };
    bench_.fragment("white", "", "result = vec4(1.0);");
    bench_.fragment("reader", "uniform sampler2D a;", "result = texture(a, v_uv);");
    EXPECT_TRUE(bench_.problemsOf(listing(R"(["a"])")).empty());
    bench_.fragment("reader", "uniform sampler2D a;", "result = vec4(0.5);");
    ProgramBench fresh;  // effects are read once
    fresh.fragment("white", "", "result = vec4(1.0);");
    fresh.fragment("reader", "uniform sampler2D a;", "result = vec4(0.5);");
    const std::vector<Problem> problems = fresh.problemsOf(listing(R"(["a"])"));
    ASSERT_FALSE(problems.empty());
    EXPECT_EQ(problems[0].message, "stage 'Show' lists 'a' in 'reads', and its shaders do not read it");
}

}  // namespace
}  // namespace crevice
