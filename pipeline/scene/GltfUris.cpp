// What URIs hold: percent codes and data.
#include <array>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = char(c | 32);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

constexpr std::array<signed char, 256> makeDigits() {
    std::array<signed char, 256> digits{};
    for (signed char& digit : digits) digit = -1;
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) digits[static_cast<unsigned char>(kDigits[i])] = char(i);
    return digits;
}

// RFC 4648, 4; the padding may be missing.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view text) {
    static constexpr std::array<signed char, 256> kDigits = makeDigits();
    while (text.ends_with('=')) text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    std::vector<std::byte> bytes(text.size() / 4 * 3 + (text.size() % 4 ? text.size() % 4 - 1 : 0));
    std::uint32_t group = 0;
    std::size_t out = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const int digit = kDigits[static_cast<unsigned char>(text[i])];
        if (digit < 0) return std::nullopt;
        group = group << 6 | std::uint32_t(digit);
        if (i % 4 == 3) {
            for (const int shift : {16, 8, 0}) bytes[out++] = std::byte(group >> shift & 255);
            group = 0;
        }
    }
    if (text.size() % 4 == 2) bytes[out++] = std::byte(group >> 4 & 255);
    if (text.size() % 4 == 3) {
        bytes[out++] = std::byte(group >> 10 & 255);
        bytes[out++] = std::byte(group >> 2 & 255);
    }
    return bytes;
}

}  // namespace

std::string decodePercent(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0) {
            decoded += char(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

// RFC 2397: data:[<media type>][;base64],<data>
std::optional<std::vector<std::byte>> decodeDataUri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    const std::string_view data = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64"))
        return data.find('%') == std::string_view::npos ? decodeBase64(data) : decodeBase64(decodePercent(data));
    const std::string text = decodePercent(data);
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
}

}  // namespace crevice::gltf
