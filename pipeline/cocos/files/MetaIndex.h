// Which file a uuid stands for: read once out of all .meta files of a project and of an engine.
#pragma once

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/Document.h"
#include "core/Error.h"

namespace crevice::cocos {

/// An asset, or a part of one (a mesh of a glTF, the texture of an image).
struct MetaAsset {
    std::string uuid;              ///< Normal form (Uuid.h); sub-assets: "parent@id", nested "parent@id@id".
    std::filesystem::path path{};  ///< The file; for a sub-asset that of its outermost parent.
    std::string importer{};        ///< "effect", "material", "gltf-mesh", "image", "texture", …
    std::string name{};            ///< "sphere.mesh"; the file's name when the meta gives none.
    Value userData{};              ///< Object or null: sampler words of textures, gltfIndex of meshes.
    bool isSubAsset() const { return uuid.find('@') != std::string::npos; }
};

class MetaIndex {
public:
    MetaIndex() = default;
    /// Searches folders, first ones win. Broken and duplicate metas are warnings in `problems`, never errors; the rest
    /// of such a file is left out.
    static MetaIndex build(std::span<const std::filesystem::path> roots, Problems& problems);

    /// By uuid in any form; a sub-asset that no meta lists is null even when its parent is known.
    const MetaAsset* find(std::string_view uuid) const;
    /// The same, and for an unlisted sub-asset its nearest listed parent.
    const MetaAsset* findNearest(std::string_view uuid) const;
    /// The asset at a path (not a sub-asset), or null.
    const MetaAsset* findFile(const std::filesystem::path& path) const;
    /// Parts of an asset with one importer ("gltf-mesh"), by the number they have in the file (`gltfIndex`), then uuid.
    std::vector<const MetaAsset*> parts(std::string_view uuid, std::string_view importer) const;

    std::size_t size() const { return assets_.size(); }
    std::size_t fileCount() const { return files_; }

private:
    friend class MetaReader;
    std::map<std::string, MetaAsset, std::less<>> assets_;
    std::map<std::filesystem::path, std::string> byPath_;
    std::size_t files_ = 0;
};

}  // namespace crevice::cocos
