// The columns of a row and of a mean, once for all file formats.
#pragma once

#include "app/bench/AoResults.h"
#include "app/bench/AoTable.h"

namespace crevice {

/// NaN where a region has no pixel.
inline double regionColumn(const RegionError& region) { return region.count > 0 ? region.rmse : kUnknown; }

/// Calls `visit(name, value)` with strings and doubles.
template <class Visit>
void visitColumns(const AoRow& row, Visit visit) {
    const MapMetrics& all = row.metrics.all;
    visit("scene", row.scene);
    visit("kind", row.kind);
    visit("view", row.view);
    visit("set", row.set);
    visit("width", double(row.size.x));
    visit("height", double(row.size.y));
    visit("radius_share", row.share);
    visit("radius", row.radius);
    visit("technique", row.technique);
    visit("quality", row.quality);
    visit("options", row.extras);
    visit("pixels", double(all.count));
    visit("excluded", row.excluded);
    visit("rmse", all.rmse);
    visit("of_white", all.ofWhite);
    visit("mae", all.mae);
    visit("bias", all.bias);
    visit("p95", all.p95);
    visit("ssim", row.metrics.ssim);
    visit("correlation", all.correlation);
    visit("skill", all.skill);
    visit("noise", row.metrics.noise);
    visit("edge", regionColumn(row.metrics.edge));
    visit("border", regionColumn(row.metrics.border));
    visit("contact", regionColumn(row.metrics.contact));
    visit("slope", all.slope);
    visit("offset", all.offset);
    visit("fit_rmse", all.fitRmse);
    visit("white_rmse", all.white);
    visit("truth_noise", row.truthNoise);
    visit("taps", row.taps);
    visit("taps_per_pixel", row.tapsPerPixel);
    visit("denoise_taps", row.denoiseTaps);
    visit("cpu_ms", row.cpuMs);
    visit("guard_ms", row.guardMs);
    visit("cpu_share", row.cpuShare);
    visit("guard_share", row.guardShare);
}

template <class Visit>
void visitColumns(const AoMean& mean, Visit visit) {
    visit("label", mean.label);
    visit("technique", mean.technique);
    visit("quality", mean.quality);
    visit("options", mean.extras);
    visit("rows", double(mean.rows));
    visit("rmse", mean.rmse);
    visit("of_white", mean.ofWhite);
    visit("mae", mean.mae);
    visit("bias", mean.bias);
    visit("abs_bias", mean.absBias);
    visit("p95", mean.p95);
    visit("ssim", mean.ssim);
    visit("correlation", mean.correlation);
    visit("skill", mean.skill);
    visit("noise", mean.noise);
    visit("edge", mean.edge);
    visit("border", mean.border);
    visit("contact", mean.contact);
    visit("slope", mean.slope);
    visit("offset", mean.offset);
    visit("fit_rmse", mean.fitRmse);
    visit("taps", mean.taps);
    visit("taps_per_pixel", mean.tapsPerPixel);
    visit("denoise_taps", mean.denoiseTaps);
    visit("cpu_share", mean.cpuShare);
    visit("guard_share", mean.guardShare);
}

}  // namespace crevice
