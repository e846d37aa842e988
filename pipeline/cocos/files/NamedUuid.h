// Uuids that are made of names, as Cocos' editor makes them for the parts of models.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace crevice::cocos {

/// SHA-1 of bytes: FIPS 180-4, section 6.1. For names only; nothing here is secret.
std::array<std::uint8_t, 20> sha1(std::string_view bytes);

/// The uuid of a name in a namespace (36 characters): RFC 4122, 4.3, version 5, in 36 characters with dashes.
std::string namedUuid(std::string_view space, std::string_view name);

/// 22 characters: two hex digits, then base64 of three hex digits in two characters. `uuid` has 36.
std::string compressUuid(std::string_view uuid);

}  // namespace crevice::cocos
