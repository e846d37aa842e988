// The folders behind a project's and an engine's path.
#include "cocos/Roots.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

fs::path orItself(const fs::path& folder, const fs::path& below) {
    std::error_code error;
    return !folder.empty() && fs::is_directory(folder / below, error) ? folder / below : folder;
}

}  // namespace

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
