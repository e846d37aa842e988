// The parts of a glTF that importing its prefab and its pictures needs; the meshes are the loader's.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "core/Document.h"
#include "core/Image.h"
#include "core/Limits.h"

namespace crevice::cocos {

struct GltfJson {
    std::vector<std::byte> bytes{};  ///< The whole file.
    Value json{};
    std::span<const std::byte> binary{};  ///< The second chunk of a .glb, in `bytes`.
};

/// A .gltf or .glb. Throws Error: it cannot be read, or its JSON is broken.
GltfJson readGltfJson(const std::filesystem::path& path, const Limits& limits);

/// A picture that is stored in the binary chunk of a .glb. Throws Error: there is none of that number, or it lies
/// elsewhere.
Image readEmbeddedPicture(const std::filesystem::path& path, int index, const Limits& limits);

}  // namespace crevice::cocos
