// The steps from a document to a plan, in order; compiling is in ProgramCompile.cpp.
#include "flow/FrameProgram.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Params.h"
#include "core/Text.h"
#include "flow/CocosChecks.h"
#include "flow/ProgramCompile.h"
#include "flow/RenderStage.h"
#include "flow/SceneDefines.h"
#include "flow/StageChecks.h"
#include "flow/StageRegistry.h"
#include "flow/Wiring.h"
#include "plan/PipelineAsset.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

/// Runs a step and keeps what it throws, so that several mistakes are reported in one run.
template <class Step>
void collect(Problems& problems, Step&& step) {
    try {
        step();
    } catch (const RenderError&) {
        throw;
    } catch (const Error& error) {
        problems.add(error);
    }
}

void readParams(StageProgram& program, Problems& problems) {
    const StageDesc& desc = *program.desc;
    const Value empty = Value::makeObject(desc.where);
    ParamReader reader(desc.params.isNull() ? empty : desc.params, fmt::format("params of stage '{}'", desc.name),
                       problems);
    program.stage->params(reader);
    reader.finish();
}

/// What a document says beyond what the class has a use for would be dropped in silence.
void checkListsFit(const StageDesc& desc, const StageDeclaration& declaration, Problems& problems) {
    const auto outputs = static_cast<std::size_t>(std::count_if(
        declaration.writes.begin(), declaration.writes.end(),
        [](const TargetWrite& write) { return write.kind == WriteKind::Color || write.kind == WriteKind::Storage; }));
    const auto check = [&](const char* key, std::size_t listed, std::size_t used) {
        if (listed <= used) return;
        problems.error(desc.where,
                       fmt::format("'{}' of stage '{}' has {} entries, and class '{}' has a use for {}", key, desc.name,
                                   listed, desc.stageClass, used),
                       used == 0 ? "remove the key" : "remove the last ones, or choose another class");
    };
    check("writes", desc.writes.size(), outputs);
    const auto named = std::count_if(declaration.queues.begin(), declaration.queues.end(),
                                     [](const QueueDeclaration& queue) { return !queue.perLight; });
    check("queues", desc.queues.size(), static_cast<std::size_t>(named));
}

std::vector<StageProgram> makePrograms(const PipelineDesc& pipeline, const StageRegistry& registry, RunInfo run,
                                       Problems& problems) {
    std::vector<StageProgram> stages;
    const std::uint32_t guard = guardPixels(pipeline.guard, run.height);
    run.width += 2 * guard;
    run.height += 2 * guard;
    checkPriorities(
        pipeline, [&](const std::string& name) { return registry.priorityOf(name); }, problems);
    for (const FlowDesc& flow : pipeline.flows) {
        for (const StageDesc& desc : flow.stages) {
            StageProgram program;
            program.flow = flow.name;
            program.desc = &desc;
            collect(problems, [&] {
                program.stage = registry.get(desc.stageClass, desc.where).make();
                readParams(program, problems);
                StageIo io(program.declaration, desc, run, &pipeline);
                program.stage->declare(io);
                checkListsFit(desc, program.declaration, problems);
                stages.push_back(std::move(program));
            });
        }
    }
    return stages;
}

ShadowMaps filledShadowMaps(const std::vector<StageProgram>& stages) {
    ShadowMaps maps;
    for (const StageProgram& stage : stages) {
        if (!stage.desc->enabled) continue;
        for (const BlockDeclaration& block : stage.declaration.blocks) {
            maps.main = maps.main || block.name == "CCShadow";
            maps.spot = maps.spot || block.name == "CCSpotShadow";
        }
    }
    return maps;
}

}  // namespace

void checkStages(const PipelineDesc& desc, const StageRegistry& registry, RunInfo run) {
    Problems problems;
    makePrograms(desc, registry, run, problems);
    problems.throwIfErrors();
}

FrameProgram::FrameProgram(PipelineDesc desc, const StageRegistry& registry, EffectLibrary& library, const Log& log,
                           RunInfo run)
    : desc_(std::move(desc)), library_(library), log_(log) {
    Problems problems;
    makeStages(registry, run, problems);
    problems.throwIfErrors();
    nameGlobals();
    compileDraws(frameDefines(desc_, nullptr, {}), problems);
    problems.throwIfErrors();
    logOnce(problems);
}

/// Passes of one effect say the same of it again and again.
void FrameProgram::logOnce(const Problems& problems) {
    for (const Problem& problem : problems.all()) {
        if (!logged_.insert(problem.message).second) continue;
        Problems one;
        if (problem.severity == Severity::Warning) {
            one.warning(problem.where, problem.message, problem.help);
        } else {
            one.note(problem.where, problem.message, problem.help);
        }
        log_.write(one);
    }
}

FrameProgram::~FrameProgram() = default;

void FrameProgram::makeStages(const StageRegistry& registry, const RunInfo& run, Problems& problems) {
    stages_ = makePrograms(desc_, registry, run, problems);
}

void FrameProgram::compileDraws(const Defines& defines, Problems& problems) {
    ProgramCompiler compiler(desc_, library_, globals_, defines);
    for (StageProgram& stage : stages_) {
        stage.draws.clear();
        collect(problems, [&] { compiler.compileDraws(stage, problems); });
    }
    drawDefines_ = defines;
}

