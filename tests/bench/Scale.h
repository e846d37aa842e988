// `crevice_bench --scale`: how cost grows with objects, triangles, lights, pixels and textures.
#pragma once

#include <string>
#include <vector>

namespace crevice::bench {

struct ScaleOptions {
    int repeats = 3;
    /// Some of objects, triangles, lights, pixels, textures; empty = all.
    std::vector<std::string> curves{};
    std::uint32_t triangleMeshes = 20;  ///< Of half a million triangles each.
};

/// Measures and prints the curves and their bars.
void runScale(const ScaleOptions& options);

}  // namespace crevice::bench
