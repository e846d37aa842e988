// Where a Cocos project keeps its files, and where the engine it was made with keeps its own.
#pragma once

#include <filesystem>
#include <vector>

namespace crevice::cocos {

/// Folders of the user's own machine; all are read, none is written. An empty path = not given.
struct Roots {
    std::vector<std::filesystem::path> chunks;  ///< Searched for chunks before all others, first match wins.
    std::filesystem::path project;              ///< A project folder (it holds `assets/`), or its assets folder itself.
    std::filesystem::path engine;               ///< An engine checkout (it holds `editor/assets/`), or that folder.

    /// PROJECT/assets where it exists, else the project folder itself; empty when none is given.
    std::filesystem::path projectAssets() const;
    /// ENGINE/editor/assets where it exists, else the engine folder itself; empty when none is given.
    std::filesystem::path engineAssets() const;
    /// The given folders that hold assets, project before engine: where effects, materials and metas are looked up.
    std::vector<std::filesystem::path> assetFolders() const;
    /// The folders below which `#include <a/b>` is `a/b.chunk`: `chunks`, the project's assets/chunks and assets, the
    /// same of the engine, and the project's extensions.
    std::vector<std::filesystem::path> chunkFolders() const;
};

/// The engine that a user means: a folder that holds `editor/assets`, or an installed editor's
/// `resources/3d/engine` below the given one; or the engine around it, when it is `editor` or lies within. Else the
/// given folder itself.
std::filesystem::path engineFolder(const std::filesystem::path& given);

}  // namespace crevice::cocos
