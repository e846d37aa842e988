// What the tests of programs share: shipped pipelines and documents of a test, declared and compiled without a GPU.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "EffectTestTools.h"
#include "flow/FrameProgram.h"
#include "flow/RenderStage.h"
#include "plan/PipelineAsset.h"
#include "scene/Primitives.h"
#include "stages/Builtin.h"

namespace crevice {

/// The shipped data behind a folder of the test's own.
class ProgramBench {
public:
    ProgramBench() { registerBuiltinStages(registry); }

    EffectFolder folder;
    AssetRoots roots = [this] {
        AssetRoots both = AssetRoots::standard();
        both.prepend(folder.path());
        return both;
    }();
    Log log{LogLevel::Error};
    EffectLibrary library{roots, log};
    StageRegistry registry;

    std::unique_ptr<FrameProgram> load(const std::string& pipeline, std::map<std::string, std::string> options = {},
                                       std::vector<StageSet> sets = {}) {
        return program(
            loadPipeline(roots, {.nameOrPath = pipeline, .options = std::move(options), .sets = std::move(sets)}));
    }
    /// A document from its text; problems stand in test.json.
    std::unique_ptr<FrameProgram> parse(const std::string& text) {
        return program(parsePipeline(text, "test.json", roots));
    }
    /// The problems that declaring, compiling or planning a document ends in.
    std::vector<Problem> problemsOf(const std::string& text) {
        try {
            parse(text)->prepare(nullptr);
        } catch (const Error& error) {
            return error.problems();
        }
        return {};
    }
    /// A full-screen effect from its fragment program's declarations and body.
    void fragment(const std::string& name, const std::string& declarations, const std::string& body,
                  const std::string& passLines = "") const {
        folder.write("effects/" + name + ".effect",
                     "CCEffect %{\n  techniques:\n  - passes:\n    - vert: fullscreen-vs\n      frag: fs\n" +
                         passLines + "}%\nCCProgram fs %{\n  precision highp float;\n  in vec2 v_uv;\n" + declarations +
                         "\n  layout(location = 0) out vec4 result;\n  void main() { " + body + " }\n}%\n");
    }
    /// A copy of a shipped effect with one text replaced; false when the text is not in it.
    bool copyEffect(const std::string& shipped, const std::string& name, const std::string& from,
                    const std::string& to) const {
        std::string text = readText(*AssetRoots::standard().find(AssetKind::Effect, shipped));
        const std::size_t at = text.find(from);
        if (at == std::string::npos) return false;
        folder.write("effects/" + name + ".effect", text.replace(at, from.size(), to));
        return true;
    }

private:
    std::unique_ptr<FrameProgram> program(PipelineDesc desc) {
        return std::make_unique<FrameProgram>(std::move(desc), registry, library, log,
                                              RunInfo{.width = 1, .height = 1});
    }
};

/// One opaque and one blended triangle.
inline Scene twoMaterials() {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].alphaMode = AlphaMode::Blend;
    scene.meshes.push_back(makePlane(glm::vec2(1)));
    updateBounds(scene.meshes[0]);
    scene.instances.resize(2);
    scene.instances[1].material = 1;
    return scene;
}

inline const StageProgram& stageOf(const FrameProgram& program, const std::string& name) {
    for (const StageProgram& stage : program.stages())
        if (stage.desc->name == name) return stage;
    throw Error("no stage " + name);
}

/// Targets that a stage reads, as the plan has them.
inline std::vector<std::string> readsOf(const FrameProgram& program, const std::string& stage) {
    std::vector<std::string> names;
    for (const StageUse& use : program.plan().uses) {
        if (use.stage != stage) continue;
        for (const TargetRead& read : use.reads) names.push_back(read.target);
    }
    return names;
}

}  // namespace crevice
