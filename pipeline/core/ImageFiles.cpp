// Images from and to files: PNG is read by libspng, EXR by tinyexr, and the ending chooses what is written.
#include <array>
#include <cstring>
#include <memory>
#include <span>

#include <fmt/format.h>
#include <spng.h>

#include "core/Exr.h"
#include "core/Files.h"
#include "core/Image.h"

namespace crevice {
namespace {

constexpr std::uint32_t kMaxSide = 1u << 16;

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};

bool looksLikePng(std::span<const std::byte> bytes) {
    constexpr std::array<unsigned char, 8> kMagic{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

/// 16-bit channels are rounded to 8 by libspng, palettes and grey are widened to RGBA.
Image decodePng(std::span<const std::byte> bytes, const std::string& name) {
    const auto check = [&](int result) {
        if (result == 0) return;
        if (result == SPNG_EUSER_WIDTH || result == SPNG_EUSER_HEIGHT)
            throw Error(fmt::format("the PNG '{}' is larger than {} pixels a side", name, kMaxSide), "make it smaller");
        throw Error(fmt::format("the PNG '{}' is damaged or cut off", name), "write it again, or fetch it again");
    };
    const std::unique_ptr<spng_ctx, FreeContext> context(spng_ctx_new(0));
    if (!context) throw Error(fmt::format("cannot read '{}': no memory", name));
    check(spng_set_image_limits(context.get(), kMaxSide, kMaxSide));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    spng_ihdr header{};
    check(spng_get_ihdr(context.get(), &header));
    Image image(header.width, header.height, Format::RGBA8);
    std::size_t size = 0;
    check(spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &size));
    if (size != image.pixels.size()) throw Error(fmt::format("cannot read '{}': its size is contradictory", name));
    check(spng_decode_image(context.get(), image.pixels.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
    return image;
}

std::string lowerCaseEnding(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return ending;
}

}  // namespace

Image readImage(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = readBytes(path);
    if (looksLikePng(bytes)) return decodePng(bytes, path.string());
    if (looksLikeExr(bytes)) return decodeExr(bytes, path.string());
    throw Error(fmt::format("'{}' is neither a PNG nor an EXR image", path.string()), "convert it to PNG or EXR");
}

void writeImage(const std::filesystem::path& path, const Image& image, PngMapping mapping, float far) {
    const std::string ending = lowerCaseEnding(path);
    if (ending == ".png") {
        writeFileAtomically(path, encodePng(toEightBit(image, mapping, far)));
    } else if (ending == ".exr") {
        writeFileAtomically(path, encodeExr(image));
    } else {
        throw Error(fmt::format("'{}' does not end in .png or .exr", path.string()),
                    "name the picture .png (8 bits) or .exr (full floats)");
    }
}

}  // namespace crevice
