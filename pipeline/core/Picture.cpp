// Pictures by libspng, libjpeg-turbo and libwebp, all of which are made for hostile input; sizes are judged before.
#include "core/Picture.h"

#include <cstring>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <spng.h>
#include <turbojpeg.h>
#include <webp/decode.h>

#include "core/Error.h"

namespace crevice {
namespace {

constexpr const char* kWriteAgain = "write it again, or fetch it again";

[[noreturn]] void failDamaged(std::string_view kind, const std::string& name) {
    throw Error(fmt::format("the {} '{}' is damaged or cut off", kind, name), kWriteAgain);
}

const unsigned char* asChars(std::span<const std::byte> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

bool startsWith(std::span<const std::byte> bytes, std::string_view magic, std::size_t offset = 0) {
    return bytes.size() >= offset + magic.size() && std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

std::uint32_t bigEndian(std::span<const std::byte> bytes, std::size_t offset, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return value;
}

// PNG specification (ISO 15948), 11.2.2 "IHDR": width and height follow the signature, the length and the name.
std::optional<PictureHeader> readPngHeader(std::span<const std::byte> bytes) {
    constexpr std::string_view kMagic = "\x89PNG\r\n\x1a\n";
    if (bytes.size() < 24 || !startsWith(bytes, kMagic)) return std::nullopt;
    return PictureHeader{PictureKind::Png, bigEndian(bytes, 16, 4), bigEndian(bytes, 20, 4)};
}

// ITU-T T.81, B.2.2: a frame header SOF0 … SOF15 (not the tables 4, 8, 12) holds height and width.
std::optional<PictureHeader> readJpegHeader(std::span<const std::byte> bytes) {
    constexpr int kMaxSegments = 2000;  // ICC profiles have up to 255
    if (!startsWith(bytes, "\xff\xd8\xff")) return std::nullopt;
    std::size_t at = 2;
    for (int segments = 0; segments < kMaxSegments && at + 9 <= bytes.size();) {
        if (bytes[at] != std::byte{0xff}) return std::nullopt;
        const unsigned marker = std::to_integer<unsigned>(bytes[at + 1]);
        if (marker == 0xff) {  // B.1.1.2: any number of them may stand before a marker
            ++at;
            continue;
        }
        ++segments;
        if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
            return PictureHeader{PictureKind::Jpeg, bigEndian(bytes, at + 7, 2), bigEndian(bytes, at + 5, 2)};
        at += 2 + bigEndian(bytes, at + 2, 2);
    }
    return std::nullopt;
}

std::optional<PictureHeader> readWebPHeader(std::span<const std::byte> bytes) {
    if (!startsWith(bytes, "RIFF") || !startsWith(bytes, "WEBP", 8)) return std::nullopt;
    int width = 0, height = 0;
    if (!WebPGetInfo(asChars(bytes), bytes.size(), &width, &height) || width < 0 || height < 0) return std::nullopt;
    return PictureHeader{PictureKind::WebP, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
    void operator()(void* decompressor) const { tjDestroy(decompressor); }
};

/// 16-bit channels are rounded to 8 by libspng, palettes and grey are widened to RGBA.
void decodePng(std::span<const std::byte> bytes, const std::string& name, Image& image) {
    const auto check = [&](int result) {
        if (result != 0) failDamaged("PNG", name);
    };
    const std::unique_ptr<spng_ctx, FreeContext> context(spng_ctx_new(0));
    if (!context) throw Error(fmt::format("cannot read '{}': no memory", name));
    // Texts and profiles are kept by libspng although nobody asks for them.
    constexpr std::size_t kMaxChunk = std::size_t(16) << 20;
    check(spng_set_chunk_limits(context.get(), kMaxChunk, kMaxChunk));
    check(spng_set_png_buffer(context.get(), bytes.data(), bytes.size()));
    std::size_t size = 0;
    check(spng_decoded_image_size(context.get(), SPNG_FMT_RGBA8, &size));
    if (size != image.pixels.size()) failDamaged("PNG", name);
    check(spng_decode_image(context.get(), image.pixels.data(), size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS));
}

/// A progressive picture may hold any number of scans that change nothing: their number is limited.
void decodeJpeg(std::span<const std::byte> bytes, const std::string& name, Image& image) {
    const std::unique_ptr<void, FreeContext> jpeg(tjInitDecompress());
    if (!jpeg) throw Error(fmt::format("cannot read '{}': no memory", name));
    int width = 0, height = 0, subsampling = 0, colours = 0;
    if (tjDecompressHeader3(jpeg.get(), asChars(bytes), bytes.size(), &width, &height, &subsampling, &colours) != 0 ||
        std::uint32_t(width) != image.width || std::uint32_t(height) != image.height)
        failDamaged("JPEG", name);
    if (colours == TJCS_CMYK || colours == TJCS_YCCK)
        throw Error(fmt::format("the JPEG '{}' has colours for print (CMYK)", name), "convert it to RGB");
    if (tjDecompress2(jpeg.get(), asChars(bytes), bytes.size(), reinterpret_cast<unsigned char*>(image.pixels.data()),
                      width, 0, height, TJPF_RGBA, TJFLAG_LIMITSCANS) == 0)
        return;
    // Warnings about bytes between markers do no harm; a picture that ends early does.
    const std::string_view reason = tjGetErrorStr2(jpeg.get());
    if (tjGetErrorCode(jpeg.get()) != TJERR_WARNING || reason.find("remature end") != std::string_view::npos)
        failDamaged("JPEG", name);
}

void decodeWebP(std::span<const std::byte> bytes, const std::string& name, Image& image) {
    if (!WebPDecodeRGBAInto(asChars(bytes), bytes.size(), reinterpret_cast<unsigned char*>(image.pixels.data()),
                            image.pixels.size(), static_cast<int>(image.width) * 4))
        failDamaged("WebP", name);
}

/// Pixels that one byte of file can stand for at most: deflate codes up to 258 bytes in 2 bits, and a PNG's pixel may
/// be one bit; a JPEG spends a bit or more on each block of 64 pixels (the room above that is for arithmetic coding);
/// WebP knows no bound (a picture of one colour needs no data).
std::uint64_t pixelsPerByte(PictureKind kind) {
    switch (kind) {
        case PictureKind::Png:
            return 1032 * 8;
        case PictureKind::Jpeg:
            return 8192;
        case PictureKind::WebP:
            break;
    }
    return 0;
}

}  // namespace

std::optional<PictureHeader> readPictureHeader(std::span<const std::byte> bytes) {
    if (const auto png = readPngHeader(bytes)) return png;
    if (const auto jpeg = readJpegHeader(bytes)) return jpeg;
    return readWebPHeader(bytes);
}

void checkPictureSize(const PictureHeader& header, std::size_t byteCount, const std::string& name,
                      const Limits& limits) {
    const std::uint64_t pixels = std::uint64_t(header.width) * header.height;
    const auto refuse = [&](std::string what, std::string help) {
        throw Error(
            fmt::format("the picture '{}' says it has {} x {} pixels, {}", name, header.width, header.height, what),
            std::move(help));
    };
    if (pixels == 0) refuse("which is none", kWriteAgain);
    if (header.width > limits.maxImageSide || header.height > limits.maxImageSide)
        refuse(fmt::format("the limit is {} a side", limits.maxImageSide), raiseLimit("image-side"));
    if (pixels > limits.maxImagePixels)
        refuse(fmt::format("the limit is {}", limits.maxImagePixels), raiseLimit("image-pixels"));
    if (const std::uint64_t most = pixelsPerByte(header.kind); most != 0 && pixels / most > byteCount)
        refuse(fmt::format("which {} bytes cannot hold", byteCount), kWriteAgain);
}

Image decodePicture(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    const auto header = readPictureHeader(bytes);
    if (!header) throw Error(fmt::format("'{}' is no PNG, JPEG or WebP picture, or is cut off", name), kWriteAgain);
    checkPictureSize(*header, bytes.size(), name, limits);
    Image image(header->width, header->height, Format::RGBA8);
    if (header->kind == PictureKind::Png) decodePng(bytes, name, image);
    if (header->kind == PictureKind::Jpeg) decodeJpeg(bytes, name, image);
    if (header->kind == PictureKind::WebP) decodeWebP(bytes, name, image);
    return image;
}

}  // namespace crevice
