// Radiance .hdr files with any byte changed, put in or taken out are decoded or refused; none is read beyond its end.
#include <gtest/gtest.h>

#include "SceneTestTools.h"
#include "core/Hdr.h"

namespace crevice {
namespace {

/// Run-length encoded: `rows` of eight pixels, every channel in runs of several kinds.
std::string encoded(int rows) {
    std::string text = "#?RADIANCE\nEXPOSURE=1.5\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(rows) + " +X 8\n";
    for (int y = 0; y < rows; ++y) {
        text += {2, 2, 0, 8};
        text += {8, 1, 2, 3, 4, 5, 6, 7, 8};
        text += {char(128 + 8), char(y)};
        text += {char(128 + 5), 0, 3, 9, 9, 9};
        text += {char(128 + 8), char(128)};
    }
    return text;
}

std::string plain() {
    std::string text = "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n";
    for (int i = 0; i < 48; ++i) text += char(i * 5);
    return text;
}

/// 1 when it is decoded, 0 when it is refused.
int decode(const std::string& bytes) {
    const Limits limits{.maxImageSide = 1024, .maxImagePixels = 1u << 16};
    try {
        const Image image = decodeHdr(std::as_bytes(std::span(bytes)), "m.hdr", limits);
        EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * image.height * 16);
        return 1;
    } catch (const Error& error) {
        EXPECT_NE(formatError(error).find("m.hdr"), std::string::npos) << formatError(error);
        return 0;
    }
}

TEST(HdrMutations, EveryByteMayBeAnything) {
    int decoded = 0, refused = 0;
    for (const std::string& whole : {encoded(4), plain()})
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const int value : {0, 1, 2, 10, 32, 48, 57, 127, 128, 129, 200, 255}) {
                std::string changed = whole;
                changed[at] = char(value);
                decode(changed) ? ++decoded : ++refused;
            }
    EXPECT_GT(decoded, 500);
    EXPECT_GT(refused, 500);
}

TEST(HdrMutations, BytesMayBeMissingOrTooMany) {
    int decoded = 0;
    for (const std::string& whole : {encoded(4), plain()})
        for (std::size_t at = 0; at < whole.size(); ++at) {
            std::string changed = whole;
            changed.erase(at, 1 + at % 5);
            decoded += decode(changed);
            changed = whole;
            changed.insert(at, std::string(1 + at % 300, char(at)));
            decoded += decode(changed);
            decoded += decode(whole.substr(at) + whole.substr(0, at));
        }
    EXPECT_GT(decoded, 10);
}

}  // namespace
}  // namespace crevice
