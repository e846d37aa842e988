// Writes PNG: with ISA-L our own chunks around its fast deflate, otherwise libspng at its fastest level.
#include <cassert>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Image.h"

#ifdef CREVICE_HAVE_ISAL
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#else
#include <cstdlib>

#include <spng.h>
#endif

namespace crevice {
namespace {

constexpr std::uint8_t kPngGrey = 0;
constexpr std::uint8_t kPngRgb = 2;
constexpr std::uint8_t kPngRgba = 6;

/// Pixels in one of PNG's own layouts.
struct PngPixels {
    std::uint8_t colorType = kPngGrey;
    std::size_t channels = 1;
    std::span<const std::byte> bytes;
    std::vector<std::byte> converted;  // what `bytes` shows, unless that is the image itself
};

bool isOpaque(const Image& image) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
        if (image.pixels[i] != std::byte{255}) return false;
    }
    return true;
}

/// Three bytes per pixel from two (blue 0) or four (alpha dropped).
std::vector<std::byte> toRgb(const Image& image, std::size_t channels) {
    const std::size_t count = std::size_t(image.width) * image.height;
    std::vector<std::byte> rgb(count * 3);
    const std::byte* source = image.pixels.data();
    for (std::size_t i = 0; i < count; ++i, source += channels) {
        rgb[3 * i] = source[0];
        rgb[3 * i + 1] = source[1];
        rgb[3 * i + 2] = channels == 4 ? source[2] : std::byte{0};
    }
    return rgb;
}

PngPixels asRgb(const Image& image, std::size_t channels) {
    PngPixels pixels{kPngRgb, 3, {}, toRgb(image, channels)};
    pixels.bytes = pixels.converted;  // a vector keeps its memory when it is moved
    return pixels;
}

PngPixels toPngPixels(const Image& image) {
    switch (image.format) {
        case Format::R8:
            return {kPngGrey, 1, image.pixels, {}};
        case Format::RG8:
            return asRgb(image, 2);
        default:
            break;
    }
    assert(image.format == Format::RGBA8 || image.format == Format::RGBA8_SRGB);
    if (isOpaque(image)) return asRgb(image, 4);
    return {kPngRgba, 4, image.pixels, {}};
}

#ifdef CREVICE_HAVE_ISAL

void appendBigEndian(std::vector<std::byte>& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::byte>((value >> shift) & 0xff));
}

void appendText(std::vector<std::byte>& out, std::string_view text) {
    for (const char c : text) out.push_back(static_cast<std::byte>(c));
}

