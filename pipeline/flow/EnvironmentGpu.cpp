// Uploads what scene/EnvironmentCube.h made.
#include "flow/EnvironmentGpu.h"

#include <cmath>
#include <span>

#include "flow/CocosCube.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"
#include "scene/EnvironmentCube.h"

namespace crevice {
namespace {

/// [level][face]
GpuTexture uploadCube(Device& device, const std::vector<std::vector<Image>>& levels) {
    GpuTexture texture(device, {.format = Format::RGBA16F,
                                .width = levels[0][0].width,
                                .height = levels[0][0].height,
                                .mips = static_cast<std::uint32_t>(levels.size()),
                                .cube = true,
                                .usage = TextureUsage::Sampled | TextureUsage::TransferDest,
                                .name = "environment"});
    std::uint64_t bytes = 0;
    for (const auto& level : levels) bytes += level.size() * level[0].pixels.size();
    Buffer staging(device, {.size = bytes, .usage = BufferUsage::TransferSource, .name = "staging"});
    Commands commands(device, "upload the environment");
    commands.begin();
    commands.barrier(texture, TextureState::Undefined, TextureState::TransferDest);
    std::uint64_t offset = 0;
    for (std::uint32_t level = 0; level < levels.size(); ++level) {
        for (std::uint32_t face = 0; face < levels[level].size(); ++face) {
            const Image& image = levels[level][face];
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
    cube_ = uploadCube(device, cube->levels);
    table_ = makeTexture(device, cube->brdf, false, "environment reflectance");
    const EnvironmentBlock block = environmentBlock(environment, static_cast<std::uint32_t>(cube->levels.size()));
    block_ = Buffer(device, {.size = sizeof block, .usage = BufferUsage::Storage, .name = "environment"},
                    std::as_bytes(std::span(&block, 1)));
}

EnvironmentGpu::EnvironmentGpu(Device& device, const Environment& environment, float scale) {
    const auto cube = environment.cube ? environment.cube : cachedEnvironmentCube(environment.radiance, std::nullopt);
    const CocosCubes cubes = cocosCubes(environment, *cube, scale);
    cube_ = uploadCube(device, cubes.mirrored);
    diffuse_ = uploadCube(device, cubes.diffuse);
}

void EnvironmentGpu::writeNone(GlobalSet& globals, const GlobalLayout& layout) {
    for (const char* name : {"cc_environment", "cc_diffuseMap", "cc_environmentBrdf", "CCEnvironment"})
        if (layout.find(name)) globals.writeDefault(name);
}

void EnvironmentGpu::write(GlobalSet& globals, const GlobalLayout& layout) const {
    const SamplerKey smooth{.minFilter = Filter::Linear, .magFilter = Filter::Linear, .mipFilter = MipFilter::Linear};
    if (layout.find("cc_environment")) globals.writeImage("cc_environment", cube_, smooth);
    if (layout.find("cc_diffuseMap")) globals.writeImage("cc_diffuseMap", diffuse_, smooth);
    if (layout.find("cc_environmentBrdf"))
        globals.writeImage("cc_environmentBrdf", table_, samplerKey(SamplerKind::LinearClamp));
    if (layout.find("CCEnvironment")) globals.writeBuffer("CCEnvironment", block_);
}

}  // namespace crevice
