// One row per map, columns of eight characters.
#include "app/commands/ReferenceTables.h"

#include <fmt/format.h>

#include "truth/PictureMetrics.h"

namespace crevice {
namespace {

std::string errorRow(const MapMetrics& m, const std::string& name) {
    return fmt::format("{:8.4f} {:8.4f} {:+8.4f} {:8.4f} {:8.4f} {:8.4f} {:8.4f}  {}\n", m.rmse, m.mae, m.bias, m.p95,
                       m.correlation, m.skill, m.ofWhite, name);
}

std::string pictureRow(const PictureMetrics& m, double truthNoise, const std::string& name) {
    return fmt::format("{:9.4f} {:8.4f} {:8.4f} {:+8.4f} {:8.4f} {:8.4f} {:8.4f} {:8.4f} {:8.4f}  {}\n",
                       noiseCorrected(m.all.rmse, truthNoise), m.ssim, m.all.slope, m.all.offset, m.all.fitRmse,
                       m.noise, m.edge.rmse, m.border.rmse, m.contact.rmse, name);
}

}  // namespace

std::string measureTables(const AmbientMap& truth, std::size_t layer, const Camera& camera,
                          const std::vector<MeasuredMap>& maps, std::span<const float> heightfield) {
    std::vector<MeasuredMap> all = maps;
    if (!heightfield.empty()) all.push_back({"(heightfield)", heightfield});
    const AmbientLayer& target = truth.layers[layer];
    std::string errors = fmt::format("{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}  map\n", "rmse", "mae", "bias", "p95",
                                     "r", "skill", "of white");
    std::string pictures = fmt::format("{:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}  map\n", "corrected",
                                       "ssim", "slope", "offset", "fit", "noise", "edge", "border", "contact");
    for (const MeasuredMap& map : all) {
        const PictureMetrics metrics = measurePicture(
            {truth.size, map.values, target.openness, truth.isCounted, truth.viewDepth, camera, target.term.radius});
        errors += errorRow(metrics.all, map.name);
        pictures += pictureRow(metrics, truth.countedNoise(layer), map.name);
    }
    if (heightfield.empty() || maps.empty()) return errors + pictures;
    std::string split = fmt::format("{:>8}  map\n", "estimator");
    for (const MeasuredMap& map : maps)
        split += fmt::format("{:9.4f}  {}\n", measureMap(map.values, heightfield, truth.isCounted).rmse, map.name);
    return errors + pictures + split;
}

}  // namespace crevice
