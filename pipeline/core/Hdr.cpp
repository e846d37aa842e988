// .hdr through stb_image, which is given only what its reader survives: the header is checked before, and the end of
// the file is watched while it reads.
#include "core/Hdr.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/Error.h"

namespace crevice {
namespace {

constexpr std::size_t kMaxHeaderBytes = 1u << 16;
constexpr std::size_t kMaxLineBytes = 1000;  // stb_image cuts off longer ones

[[noreturn]] void fail(const std::string& name, const std::string& reason,
                       const char* help = "write it again as Radiance .hdr (RGBE)") {
    throw Error(fmt::format("cannot read '{}' as Radiance .hdr: {}", name, reason), help);
}

std::string_view textOf(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class Number>
std::optional<Number> readWhole(std::string_view text) {
    Number value{};
    const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failed != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// Lines of the header, one after the other.
class HeaderLines {
public:
    HeaderLines(std::string_view text, const std::string& name) : text_(text.substr(0, kMaxHeaderBytes)), name_(name) {}
    std::string_view next() {
        const std::size_t end = text_.find('\n', at_);
        if (end == std::string_view::npos || end - at_ > kMaxLineBytes) fail(name_, "its header does not end");
        const std::string_view line = text_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }
    std::size_t offset() const { return at_; }

private:
    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
};

/// "-Y 512 +X 1024": rows from the top, columns from the left.
void readSize(std::string_view line, HdrHeader& header, const std::string& name, const Limits& limits) {
    const std::size_t x = line.find(" +X ");
    if (!line.starts_with("-Y ") || x == std::string_view::npos) {
        fail(name, "its rows do not run from the top left", "turn it upright, then write it again");
    }
    const auto height = readWhole<std::uint64_t>(line.substr(3, x - 3));
    const auto width = readWhole<std::uint64_t>(line.substr(x + 4));
    if (!width || !height) fail(name, fmt::format("'{}' is no size", std::string(line.substr(0, 40))));
    if (*width < 1 || *height < 1) fail(name, fmt::format("its size is {} x {}", *width, *height));
    if (*width > limits.maxImageSide || *height > limits.maxImageSide)
        throw Error(fmt::format("the .hdr '{}' has {} x {} pixels, the limit is {} a side", name, *width, *height,
                                limits.maxImageSide),
                    raiseLimit("image-side"));
    if (*width * *height > limits.maxImagePixels)
        throw Error(fmt::format("the .hdr '{}' has {} x {} pixels, the limit is {}", name, *width, *height,
                                limits.maxImagePixels),
                    raiseLimit("image-pixels"));
    header.width = static_cast<std::uint32_t>(*width);
    header.height = static_cast<std::uint32_t>(*height);
}

/// Hands the file to stb_image. Beyond the end come bytes of 255, which its reader takes as runs that are too long or
/// as pixels: it always comes to an end (version 2.27 waits for ever at zeroes), and what it made is thrown away.
struct WatchedFile {
    std::span<const std::byte> bytes;
    std::size_t at = 0;
    bool ended = false;

    static int read(void* user, char* data, int size) {
        auto& file = *static_cast<WatchedFile*>(user);
        const auto wanted = static_cast<std::size_t>(size);
        const std::size_t count = std::min(wanted, file.bytes.size() - file.at);
        std::memcpy(data, file.bytes.data() + file.at, count);
        file.at += count;
        if (count > 0) return static_cast<int>(count);
        file.ended = true;
        std::memset(data, 255, wanted);
        return size;
    }
    static void skip(void* user, int count) {
        auto& file = *static_cast<WatchedFile*>(user);
        if (count > 0) file.at = std::min(file.at + static_cast<std::size_t>(count), file.bytes.size());
    }
    static int eof(void* user) { return static_cast<WatchedFile*>(user)->ended; }
};

}  // namespace

bool looksLikeHdr(std::span<const std::byte> bytes) {
    const std::string_view text = textOf(bytes);
    return text.starts_with("#?RADIANCE\n") || text.starts_with("#?RGBE\n");
}

HdrHeader readHdrHeader(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    HdrHeader header;
    HeaderLines lines(textOf(bytes), name);
    lines.next();
    bool isRgbe = false;
    for (std::string_view line = lines.next(); !line.empty(); line = lines.next()) {
        constexpr std::string_view kFormat = "FORMAT=", kExposure = "EXPOSURE=";
        if (line.starts_with(kFormat)) {
            if (line != "FORMAT=32-bit_rle_rgbe")
                fail(name, fmt::format("its format is '{}'", std::string(line.substr(kFormat.size(), 40))));
            isRgbe = true;
        } else if (line.starts_with(kExposure)) {
            line.remove_prefix(kExposure.size());
            while (line.starts_with(' ')) line.remove_prefix(1);
            header.exposure *= readWhole<float>(line).value_or(0.0f);
        }
    }
    if (!isRgbe) fail(name, "it names no FORMAT");
    if (!(header.exposure >= 1e-20f && header.exposure <= 1e20f)) fail(name, "its EXPOSURE is no usable number");
    readSize(lines.next(), header, name, limits);
    header.pixelsAt = lines.offset();
    return header;
}

Image decodeHdr(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    const HdrHeader header = readHdrHeader(bytes, name, limits);
    // The least that a scan line takes: four channels of runs of 127.
    const std::size_t least = std::size_t(header.height) * (header.width < 8 ? 4 : 4 + 4 * (header.width / 127) * 2);
    if (bytes.size() - header.pixelsAt < least) fail(name, "it is cut off");

    WatchedFile file{.bytes = bytes};
    const stbi_io_callbacks callbacks{.read = WatchedFile::read, .skip = WatchedFile::skip, .eof = WatchedFile::eof};
    constexpr int kRgba = 4;
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, decltype(&stbi_image_free)> pixels(
        stbi_loadf_from_callbacks(&callbacks, &file, &width, &height, &channels, kRgba), &stbi_image_free);
    if (file.ended) fail(name, "it is cut off");
    if (!pixels) fail(name, "its scan lines are damaged");
    if (std::uint32_t(width) != header.width || std::uint32_t(height) != header.height)
        fail(name, "its size is contradictory");

    Image image(header.width, header.height, Format::RGBA32F);
    std::memcpy(image.pixels.data(), pixels.get(), image.pixels.size());
    if (header.exposure == 1.0f) return image;
    auto* values = reinterpret_cast<float*>(image.pixels.data());
    for (std::size_t i = 0; i < image.pixels.size() / sizeof(float); ++i)
        if (i % 4 != 3) values[i] /= header.exposure;
    return image;
}

}  // namespace crevice
