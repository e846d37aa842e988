// Macros offered by code or scene are dropped where an effect does not know them; those of the document must exist.
#include "flow/ProgramCompile.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "flow/CocosMacros.h"
#include "flow/CocosSurface.h"
#include "flow/MaterialStates.h"
#include "flow/RenderStage.h"
#include "flow/Surface.h"
#include "flow/VertexInput.h"
#include "flow/Wiring.h"

namespace crevice {
namespace {

/// The later set of values wins, key by key.
Value merged(const Value& base, const Value& over) {
    if (base.isNull()) return over;
    if (over.isNull()) return base;
    Value result = base;
    for (const Member& member : over.members()) result.set(member.key, member.value, member.keyLoc);
    return result;
}

std::unique_ptr<Material> makeMaterial(const EffectVariant& variant, const Value& values, Problems& problems,
                                       Profile profile) {
    auto material = std::make_unique<Material>(
        variant, isCocos(profile) ? Material::LinearRule::AsGiven : Material::LinearRule::FromSrgb);
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

/// Of a glTF material that nobody translated for a Cocos effect: what has the same name and size there.
Value fittingProperties(const Value& offered, const EffectPass& pass) {
    const auto count = [](const Value& value) { return value.isArray() ? value.items().size() : std::size_t(1); };
    Value fitting = Value::makeObject();
    for (const EffectProperty& property : pass.properties) {
        const Value* value = offered.find(property.name);
        if (value && count(*value) == count(property.value)) fitting.set(property.name, *value);
    }
    return fitting;
}

/// What a mesh is made of, over what the pass says of triangles.
void setTopology(RenderState& state, MeshTopology topology) {
    if (topology == MeshTopology::Points) state.topology = Topology::PointList;
    if (topology == MeshTopology::Lines) state.topology = Topology::LineList;
}

/// A material made by code may name a texture that the scene does not have.
void checkTextures(const SurfaceProgram& surface, const Scene& scene, const std::string& material) {
    for (const auto& [slot, ref] : surface.textures) {
        if (ref.texture >= 0 && std::size_t(ref.texture) < scene.textures.size()) continue;
        throw Error(fmt::format("material '{}' names texture {}, and the scene has {}", material, ref.texture,
                                scene.textures.size()),
                    "give the index of a texture of the scene, counted from 0");
    }
}

/// Whether a surface receives shadows is its renderer's to say; our importers write it into the material.
bool isSwitchedOffByMaterial(const std::string& macro, const Defines& offered) {
    const auto given = offered.find(macro);
    return macro == "CC_RECEIVE_SHADOW" && given != offered.end() && given->second == "0";
}

void addTextures(SurfaceProgram& surface, const std::vector<std::pair<std::string, TextureRef>>& textures) {
    for (const auto& [sampler, ref] : textures) {
        for (const Wire& wire : surface.wires) {
            if (wire.name == sampler && wire.target.empty()) surface.textures.emplace_back(wire.slot, ref);
        }
    }
}

}  // namespace

ProgramCompiler::ProgramCompiler(const PipelineDesc& desc, EffectLibrary& library, const GlobalLayout& globals,
                                 Defines sceneDefines)
    : desc_(desc), library_(library), globals_(globals) {
    (isCocos(desc.profile) ? macros_ : sceneDefines_) = std::move(sceneDefines);
}

Defines frameDefines(const PipelineDesc& desc, const Scene* scene, ShadowMaps maps) {
    return isCocos(desc.profile) ? pipelineMacros(desc, scene) : sceneDefines(scene, maps);
}

const EffectVariant& ProgramCompiler::compile(const StageProgram& stage, const std::string& effect, PassChoice choice,
                                              const Defines& offered) {
    const StageDesc& desc = *stage.desc;
    for (const auto& [name, text] : stage.declaration.chunks) library_.setChunk(name, text);
    VariantRequest request{.effect = effect,
                           .technique = choice.technique,
                           .pass = choice.pass,
                           .defines = {},
                           .where = desc.effectWhere.line ? desc.effectWhere : desc.where};
    request.rebindLiterals = desc_.fallbacks.rebindLiterals;
    std::set<std::string> known;
    library_.asset(effect, request.where);
    const std::vector<DefineInfo> infos = library_.discoverDefines(effect, choice.technique, choice.pass);
    for (const DefineInfo& info : infos) known.insert(info.name);
    for (const Defines* defines : {&offered, static_cast<const Defines*>(&sceneDefines_)}) {
        for (const auto& [name, value] : *defines) {
            if (known.contains(name)) request.defines.emplace(name, value);
        }
    }
    for (const auto& [name, value] : macros_) {
        if (!known.contains(name)) request.constants.emplace(name, value);
        if (!known.contains(name) || isSwitchedOffByMaterial(name, offered)) continue;
        request.defines.insert_or_assign(name, value);
    }
    if (desc.defines.isObject()) {
        Problems problems;  // each at its own place: the library knows one for all
        for (const Member& member : desc.defines.members()) {
            const std::string value = defineText(member.value, member.key);
            const auto info = std::find_if(infos.begin(), infos.end(),
                                           [&](const DefineInfo& other) { return other.name == member.key; });
            if (info == infos.end() && isCocos(desc_.profile)) continue;  // a material's, from another version of it
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

const EffectTechnique& ProgramCompiler::techniqueOf(const StageProgram& stage, const MaterialEffect& material) {
    const EffectAsset& asset = library_.asset(material.effect, stage.desc->where);
    if (material.technique < asset.techniques.size()) return asset.techniques[material.technique];
    throw Error(asset.where,
                fmt::format("effect '{}' has no technique {}, which a material names", asset.name, material.technique),
                fmt::format("it has {}, counted from 0", asset.techniques.size()));
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
        const Value values = merged(draw.material, desc.material);
        program.material =
            makeMaterial(variant, isCocos(desc_.profile) ? passValues(values, *variant.pass).numbers : values, problems,
                         desc_.profile);
        program.state = withStates(variant.pass->state, desc.states, problems);
        program.autoProperties = program.material->autoProperties();
        program.wires = wireShader({.pipeline = desc_,
                                    .stage = desc,
                                    .variant = variant,
                                    .material = *program.material,
                                    .writes = stage.declaration.writes,
                                    .inputs = &draw.inputs},
                                   problems);
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
        const auto topology = MeshTopology(index % kSurfaceKinds / 2);
        const std::string& name = scene.materials[index / kSurfaceKinds].name;
        setTopology(queue.surfaces[index].state, topology);
        checkTextures(queue.surfaces[index], scene, name);
        for (const SurfaceProgram& more : queue.surfaces[index].further) checkTextures(more, scene, name);
        for (SurfaceProgram& more : queue.surfaces[index].further) setTopology(more.state, topology);
    }
}

SurfaceProgram ProgramCompiler::compileSurface(const StageProgram& stage, const QueueDeclaration& queue,
                                               const SceneMaterial& material, bool hasTangents, Problems& problems) {
    if (material.effect) return compileEffectSurface(stage, queue, *material.effect, problems);
    SurfaceProgram surface;
    PassChoice choice;
    if (!choosePass(stage, queue, material.alphaMode, choice)) return surface;
    SurfaceInputs inputs = surfaceInputs(material, hasTangents);
    const EffectVariant& variant = compile(stage, queue.effect, choice, inputs.defines);
    checkBlocks(stage, variant, problems);
    static_cast<void>(vertexInput(variant, VertexSource::Mesh, missingAttributes(desc_.profile)));  // may refuse some
    surface.variant = &variant;
    surface.state = variant.pass->state;
    if (material.doubleSided) surface.state.cullMode = CullMode::None;
    const Value known = isCocos(desc_.profile) ? fittingProperties(inputs.properties, *variant.pass)
                                               : knownProperties(inputs.properties, *variant.pass);
    surface.material = makeMaterial(variant, merged(known, stage.desc->material), problems, desc_.profile);
    surface.wires =
        wireShader({desc_, *stage.desc, variant, *surface.material, stage.declaration.writes, true}, problems);
    addTextures(surface, inputs.textures);
    return surface;
}

SurfaceProgram ProgramCompiler::compileEffectSurface(const StageProgram& stage, const QueueDeclaration& queue,
                                                     const MaterialEffect& material, Problems& problems) {
    SurfaceProgram first;
    const EffectTechnique& technique = techniqueOf(stage, material);
    const std::vector<BlendTarget>& base = technique.passes.front().state.blendTargets;
    if (queue.perLight && !base.empty() && base[0].blend) return first;
    for (ChosenPass& chosen : choosePasses(technique, material, queue.queue, problems)) {
        SurfaceProgram surface;
        const EffectVariant& variant =
            compile(stage, material.effect, {material.technique, chosen.pass}, materialDefines(material, chosen.pass));
        checkBlocks(stage, variant, problems);
        static_cast<void>(vertexInput(variant, VertexSource::Mesh, missingAttributes(desc_.profile)));
        surface.variant = &variant;
        surface.state = std::move(chosen.state);
        surface.order = chosen.order;
        const Value& given = chosen.pass < material.passes.size() ? material.passes[chosen.pass].properties : Value{};
        const PassValues values = passValues(given, *variant.pass);
        surface.material = makeMaterial(variant, values.numbers, problems, desc_.profile);
        surface.wires =
            wireShader({desc_, *stage.desc, variant, *surface.material, stage.declaration.writes, true}, problems);
        addTextures(surface, values.textures);
        if (!first.variant) {
            first = std::move(surface);
        } else {
            first.further.push_back(std::move(surface));
        }
    }
    return first;
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

/// Numbers that an author wrote out and nobody rebound: another one's, or nobody's.
void ProgramCompiler::checkNumbers(const StageProgram& stage, const EffectVariant& variant, Problems& problems) const {
    for (const ShaderResource& resource : variant.info.resources) {
        if (resource.slot.set == 1) continue;
        const auto known = globals_.bindings().find(resource.name);
        if (known != globals_.bindings().end() && known->second == resource.slot) continue;
        const std::string place = fmt::format("set {}, binding {}", resource.slot.set, resource.slot.binding);
        problems.error(
            resource.where.line ? resource.where : stage.desc->where,
            fmt::format("'{}' of effect '{}' is written for {}, and the pipeline {}", resource.name, variant.effect,
                        place,
                        known == globals_.bindings().end()
                            ? std::string("has no such name")
                            : fmt::format("has it at set {}, binding {}", known->second.set, known->second.binding)),
            "correct the number, or leave \"fallbacks\": { \"rebindLiterals\" } on: names then decide");
    }
}

void ProgramCompiler::checkBlocks(const StageProgram& stage, const EffectVariant& variant, Problems& problems) const {
    if (isCocos(desc_.profile)) checkNumbers(stage, variant, problems);
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
