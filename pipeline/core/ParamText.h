// Ranges and numbers of parameters in words, shared by the reader and the table.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

#include "core/Params.h"

namespace crevice {

/// The shortest text that reads back as the same number; floats as floats: "0.1".
std::string numberText(float value);
std::string numberText(double value);
std::string numberText(std::int32_t value);
std::string numberText(std::uint32_t value);
/// "[0, 0.5, 1]".
std::string vectorText(const float* values, int count);
/// A float as the double of its shortest decimal text: 0.1f becomes 0.1.
double tidyDouble(float value);

/// What a number may be: the field's range cut to what the C++ type can hold.
struct ParamRange {
    double min = 0;
    double max = 0;
    bool showMin = false;  ///< false where nobody set a limit and the type has no natural one
    bool showMax = false;

    bool holds(double value) const { return value >= min && value <= max; }
    /// The range as a message about `value` shows it: a limit that the value breaks is always told.
    ParamRange shownFor(double value) const { return {min, max, showMin || value < min, showMax || value > max}; }
    /// "0 … 1", "≥ 0", "≤ 1" or "".
    std::string text() const;
    /// "write a number from 0 to 1 (metres)".
    std::string help(const std::string& unit) const;
};

template <class Number>
ParamRange rangeOf(const FieldInfo& info) {
    const auto lowest = static_cast<double>(std::numeric_limits<Number>::lowest());
    const auto highest = static_cast<double>(std::numeric_limits<Number>::max());
    ParamRange range{std::max(info.min, lowest), std::min(info.max, highest), std::isfinite(info.min),
                     std::isfinite(info.max)};
    if (std::is_unsigned_v<Number>) range.showMin = true;
    return range;
}

}  // namespace crevice
