// Every form is turned into 32 hex digits first; the dashes are put in last.
#include "cocos/files/Uuid.h"

#include <algorithm>

namespace crevice::cocos {
namespace {

constexpr std::size_t kHexDigits = 32;
constexpr std::size_t kWhole = 36;
constexpr char kHex[] = "0123456789abcdef";

int hexValue(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

int base64Value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

bool isDash(std::size_t place) { return place == 8 || place == 13 || place == 18 || place == 23; }

/// "" when the text is not of the form 8-4-4-4-12.
std::string digitsOfWhole(std::string_view text) {
    std::string digits;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (isDash(i)) {
            if (text[i] != '-') return {};
            continue;
        }
        const int value = hexValue(text[i]);
        if (value < 0) return {};
        digits += kHex[value];
    }
    return digits;
}

/// `head` hex digits, then pairs of base64 digits that hold three hex digits each.
std::string digitsOfCompressed(std::string_view text, std::size_t head) {
    std::string digits;
    for (std::size_t i = 0; i < head; ++i) {
        const int value = hexValue(text[i]);
        if (value < 0) return {};
        digits += kHex[value];
    }
    for (std::size_t i = head; i + 1 < text.size(); i += 2) {
        const int high = base64Value(text[i]), low = base64Value(text[i + 1]);
        if (high < 0 || low < 0) return {};
        const int bits = high << 6 | low;
        digits += kHex[bits >> 8];
        digits += kHex[bits >> 4 & 15];
        digits += kHex[bits & 15];
    }
    return digits;
}

std::string digitsOf(std::string_view text) {
    if (text.size() == kWhole) return digitsOfWhole(text);
    if (text.size() == 22) return digitsOfCompressed(text, 2);
    if (text.size() == 23) return digitsOfCompressed(text, 5);
    return {};
}

bool areSubIds(std::string_view text) {
    for (const char c : text) {
        if (c <= ' ' || c == 0x7f) return false;
    }
    return !text.ends_with('@') && text.find("@@") == std::string_view::npos;
}

}  // namespace

std::optional<std::string> normalizeUuid(std::string_view text) {
    const std::size_t end = std::min(text.find('@'), text.size());
    const std::string digits = digitsOf(text.substr(0, end));
    const std::string_view subIds = text.substr(end);
    if (digits.size() != kHexDigits || !areSubIds(subIds)) return std::nullopt;
    std::string uuid;
    for (std::size_t i = 0; i < kHexDigits; ++i) {
        if (isDash(uuid.size())) uuid += '-';
        uuid += digits[i];
    }
    return uuid.append(subIds);
}

std::string_view parentUuid(std::string_view normalized) { return normalized.substr(0, normalized.find('@')); }

}  // namespace crevice::cocos
