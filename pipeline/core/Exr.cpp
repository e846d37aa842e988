// EXR through OpenEXR, which is made for hostile files: full floats, zip compression.
#include "core/Exr.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfVersion.h>
#include <fmt/format.h>

#include "core/Error.h"

namespace crevice {
namespace {

constexpr int kThreads = 0;  // besides the caller's
constexpr std::size_t kMaxChannels = 64;

/// Bytes as a file to OpenEXR, which reports its own failures and ours alike by exceptions.
class BytesIn final : public Imf::IStream {
public:
    BytesIn(std::span<const std::byte> bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char to[], int count) override {
        if (count < 0 || std::size_t(count) > bytes_.size() - at_) throw std::runtime_error("it ends too early");
        std::memcpy(to, bytes_.data() + at_, std::size_t(count));
        at_ += std::size_t(count);
        return at_ < bytes_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override {
        if (position > bytes_.size()) throw std::runtime_error("it ends too early");
        at_ = position;
    }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

class BytesOut final : public Imf::OStream {
public:
    BytesOut() : OStream("memory") {}
    void write(const char from[], int count) override {
        const std::size_t end = at_ + std::size_t(count);
        if (end > bytes.size()) bytes.resize(end);
        std::memcpy(bytes.data() + at_, from, std::size_t(count));
        at_ = end;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    std::vector<std::byte> bytes;

private:
    std::size_t at_ = 0;
};

[[noreturn]] void fail(const std::string& name, const std::string& reason) {
    throw Error(fmt::format("cannot read '{}' as EXR: {}", name, reason),
                "write it again as single-part EXR with channels R, G, B, A");
}

ExrSize checkSize(const Imath::Box2i& window, const std::string& name, const Limits& limits) {
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
    const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
    const std::int64_t side = limits.maxImageSide;
    if (width < 1 || height < 1) fail(name, fmt::format("its size is {} x {}", width, height));
    if (width > side || height > side)
        throw Error(fmt::format("the EXR '{}' has {} x {} pixels, the limit is {} a side", name, width, height, side),
                    raiseLimit("image-side"));
    if (std::uint64_t(width) * std::uint64_t(height) > limits.maxImagePixels)
        throw Error(
            fmt::format("the EXR '{}' has {} x {} pixels, the limit is {}", name, width, height, limits.maxImagePixels),
            raiseLimit("image-pixels"));
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

std::size_t countChannels(const Imf::ChannelList& channels) {
    std::size_t count = 0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) ++count;
    return count;
}

/// Runs `read`; whatever OpenEXR throws becomes an Error.
template <class Read>
auto inOurWords(const std::string& name, Read read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        std::string reason = error.what();
        while (!reason.empty() && (reason.back() == '\n' || reason.back() == '.')) reason.pop_back();
        fail(name, reason);
    }
}

/// OpenEXR makes room for as many bytes as an attribute says it has: here they must be there. An attribute is a name, a
/// type (both end in a zero) and a size; an empty name ends the header.
void checkAttributes(std::span<const std::byte> bytes, std::size_t at, const std::string& name) {
    const auto skipWord = [&] {
        const std::size_t begin = at;
        while (at < bytes.size() && bytes[at] != std::byte{0}) ++at;
        if (at++ >= bytes.size()) fail(name, "its header is cut off");
        return at - begin - 1;
    };
    while (skipWord() > 0) {
        skipWord();
        std::uint32_t size = 0;
        if (bytes.size() - at < sizeof size) fail(name, "its header is cut off");
        std::memcpy(&size, bytes.data() + at, sizeof size);
        at += sizeof size;
        if (size > bytes.size() - at) fail(name, "an attribute of its header reaches beyond the file");
        at += size;
    }
}

/// Read on its own and judged before OpenEXR makes room for lines and tiles. Layout: magic number, version and flags,
/// attributes ("OpenEXR File Layout").
Imf::Header readHeader(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    constexpr std::size_t kAttributes = 8;
    std::int32_t version = 0;
    if (bytes.size() < kAttributes) fail(name, "its header is damaged");
    std::memcpy(&version, bytes.data() + 4, sizeof version);
    if (Imf::isMultiPart(version) || Imf::isNonImage(version)) fail(name, "it has several parts or deep pixels");
    checkAttributes(bytes, kAttributes, name);
    return inOurWords(name, [&] {
        BytesIn stream(bytes, name);
        stream.seekg(kAttributes);
        Imf::Header header;
        header.readFrom(stream, version);
        checkSize(header.dataWindow(), name, limits);
        if (countChannels(header.channels()) > kMaxChannels)
            fail(name, fmt::format("it has more than {} channels", kMaxChannels));
        return header;
    });
}

/// Which component a channel is: the last part of its name, "diffuse.R" → 0; -1 for others.
int componentOf(std::string_view name) {
    if (const std::size_t dot = name.rfind('.'); dot != std::string_view::npos) name.remove_prefix(dot + 1);
    constexpr std::string_view kComponents = "RGBA";
    return name.size() == 1 ? static_cast<int>(kComponents.find(name.front())) : -1;
}

/// Colours go where they belong in RGBA pixels; a single channel that is no colour goes to red.
Imf::FrameBuffer placeChannels(const Imf::Header& header, ExrSize size, const std::string& name,
                               std::vector<glm::vec4>& pixels) {
    const Imf::ChannelList& channels = header.channels();
    const Imath::V2i corner = header.dataWindow().min;
    constexpr std::size_t kPixel = sizeof(glm::vec4);
    const bool single = countChannels(channels) == 1;
    Imf::FrameBuffer buffer;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const Imf::Channel& info = channel.channel();
        const int component = componentOf(channel.name());
        if (component < 0 && !single) continue;
        if (info.type == Imf::UINT) fail(name, "it has integer channels");
        if (info.xSampling != 1 || info.ySampling != 1) fail(name, "its channels have fewer pixels than the image");
        // OpenEXR counts pixels from the data window's corner, wherever that lies.
        const auto* base =
            reinterpret_cast<const char*>(pixels.data()) + std::size_t(std::max(component, 0)) * sizeof(float);
        buffer.insert(channel.name(),
                      Imf::Slice::Make(Imf::FLOAT, base, corner, size.width, size.height, kPixel, kPixel * size.width));
    }
    if (buffer.begin() == buffer.end()) fail(name, "it has no channel R, G, B or A");
    return buffer;
}

}  // namespace

bool looksLikeExr(std::span<const std::byte> bytes) {
    constexpr std::array<unsigned char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
    return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

ExrSize exrSize(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    return checkSize(readHeader(bytes, name, limits).dataWindow(), name, limits);
}

int exrColourChannels(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    const Imf::Header header = readHeader(bytes, name, limits);
    int last = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        const int component = componentOf(channel.name());
        if (component < 3) last = std::max(last, component + 1);
    }
    return last > 0 ? last : 3;
}

Image decodeExr(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
    const ExrSize size = exrSize(bytes, name, limits);
    return inOurWords(name, [&] {
        BytesIn stream(bytes, name);
        Imf::InputFile file(stream, kThreads);
        std::vector<glm::vec4> pixels(std::size_t(size.width) * size.height, glm::vec4(0, 0, 0, 1));
        file.setFrameBuffer(placeChannels(file.header(), size, name, pixels));
        const Imath::Box2i window = file.header().dataWindow();
        file.readPixels(window.min.y, window.max.y);
        const Imf::ChannelList& channels = file.header().channels();
        if (countChannels(channels) == 1 && componentOf(channels.begin().name()) < 0)
            for (glm::vec4& pixel : pixels) pixel = {pixel.r, pixel.r, pixel.r, 1.0f};
        Image image(size.width, size.height, Format::RGBA32F);
        std::memcpy(image.pixels.data(), pixels.data(), image.pixels.size());
        return image;
    });
}

std::vector<std::byte> encodeExr(const Image& image) try {
    assert(image.width > 0 && image.height > 0);
    const auto channels = static_cast<std::size_t>(formatInfo(image.format).channels);
    const std::size_t count = std::size_t(image.width) * image.height;
    const auto stride = static_cast<std::size_t>(formatInfo(image.format).bytesPerPixel);
    std::vector<float> values(count * channels);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec4 value = decodePixel(image.format, image.pixels.data() + i * stride);
        for (std::size_t c = 0; c < channels; ++c) values[i * channels + c] = value[static_cast<int>(c)];
    }
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    constexpr std::array kNames = {"R", "G", "B", "A"};
    const std::size_t step = channels * sizeof(float);
    for (std::size_t c = 0; c < channels; ++c) {
        header.channels().insert(kNames[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(kNames[c],
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data() + c), step, step * image.width));
    }
    BytesOut stream;
    {
        Imf::OutputFile file(stream, header, kThreads);
        file.setFrameBuffer(buffer);
        file.writePixels(static_cast<int>(image.height));
    }
    return std::move(stream.bytes);
} catch (const std::exception& error) {
    throw RenderError(fmt::format("writing an EXR failed: {}", error.what()));
}

}  // namespace crevice
