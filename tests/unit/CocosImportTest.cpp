// .rpp → our document: versions, classes, materials, queues, targets; the text is valid and says what was left out.
#include "CocosImportTools.h"

#include <gtest/gtest.h>

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::errorOf;
using test::TempFolder;

TEST(CocosImport, TheDemosShapeBecomesADocument) {
    ProjectFolder project;
    const ImportedPipeline imported = project.import(mainFlow(kSsao));
    const PipelineDesc desc = load(imported.text);
    EXPECT_EQ(desc.name, "mine");
    EXPECT_EQ(desc.profile, Profile::Cocos36);
    EXPECT_EQ(desc.output, "finalColor");
    EXPECT_EQ(stagesOf(desc),
              "ShadowFlow: ShadowStage; MainFlow: GbufferStage SsaoStage LightingStage PostProcessStage; ");
    EXPECT_EQ(desc.findTarget("cc_shadowMap")->format, Format::R32F);
    EXPECT_EQ(desc.findTarget("cc_shadowMap")->size, glm::uvec2(1024, 1024));
    EXPECT_EQ(desc.findTarget("shadowDepth")->format, Format::D32F);
    EXPECT_EQ(stage(desc, "GbufferStage").queues.at(0).phases, std::vector<std::string>{"default"});
    EXPECT_EQ(stage(desc, "LightingStage").effect, "pipeline/deferred-lighting");
    EXPECT_EQ(stage(desc, "PostProcessStage").effect, "pipeline/post-process");
    const StageDesc& blended = stage(desc, "LightingStage");
    EXPECT_EQ(blended.queues.at(0).phases, (std::vector<std::string>{"default", "deferred"}));
    EXPECT_EQ(blended.queues.at(0).sort, QueueSort::BackToFront);
    EXPECT_TRUE(contains(project.notes, "stage 'BloomStage' is left out")) << project.notes;
    EXPECT_TRUE(contains(project.notes, "'SsaoRenderPipeline' is a script"));
}

TEST(CocosImport, StatesAndPicturesOfAStagesMaterialAreTaken) {
    ProjectFolder project;
    project.write("assets/pipeline/ssao.mtl",
                  std::string(R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": ")") + kEffect +
                      R"(" }, "_states": [ { "depthStencilState": { "depthTest": true, "stencilFuncFront": 2 } } ],
                      "_props": [ { "noise": { "__uuid__": "00000000-0000-4000-8000-000000000002@6c48a" } } ] })");
    project.write("assets/noise.png", "");
    project.write("assets/noise.png.meta", R"({"importer":"image","uuid":"00000000-0000-4000-8000-000000000002",
        "subMetas":{"6c48a":{"importer":"texture","uuid":"00000000-0000-4000-8000-000000000002@6c48a"}}})");
    const StageDesc ssao = stage(load(project.import(mainFlow(kSsao)).text), "SsaoStage");
    EXPECT_EQ(ssao.states.toJson(-1), R"({"depthStencilState":{"depthTest":true,"stencilFuncFront":2}})");
    EXPECT_EQ(ssao.material.find("noise")->string(), (project.folder.path() / "assets/noise.png").string());
}

