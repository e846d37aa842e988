// The numbers of `crevice reference --measure` as text.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "truth/AmbientReference.h"

namespace crevice {

struct MeasuredMap {
    std::string name;
    std::span<const float> values;
};

/// Errors against one layer of the truth, then what else tells about the maps; with a heightfield its own line and
/// every map's error against it.
std::string measureTables(const AmbientMap& truth, std::size_t layer, const Camera& camera,
                          const std::vector<MeasuredMap>& maps, std::span<const float> heightfield);

}  // namespace crevice
