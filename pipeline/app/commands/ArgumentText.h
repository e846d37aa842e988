// Values of options as text → numbers, vectors, colours; every mistake names the option and shows how to write it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include <glm/glm.hpp>

namespace crevice {

inline constexpr std::uint32_t kMaxImageSide = 16384;

/// `option` stands in messages: "--size". All throw Error.
glm::uvec2 parseSize(std::string_view option, std::string_view text);
double parseNumber(std::string_view option, std::string_view text);
std::uint32_t parseCount(std::string_view option, std::string_view text, std::uint32_t min, std::uint32_t max);
glm::vec3 parseVector(std::string_view option, std::string_view text);
/// "transparent", "#rrggbb", "#rrggbbaa", "r,g,b" in 0 … 1 or one of a few names. sRGB, straight alpha.
glm::vec4 parseColor(std::string_view option, std::string_view text);
/// "name=value", split at the first '='. `form` is shown in help: "NAME=VALUE".
std::pair<std::string, std::string> parseAssignment(std::string_view option, std::string_view text,
                                                    std::string_view form);

}  // namespace crevice