TEST(CocosImport, PicturesOfAStagesMaterialAreSampledAsTheirMetasSay) {
    ProjectFolder project;
    project.writeMaterial(R"([ { "noise": { "__uuid__": "00000000-0000-4000-8000-000000000002@6c48a" } } ])");
    project.write("assets/noise.png", "");
    const auto noiseWith = [&](const std::string& words) {
        project.write("assets/noise.png.meta",
                      R"({"importer":"image","uuid":"00000000-0000-4000-8000-000000000002",
            "subMetas":{"6c48a":{"importer":"texture","uuid":"00000000-0000-4000-8000-000000000002@6c48a",
            "userData":{)" +
                          words + "}}}}");
        const StageDesc ssao = stage(load(project.import(mainFlow(kSsao)).text), "SsaoStage");
        const std::string name = ssao.material.find("noise")->string();
        return name.substr(name.rfind('/') + 1);
    };
    EXPECT_EQ(noiseWith(R"("wrapModeS":"repeat","wrapModeT":"repeat","minfilter":"linear","magfilter":"linear")"),
              "noise.png");
    EXPECT_EQ(
        noiseWith(
            R"("wrapModeS":"clamp-to-edge","wrapModeT":"clamp-to-edge","minfilter":"nearest","magfilter":"nearest")"),
        "noise.png#nearest,clamp");
    EXPECT_EQ(noiseWith(R"("wrapModeS":"mirrored-repeat","magfilter":"nearest")"), "noise.png#nearest-mag,mirror-u");
    EXPECT_EQ(noiseWith(R"("wrapModeS":"clamp-to-edge","wrapModeT":"mirrored-repeat","minfilter":"nearest")"),
              "noise.png#nearest-min,clamp-u,mirror-v");
}

TEST(CocosImport, TheSkyIsAStageBeforeWhatFollowsIt) {
    ProjectFolder project;
    project.classes.push_back({"SkyboxStage", {}, {}});
    project.classes.push_back({"ForwardStage", {}, {}});
    const PipelineDesc deferred = load(project.import(mainFlow(kSsao)).text);
    EXPECT_EQ(stagesOf(deferred),
              "ShadowFlow: ShadowStage; MainFlow: GbufferStage SsaoStage SkyboxStage LightingStage PostProcessStage; ");
    EXPECT_TRUE(stage(deferred, "SkyboxStage").writes.empty());
    const PipelineDesc forward = load(project.import(R"({ "__type__": "ForwardPipeline", "_flows": [] })").text);
    EXPECT_EQ(stagesOf(forward),
              "ShadowFlow: SpotShadowStage ShadowStage; ForwardFlow: ForwardStage SkyboxStage TransparentStage; ");
    EXPECT_EQ(stage(forward, "SkyboxStage").writes, std::vector<std::string>{"finalColor"});
}

TEST(CocosImport, AUsersStageTakesItsMaterial) {
    ProjectFolder project;
    const PipelineDesc desc = load(project.import(mainFlow(kSsao)).text);
    const StageDesc& ssao = stage(desc, "SsaoStage");
    EXPECT_EQ(ssao.effect, "pipeline/ssao");
    EXPECT_EQ(ssao.defines.toJson(-1), R"({"USE_BLUR":true})");
    EXPECT_EQ(ssao.material.toJson(-1), R"({"radius":2.5,"tint":[1,0,0.2,1]})");
    EXPECT_TRUE(contains(project.notes, "texture 'noise' of material 'ssao' is left out")) << project.notes;
    const TargetDesc* map = desc.findTarget("cc_ssaoMap");
    ASSERT_TRUE(map);
    EXPECT_EQ(map->clear, glm::vec4(1));
    EXPECT_EQ(map->format, Format::RGBA8);
}

TEST(CocosImport, FieldsOfAUsersStageBecomeParamsOrNotes) {
    ProjectFolder project;
    const PipelineDesc desc =
        load(project
                 .import(mainFlow(
                     ssaoStage(R"("_seed": 5, "kernel": "article", "strength": 2, "_xMaterial": null, "_name": "Ao")")))
                 .text);
    EXPECT_EQ(stage(desc, "Ao").params.toJson(-1), R"({"seed":5,"kernel":"article"})");
    EXPECT_TRUE(contains(project.notes, "field 'strength' of stage 'SsaoStage' is left out")) << project.notes;
    EXPECT_TRUE(contains(project.notes, "params of the class: seed, kernel"));
    EXPECT_FALSE(contains(project.notes, "'_xMaterial'"));
}

TEST(CocosImport, AnUnknownClassIsAnErrorThatListsTheRegisteredOnes) {
    ProjectFolder project;
    const std::string text = errorOf([&] { project.import(mainFlow(R"({ "__type__": "SsaoStages" },)")); });
    EXPECT_TRUE(contains(text, "error: no stage class 'SsaoStages' is registered")) << text;
    EXPECT_TRUE(contains(text, "mine.rpp:4:"));
    EXPECT_TRUE(contains(text, "did you mean 'SsaoStage'?"));
    EXPECT_TRUE(contains(text, "registered: GbufferStage, LightingStage, PostProcessStage, ShadowStage, SsaoStage"));
}

TEST(CocosImport, MissingAssetsAreErrorsWhereTheyAreNamed) {
    ProjectFolder project;
    const std::string unknown = errorOf([&] {
        project.import(
            mainFlow(ssaoStage(R"("ssaoMaterial": { "__uuid__": "10ff50d1-0000-4000-8000-000000000000" })")));
    });
    EXPECT_TRUE(contains(
        unknown, "no .meta has the uuid '10ff50d1-0000-4000-8000-000000000000' of 'ssaoMaterial' of stage 'SsaoStage'"))
        << unknown;
    const std::string none =
        errorOf([&] { project.import(mainFlow(ssaoStage(R"("ssaoMaterial": { "__uuid__": "nonsense" })"))); });
    EXPECT_TRUE(contains(none, "'nonsense' of 'ssaoMaterial' of stage 'SsaoStage' is no uuid")) << none;
    const std::string other = errorOf([&] {
        project.import(
            mainFlow(ssaoStage(R"("ssaoMaterial": { "__uuid__": "7acaaaaa-1111-4222-8333-444455556666" })")));
    });
    EXPECT_TRUE(contains(other, "which is no material")) << other;
    project.write("assets/pipeline/ssao.mtl", "{");
    EXPECT_TRUE(contains(errorOf([&] { project.import(mainFlow(kSsao)); }), "ssao.mtl:1:"));
    project.writeMaterial(R"([ { "radius": "wide" } ])");
    EXPECT_TRUE(contains(errorOf([&] { project.import(mainFlow(kSsao)); }), "property 'radius' is a word"));
}

TEST(CocosImport, ThePhaseListOfTheDemoIsReported) {
    ProjectFolder project;
    const PipelineDesc desc =
        load(project
                 .import(R"({ "__type__": "DeferredPipeline", "_flows": [ { "__type__": "MainFlow", "_stages": [
        { "__type__": "LightingStage", "renderQueues": [ { "__type__": "RenderQueueDesc", "isTransparent": true, "sortMode": 1, "stages": [""] } ] } ] } ] })")
                 .text);
    EXPECT_EQ(stagesOf(desc), "MainFlow: LightingStage; ");
    EXPECT_TRUE(contains(project.notes, "this queue of stage 'LightingStage' draws nothing: its phases are ['']"))
        << project.notes;
}

