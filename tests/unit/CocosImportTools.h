// What the tests of the importer share: a project folder with one effect and one material, and views of the document.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "SceneTestTools.h"
#include "cocos/import/Import.h"
#include "core/Files.h"
#include "plan/PipelineAsset.h"

namespace crevice::cocos {

inline constexpr const char* kMaterial = "10ff50d1-0000-4000-8000-000000f1736b";
inline constexpr const char* kEffect = "7acaaaaa-1111-4222-8333-444455556666";

inline const std::vector<StageFacts> kClasses = {
    {"GbufferStage", {}, {}},
    {"LightingStage", {}, {}},
    {"PostProcessStage", {}, {}},
    {"ShadowStage", {"light", "pcf"}, {}},
    {"SsaoStage", {"seed", "kernel"}, {"cc_ssaoMap"}},
};

/// A project folder with one effect and one material for it.
struct ProjectFolder {
    test::TempFolder folder;
    std::string notes;
    std::vector<StageFacts> classes = kClasses;

    ProjectFolder() {
        write("package.json", "{}");
        write("assets/pipeline/ssao.effect", R"(CCEffect %{
  techniques:
  - passes:
    - vert: vs
      frag: fs
      phase: ssao
      properties:
        radius: { value: 1.0, target: params.x }
        tint: { value: [1, 1, 1, 1] }
        noise: { value: grey }
}%
)");
        write("assets/pipeline/ssao.effect.meta", meta(kEffect, "effect"));
        writeMaterial(R"([ { "radius": 2.5, "tint": { "__type__": "cc.Color", "r": 255, "g": 0, "b": 51, "a": 255 },
                            "noise": { "__uuid__": "00000000-0000-4000-8000-000000000001" }, "strange": 1 } ])");
    }
    static std::string meta(const std::string& uuid, const std::string& importer) {
        return R"({"importer":")" + importer + R"(","uuid":")" + uuid + "\"}";
    }
    void write(const std::string& name, const std::string& text) const { folder.write(name, text); }
    void writeMaterial(const std::string& props) const {
        write("assets/pipeline/ssao.mtl",
              std::string(R"({ "__type__": "cc.Material", "_effectAsset": { "__uuid__": ")") + kEffect +
                  R"(" }, "_defines": [ { "USE_BLUR": true } ], "_props": )" + props + "}");
        write("assets/pipeline/ssao.mtl.meta", meta(kMaterial, "material"));
    }
    ImportedPipeline import(const std::string& rpp, const std::string& version = "",
                            const std::filesystem::path& engine = {}) {
        write("assets/pipeline/mine.rpp", rpp);
        Problems problems;
        const EffectReader effects = [](const std::filesystem::path& path, const std::string& name, Problems& found) {
            return parseEffect(readText(path), name, path.string(), found, EffectReading::Tolerant);
        };
        Project project({.chunks = {}, .project = folder.path(), .engine = engine}, effects, problems);
        ImportedPipeline imported =
            importPipeline({.rpp = folder.path() / "assets/pipeline/mine.rpp", .classes = classes, .version = version},
                           project, problems);
        problems.throwIfErrors();
        for (const Problem& problem : problems.all()) notes += formatProblem(problem) + "\n";
        return imported;
    }
};

inline PipelineDesc load(const std::string& text) { return parsePipeline(text, "test.json", AssetRoots({})); }

inline std::string stagesOf(const PipelineDesc& desc) {
    std::string text;
    for (const FlowDesc& flow : desc.flows) {
        text += flow.name + ":";
        for (const StageDesc& stage : flow.stages) text += " " + stage.name;
        text += "; ";
    }
    return text;
}

inline const StageDesc& stage(const PipelineDesc& desc, const std::string& name) {
    for (const FlowDesc& flow : desc.flows)
        for (const StageDesc& candidate : flow.stages)
            if (candidate.name == name) return candidate;
    throw std::runtime_error("no stage " + name);
}

/// The demo's shape; `ssao` stands in the stage's place.
inline std::string mainFlow(const std::string& ssao) {
    return R"([ { "__type__": "SsaoRenderPipeline", "_flows": [ { "__id__": 1 }, { "__id__": 2 } ], "renderTextures": [] },
      { "__type__": "ShadowFlow", "_name": "ShadowFlow", "_stages": [ { "__type__": "ShadowStage", "_name": "ShadowStage" } ] },
      { "__type__": "MainFlow", "_name": "MainFlow", "_priority": 1, "_stages": [
        { "__type__": "GbufferStage", "renderQueues": [ { "__type__": "RenderQueueDesc", "isTransparent": false, "sortMode": 0, "stages": ["default"] } ] },)" +
           ssao + R"(
        { "__type__": "LightingStage", "_deferredMaterial": null,
          "renderQueues": [ { "__type__": "RenderQueueDesc", "isTransparent": true, "sortMode": 1, "stages": ["default", "deferred", "default"] } ] },
        { "__type__": "BloomStage", "_bloomMaterial": null },
        { "__type__": "PostProcessStage", "_postProcessMaterial": null } ] } ])";
}

inline std::string ssaoStage(const std::string& fields) { return R"({ "__type__": "SsaoStage", )" + fields + "},"; }

inline const std::string kSsao = ssaoStage(R"("ssaoMaterial": { "__uuid__": "10ff50d1-0000-4000-8000-000000f1736b" })");

}  // namespace crevice::cocos
