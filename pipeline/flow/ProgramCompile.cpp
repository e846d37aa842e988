// Macros offered by code or scene are dropped where an effect does not know them; those of the document must exist.
#include "flow/ProgramCompile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flow/RenderStage.h"
#include "flow/Surface.h"
#include "flow/VertexInput.h"
#include "flow/Wiring.h"

namespace crevice {
namespace {

/// A macro's value in a document: bool, integer or word.
std::string defineText(const Value& value, const std::string& name) {
    if (value.isBool()) return value.boolean() ? "1" : "0";
    if (value.isInteger()) return std::to_string(value.integer());
    if (value.isString()) return value.string();
    throw Error(value.where(),
                fmt::format("define '{}' must be a bool, an integer or a word, found {}", name, value.typeName()),
                "write true, false, 3 or \"word\"");
}

/// The later set of values wins, key by key.
Value merged(const Value& base, const Value& over) {
    if (base.isNull()) return over;
    if (over.isNull()) return base;
    Value result = base;
    for (const Member& member : over.members()) result.set(member.key, member.value, member.keyLoc);
    return result;
}

std::unique_ptr<Material> makeMaterial(const EffectVariant& variant, const Value& values, Problems& problems) {
    auto material = std::make_unique<Material>(variant);
    if (!values.isNull()) material->apply(values, problems);
    return material;
}

/// Only the properties that the pass declares: what a scene offers need not be used.
Value knownProperties(const Value& offered, const EffectPass& pass) {
    Value known = Value::makeObject();
    for (const Member& member : offered.members()) {
        const bool declared = std::any_of(pass.properties.begin(), pass.properties.end(),
                                          [&](const EffectProperty& p) { return p.name == member.key; });
        if (declared) known.set(member.key, member.value, member.keyLoc);
    }
    return known;
}

}  // namespace

const EffectVariant& ProgramCompiler::compile(const StageProgram& stage, const std::string& effect, PassChoice choice,
                                              const Defines& offered) {
    const StageDesc& desc = *stage.desc;
    for (const auto& [name, text] : stage.declaration.chunks) library_.setChunk(name, text);
    VariantRequest request{.effect = effect,
                           .technique = choice.technique,
                           .pass = choice.pass,
                           .defines = {},
                           .where = desc.effectWhere.line ? desc.effectWhere : desc.where};
    std::set<std::string> known;
    library_.asset(effect, request.where);
    const std::vector<DefineInfo> infos = library_.discoverDefines(effect, choice.technique, choice.pass);
    for (const DefineInfo& info : infos) known.insert(info.name);
    for (const auto& [name, value] : offered) {
        if (known.contains(name)) request.defines.emplace(name, value);
    }
    if (desc.defines.isObject()) {
        Problems problems;  // each at its own place: the library knows one for all
        for (const Member& member : desc.defines.members()) {
            const std::string value = defineText(member.value, member.key);
            const auto info = std::find_if(infos.begin(), infos.end(),
                                           [&](const DefineInfo& other) { return other.name == member.key; });
            if (info != infos.end()) {
                checkDefine(*info, value, member.value.where(), problems);
            } else {
                request.where = member.keyLoc;
            }
            request.defines.insert_or_assign(member.key, value);
        }
        problems.throwIfErrors();
    }
    return library_.get(request, globals_.bindings());
}

void ProgramCompiler::compileDraws(StageProgram& stage, Problems& problems) {
    const StageDesc& desc = *stage.desc;
    for (const DrawDeclaration& draw : stage.declaration.draws) {
        DrawProgram program;
        program.variant = &compile(stage, draw.effect, {}, draw.defines);
        const EffectVariant& variant = *program.variant;
        if (draw.compute == variant.compute.empty()) {
            problems.error(desc.effectWhere.line ? desc.effectWhere : desc.where,
                           draw.compute
                               ? fmt::format("effect '{}' of stage '{}' has no compute program", draw.effect, desc.name)
                               : fmt::format("effect '{}' of stage '{}' is a compute effect", draw.effect, desc.name),
                           draw.compute ? "give its pass \"compute: PROGRAM\", or use FullscreenStage"
                                        : "use ComputeStage for it");
            continue;
        }
        checkBlocks(stage, variant, problems);
        program.material = makeMaterial(variant, merged(draw.material, desc.material), problems);
        program.autoProperties = program.material->autoProperties();
        program.wires = wireShader({desc_, desc, variant, *program.material, stage.declaration.writes}, problems);
        stage.draws.push_back(std::move(program));
    }
}

void ProgramCompiler::compileQueue(const StageProgram& stage, QueueProgram& queue, const Scene& scene,
                                   Problems& problems) {
    queue.surfaces.resize(scene.materials.size() * kSurfaceKinds);
    std::set<std::size_t> needed;
    for (const Instance& instance : scene.instances) {
        needed.insert(surfaceIndex(instance.material, scene.meshes[std::size_t(instance.mesh)]));
    }
    for (const std::size_t index : needed) {
        queue.surfaces[index] =
            compileSurface(stage, queue.declaration, scene.materials[index / kSurfaceKinds], index % 2 == 1, problems);
        queue.surfaces[index].topology = MeshTopology(index % kSurfaceKinds / 2);
    }
}

SurfaceProgram ProgramCompiler::compileSurface(const StageProgram& stage, const QueueDeclaration& queue,
                                               const SceneMaterial& material, bool hasTangents, Problems& problems) {
    SurfaceProgram surface;
    PassChoice choice;
    if (!choosePass(stage, queue, material.alphaMode, choice)) return surface;
    SurfaceInputs inputs = surfaceInputs(material, hasTangents);
    const EffectVariant& variant = compile(stage, queue.effect, choice, inputs.defines);
    checkBlocks(stage, variant, problems);
    static_cast<void>(vertexInput(variant));  // refuses attributes that meshes do not have
    surface.variant = &variant;
    surface.doubleSided = material.doubleSided;
    surface.material = makeMaterial(
        variant, merged(knownProperties(inputs.properties, *variant.pass), stage.desc->material), problems);
    surface.wires =
        wireShader({desc_, *stage.desc, variant, *surface.material, stage.declaration.writes, true}, problems);
    for (const auto& [sampler, ref] : inputs.textures) {
        for (const Wire& wire : surface.wires) {
            if (wire.name == sampler && wire.target.empty()) surface.textures.emplace_back(wire.slot, ref);
        }
    }
    return surface;
}

bool ProgramCompiler::choosePass(const StageProgram& stage, const QueueDeclaration& queue, AlphaMode mode,
                                 PassChoice& choice) {
    const EffectAsset& asset =
        library_.asset(queue.effect, stage.desc->effectWhere.line ? stage.desc->effectWhere : stage.desc->where);
    // Technique 0 is opaque; one named `transparent` serves blended materials.
    if (mode == AlphaMode::Blend) {
        for (std::size_t i = 0; i < asset.techniques.size(); ++i) {
            if (asset.techniques[i].name == "transparent") choice.technique = i;
        }
    }
    const std::vector<EffectPass>& passes = asset.techniques[choice.technique].passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const bool blends = !passes[i].state.blendTargets.empty() && passes[i].state.blendTargets[0].blend;
        const std::vector<std::string>& phases = queue.queue.phases;
        if (std::find(phases.begin(), phases.end(), passes[i].phase) != phases.end() &&
            blends == (queue.queue.sort == QueueSort::BackToFront)) {
            choice.pass = i;
            return true;
        }
    }
    return false;
}

void ProgramCompiler::checkBlocks(const StageProgram& stage, const EffectVariant& variant, Problems& problems) const {
    for (const ShaderResource& resource : variant.info.resources) {
        if (resource.slot.set != 0 || resource.kind != ResourceKind::UniformBlock) continue;
        const GlobalSlot* slot = globals_.find(resource.name);
        if (!slot || slot->size == resource.size) continue;
        problems.error(
            resource.where.line ? resource.where : stage.desc->where,
            fmt::format("block '{}' has {} bytes in effect '{}' and {} bytes in the pipeline", resource.name,
                        resource.size, variant.effect, slot->size),
            "declare the same members in the effect and in the stage's struct",
            slot->where.line ? std::vector<Remark>{{slot->where, "declared by this stage"}} : std::vector<Remark>{});
    }
}

}  // namespace crevice
