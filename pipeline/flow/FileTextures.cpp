// Reads and uploads on first use.
#include "flow/FileTextures.h"

#include <filesystem>

#include "core/Image.h"
#include "gfx/Device.h"
#include "gfx/Readback.h"

namespace crevice {

bool isPictureFile(const std::string& texture) { return std::filesystem::path(texture).has_extension(); }

const GpuTexture& FileTextures::get(const std::string& path) {
    const auto known = textures_.find(path);
    if (known != textures_.end()) return known->second;
    return textures_.emplace(path, makeTexture(device_, readImage(path), false, path)).first->second;
}

}  // namespace crevice
