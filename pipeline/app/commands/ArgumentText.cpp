// Reads whole texts only: "12abc" is no number.
#include "app/commands/ArgumentText.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Text.h"

namespace crevice {
namespace {

template <class Number>
std::optional<Number> readWhole(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (std::size_t begin = 0;;) {
        const std::size_t end = text.find(separator, begin);
        parts.push_back(text.substr(begin, end - begin));
        if (end == std::string_view::npos) return parts;
        begin = end + 1;
    }
}

/// Finite numbers separated by commas; nothing when one is malformed.
std::optional<std::vector<float>> readList(std::string_view text) {
    std::vector<float> values;
    for (const std::string_view part : split(text, ',')) {
        const auto value = readWhole<double>(part);
        if (!value || !std::isfinite(*value) || !std::isfinite(static_cast<float>(*value))) return std::nullopt;
        values.push_back(static_cast<float>(*value));
    }
    return values;
}

struct NamedColor {
    const char* name;
    glm::vec4 color;
};
constexpr float kHalf = 128.0f / 255.0f;
const NamedColor kColors[] = {
    {"transparent", {0, 0, 0, 0}}, {"black", {0, 0, 0, 1}},
    {"white", {1, 1, 1, 1}},       {"grey", {kHalf, kHalf, kHalf, 1}},
    {"red", {1, 0, 0, 1}},         {"green", {0, kHalf, 0, 1}},
    {"blue", {0, 0, 1, 1}},        {"yellow", {1, 1, 0, 1}},
    {"cyan", {0, 1, 1, 1}},        {"magenta", {1, 0, 1, 1}},
};

std::optional<glm::vec4> readHexColor(std::string_view digits) {
    if (digits.size() != 6 && digits.size() != 8) return std::nullopt;
    glm::vec4 color(0, 0, 0, 1);
    for (std::size_t i = 0; i < digits.size() / 2; ++i) {
        std::uint32_t byte = 0;
        const char* begin = digits.data() + 2 * i;
        const auto [end, failed] = std::from_chars(begin, begin + 2, byte, 16);
        if (failed != std::errc() || end != begin + 2) return std::nullopt;
        color[static_cast<int>(i)] = static_cast<float>(byte) / 255.0f;
    }
    return color;
}

}  // namespace

glm::uvec2 parseSize(std::string_view option, std::string_view text) {
    const std::vector<std::string_view> parts = split(text, 'x');
    std::optional<std::int64_t> width, height;
    if (parts.size() == 2) {
        width = readWhole<std::int64_t>(parts[0]);
        height = readWhole<std::int64_t>(parts[1]);
    }
    if (!width || !height) {
        throw Error(fmt::format("{}: '{}' is not a size", option, text), "write WIDTHxHEIGHT in pixels: 1280x720");
    }
    const auto inRange = [](std::int64_t side) { return side >= 1 && side <= kMaxImageSide; };
    if (!inRange(*width) || !inRange(*height)) {
        throw Error(fmt::format("{}: '{}' is out of range", option, text),
                    fmt::format("width and height may be 1 to {} pixels", kMaxImageSide));
    }
    return {static_cast<std::uint32_t>(*width), static_cast<std::uint32_t>(*height)};
}

double parseNumber(std::string_view option, std::string_view text) {
    const auto value = readWhole<double>(text);
    if (!value || !std::isfinite(*value)) {
        throw Error(fmt::format("{}: '{}' is not a number", option, text), "write a number such as 0.5");
    }
    return *value;
}

std::uint32_t parseCount(std::string_view option, std::string_view text, std::uint32_t min, std::uint32_t max) {
    const auto value = readWhole<std::int64_t>(text);
    const std::string help = fmt::format("write a whole number from {} to {}", min, max);
    if (!value) throw Error(fmt::format("{}: '{}' is not a whole number", option, text), help);
    if (*value < min || *value > max) throw Error(fmt::format("{}: '{}' is out of range", option, text), help);
    return static_cast<std::uint32_t>(*value);
}

glm::vec3 parseVector(std::string_view option, std::string_view text) {
    const auto values = readList(text);
    if (!values || values->size() != 3) {
        throw Error(fmt::format("{}: '{}' is not a vector", option, text),
                    fmt::format("write three numbers with commas and no spaces: {} 0,1.5,-2", option));
    }
    return {(*values)[0], (*values)[1], (*values)[2]};
}

glm::vec4 parseColor(std::string_view option, std::string_view text) {
    for (const NamedColor& named : kColors) {
        if (text == named.name) return named.color;
    }
    if (text.starts_with('#')) {
        if (const auto color = readHexColor(text.substr(1))) return *color;
    } else if (const auto values = readList(text); values && values->size() == 3) {
        const glm::vec4 color((*values)[0], (*values)[1], (*values)[2], 1);
        if (color == glm::clamp(color, glm::vec4(0), glm::vec4(1))) return color;
        throw Error(fmt::format("{}: '{}' is out of range", option, text), "each of r,g,b may be 0 to 1");
    }
    std::vector<std::string> names;
    for (const NamedColor& named : kColors) names.emplace_back(named.name);
    throw Error(fmt::format("{}: '{}' is not a colour", option, text),
                "write #rrggbb, r,g,b in 0 to 1, or a name: " + join(names));
}

std::pair<std::string, std::string> parseAssignment(std::string_view option, std::string_view text,
                                                    std::string_view form) {
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        throw Error(fmt::format("{}: '{}' has no '='", option, text), fmt::format("write {} {}", option, form));
    }
    return {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
}

}  // namespace crevice
