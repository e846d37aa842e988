// Where the objects of a scene document stand, and how many places they may take together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/Document.h"
#include "core/Error.h"

namespace crevice {

/// Places of an array's cells, relative to its object; x runs fastest. step: world units from one cell to the next.
std::vector<glm::mat4> arrayCells(const glm::vec3& step, const glm::uvec3& count);

/// Counts the places of objects and groups. Groups stand somewhere even where nothing is in them, and each place takes
/// time: there may be more of them than of instances, but not without end.
class PlaceBudget {
public:
    explicit PlaceBudget(std::size_t maxInstances) : most_(double(maxInstances)) {}

    /// Whether `what` may stand in so many places more; an error at its value when not, and once for all of them
    /// together.
    bool take(double places, const Value& value, const std::string& what, Problems& problems);

private:
    double most_;
    double taken_ = 0;
};

}  // namespace crevice
