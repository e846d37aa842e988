// Pictures that a document's full-screen stages name by their files, each uploaded once.
#pragma once

#include <map>
#include <string>

#include "gfx/Texture.h"

namespace crevice {

class Device;

/// "material" of a stage under a Cocos profile may name a picture: what has an ending is no keyword.
bool isPictureFile(const std::string& texture);

class FileTextures {
public:
    explicit FileTextures(Device& device) : device_(device) {}
    /// PNG, JPEG, WebP or EXR, texels as they are stored. Throws Error when the file cannot be read.
    const GpuTexture& get(const std::string& path);

private:
    Device& device_;
    std::map<std::string, GpuTexture> textures_;
};

}  // namespace crevice
