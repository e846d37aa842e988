// Textures to CPU images and back.
#pragma once

#include <cstdint>

#include "core/Image.h"
#include "gfx/Buffer.h"
#include "gfx/Commands.h"
#include "gfx/Texture.h"

namespace crevice {

class Device;

/// Reads one mip of one layer now and waits. The texture is in `state` before and after; it needs usage TransferSource.
Image readTexture(Device& device, const GpuTexture& texture, TextureState state, std::uint32_t mip = 0,
                  std::uint32_t layer = 0);

/// Fills one mip of one layer now and waits. The image must have the texture's format and the mip's size (asserted).
/// The texture's old contents are lost when `from` is Undefined; it ends in `to` and needs usage TransferDest.
void uploadTexture(Device& device, const GpuTexture& texture, const Image& image,
                   TextureState from = TextureState::Undefined, TextureState to = TextureState::Sampled,
                   std::uint32_t mip = 0, std::uint32_t layer = 0);

/// A texture from an image: Sampled usage, in state Sampled; with `mips`, all mips by halving.
GpuTexture makeTexture(Device& device, const Image& image, bool mips, const std::string& name);

/// A host buffer that is kept from frame to frame: record the copy with the frame's commands, take the image after they
/// ran.
class Readback {
public:
    explicit Readback(Device& device) : device_(device) {}
    /// The texture is in TransferSource.
    void record(Commands& commands, const GpuTexture& texture, std::uint32_t mip = 0, std::uint32_t layer = 0);
    /// What the last record() copied; its commands must have been waited for.
    Image image() const;

private:
    Device& device_;
    Buffer buffer_;
    std::uint32_t width_ = 0, height_ = 0;
    Format format_ = Format::RGBA8;
};

}  // namespace crevice
