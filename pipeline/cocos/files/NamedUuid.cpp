// Big-endian words throughout, as the hash is defined.
#include "cocos/files/NamedUuid.h"

#include <bit>

namespace crevice::cocos {
namespace {

constexpr char kHex[] = "0123456789abcdef";
constexpr std::size_t kBlock = 64;

using State = std::array<std::uint32_t, 5>;

void addBlock(State& state, const std::uint8_t* block) {
    std::array<std::uint32_t, 80> w;
    for (std::size_t i = 0; i < 16; ++i) {
        const std::uint8_t* b = block + 4 * i;
        w[i] = std::uint32_t(b[0]) << 24 | std::uint32_t(b[1]) << 16 | std::uint32_t(b[2]) << 8 | b[3];
    }
    for (std::size_t i = 16; i < 80; ++i) w[i] = std::rotl(w[i - 3] ^ w[i - 8] ^ w[i - 14] ^ w[i - 16], 1);
    auto [a, b, c, d, e] = state;
    for (std::size_t i = 0; i < 80; ++i) {
        const std::uint32_t f = i < 20              ? (b & c) | (~b & d)
                                : i < 40 || i >= 60 ? b ^ c ^ d
                                                    : (b & c) | (b & d) | (c & d);
        const std::uint32_t k = i < 20 ? 0x5a827999 : i < 40 ? 0x6ed9eba1 : i < 60 ? 0x8f1bbcdc : 0xca62c1d6;
        const std::uint32_t next = std::rotl(a, 5) + f + e + k + w[i];
        e = d;
        d = c;
        c = std::rotl(b, 30);
        b = a;
        a = next;
    }
    state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d, state[4] + e};
}

int hexValue(char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : 0; }

std::string digitsOf(std::string_view uuid) {
    std::string digits;
    for (const char c : uuid)
        if (c != '-') digits += c;
    digits.resize(32, '0');
    return digits;
}

}  // namespace

std::array<std::uint8_t, 20> sha1(std::string_view bytes) {
    std::string padded(bytes);
    padded += '\x80';
    while (padded.size() % kBlock != kBlock - 8) padded += '\0';
    const std::uint64_t bits = std::uint64_t(bytes.size()) * 8;
    for (int shift = 56; shift >= 0; shift -= 8) padded += char(bits >> shift & 255);
    State state = {0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
    for (std::size_t at = 0; at < padded.size(); at += kBlock)
        addBlock(state, reinterpret_cast<const std::uint8_t*>(padded.data()) + at);
    std::array<std::uint8_t, 20> hash;
    for (std::size_t i = 0; i < hash.size(); ++i) hash[i] = std::uint8_t(state[i / 4] >> (24 - 8 * (i % 4)));
    return hash;
}

std::string namedUuid(std::string_view space, std::string_view name) {
    std::string text;
    const std::string digits = digitsOf(space);
    for (std::size_t i = 0; i < digits.size(); i += 2) text += char(hexValue(digits[i]) << 4 | hexValue(digits[i + 1]));
    auto hash = sha1(text.append(name));
    hash[6] = std::uint8_t((hash[6] & 0x0f) | 0x50);  // version 5
    hash[8] = std::uint8_t((hash[8] & 0x3f) | 0x80);  // the variant of RFC 4122
    std::string uuid;
    for (std::size_t i = 0; i < 16; ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) uuid += '-';
        uuid += kHex[hash[i] >> 4];
        uuid += kHex[hash[i] & 15];
    }
    return uuid;
}

std::string compressUuid(std::string_view uuid) {
    static constexpr char kBase64[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::string digits = digitsOf(uuid);
    std::string text = digits.substr(0, 2);
    for (std::size_t i = 2; i + 2 < digits.size(); i += 3) {
        const int bits = hexValue(digits[i]) << 8 | hexValue(digits[i + 1]) << 4 | hexValue(digits[i + 2]);
        text += kBase64[bits >> 6];
        text += kBase64[bits & 63];
    }
    return text;
}

}  // namespace crevice::cocos
