// JSON of formats that let a key stand twice in an object.
#pragma once

#include <functional>
#include <string_view>

#include "core/Document.h"

namespace crevice {

/// Is told each key that stands in its object already, and where it stands again.
using RepeatedKey = std::function<void(std::string_view key, const SourceLoc& where)>;

/// parseJson(), but a later value for the same key of an object takes the place of the earlier one.
Value parseJsonLastWins(std::string_view text, const std::string& file, const DocumentLimits& limits,
                        const RepeatedKey& repeated);

}  // namespace crevice
