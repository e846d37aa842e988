// Means of the benchmark's rows, case by case, and which of them no other beats in both error and cost.
#pragma once

#include <string>
#include <vector>

#include "app/bench/AoResults.h"

namespace crevice {

/// Which rows a table is the mean of. Empty or 0 = any.
struct AoGroup {
    glm::uvec2 size{0};
    std::string kind, set, scene;
    double share = 0;
    std::string title() const;
    bool contains(const AoRow& row) const;
};

/// Means of the rows of one case. Regions that a row lacks (no edge in the picture) do not count.
struct AoMean {
    std::string technique, quality, extras, label;
    int rows = 0;
    double rmse = 0, ofWhite = 0, mae = 0, bias = 0, absBias = 0, p95 = 0, ssim = 0, correlation = 0, skill = 0;
    double noise = 0, edge = 0, border = 0, contact = 0, slope = 0, offset = 0, fitRmse = 0;
    double taps = 0, tapsPerPixel = 0, denoiseTaps = 0;
    double cpuShare = kUnknown, guardShare = kUnknown;  ///< Means of the rows that have them.
    bool onFront = false;  ///< No other case of the table is at most as wrong and at most as dear.
};

/// One mean per case that has as many rows as the white map: cases measured at fewer radii are left out, since means
/// over different rows do not compare. In the order of first appearance; white comes first.
std::vector<AoMean> meanRows(const std::vector<AoRow>& rows, const AoGroup& group);

/// The cases that are measured at the costs of the whole run: shares come from every row that has one.
void addCosts(std::vector<AoMean>& means, const std::vector<AoRow>& rows);
void markFront(std::vector<AoMean>& means);

/// The groups that reports show: rooms to judge by, rooms to tune on, thin occluders; each at the middle radius, then
/// over all radii; then every scene at the middle radius.
std::vector<AoGroup> listGroups(const std::vector<AoRow>& rows);

/// The middle radius, as a share.
double middleShare(const std::vector<AoRow>& rows);

}  // namespace crevice
