// From an effect's pass and macro values to the texts of its stages.
#include "effect/VariantBuilder.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/Text.h"
#include "effect/Declarations.h"
#include "effect/PropertyTarget.h"

namespace crevice {
namespace {

std::string entryText(ShaderStageBits stage, const std::string& entry) {
    if (entry.empty()) return {};
    if (stage == kVertexBit) return fmt::format("void main() {{ gl_Position = {}(); }}\n", entry);
    if (stage == kComputeBit) return fmt::format("void main() {{ {}(); }}\n", entry);
    return fmt::format("layout(location = 0) out vec4 cc_FragColor; void main() {{ cc_FragColor = {}(); }}\n", entry);
}

Defines mergeDefines(const EffectPass& pass, const VariantRequest& request, Problems& problems) {
    Defines values = request.defines;
    for (const auto& [name, value] : pass.embeddedMacros) {
        const auto [it, isNew] = values.emplace(name, value);
        if (!isNew && it->second != value)
            problems.error(request.where,
                           fmt::format("define '{}' is {}, but the pass of effect '{}' fixes it to {}", name,
                                       it->second, request.effect, value),
                           "leave it out, or choose another pass",
                           {{pass.where, "the pass with these 'embeddedMacros'"}});
    }
    return values;
}

}  // namespace

std::vector<StagePart> partsOf(const EffectPass& pass) {
    std::vector<StagePart> parts;
    if (!pass.vertex.empty()) parts.push_back({kVertexBit, pass.vertex, pass.vertexWhere});
    if (!pass.fragment.empty()) parts.push_back({kFragmentBit, pass.fragment, pass.fragmentWhere});
    if (!pass.compute.empty()) parts.push_back({kComputeBit, pass.compute, pass.computeWhere});
    return parts;
}

ProgramReference parseProgram(const std::string& reference) {
    const auto colon = reference.find(':');
    if (colon == std::string::npos) return {reference, {}};
    return {reference.substr(0, colon), reference.substr(colon + 1)};
}

std::vector<const FlatSource*> FlatPass::pointers() const {
    std::vector<const FlatSource*> result;
    for (const FlatSource& source : sources) result.push_back(&source);
    return result;
}

FlatPass flattenPass(const IncludeSources& sources, const EffectPass& pass, Problems& problems) {
    FlatPass flat;
    for (const StagePart& part : partsOf(pass)) {
        const ProgramReference reference = parseProgram(part.reference);
        flat.stages.push_back(part.stage);
        flat.sources.push_back(flattenProgram(sources, reference.program, part.where, problems));
        appendEntry(flat.sources.back(), part.stage, reference.entry, part.where);
    }
    return flat;
}

void appendEntry(FlatSource& flat, ShaderStageBits stage, const std::string& entry, const SourceLoc& where) {
    if (entry.empty()) return;
    flat.text += entryText(stage, entry);
    flat.files.push_back(where.file);
    flat.lines.push_back({static_cast<std::uint32_t>(flat.files.size() - 1), where.line});
}

std::vector<StageSource> makeStageSources(FlatPass flat, const EffectPass& pass, const VariantRequest& request,
                                          const std::vector<std::string>& knownElsewhere, Problems& problems) {
    const std::vector<DefineInfo> infos = findDefines(flat.pointers(), problems);
    const Defines values = mergeDefines(pass, request, problems);
    std::vector<std::string> known;
    for (const DefineInfo& info : infos) known.push_back(info.name);
    for (const auto& [name, value] : values) {
        const auto info =
            std::find_if(infos.begin(), infos.end(), [&word = name](const DefineInfo& i) { return i.name == word; });
        if (info != infos.end()) {
            checkDefine(*info, value, request.where, problems);
        } else if (std::find(knownElsewhere.begin(), knownElsewhere.end(), name) == knownElsewhere.end()) {
            const std::string help = known.empty() ? "it has none" : didYouMean(name, known, "defines");
            const SourceLoc& where = request.defines.contains(name) ? request.where : pass.where;
            problems.error(where, fmt::format("effect '{}' has no define '{}'", request.effect, name), help);
        }
    }
    const std::string head = "#version 450\n" + defineLines(infos, values);
    std::vector<StageSource> sources;
    for (std::size_t i = 0; i < flat.sources.size(); ++i) {
        StageSource& source = sources.emplace_back();
        source.stage = flat.stages[i];
        source.head = head;
        source.text = withoutDefineMeta(flat.sources[i]);
        source.flat = std::move(flat.sources[i]);
    }
    return sources;
}

void checkPropertyTargets(const IncludeSources& sources, const EffectPass& pass, const std::vector<StageSource>& stages,
                          Problems& problems) {
    std::set<std::string> words;
    const auto collect = [&](const FlatSource& flat) {
        for (std::string& name : Declarations(flat).names()) words.insert(std::move(name));
    };
    const auto isMentioned = [&](const EffectProperty& p) { return words.contains(uniformOf(p)); };
    for (const StageSource& stage : stages) collect(stage.flat);
    if (std::all_of(pass.properties.begin(), pass.properties.end(), isMentioned)) return;
    // Passes often share one list of properties; another pass may be the one that uses it.
    Problems ignored;
    for (const EffectTechnique& technique : sources.effect.techniques)
        for (const EffectPass& other : technique.passes)
            for (const FlatSource& flat : flattenPass(sources, other, ignored).sources) collect(flat);
    for (const EffectProperty& property : pass.properties) {
        if (isMentioned(property)) continue;
        const std::string target = uniformOf(property);
        const auto near = nearestNames(target, {words.begin(), words.end()}, 1);
        problems.error(property.where,
                       fmt::format("property '{}' of effect '{}' feeds no uniform: no program mentions '{}'",
                                   property.name, sources.effect.name, target),
                       near.empty() ? "declare it in a uniform block, or remove the property"
                                    : fmt::format("did you mean '{}'?", near[0]));
    }
}

}  // namespace crevice