TEST(CocosImport, PrioritiesSortStagesAndSayso) {
    ProjectFolder project;
    const PipelineDesc desc =
        load(project
                 .import(R"({ "__type__": "DeferredPipeline", "_flows": [ { "__type__": "MainFlow", "_stages": [
        { "__type__": "PostProcessStage", "_priority": 30 }, { "__type__": "GbufferStage", "_priority": 10 },
        { "__type__": "SsaoStage", "_priority": 10 } ] } ] })")
                 .text);
    EXPECT_EQ(stagesOf(desc), "MainFlow: GbufferStage SsaoStage PostProcessStage; ");
    EXPECT_EQ(stage(desc, "GbufferStage").priority, 10);
    EXPECT_TRUE(contains(project.notes, "'_priority' puts stages of 'MainFlow' into another order")) << project.notes;
}

TEST(CocosImport, EqualNamesBecomeUnique) {
    ProjectFolder project;
    const PipelineDesc desc = load(project
                                       .import(R"({ "__type__": "DeferredPipeline", "_flows": [
        { "__type__": "F", "_stages": [ { "__type__": "SsaoStage" }, { "__type__": "SsaoStage" }, { "__type__": "SsaoStage", "_name": "a.b" } ] },
        { "__type__": "F", "_stages": [ { "__type__": "GbufferStage", "enabled": false } ] } ] })")
                                       .text);
    EXPECT_EQ(stagesOf(desc), "F: SsaoStage SsaoStage2 a_b; F2: GbufferStage; ");
    EXPECT_FALSE(stage(desc, "GbufferStage").enabled);
}

