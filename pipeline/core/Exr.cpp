// EXR through tinyexr: full floats, zip compression.
#include "core/Exr.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <tinyexr.h>

#include "core/Error.h"

namespace crevice {
namespace {

/// A header whose parts tinyexr allocated.
struct ParsedHeader {
    EXRHeader header;
    ParsedHeader() { InitEXRHeader(&header); }
    ParsedHeader(const ParsedHeader&) = delete;
    ParsedHeader& operator=(const ParsedHeader&) = delete;
    ~ParsedHeader() { FreeEXRHeader(&header); }
};

/// An image whose planes tinyexr allocated.
struct LoadedImage {
    EXRImage image;
    LoadedImage() { InitEXRImage(&image); }
    LoadedImage(const LoadedImage&) = delete;
    LoadedImage& operator=(const LoadedImage&) = delete;
    ~LoadedImage() { FreeEXRImage(&image); }
};

/// Takes over tinyexr's text.
std::string takeMessage(const char* message) {
    if (!message) return "the data is damaged";
    std::string text = message;
    FreeEXRErrorMessage(message);
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    return text;
}

const unsigned char* asChars(std::span<const std::byte> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
    throw Error(fmt::format("cannot read '{}' as EXR: {}", name, reason),
                "write it again as single-part EXR with channels R, G, B, A");
}

void parseHeader(EXRHeader& header, std::span<const std::byte> bytes, const std::string& name) {
    EXRVersion version;
    if (ParseEXRVersionFromMemory(&version, asChars(bytes), bytes.size()) != TINYEXR_SUCCESS) {
        fail(name, "its header is damaged");
    }
    if (version.multipart || version.non_image) fail(name, "it has several parts or deep pixels");
    const char* message = nullptr;
    if (ParseEXRHeaderFromMemory(&header, &version, asChars(bytes), bytes.size(), &message) != TINYEXR_SUCCESS) {
        fail(name, takeMessage(message));
    }
}

void checkSize(std::int64_t width, std::int64_t height, const std::string& name, const Limits& limits) {
    const std::int64_t side = limits.maxImageSide;
    if (width < 1 || height < 1) fail(name, fmt::format("its size is {} x {}", width, height));
    if (width > side || height > side)
        throw Error(fmt::format("the EXR '{}' has {} x {} pixels, the limit is {} a side", name, width, height, side),
                    raiseLimit("image-side"));
    if (std::uint64_t(width) * std::uint64_t(height) > limits.maxImagePixels)
        throw Error(
            fmt::format("the EXR '{}' has {} x {} pixels, the limit is {}", name, width, height, limits.maxImagePixels),
            raiseLimit("image-pixels"));
}

/// Which component a channel is: the last part of its name, "diffuse.R" → 0; -1 for others.
int componentOf(std::string_view name) {
    if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name.remove_prefix(dot + 1);
    constexpr std::string_view kComponents = "RGBA";
    return name.size() == 1 ? static_cast<int>(kComponents.find(name.front())) : -1;
}

/// Planes to interleaved pixels; a single channel that is no colour is shown as grey.
Image interleave(const EXRHeader& header, const EXRImage& planes) {
    Image result(static_cast<std::uint32_t>(planes.width), static_cast<std::uint32_t>(planes.height), Format::RGBA32F);
    const std::size_t count = std::size_t(result.width) * result.height;
    std::vector<glm::vec4> pixels(count, glm::vec4(0, 0, 0, 1));
    for (int c = 0; c < planes.num_channels; ++c) {
        const auto* plane = reinterpret_cast<const float*>(planes.images[c]);
        const int component = componentOf(header.channels[c].name);
        const bool grey = component < 0 && planes.num_channels == 1;
        if (component < 0 && !grey) continue;
        for (std::size_t i = 0; i < count; ++i) {
            if (grey) {
                pixels[i] = {plane[i], plane[i], plane[i], 1.0f};
            } else {
                pixels[i][component] = plane[i];
            }
        }
    }
    std::memcpy(result.pixels.data(), pixels.data(), result.pixels.size());
    return result;
}

/// Tiles are put together by tinyexr itself, which knows RGB(A) and single channels.
Image decodeTiled(std::span<const std::byte> bytes, const std::string& name) {
    float* rgba = nullptr;
    int width = 0;
    int height = 0;
    const char* message = nullptr;
    const int code = LoadEXRFromMemory(&rgba, &width, &height, asChars(bytes), bytes.size(), &message);
    const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
    if (code != TINYEXR_SUCCESS) fail(name, takeMessage(message));
    Image result(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), Format::RGBA32F);
    std::memcpy(result.pixels.data(), rgba, result.pixels.size());
    return result;
}

}  // namespace

