// The folders behind a project's and an engine's path.
#include "cocos/files/Roots.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

fs::path orItself(const fs::path& folder, const fs::path& below) {
    std::error_code error;
    return !folder.empty() && fs::is_directory(folder / below, error) ? folder / below : folder;
}

bool holdsAssets(const fs::path& folder) {
    std::error_code error;
    return fs::is_directory(folder / "editor" / "assets", error);
}

}  // namespace

fs::path engineFolder(const fs::path& given) {
    if (given.empty() || holdsAssets(given)) return given;
    for (const char* below :
         {"resources/3d/engine", "resources/resources/3d/engine", "Contents/Resources/resources/3d/engine"})
        if (holdsAssets(given / below)) return given / below;
    std::error_code error;
    for (fs::path at = fs::weakly_canonical(given, error); at.has_relative_path(); at = at.parent_path())
        if (at.filename() == "editor" && holdsAssets(at.parent_path())) return at.parent_path();
    return given;
}

fs::path Roots::projectAssets() const { return orItself(project, "assets"); }

fs::path Roots::engineAssets() const { return orItself(engine, fs::path("editor") / "assets"); }

std::vector<fs::path> Roots::assetFolders() const {
    std::vector<fs::path> folders;
    for (const fs::path& folder : {projectAssets(), engineAssets()})
        if (!folder.empty()) folders.push_back(folder);
    return folders;
}

std::vector<fs::path> Roots::chunkFolders() const {
    std::vector<fs::path> folders = chunks;
    std::error_code error;
    for (const fs::path& assets : assetFolders()) {
        if (fs::is_directory(assets / "chunks", error)) folders.push_back(assets / "chunks");
        folders.push_back(assets);
    }
    if (!project.empty() && fs::is_directory(project / "extensions", error)) folders.push_back(project / "extensions");
    return folders;
}

}  // namespace crevice::cocos
