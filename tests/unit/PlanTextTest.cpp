// The table and the drawing of a plan, as text; and how large targets are.
#include <gtest/gtest.h>

#include "plan/FramePlan.h"
#include "plan/GlobalNames.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

void addTarget(PipelineDesc& desc, const char* name, Format format) {
    TargetDesc target;
    target.name = name;
    target.format = format;
    desc.targets.push_back(target);
}

StageUse stage(const char* name, std::vector<const char*> colors, std::vector<const char*> reads) {
    StageUse use;
    use.stage = name;
    use.flow = "Flow";
    for (const char* target : colors) use.writes.push_back({target, WriteKind::Color, false, 0, {}});
    for (const char* target : reads) use.reads.push_back({target, false, 0, target, {}});
    return use;
}

/// ssao-deferred as the architecture's example draws it.
PipelineDesc ssaoDeferred() {
    PipelineDesc desc;
    for (const char* name :
         {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "cc_gbuffer_emissiveMap"}) {
        addTarget(desc, name, Format::RGBA16F);
    }
    addTarget(desc, "cc_lighting_resultMap", Format::RGBA16F);
    addTarget(desc, "depth", Format::D32F);
    addTarget(desc, "finalColor", Format::RGBA8);
    addTarget(desc, "cc_ssaoMap", Format::R8);
    desc.output = "finalColor";
    return desc;
}

std::vector<StageUse> ssaoDeferredUses() {
    std::vector<StageUse> uses{
        stage("GbufferStage",
              {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "cc_gbuffer_emissiveMap"}, {}),
        stage("SsaoStage", {"cc_ssaoMap"}, {"cc_gbuffer_positionMap", "cc_gbuffer_normalMap"}),
        stage("LightingStage", {"cc_lighting_resultMap"},
              {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "cc_gbuffer_emissiveMap",
               "cc_ssaoMap"}),
        stage("PostProcessStage", {"finalColor"}, {"cc_lighting_resultMap"})};
    uses[0].writes.push_back({"depth", WriteKind::DepthWrite, false, 0, {}});
    return uses;
}

BindingMap bindingsOf(const PipelineDesc& desc) {
    GlobalNames names;
    for (const TargetDesc& target : desc.targets) names.addTarget(target.name, target.binding, target.where);
    return names.freeze().bindings();
}

TEST(PlanText, TheTableOfTheArchitecture) {
    const PipelineDesc desc = ssaoDeferred();
    const BindingMap bindings = bindingsOf(desc);
    EXPECT_EQ("\n" + planTable(planFrame(desc, ssaoDeferredUses()), desc, 1280, 720, &bindings), R"(
 # stage             writes                             reads                      transitions before
 1 GbufferStage      cc_gbuffer_albedoMap C,            –                          cc_gbuffer_albedoMap, cc_gbuffer_positionMap,
                     cc_gbuffer_positionMap C,                                     cc_gbuffer_normalMap, cc_gbuffer_emissiveMap
                     cc_gbuffer_normalMap C,                                       undefined→color; depth undefined→depth
                     cc_gbuffer_emissiveMap C, depth C
 2 SsaoStage         cc_ssaoMap C                       cc_gbuffer_positionMap 7,  cc_gbuffer_positionMap, cc_gbuffer_normalMap color→sampled;
                                                        cc_gbuffer_normalMap 8     cc_ssaoMap undefined→color
 3 LightingStage     cc_lighting_resultMap C            cc_gbuffer_albedoMap 6,    cc_gbuffer_albedoMap, cc_gbuffer_emissiveMap, cc_ssaoMap
                                                        cc_gbuffer_positionMap 7,  color→sampled; cc_lighting_resultMap undefined→color
                                                        cc_gbuffer_normalMap 8,
                                                        cc_gbuffer_emissiveMap 9,
                                                        cc_ssaoMap 11
 4 PostProcessStage  finalColor C                       cc_lighting_resultMap 10   cc_lighting_resultMap color→sampled; finalColor
                                                                                   undefined→color
   (readback)        –                                  finalColor                 finalColor color→transfer-source
 C = first write this frame, clears.  Memory 1280×720: 43.1 MiB.  Unused: –
)");
}

