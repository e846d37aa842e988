// Fuzzes effect files: header and programs, strict and tolerant, then flattening, macros and stage texts of each pass.
#include "FuzzTargets.h"
#include "effect/VariantBuilder.h"

namespace crevice::fuzz {
namespace {

void buildStages(const EffectAsset& asset, const EffectPass& pass, const AssetRoots& roots, Problems& problems) {
    static const Chunks kGenerated = {{"generated", "float generated() { return 1.0; }\n"}};
    const IncludeSources sources{.effect = asset, .roots = roots, .generated = kGenerated};
    FlatPass flat = flattenPass(sources, pass, problems);
    if (problems.hasErrors()) return;
    VariantRequest request;
    request.effect = asset.name;
    for (const DefineInfo& info : findDefines(flat.pointers(), problems)) {
        checkDefine(info, "1", info.where, problems);
        if (info.type != DefineType::String) request.defines[info.name] = "1";
    }
    const std::vector<StageSource> stages = makeStageSources(std::move(flat), pass, request, {}, problems);
    if (!problems.hasErrors()) checkPropertyTargets(sources, pass, stages, problems);
}

}  // namespace

void effect(std::string_view input) {
    static const AssetRoots kRoots = AssetRoots::standard();
    for (const EffectReading reading : {EffectReading::Strict, EffectReading::Tolerant}) {
        expectAnswer([&] {
            Problems problems;
            const EffectAsset asset = parseEffect(input, "fuzz", "fuzz.effect", problems, reading);
            problems.throwIfErrors();
            for (const EffectTechnique& technique : asset.techniques)
                for (const EffectPass& pass : technique.passes) buildStages(asset, pass, kRoots, problems);
            problems.throwIfErrors();
        });
    }
}

}  // namespace crevice::fuzz