TEST(CocosImport, APipelineWithoutFlowsHasItsDefaultOnes) {
    ProjectFolder project;
    EXPECT_EQ(stagesOf(load(project.import(R"({ "__type__": "DeferredPipeline", "_flows": [] })", "3.3.1").text)),
              "ShadowFlow: ShadowStage; GbufferFlow: GbufferStage; LightingFlow: LightingStage "
              "PostProcessStage; ");
    EXPECT_EQ(stagesOf(load(project.import(R"({ "__type__": "DeferredPipeline", "_flows": [] })", "3.6.1").text)),
              "ShadowFlow: ShadowStage; MainFlow: GbufferStage LightingStage PostProcessStage; ");
    const std::string text = errorOf([&] { project.import(R"({ "__type__": "cc.RenderPipeline", "_flows": [] })"); });
    EXPECT_TRUE(contains(text, "pipeline 'mine' has no flows")) << text;
}

TEST(CocosImport, TheGbufferFollowsTheVersion) {
    ProjectFolder project;
    const std::string rpp = R"({ "__type__": "DeferredPipeline", "_flows": [] })";
    const PipelineDesc old = load(project.import(rpp, "3.3.1").text);
    EXPECT_EQ(old.profile, Profile::Cocos33);
    for (const char* name : {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap",
                             "cc_gbuffer_emissiveMap", "cc_lighting_resultMap"}) {
        ASSERT_TRUE(old.findTarget(name)) << name;
        EXPECT_EQ(old.findTarget(name)->format, Format::RGBA16F);
    }
    EXPECT_EQ(old.findTarget("depth")->clear.x, 1.0f);
    const PipelineDesc recent = load(project.import(rpp, "3.4").text);
    EXPECT_EQ(recent.profile, Profile::Cocos36);
    for (const char* name : {"gbufferAlbedo", "gbufferNormal", "gbufferEmissive", "lightingResult"})
        EXPECT_TRUE(recent.findTarget(name)) << name;
    EXPECT_FALSE(recent.findTarget("cc_gbuffer_positionMap"));
}

TEST(CocosImport, TheVersionIsFoundOut) {
    ProjectFolder project;
    const std::string shaped33 =
        R"({ "__type__": "DeferredPipeline", "_flows": [ { "__type__": "LightingFlow", "_stages": [ { "__type__": "LightingStage" } ] } ] })";
    EXPECT_EQ(project.import(shaped33).version.profile, "cocos-3.3");
    EXPECT_EQ(project.import(mainFlow("")).version.profile, "cocos-3.6");
    project.write("package.json", R"({ "creator": { "version": "3.3.2" } })");
    EXPECT_EQ(project.import(mainFlow("")).version.profile, "cocos-3.3");
    project.write("engine/package.json", R"({ "version": "3.8.5" })");
    EXPECT_EQ(project.import(shaped33, "", project.folder.path() / "engine").version.profile, "cocos-3.6");
    EXPECT_EQ(project.import(shaped33, "3.2", project.folder.path() / "engine").version.profile, "cocos-3.3");
    project.write("engine/package.json", "{ broken");
    EXPECT_EQ(project.import(mainFlow(""), "", project.folder.path() / "engine").version.profile, "cocos-3.3");
    for (const std::string bad : {"3", "x", "2.4.1", "3.", "3.x", "3.6 "})
        EXPECT_TRUE(contains(errorOf([&] { project.import(shaped33, bad); }), "is no version of Cocos Creator 3"))
            << bad;
}

