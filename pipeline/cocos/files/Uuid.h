// The names Cocos gives to assets: 128-bit uuids as text, whole or compressed, with the ids of sub-assets behind '@'.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace crevice::cocos {

/// `1BAF0FC9-befa-…@6c48a` → lower case, 36 characters with dashes, sub ids kept as they are (they tell apart). The
/// compressed forms are read as well: 22 characters (2 hex digits, then base64) as builds write them, 23 (5 hex digits,
/// then base64) as classes of scripts have them. Nothing when the text is none of these.
std::optional<std::string> normalizeUuid(std::string_view text);

/// The part before the first '@'.
std::string_view parentUuid(std::string_view normalized);

}  // namespace crevice::cocos
