// Waits for single copies; Readback rides on the frame's own commands.
#include "gfx/Readback.h"

#include <cassert>
#include <cstring>

#include "core/ImageMips.h"
#include "gfx/Device.h"

namespace crevice {

namespace {

std::uint64_t byteSize(const GpuTexture& texture, std::uint32_t mip) {
    return std::uint64_t(texture.width(mip)) * texture.height(mip) *
           static_cast<std::uint64_t>(formatInfo(texture.format()).bytesPerPixel);
}

}  // namespace

Image readTexture(Device& device, const GpuTexture& texture, TextureState state, std::uint32_t mip,
                  std::uint32_t layer) {
    assert(state != TextureState::Undefined && hasUsage(texture.desc().usage, TextureUsage::TransferSource));
    Readback readback(device);
    Commands commands(device, "read '" + texture.desc().name + "'");
    commands.begin();
    const bool moves = state != TextureState::TransferSource;
    if (moves) commands.barrier(texture, state, TextureState::TransferSource);
    readback.record(commands, texture, mip, layer);
    if (moves) commands.barrier(texture, TextureState::TransferSource, state);
    commands.submitAndWait();
    return readback.image();
}

void uploadTexture(Device& device, const GpuTexture& texture, const Image& image, TextureState from, TextureState to,
                   std::uint32_t mip, std::uint32_t layer) {
    assert(image.format == texture.format() && image.width == texture.width(mip) &&
           image.height == texture.height(mip));
    const Buffer staging(device, {.size = image.pixels.size(), .usage = BufferUsage::TransferSource, .name = "staging"},
                         image.pixels);
    Commands commands(device, "upload '" + texture.desc().name + "'");
    commands.begin();
    commands.barrier(texture, from, TextureState::TransferDest);
    commands.copyBufferToTexture(staging, texture, mip, layer);
    if (to != TextureState::TransferDest) commands.barrier(texture, TextureState::TransferDest, to);
    commands.submitAndWait();
}

GpuTexture makeTexture(Device& device, const Image& image, bool mips, const std::string& name) {
    TextureDesc desc;
    desc.format = image.format;
    desc.width = image.width;
    desc.height = image.height;
    desc.mips = mips ? fullMipCount(image.width, image.height) : 1;
    desc.usage = TextureUsage::Sampled | TextureUsage::TransferDest | TextureUsage::TransferSource;
    desc.name = name;
    GpuTexture texture(device, desc);

    std::vector<Image> levels;
    if (mips) levels = makeMips(image);
    std::uint64_t bytes = image.pixels.size();
    for (const Image& level : levels) bytes += level.pixels.size();
    Buffer staging(device, {.size = bytes, .usage = BufferUsage::TransferSource, .name = "staging"});
    Commands commands(device, "upload '" + name + "'");
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::TransferDest);
    std::uint64_t offset = 0;
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip) {
        const Image& level = mip == 0 ? image : levels[mip - 1];
        staging.write(level.pixels, offset);
        commands.copyBufferToTexture(staging, texture, mip, 0, offset);
        offset += level.pixels.size();
    }
    commands.barrier(texture, TextureState::TransferDest, TextureState::Sampled);
    commands.submitAndWait();
    return texture;
}

void Readback::record(Commands& commands, const GpuTexture& texture, std::uint32_t mip, std::uint32_t layer) {
    const std::uint64_t bytes = byteSize(texture, mip);
    if (!buffer_ || buffer_.size() < bytes) {
        buffer_ = Buffer(
            device_,
            {.size = bytes, .usage = BufferUsage::TransferDest, .access = BufferAccess::HostRead, .name = "readback"});
    }
    width_ = texture.width(mip);
    height_ = texture.height(mip);
    format_ = texture.format();
    commands.copyTextureToBuffer(texture, buffer_, mip, layer);
    commands.memoryBarrier();
}

Image Readback::image() const {
    Image image(width_, height_, format_);
    std::memcpy(image.pixels.data(), buffer_.data().data(), image.pixels.size());
    return image;
}

}  // namespace crevice
