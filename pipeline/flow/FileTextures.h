// Pictures that a document's full-screen stages name by their files, each uploaded once.
#pragma once

#include <map>
#include <string>

#include "gfx/Sampler.h"
#include "gfx/Texture.h"

namespace crevice {

class Device;

/// "material" of a stage under a Cocos profile may name a picture: what has an ending is no keyword.
bool isPictureFile(const std::string& texture);

/// A picture's name with how it is sampled behind a '#': "noise.png#nearest,clamp". Words: linear (as without any),
/// nearest, nearest-min, nearest-mag; repeat (as without any), clamp, mirror, clamp-u, clamp-v, mirror-u, mirror-v.
struct PictureName {
    std::string file{};
    SamplerKey sampler{};
};
/// A '#' in the name of a file that exists is its own. Throws Error for an unknown word.
PictureName readPictureName(const std::string& texture);

class FileTextures {
public:
    explicit FileTextures(Device& device) : device_(device) {}
    /// PNG, JPEG, WebP or EXR, texels as they are stored. `texture`: as readPictureName() takes it. Throws Error when
    /// the file cannot be read.
    const GpuTexture& get(const std::string& texture);

private:
    Device& device_;
    std::map<std::string, GpuTexture> textures_;
};

}  // namespace crevice