bool looksLikeExr(std::span<const std::byte> bytes) {
    constexpr std::array<unsigned char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

int exrColourChannels(std::span<const std::byte> bytes, const std::string& name) {
    ParsedHeader parsed;
    parseHeader(parsed.header, bytes, name);
    int last = 0;
    for (int c = 0; c < parsed.header.num_channels; ++c) {
        const int component = componentOf(parsed.header.channels[c].name);
        if (component < 3) last = std::max(last, component + 1);
    }
    return last > 0 ? last : 3;
}

Image decodeExr(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    ParsedHeader parsed;
    parseHeader(parsed.header, bytes, name);
    const char* message = nullptr;
    const EXRBox2i& window = parsed.header.data_window;
    const std::int64_t width = std::int64_t(window.max_x) - window.min_x + 1;
    const std::int64_t height = std::int64_t(window.max_y) - window.min_y + 1;
    checkSize(width, height, name, limits);
    if (parsed.header.tiled) return decodeTiled(bytes, name);
    for (int c = 0; c < parsed.header.num_channels; ++c) {
        if (parsed.header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT) fail(name, "it has integer channels");
        parsed.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    LoadedImage loaded;
    const int code = LoadEXRImageFromMemory(&loaded.image, &parsed.header, asChars(bytes), bytes.size(), &message);
    if (code != TINYEXR_SUCCESS) {
        InitEXRImage(
            &loaded.image);  // tinyexr 1.0.1 has freed the list of planes (not the planes: a leak) and left its pointer
        fail(name, takeMessage(message));
    }
    if (!loaded.image.images) fail(name, "it has no scan lines");
    return interleave(parsed.header, loaded.image);
}

std::vector<std::byte> encodeExr(const Image& image) {
    assert(image.width > 0 && image.height > 0);
    const auto channels = static_cast<std::size_t>(formatInfo(image.format).channels);
    const std::size_t count = std::size_t(image.width) * image.height;
    const auto stride = static_cast<std::size_t>(formatInfo(image.format).bytesPerPixel);
    std::vector<std::vector<float>> planes(channels, std::vector<float>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 value = decodePixel(image.format, image.pixels.data() + i * stride);
        // Channels are stored in the order of their names: A, B, G, R.
        for (std::size_t c = 0; c < channels; ++c) planes[channels - 1 - c][i] = value[static_cast<int>(c)];
    }
    std::vector<unsigned char*> pointers;
    for (std::vector<float>& plane : planes) pointers.push_back(reinterpret_cast<unsigned char*>(plane.data()));
    std::vector<EXRChannelInfo> infos(channels);
    std::vector<int> types(channels, TINYEXR_PIXELTYPE_FLOAT);
    constexpr std::string_view kComponents = "RGBA";
    for (std::size_t c = 0; c < channels; ++c) infos[c].name[0] = kComponents[channels - 1 - c];

    EXRHeader header;  // points into the vectors above, so it is not freed by tinyexr
    InitEXRHeader(&header);
    header.num_channels = static_cast<int>(channels);
    header.channels = infos.data();
    header.pixel_types = types.data();
    header.requested_pixel_types = types.data();
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    EXRImage exr;
    InitEXRImage(&exr);
    exr.num_channels = static_cast<int>(channels);
    exr.images = pointers.data();
    exr.width = static_cast<int>(image.width);
    exr.height = static_cast<int>(image.height);

    unsigned char* data = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&exr, &header, &data, &message);
    const std::unique_ptr<unsigned char, decltype(&std::free)> owner(data, &std::free);
    if (size == 0) throw RenderError("writing an EXR failed: " + takeMessage(message));
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    return {begin, begin + size};
}

}  // namespace crevice
