// Which macro values an effect is compiled with: defaults, given ones, or every combination.
#pragma once

#include <cstddef>
#include <vector>

#include "effect/Defines.h"

namespace crevice {

/// Above this number of combinations, each value is tried alone instead, the other macros at their defaults.
inline constexpr std::size_t kMaxCombinations = 128;
/// Tried alone, a number takes every value of a range that has at most as many.
inline constexpr int kMaxValues = 8;

struct VariantList {
    std::vector<Defines> variants;
    std::size_t macros = 0;  ///< That vary.
    bool alone = false;  ///< Too many to combine: the first variant has all defaults, the others differ by one value.
};

/// Values of the macros to compile a pass with; those in `fixed` keep their value. Bools take 0 and 1, strings each of
/// their options, numbers both ends of their range (alone, all of a short one).
VariantList enumerateVariants(const std::vector<DefineInfo>& infos, const Defines& fixed);

}  // namespace crevice
