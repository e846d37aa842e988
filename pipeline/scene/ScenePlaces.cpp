// Counts are doubles: products of lengths from a document may exceed any integer.
#include "scene/ScenePlaces.h"

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include "core/Limits.h"

namespace crevice {

std::vector<glm::mat4> arrayCells(const glm::vec3& step, const glm::uvec3& count) {
    std::vector<glm::mat4> cells;
    for (unsigned z = 0; z < count.z; ++z)
        for (unsigned y = 0; y < count.y; ++y)
            for (unsigned x = 0; x < count.x; ++x)
                cells.push_back(glm::translate(glm::mat4(1), step * glm::vec3(x, y, z)));
    return cells;
}

bool PlaceBudget::take(double places, const Value& value, const std::string& what, Problems& problems) {
    constexpr double kPlacesPerInstance = 4;
    const double all = kPlacesPerInstance * most_;
    const bool hadRoom = taken_ <= all;
    taken_ += places;
    if (places > most_)
        problems.error(value.where(), fmt::format("{} stands {} times, more than {}", what, places, most_),
                       "lower \"count\" of its arrays or its \"instances\", or " + raiseLimit("instances"));
    else if (hadRoom && taken_ > all)
        problems.error(value.where(),
                       fmt::format("objects and groups up to {} stand more than {} times together", what, all),
                       "lower \"count\" of the arrays, or " + raiseLimit("instances"));
    return places > 0 && places <= most_ && taken_ <= all;
}

}  // namespace crevice