void FrameProgram::nameGlobals() {
    GlobalNames names(desc_.files, desc_.profile);
    for (const TargetDesc& target : desc_.targets) names.addTarget(target.name, target.binding, target.where);
    for (const StageProgram& stage : stages_) {
        for (const BlockDeclaration& block : stage.declaration.blocks)
            names.addBlock(block.name, block.size, {}, stage.desc->where);
    }
    for (const BlockPin& pin : desc_.blocks) {
        if (pin.binding) names.pinBlock(pin.name, *pin.binding, pin.where);
    }
    globals_ = names.freeze();
}

void FrameProgram::prepare(const Scene* scene) {
    Problems problems;
    const Defines defines = frameDefines(desc_, scene, filledShadowMaps(stages_));
    if (defines != drawDefines_) compileDraws(defines, problems);
    ProgramCompiler compiler(desc_, library_, globals_, defines);
    for (StageProgram& stage : stages_) {
        stage.queues.clear();
        for (const QueueDeclaration& queue : stage.declaration.queues) {
            QueueProgram program{.declaration = queue, .surfaces = {}};
            if (scene) collect(problems, [&] { compiler.compileQueue(stage, program, *scene, problems); });
            stage.queues.push_back(std::move(program));
        }
    }
    problems.throwIfErrors();
    if (scene && isCocos(desc_.profile)) reportUndrawn(desc_, stages_, *scene, library_, problems);
    logOnce(problems);
    std::vector<StageUse> uses;
    for (const StageProgram& stage : stages_) uses.push_back(useOf(stage, problems));
    problems.throwIfErrors();
    plan_ = planFrame(desc_, std::move(uses));
}

StageUse FrameProgram::useOf(const StageProgram& stage, Problems& problems) const {
    const StageDesc& desc = *stage.desc;
    StageUse use{.stage = desc.name,
                 .flow = stage.flow,
                 .enabled = desc.enabled,
                 .compute = false,
                 .writes = stage.declaration.writes,
                 .reads = {},
                 .where = desc.where,
                 .reach = desc.reach};
    const auto addReads = [&](const EffectVariant& variant, const RenderState& state, const std::vector<Wire>& wires) {
        for (TargetRead& read : findReads(desc_, variant, wires)) {
            const bool known = std::any_of(use.reads.begin(), use.reads.end(), [&](const TargetRead& other) {
                return other.target == read.target && other.mip == read.mip && other.storage == read.storage;
            });
            if (!known) use.reads.push_back(std::move(read));
        }
        const std::vector<BlendTarget>& targets = state.blendTargets;
        for (std::size_t i = 0; i < use.writes.size(); ++i) {
            if (use.writes[i].kind == WriteKind::Color && i < targets.size() && targets[i].blend)
                use.writes[i].blends = true;
        }
        use.compute = use.compute || !variant.compute.empty();
    };
    for (const DrawProgram& draw : stage.draws) {
        if (draw.variant) addReads(*draw.variant, draw.state, draw.wires);
    }
    for (const QueueProgram& queue : stage.queues) {
        for (const SurfaceProgram& surface : queue.surfaces) {
            if (!surface.variant) continue;
            addReads(*surface.variant, surface.state, surface.wires);
            for (const SurfaceProgram& more : surface.further) addReads(*more.variant, more.state, more.wires);
        }
    }
    for (const std::string& target : stage.declaration.reads)
        use.reads.push_back({.target = target, .shaderName = {}, .where = desc.where});
    checkListedReads(desc, use, problems);
    return use;
}

std::set<std::string> FrameProgram::stencilTargets() const {
    const auto tests = [](const RenderState& state) { return state.stencilFront.test || state.stencilBack.test; };
    const auto anyTests = [&](const QueueProgram& queue) {
        return std::any_of(queue.surfaces.begin(), queue.surfaces.end(), [&](const SurfaceProgram& surface) {
            return (surface.variant && tests(surface.state)) ||
                   std::any_of(surface.further.begin(), surface.further.end(),
                               [&](const SurfaceProgram& more) { return tests(more.state); });
        });
    };
    std::set<std::string> targets;
    for (const StageProgram& stage : stages_) {
        const bool tested = std::any_of(stage.draws.begin(), stage.draws.end(),
                                        [&](const DrawProgram& draw) { return tests(draw.state); }) ||
                            std::any_of(stage.queues.begin(), stage.queues.end(), anyTests);
        if (!tested) continue;
        for (const TargetWrite& write : stage.declaration.writes)
            if (write.kind == WriteKind::DepthTest || write.kind == WriteKind::DepthWrite) targets.insert(write.target);
    }
    return targets;
}

void FrameProgram::checkListedReads(const StageDesc& desc, const StageUse& use, Problems& problems) {
    for (const ReadWire& listed : desc.reads) {
        if (!listed.shaderName.empty() || !desc.enabled || isReadForSomeScenes(listed.target)) continue;
        const bool found = std::any_of(use.reads.begin(), use.reads.end(),
                                       [&](const TargetRead& r) { return r.target == listed.target; });
        if (found) continue;
        std::vector<std::string> names;
        for (const TargetRead& read : use.reads) names.push_back(read.target);
        problems.error(
            listed.where,
            fmt::format("stage '{}' lists '{}' in 'reads', and its shaders do not read it", desc.name, listed.target),
            names.empty() ? "its shaders read no target: remove the entry" : "it reads: " + join(names));
    }
}

}  // namespace crevice
