// Every technique of the pipeline's own option in its default form, at both resolutions.
#pragma once

#include "AoFixture.h"
#include "core/Files.h"
#include "plan/PipelineAsset.h"

namespace crevice {

struct AoCase {
    std::string technique, resolution;
};

inline std::ostream& operator<<(std::ostream& out, const AoCase& c) {
    return out << c.technique << ' ' << c.resolution;
}

inline std::vector<AoCase> everyAoCase() {
    std::vector<AoCase> all;
    const PipelineDesc desc =
        loadPipeline(AssetRoots::standard(), {.nameOrPath = "ao-deferred", .options = {}, .sets = {}});
    for (const OptionDesc& option : desc.options) {
        if (option.name != "ao") continue;
        for (const std::string& technique : option.choices) {
            if (technique == "off") continue;
            for (const char* resolution : {"full", "half"}) all.push_back({technique, resolution});
        }
    }
    return all;
}

inline std::string nameOfAoCase(const testing::TestParamInfo<AoCase>& info) {
    return info.param.technique + "_" + info.param.resolution;
}

class AoComplaints : public AoTest, public testing::WithParamInterface<AoCase> {
protected:
    Options options(float radius, Options more = {}) const {
        Options all{
            {"ao", GetParam().technique}, {"resolution", GetParam().resolution}, {"radius", std::to_string(radius)}};
        all.merge(more);
        return all;
    }
    /// The technique without light and picture.
    void loadMaps(float radius, Options more = {}) {
        load("ao-views", options(radius, std::move(more)), {{"cc_ssaoBlurMap.format", "R32F"}});
    }
    /// What lighting samples.
    FloatMap open(const View& view) { return map(view, "cc_ssaoBlurMap"); }
};

/// Position of the surface that a pixel shows, from the target viewDepth; perspective cameras that are not shifted.
inline glm::vec3 worldAt(const View& view, const FloatMap& depth, std::uint32_t x, std::uint32_t y) {
    const float halfHeight = std::tan(0.5f * view.camera->fovY);
    const float aspect = float(depth.width) / float(depth.height);
    const glm::vec2 ndc((float(x) + 0.5f) / float(depth.width) * 2 - 1,
                        1 - (float(y) + 0.5f) / float(depth.height) * 2);
    const glm::vec3 seen = glm::vec3(ndc.x * halfHeight * aspect, ndc.y * halfHeight, -1) * depth.at(x, y);
    return glm::vec3(glm::inverse(view.camera->view) * glm::vec4(seen, 1));
}

/// Mean openness where `counts(position)`; NaN where nothing does.
template <class Counts>
double meanWhere(const View& view, const FloatMap& depth, const FloatMap& openness, Counts counts) {
    double sum = 0, count = 0;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x) {
            if (depth.at(x, y) > 1e8f || !counts(worldAt(view, depth, x, y))) continue;
            sum += openness.at(x, y);
            ++count;
        }
    return sum / count;
}

}  // namespace crevice