/// Length, type, data and the CRC over type and data (PNG specification, section 5.3).
void appendChunk(std::vector<std::byte>& out, std::string_view type, std::span<const std::byte> data) {
    appendBigEndian(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    appendText(out, type);
    out.insert(out.end(), data.begin(), data.end());
    const auto* crcBytes = reinterpret_cast<const unsigned char*>(out.data() + begin);
    appendBigEndian(out, crc32_gzip_refl(0, crcBytes, out.size() - begin));
}

/// Memory that is not cleared first: at this size clearing costs as much as compressing.
struct RawBytes {
    std::unique_ptr<std::uint8_t[]> data;
    std::size_t size = 0;

    explicit RawBytes(std::size_t count) : data(std::make_unique_for_overwrite<std::uint8_t[]>(count)), size(count) {}
};

/// Every row as the difference to the row above (filter 2, "up"), preceded by the filter's number.
RawBytes filterUp(const PngPixels& pixels, std::size_t rowBytes, std::size_t rows) {
    RawBytes filtered((rowBytes + 1) * rows);
    const auto* source = reinterpret_cast<const std::uint8_t*>(pixels.bytes.data());
    for (std::size_t y = 0; y < rows; ++y) {
        std::uint8_t* target = filtered.data.get() + y * (rowBytes + 1);
        const std::uint8_t* row = source + y * rowBytes;
        *target++ = 2;
        if (y == 0) {
            std::memcpy(target, row, rowBytes);
            continue;
        }
        const std::uint8_t* above = row - rowBytes;
        for (std::size_t i = 0; i < rowBytes; ++i) target[i] = static_cast<std::uint8_t>(row[i] - above[i]);
    }
    return filtered;
}

RawBytes deflate(RawBytes& input) {
    // Stored blocks are the worst case: 5 bytes for each 64 KiB, zlib's frame, and room for a header that is undone.
    RawBytes output(input.size + input.size / 1000 + 4096);
    RawBytes work(ISAL_DEF_LVL1_DEFAULT);
    isal_zstream stream;
    isal_deflate_init(&stream);
    stream.level = 1;
    stream.level_buf = work.data.get();
    stream.level_buf_size = static_cast<std::uint32_t>(work.size);
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    stream.flush = NO_FLUSH;
    stream.next_in = input.data.get();
    stream.avail_in = static_cast<std::uint32_t>(input.size);
    stream.next_out = output.data.get();
    stream.avail_out = static_cast<std::uint32_t>(output.size);
    const int result = isal_deflate(&stream);
    if (result != COMP_OK || stream.internal_state.state != ZSTATE_END) {
        throw RenderError(fmt::format("compressing a PNG failed (code {})", result));
    }
    output.size = stream.total_out;
    return output;
}

std::vector<std::byte> encode(const PngPixels& pixels, std::uint32_t width, std::uint32_t height) {
    RawBytes filtered = filterUp(pixels, width * pixels.channels, height);
    const RawBytes compressed = deflate(filtered);
    std::vector<std::byte> header;
    appendBigEndian(header, width);
    appendBigEndian(header, height);
    // 8 bits, colour type, then the only compression and filter methods there are, not interlaced
    for (const std::uint8_t field :
         {std::uint8_t{8}, pixels.colorType, std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}}) {
        header.push_back(std::byte{field});
    }
    std::vector<std::byte> png;
    png.reserve(compressed.size + 100);
    appendText(png, "\x89PNG\r\n\x1a\n");
    appendChunk(png, "IHDR", header);
    appendChunk(png, "IDAT", std::as_bytes(std::span(compressed.data.get(), compressed.size)));
    appendChunk(png, "IEND", {});
    return png;
}

#else

struct FreeContext {
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};

void check(int result) {
    if (result != 0) throw RenderError(fmt::format("compressing a PNG failed: {}", spng_strerror(result)));
}

std::vector<std::byte> encode(const PngPixels& pixels, std::uint32_t width, std::uint32_t height) {
    const std::unique_ptr<spng_ctx, FreeContext> context(spng_ctx_new(SPNG_CTX_ENCODER));
    if (!context) throw RenderError("no memory to compress a PNG");
    check(spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1));
    check(spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, 1));
    check(spng_set_option(context.get(), SPNG_FILTER_CHOICE, SPNG_FILTER_CHOICE_UP));
    spng_ihdr header{};
    header.width = width;
    header.height = height;
    header.bit_depth = 8;
    header.color_type = pixels.colorType;
    check(spng_set_ihdr(context.get(), &header));
    check(
        spng_encode_image(context.get(), pixels.bytes.data(), pixels.bytes.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE));
    int result = 0;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> data(spng_get_png_buffer(context.get(), &size, &result),
                                                           &std::free);
    check(result);
    const auto* begin = static_cast<const std::byte*>(data.get());
    return {begin, begin + size};
}

#endif

}  // namespace

std::vector<std::byte> encodePng(const Image& image) {
    assert(image.width > 0 && image.height > 0);
    const PngPixels pixels = toPngPixels(image);
    if (pixels.bytes.size() > std::numeric_limits<std::uint32_t>::max() / 4) {
        throw RenderError(fmt::format("an image of {} x {} is too large for one PNG", image.width, image.height),
                          "write it as .exr, or render it smaller");
    }
    return encode(pixels, image.width, image.height);
}

}  // namespace crevice