TEST(CocosImport, TexturesOfThePipelineBecomeTargets) {
    ProjectFolder project;
    project.write("assets/half.rt", "{}");
    project.write(
        "assets/half.rt.meta",
        R"({"importer":"render-texture","uuid":"00000000-0000-4000-8000-000000000002","userData":{"width":512,"height":256}})");
    const PipelineDesc desc = load(project
                                       .import(R"({ "__type__": "DeferredPipeline", "_flows": [], "renderTextures": [
        { "__type__": "RenderTextureConfig", "name": "half", "texture": { "__uuid__": "00000000-0000-4000-8000-000000000002" } } ],
        "textures": [ { "__type__": "RenderTextureDesc", "name": "wide", "format": 41 },
                      { "__type__": "RenderTextureDesc", "name": "odd", "format": 999, "width": 8, "height": 4 } ] })")
                                       .text);
    ASSERT_TRUE(desc.findTarget("half"));
    EXPECT_EQ(desc.findTarget("half")->size, glm::uvec2(512, 256));
    EXPECT_EQ(desc.findTarget("wide")->format, Format::RGBA16F);
    EXPECT_FALSE(desc.findTarget("wide")->size.has_value());
    EXPECT_EQ(desc.findTarget("odd")->size, glm::uvec2(8, 4));
    EXPECT_TRUE(contains(project.notes, "format 999 of texture 'odd' becomes RGBA8"));
}

TEST(CocosImport, ForwardPipelinesDrawTwoQueues) {
    ProjectFolder project;
    const PipelineDesc desc = load(project.import(R"({ "__type__": "ForwardPipeline", "_flows": [] })").text);
    EXPECT_EQ(stagesOf(desc), "ShadowFlow: SpotShadowStage ShadowStage; ForwardFlow: ForwardStage TransparentStage; ");
    EXPECT_EQ(stage(desc, "SpotShadowStage").params.find("light")->string(), "spot");
    EXPECT_TRUE(desc.findTarget("cc_spotShadowMap"));
    EXPECT_TRUE(desc.findTarget("depth"));
    for (const char* deferred : {"gbufferAlbedo", "gbufferNormal", "gbufferEmissive", "lightingResult"})
        EXPECT_FALSE(desc.findTarget(deferred)) << deferred;  // nobody would read or write them
    EXPECT_EQ(stage(desc, "ForwardStage").writes, std::vector<std::string>{"finalColor"});
    EXPECT_EQ(stage(desc, "ForwardStage").queues.size(), 1u);
    EXPECT_EQ(stage(desc, "TransparentStage").queues.at(0).sort, QueueSort::BackToFront);
}

TEST(CocosImport, TheTextIsForPeople) {
    ProjectFolder project;
    const std::string text = project.import(mainFlow(kSsao)).text;
    EXPECT_TRUE(contains(text, "\n  \"profile\": \"cocos-3.6\",\n")) << text;
    EXPECT_TRUE(contains(text, "\n    \"depth\": { \"format\": \"D32F\", \"clear\": 1 },\n"));
    EXPECT_TRUE(
        contains(text, "{ \"stage\": \"PostProcessStage\", \"priority\": 0, \"effect\": \"pipeline/post-process\" }"));
    EXPECT_TRUE(contains(text, "\"help\": \"Translated from mine.rpp (SsaoRenderPipeline).\""));
    std::size_t longest = 0, start = 0;
    for (std::size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
        longest = std::max(longest, end - start);
    EXPECT_LE(longest, 130u);
}

TEST(CocosImport, TheProjectFolderIsFoundAboveAFile) {
    ProjectFolder project;
    EXPECT_EQ(findProjectFolder(project.folder.path() / "assets/pipeline/mine.rpp"), project.folder.path());
    EXPECT_EQ(findProjectFolder("/"), std::nullopt);
}

}  // namespace
}  // namespace crevice::cocos
