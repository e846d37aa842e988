// A pipeline's own numbers come from its program: stages add the blocks.
#include "app/commands/EffectBindings.h"

#include "flow/FrameProgram.h"
#include "plan/GlobalNames.h"

namespace crevice {
namespace {

constexpr std::uint32_t kSsaoMap = 11, kSsaoBlock = 12, kSsaoBlurMap = 13;
constexpr std::uint32_t kSsaoBlockSize = 1040;  // CCSsao: vec4 and vec4[64]

BindingMap defaultBindings() {
    GlobalNames names;
    for (const char* target : {"cc_gbuffer_albedoMap", "cc_gbuffer_positionMap", "cc_gbuffer_normalMap",
                               "cc_gbuffer_emissiveMap", "cc_lighting_resultMap"}) {
        names.addTarget(target, {}, {});
    }
    names.addTarget("cc_ssaoMap", kSsaoMap, {});
    names.addBlock("CCSsao", kSsaoBlockSize, kSsaoBlock, {});
    names.addTarget("cc_ssaoBlurMap", kSsaoBlurMap, {});
    return names.freeze().bindings();
}

}  // namespace

AssetRoots effectRoots(const std::string& pipeline) {
    return pipeline.empty() ? AssetRoots::standard() : rootsFor(pipeline);
}

BindingMap effectBindings(const std::string& pipeline, const PluginOptions& plugins, const Log& log) {
    if (pipeline.empty()) return defaultBindings();
    PipelineOptions options;
    options.plugins = plugins;
    const PipelineChoice choice(pipeline, options);
    EffectLibrary library(choice.roots(), log);
    return FrameProgram(choice.desc(), choice.classes().registry(), library, log, {}).globals().bindings();
}

const char* kindName(ResourceKind kind) {
    switch (kind) {
        case ResourceKind::UniformBlock:
            return "uniform block";
        case ResourceKind::CombinedSampler:
            return "sampler";
        case ResourceKind::StorageBuffer:
            return "storage buffer";
        case ResourceKind::StorageImage:
            return "storage image";
    }
    return "";
}

}  // namespace crevice
