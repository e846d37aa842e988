// Where files are found and how they are written: asset roots, confined reads, atomic writes, the cache folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/Error.h"

namespace crevice {

/// What a name may stand for, and thereby its folder and ending below an asset root.
enum class AssetKind {
    Pipeline,  ///< assets/pipelines/NAME.pipeline.json
    Flow,      ///< assets/pipelines/flows/NAME.flow.json
    Effect,    ///< effects/NAME.effect
    Chunk,     ///< effects/chunks/NAME.chunk
    Scene,     ///< assets/scenes/NAME.scene.json
    Material   ///< assets/materials/NAME.mtl.json
};

/// Folders in which assets are looked up by name, first match wins. Names may not leave the root ("..", absolute) .
class AssetRoots {
public:
    explicit AssetRoots(std::vector<std::filesystem::path> roots);
    /// CREVICE_DATA_DIR if set, else the installed share folder beside the library, else the source tree.
    static AssetRoots standard();
    /// A copy for a document that is given by a path (ends in ".json"): its own folder tree is searched before all
    /// others. Its effects and chunks may lie beside it or in effects/; a document that stands in a tree like ours,
    /// ROOT/assets/pipelines/, brings ROOT along. For a name: the same roots.
    AssetRoots forDocument(const std::string& nameOrPath) const;

    std::optional<std::filesystem::path> find(AssetKind kind, std::string_view name) const;
    /// Names of all assets of a kind, sorted, without duplicates: for "did you mean" and `effects list`.
    std::vector<std::string> list(AssetKind kind) const;
    /// Adds a root that is searched before the others.
    void prepend(std::filesystem::path root);
    const std::vector<std::filesystem::path>& roots() const { return roots_; }
    /// True when `path`, links resolved, lies inside one of the roots.
    bool contains(const std::filesystem::path& path) const;

private:
    std::optional<std::filesystem::path> besideDocument(AssetKind kind, std::string_view name) const;

    std::vector<std::filesystem::path> roots_;
    std::optional<std::filesystem::path> documentFolder_;  ///< One of the roots; files may lie in it directly.
};

/// Whole file. Throws Error naming the path and the system's reason, or the limit when it is larger.
std::string readText(const std::filesystem::path& path, std::size_t maxBytes = 64u << 20);
std::vector<std::byte> readBytes(const std::filesystem::path& path, std::size_t maxBytes = std::size_t(4) << 30);

/// Writes aside in the same folder, then renames: the old file stays until the new one is whole. Throws RenderError.
void writeFileAtomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
void writeFileAtomically(const std::filesystem::path& path, std::string_view text);

/// $XDG_CACHE_HOME/crevice or ~/.cache/crevice; nothing when it can be neither found nor made (a read-only home).
std::optional<std::filesystem::path> cacheFolder(std::string_view sub);

/// 128-bit content hash as 32 hex digits (not cryptographic): names cache entries.
std::string contentHash(std::string_view bytes);

}  // namespace crevice
