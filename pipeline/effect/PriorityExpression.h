// The little expressions of a pass' priority: `max - 10`, `min + 11`.
#pragma once

#include <optional>
#include <string_view>

namespace crevice {

/// Numbers, min (0), max (255) and default (128) with + - * / and brackets, rounded to the nearest whole number;
/// nothing when it is none or a division has no result.
std::optional<int> evaluatePriority(std::string_view expression);

}  // namespace crevice
