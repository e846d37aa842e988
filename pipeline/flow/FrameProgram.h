// A pipeline document with its stages declared, its shaders compiled and its frame planned: everything short of a GPU.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/Log.h"
#include "effect/EffectLibrary.h"
#include "effect/Material.h"
#include "flow/StageIo.h"
#include "plan/FramePlan.h"
#include "plan/GlobalNames.h"
#include "scene/Scene.h"

namespace crevice {

class RenderStage;
class StageRegistry;

/// A sampler or image of set 1 and what it is wired to: a target, or else a texture by keyword.
struct Wire {
    BindingSlot slot;
    std::string name;  ///< In the shader.
    bool storage = false;
    std::string target;  ///< Empty = `texture`.
    std::uint32_t mip = 0;
    bool oneMip = false;
    std::string texture;  ///< Keyword: white, black, grey, normal, empty, default.
    bool cube = false;    ///< The sampler is a samplerCube.
};

/// A full-screen draw or a dispatch, compiled.
struct DrawProgram {
    const EffectVariant* variant = nullptr;
    std::unique_ptr<Material> material;
    RenderState state;                        ///< The pass', with what the document changes.
    std::vector<std::string> autoProperties;  ///< Left at `auto`: a length that follows from the scene.
    std::vector<Wire> wires;
};

/// One scene material as a queue draws it.
struct SurfaceProgram {
    const EffectVariant* variant = nullptr;  ///< Null: this queue does not draw the material.
    std::unique_ptr<Material> material;
    std::vector<Wire> wires;                                   ///< Targets and keywords.
    std::vector<std::pair<BindingSlot, TextureRef>> textures;  ///< The scene's.
    RenderState state;                                         ///< The pass', with what the material changes.
    std::uint32_t order = 0;              ///< Lower ones of a queue are drawn first: priority, then pass.
    std::vector<SurfaceProgram> further;  ///< More passes of the same material in the same queue.
};

struct QueueProgram {
    QueueDeclaration declaration;
    std::vector<SurfaceProgram> surfaces;  ///< Index: surfaceIndex().
};

/// Surfaces are counted by material, and by what meshes bring: their topology and whether they have tangents.
constexpr std::size_t kSurfaceKinds = 6;
inline std::size_t surfaceIndex(int material, MeshTopology topology, bool hasTangents) {
    return std::size_t(material) * kSurfaceKinds + std::size_t(topology) * 2 + (hasTangents ? 1 : 0);
}
inline std::size_t surfaceIndex(int material, const Mesh& mesh) {
    return surfaceIndex(material, mesh.topology, mesh.hasTangents);
}

struct StageProgram {
    std::string flow;
    const StageDesc* desc = nullptr;
    std::unique_ptr<RenderStage> stage;
    StageDeclaration declaration;
    std::vector<DrawProgram> draws;
    std::vector<QueueProgram> queues;
};

class FrameProgram {
public:
    /// Makes the stages, reads their params, lets them declare, numbers set 0 and compiles what does not depend on a
    /// scene. Throws Error with everything found wrong.
    FrameProgram(PipelineDesc desc, const StageRegistry& registry, EffectLibrary& library, const Log& log, RunInfo run);
    ~FrameProgram();

    /// Compiles what the scene's materials need, unites their reads and plans the frame. Null: no scene, queues draw
    /// nothing.
    void prepare(const Scene* scene);

    const PipelineDesc& desc() const { return desc_; }
    const GlobalLayout& globals() const { return globals_; }
    const FramePlan& plan() const { return plan_; }
    /// All stages in document order; indices are those of FramePlan::uses.
    std::vector<StageProgram>& stages() { return stages_; }
    /// Depth targets that a pass with a stencil test draws into.
    std::set<std::string> stencilTargets() const;
    const std::vector<StageProgram>& stages() const { return stages_; }

private:
    void makeStages(const StageRegistry& registry, const RunInfo& run, Problems& problems);
    void nameGlobals();
    void compileDraws(const Defines& defines, Problems& problems);
    StageUse useOf(const StageProgram& stage, Problems& problems) const;
    void logOnce(const Problems& problems);
    static void checkListedReads(const StageDesc& desc, const StageUse& use, Problems& problems);

    PipelineDesc desc_;
    EffectLibrary& library_;
    const Log& log_;
    GlobalLayout globals_;
    std::vector<StageProgram> stages_;
    Defines drawDefines_;  ///< Of the scene, that draws were compiled with.
    FramePlan plan_;
    std::set<std::string> logged_;
};

}  // namespace crevice
