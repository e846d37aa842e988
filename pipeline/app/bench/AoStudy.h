// What is studied at a smaller size: calibration, each technique's own definition, and how errors split.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/bench/AoFitter.h"
#include "app/bench/AoRenderer.h"
#include "app/bench/AoResults.h"
#include "app/bench/AoTruth.h"

namespace crevice {

class AoStudy {
public:
    /// `progress` takes the number of maps rendered since the last call.
    AoStudy(AoTruthSettings truth, glm::uvec2 size, std::function<void(double)> progress)
        : truth_(std::move(truth)), size_(size), progress_(std::move(progress)) {}

    /// The cases of the study among all: each technique's "high" and "article".
    static std::vector<AoCase> choose(const std::vector<AoCase>& cases);
    static double countMaps(const std::vector<AoCase>& cases, std::size_t views);

    /// Renders and measures one scene, which the renderer holds; `share` of its diagonal is the radius.
    void addScene(AoRenderer& renderer, const AoScene& scene, double share, const std::vector<AoCase>& cases,
                  std::vector<AoSplit>& splits);
    std::vector<AoFit> fits() const;

private:
    struct Technique {
        AoCase shown;
        AoFitter fitter;
        double matched = 0;  ///< Sum over evaluation views of RMSE over white's.
        int matchedCount = 0;
        std::string matchedName;
    };
    void addMatched(Technique& technique, const AmbientMap& truth, const std::vector<float>& map) const;

    AoTruthSettings truth_;
    glm::uvec2 size_;
    std::function<void(double)> progress_;
    std::map<std::string, Technique> techniques_;
};

}  // namespace crevice
