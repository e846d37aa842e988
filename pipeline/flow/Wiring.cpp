// Resolves wires in a fixed order of precedence, so that a document can always be read without running it.
#include "flow/Wiring.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/Text.h"
#include "flow/FileTextures.h"

namespace crevice {
namespace {

const ReadWire* findReadWire(const StageDesc& stage, const std::string& shaderName) {
    for (const ReadWire& wire : stage.reads) {
        if (wire.shaderName == shaderName) return &wire;
    }
    return nullptr;
}

void setTarget(Wire& wire, const std::string& target) {
    const auto [name, mip] = splitTarget(target);
    wire.target = name;
    wire.oneMip = mip >= 0;
    wire.mip = mip >= 0 ? static_cast<std::uint32_t>(mip) : 0;
}

/// The storage image of a compute effect writes the target of its name, else the stage's writes in order.
bool wireWrite(const WiringInputs& in, Wire& wire, std::size_t& nextWrite) {
    for (const TargetWrite& write : in.writes) {
        if (write.kind == WriteKind::Storage && write.target == wire.name) {
            wire.target = write.target;
            wire.mip = write.mip;
            return true;
        }
    }
    std::vector<const TargetWrite*> storage;  // What no image has the name of.
    for (const TargetWrite& write : in.writes) {
        if (write.kind == WriteKind::Storage && !in.variant.info.find(write.target)) storage.push_back(&write);
    }
    if (nextWrite >= storage.size()) return false;
    wire.target = storage[nextWrite]->target;
    wire.mip = storage[nextWrite]->mip;
    wire.oneMip = true;
    ++nextWrite;
    return true;
}

/// The sampler's texture property, or null when it has none.
const MaterialSampler* findTexture(const Material& material, const std::string& name) {
    for (const MaterialSampler& sampler : material.samplers()) {
        if (sampler.name == name && sampler.isProperty) return &sampler;
    }
    return nullptr;
}

/// What a property's keyword names, without the endings that Cocos' textures have; "default" for what is not built in.
std::string cocosTexture(const MaterialSampler* texture) {
    if (!texture) return "default";
    std::string word = texture->texture;
    if (isPictureFile(word)) return word;
    for (const std::string_view ending : {"-texture", "-cube"})
        if (word.ends_with(ending)) word.resize(word.size() - ending.size());
    static constexpr const char* kBuiltIn[] = {"white", "black", "grey", "normal", "empty"};
    return std::find(std::begin(kBuiltIn), std::end(kBuiltIn), word) != std::end(kBuiltIn) ? word : "default";
}

const std::string* findInput(const WiringInputs& in, std::uint32_t binding) {
    if (!in.inputs) return nullptr;
    for (const auto& [number, target] : *in.inputs)
        if (number == binding) return &target;
    return nullptr;
}

/// A sampler of a Cocos effect, after "reads".
void wireCocosSampler(const WiringInputs& in, const ShaderResource& resource, const MaterialSampler* texture,
                      Wire& wire, Problems& problems) {
    const TargetDesc* target = in.pipeline.findTarget(resource.name);
    if (target && !target->isGlobal()) {
        wire.target = resource.name;
    } else if (const std::string* input = findInput(in, resource.slot.binding)) {
        setTarget(wire, *input);
    } else if (target && !texture && in.pipeline.fallbacks.globalSamplers) {
        wire.target = resource.name;
        problems.warning(
            resource.where.line ? resource.where : in.stage.where,
            fmt::format("'{}' of effect '{}' belongs to the material, which has no such property: it takes "
                        "the pipeline's '{}'",
                        resource.name, in.variant.effect, resource.name),
            "put '#pragma builtin(global)' in front of its declaration, or set "
            "\"fallbacks\": { \"globalSamplers\": false } to see what Cocos shows");
    } else {
        wire.texture = cocosTexture(texture);
    }
}

void reportUnwired(const WiringInputs& in, const ShaderResource& resource, Problems& problems) {
    problems.error(resource.where.line ? resource.where : in.stage.where,
                   fmt::format("'{}' in effect '{}' is bound to nothing in stage '{}': no target, 'reads' entry or "
                               "texture property has this name",
                               resource.name, in.variant.effect, in.stage.name),
                   fmt::format("declare a target '{0}', or wire it: \"reads\": {{ \"{0}\": \"TARGET\" }}, or give the "
                               "pass a property '{0}' with the value white",
                               resource.name),
                   {{in.stage.where, fmt::format("stage '{}' is here", in.stage.name)}});
}

/// Material textures are the built-in ones; pictures come from scenes and targets.
void checkTexture(const WiringInputs& in, const MaterialSampler& texture, Problems& problems) {
    static constexpr const char* kBuiltIn[] = {"white", "black", "grey", "normal"};
    if (std::find(std::begin(kBuiltIn), std::end(kBuiltIn), texture.texture) != std::end(kBuiltIn)) return;
    problems.error(
        texture.where,
        fmt::format("texture '{}' of '{}' in stage '{}' is not built in", texture.texture, texture.name, in.stage.name),
        fmt::format("give white, black, grey or normal; or sample a target: \"reads\": {{ \"{}\": \"TARGET\" }}",
                    texture.name));
}

void checkReadsAreUsed(const WiringInputs& in, Problems& problems) {
    std::vector<std::string> names;
    for (const ShaderResource& resource : in.variant.info.resources) {
        if (resource.slot.set == 1 &&
            (resource.kind == ResourceKind::CombinedSampler || resource.kind == ResourceKind::StorageImage)) {
            names.push_back(resource.name);
        }
    }
    for (const ReadWire& wire : in.stage.reads) {
        if (wire.shaderName.empty() || std::find(names.begin(), names.end(), wire.shaderName) != names.end()) continue;
        problems.error(wire.where,
                       fmt::format("'reads' of stage '{}' names '{}', and effect '{}' has no such sampler",
                                   in.stage.name, wire.shaderName, in.variant.effect),
                       names.empty() ? "the effect has no samplers of its own: remove the entry"
                                     : didYouMean(wire.shaderName, names, "samplers"));
    }
}

}  // namespace

std::pair<std::string, int> splitTarget(const std::string& target) {
    const std::size_t at = target.rfind('@');
    if (at == std::string::npos) return {target, -1};
    return {target.substr(0, at), std::atoi(target.c_str() + at + 1)};
}

std::vector<Wire> wireShader(const WiringInputs& in, Problems& problems) {
    std::vector<Wire> wires;
    std::size_t nextWrite = 0;
    for (const ShaderResource& resource : in.variant.info.resources) {
        const bool image = resource.kind == ResourceKind::StorageImage;
        if (resource.slot.set != 1 || (!image && resource.kind != ResourceKind::CombinedSampler)) continue;
        Wire wire{.slot = resource.slot,
                  .name = resource.name,
                  .storage = image,
                  .target = {},
                  .texture = {},
                  .cube = resource.cube};
        const MaterialSampler* texture = findTexture(in.material, resource.name);
        if (image && !resource.readOnly) {
            if (!wireWrite(in, wire, nextWrite)) {
                reportUnwired(in, resource, problems);
                continue;
            }
        } else if (const ReadWire* read = findReadWire(in.stage, resource.name)) {
            setTarget(wire, read->target);
        } else if (isCocos(in.pipeline.profile)) {
            wireCocosSampler(in, resource, texture, wire, problems);
        } else if (in.pipeline.findTarget(resource.name)) {
            wire.target = resource.name;
        } else if (texture) {
            wire.texture = texture->texture;
            checkTexture(in, *texture, problems);
        } else if (resource.active) {
            reportUnwired(in, resource, problems);
            continue;
        } else {
            wire.texture = "white";
        }
        wires.push_back(std::move(wire));
    }
    if (!in.sceneTextures) checkReadsAreUsed(in, problems);
    return wires;
}

std::vector<TargetRead> findReads(const PipelineDesc& pipeline, const EffectVariant& variant,
                                  const std::vector<Wire>& wires) {
    std::vector<TargetRead> reads;
    for (const ShaderResource& resource : variant.info.resources) {
        if (!resource.active) continue;
        const SourceLoc& where = resource.firstUse.line ? resource.firstUse : resource.where;
        if (resource.slot.set == 0 && resource.kind == ResourceKind::CombinedSampler &&
            pipeline.findTarget(resource.name)) {
            reads.push_back({.target = resource.name, .shaderName = resource.name, .where = where});
            continue;
        }
        for (const Wire& wire : wires) {
            if (wire.slot != resource.slot || wire.target.empty() || (wire.storage && resource.writeOnly)) continue;
            if (wire.storage && !resource.readOnly) continue;  // read-modify-write: the declared write covers it
            reads.push_back({.target = wire.target,
                             .storage = wire.storage,
                             .mip = wire.mip,
                             .shaderName = resource.name,
                             .where = where,
                             .oneMip = wire.oneMip});
        }
    }
    return reads;
}

}  // namespace crevice
