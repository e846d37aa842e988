// Counts are in a stage's defines or params, under the names that all techniques share.
#include "app/bench/AoTaps.h"

#include <map>
#include <optional>
#include <string>

namespace crevice {
namespace {

constexpr double kUsualSamples = 64;  // what SsaoStage and the articles' effects take unless told

std::optional<double> numberOf(const Value& object, const char* key) {
    if (!object.isObject()) return std::nullopt;
    const Value* value = object.find(key);
    if (!value || !value->isNumber()) return std::nullopt;
    return value->number();
}

double tapsOf(const StageDesc& stage) {
    const auto slices = numberOf(stage.defines, "SLICES"), steps = numberOf(stage.defines, "STEPS");
    if (slices && steps) return 2 * *slices * *steps;
    for (const Value* object : {&stage.params, &stage.defines}) {
        for (const char* key : {"samples", "SAMPLES", "SAMPLE_COUNT"}) {
            if (const auto samples = numberOf(*object, key)) return *samples;
        }
    }
    return stage.stageClass == "SsaoStage" || stage.name == "AoArticle" ? kUsualSamples : 0;
}

template <class Visit>
void forEnabledStages(const PipelineDesc& desc, Visit visit) {
    for (const FlowDesc& flow : desc.flows) {
        for (const StageDesc& stage : flow.stages) {
            if (stage.enabled) visit(stage);
        }
    }
}

/// Texels that one level of a denoiser reads.
double levelTaps(const std::string& effect) {
    const std::map<std::string, double> counts = {{"ao-denoise-atrous", 9},
                                                  {"ao-denoise-bilateral", 25},
                                                  {"ao-denoise-box", 25},
                                                  {"ao-denoise-edge-packed", 13},
                                                  {"ao-denoise-gaussian", 25}};
    const auto found = counts.find(effect);
    return found != counts.end() ? found->second : 0;
}

}  // namespace

double countTaps(const PipelineDesc& desc) {
    double taps = 0;
    forEnabledStages(desc, [&](const StageDesc& stage) {
        if (stage.name == "AoMain" || stage.name == "AoArticle") taps += tapsOf(stage);
    });
    for (const OptionDesc& option : desc.options) {
        if (option.name == "backFaces" && option.value.isBool() && option.value.boolean()) taps *= 2;
    }
    return taps;
}

double countDenoiseTaps(const PipelineDesc& desc) {
    double taps = 0;
    forEnabledStages(desc, [&](const StageDesc& stage) {
        if (stage.name.starts_with("AoDenoise")) taps += levelTaps(stage.effect);
    });
    return taps;
}

}  // namespace crevice