TEST(PlanText, TheTableSaysWhatIsOffAndHoldsItsClearValue) {
    PipelineDesc desc = ssaoDeferred();
    addTarget(desc, "spare", Format::RGBA8);
    std::vector<StageUse> uses = ssaoDeferredUses();
    uses[1].enabled = false;
    StageUse sky = stage("SkyboxStage", {"cc_lighting_resultMap"}, {});
    sky.writes.push_back({"depth", WriteKind::DepthTest, false, 0, {}});
    uses.insert(uses.begin() + 3, sky);
    const std::string table = planTable(planFrame(desc, uses), desc, 640, 360);
    EXPECT_NE(table.find(" 3 SkyboxStage       cc_lighting_resultMap L, depth T"), std::string::npos) << table;
    EXPECT_NE(table.find("cc_lighting_resultMap color→color; depth\n"), std::string::npos) << table;
    EXPECT_NE(table.find(" depth→depth-read-only\n"), std::string::npos) << table;
    EXPECT_NE(
        table.find(" C = first write this frame, clears.  L = keeps what is there.  T = only tested against.  "
                   "Memory 640×360: 11.6 MiB.  Unused: spare\n Never written, holding the clear value: cc_ssaoMap\n"
                   " Disabled: SsaoStage\n"),
        std::string::npos)
        << table;
}

TEST(PlanText, TheDrawingHasEveryStageTargetAndWire) {
    std::vector<StageUse> uses = ssaoDeferredUses();
    uses[1].enabled = false;
    const std::string dot = planDot(planFrame(ssaoDeferred(), uses));
    EXPECT_TRUE(dot.starts_with("digraph plan {\n"));
    EXPECT_TRUE(dot.ends_with("}\n"));
    for (const char* line :
         {"\"stage SsaoStage\" [label=\"SsaoStage\", shape=box, style=dashed, color=gray, fontcolor=gray];",
          "\"stage LightingStage\" [label=\"2 LightingStage\", shape=box];",
          "\"target cc_ssaoMap\" [label=\"cc_ssaoMap\", shape=ellipse, style=dotted];",
          "\"target finalColor\" [label=\"finalColor\", shape=ellipse, peripheries=2];",
          "\"target cc_ssaoMap\" -> \"stage LightingStage\";",
          "\"stage GbufferStage\" -> \"target depth\" [label=\"clear\"];"}) {
        EXPECT_NE(dot.find(std::string("  ") + line + "\n"), std::string::npos) << line << "\n" << dot;
    }
    EXPECT_EQ(dot.find("-> \"stage SsaoStage\""), std::string::npos);
}

TEST(PlanText, TheDrawingEscapesNames) {
    PipelineDesc desc;
    addTarget(desc, "a\"b", Format::RGBA8);
    desc.output = "a\"b";
    const std::string dot = planDot(planFrame(desc, {stage("Say \\ it", {"a\"b"}, {})}));
    EXPECT_NE(dot.find("\"stage Say \\\\ it\" -> \"target a\\\"b\""), std::string::npos) << dot;
}

TEST(TargetSize, ScaledSizesCoverOddFrames) {
    TargetDesc target;
    target.scale = 0.5f;
    EXPECT_EQ(targetExtent(target, 333, 777), glm::uvec3(167, 389, 1));
    EXPECT_EQ(targetExtent(target, 1280, 720), glm::uvec3(640, 360, 1));
    EXPECT_EQ(targetExtent(target, 1, 1), glm::uvec3(1, 1, 1));
    target.scale = 0.1f;  // 0.1f × 1280 is a little more than 128
    EXPECT_EQ(targetExtent(target, 1280, 16000), glm::uvec3(128, 1600, 1));
    target.scale = 2.0f;
    EXPECT_EQ(targetExtent(target, 1280, 720), glm::uvec3(2560, 1440, 1));
}

TEST(TargetSize, LevelsHalveDownToOne) {
    TargetDesc target;
    target.size = glm::uvec2(100, 7);
    target.layers = 4;
    EXPECT_EQ(targetExtent(target, 1280, 720), glm::uvec3(100, 7, 4));
    EXPECT_EQ(targetExtent(target, 1280, 720, 1), glm::uvec3(50, 3, 4));
    EXPECT_EQ(targetExtent(target, 1280, 720, 3), glm::uvec3(12, 1, 4));
    EXPECT_EQ(targetExtent(target, 1280, 720, 40), glm::uvec3(1, 1, 4));
}

TEST(TargetSize, BytesCountLevelsAndLayers) {
    TargetDesc target;
    target.format = Format::RGBA16F;
    target.size = glm::uvec2(4, 4);
    target.mips = 3;
    target.layers = 2;
    EXPECT_EQ(targetBytes(target, 1280, 720), 8u * 2u * (16u + 4u + 1u));
}

}  // namespace
}  // namespace crevice
