// Uploads what scene/EnvironmentCube.h made.
#include "flow/EnvironmentGpu.h"

#include <cmath>
#include <span>

#include "gfx/Device.h"
#include "gfx/Readback.h"
#include "scene/EnvironmentCube.h"

namespace crevice {
namespace {

GpuTexture uploadCube(Device& device, const EnvironmentCube& cube) {
    GpuTexture texture(device, {.format = Format::RGBA16F,
                                .width = cube.size,
                                .height = cube.size,
                                .mips = static_cast<std::uint32_t>(cube.levels.size()),
                                .cube = true,
                                .usage = TextureUsage::Sampled | TextureUsage::TransferDest,
                                .name = "environment"});
    std::uint64_t bytes = 0;
    for (const auto& level : cube.levels) bytes += level.size() * level[0].pixels.size();
    Buffer staging(device, {.size = bytes, .usage = BufferUsage::TransferSource, .name = "staging"});
    Commands commands(device, "upload the environment");
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::TransferDest);
    std::uint64_t offset = 0;
    for (std::uint32_t level = 0; level < cube.levels.size(); ++level) {
        for (std::uint32_t face = 0; face < cube.levels[level].size(); ++face) {
            const Image& image = cube.levels[level][face];
            staging.write(image.pixels, offset);
            commands.copyBufferToTexture(staging, texture, level, face, offset);
            offset += image.pixels.size();
        }
    }
    commands.barrier(texture, TextureState::TransferDest, TextureState::Sampled);
    commands.submitAndWait();
    return texture;
}

}  // namespace

EnvironmentBlock environmentBlock(const Environment& environment, std::uint32_t levels) {
    const auto last = static_cast<float>(levels - 1);
    EnvironmentBlock block;
    block.info = {environment.intensity, last, std::cos(environment.rotation), std::sin(environment.rotation)};
    block.view.x = environmentLevel(environment.blur) * last;
    const ShCoefficients factors = shIrradiancePolynomial(environment.harmonics);
    for (std::size_t i = 0; i < factors.size(); ++i) block.irradiance[i] = glm::vec4(factors[i], 0);
    return block;
}

EnvironmentGpu::EnvironmentGpu(Device& device, const Environment& environment) {
    const auto cube = environment.cube ? environment.cube : cachedEnvironmentCube(environment.radiance, std::nullopt);
    cube_ = uploadCube(device, *cube);
    table_ = makeTexture(device, cube->brdf, false, "environment reflectance");
    const EnvironmentBlock block = environmentBlock(environment, static_cast<std::uint32_t>(cube->levels.size()));
    block_ = Buffer(device, {.size = sizeof block, .usage = BufferUsage::Storage, .name = "environment"},
                    std::as_bytes(std::span(&block, 1)));
}

void EnvironmentGpu::writeNone(GlobalSet& globals, const GlobalLayout& layout) {
    for (const char* name : {"cc_environment", "cc_environmentBrdf", "CCEnvironment"})
        if (layout.find(name)) globals.writeDefault(name);
}

void EnvironmentGpu::write(GlobalSet& globals, const GlobalLayout& layout) const {
    const SamplerKey smooth{.minFilter = Filter::Linear, .magFilter = Filter::Linear, .mipFilter = MipFilter::Linear};
    if (layout.find("cc_environment")) globals.writeImage("cc_environment", cube_, smooth);
    if (layout.find("cc_environmentBrdf"))
        globals.writeImage("cc_environmentBrdf", table_, samplerKey(SamplerKind::LinearClamp));
    if (layout.find("CCEnvironment")) globals.writeBuffer("CCEnvironment", block_);
}

}  // namespace crevice
