// Results of a run: stage tables and the bars of docs/performance.md, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "Cases.h"

namespace crevice::bench {

/// One figure and what it is held against.
struct Bar {
    std::string name;
    double value = 0;
    double least = 0, most = 0;  ///< Inclusive.
    std::string unit{};          ///< Empty = a ratio.

    bool isMet() const { return value >= least && value <= most; }
};

struct CaseResult {
    std::string name, help;
    double frameMs = 0;
    std::vector<StageCost> stages;
};

struct Report {
    std::string device, scene;
    std::uint32_t width = 0, height = 0;
    int repeats = 0;
    std::vector<CaseResult> cases;
    double loopMs = 0;          ///< The hand-vectorised loop; 0 = this processor cannot run it.
    double loopDifference = 0;  ///< Mean difference of its picture from the article's, in 1/255.
    double processMs = 0, pngMs = 0;
    std::vector<Bar> bars;
};

std::string reportText(const Report& report);
std::string reportJson(const Report& report);

}  // namespace crevice::bench
