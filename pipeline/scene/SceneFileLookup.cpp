// Files of a scene document are looked up in its folder, then in the allowed roots.
#include "scene/SceneFileLookup.h"

#include <fmt/format.h>

#include "core/Files.h"

namespace crevice {

namespace fs = std::filesystem;

std::optional<fs::path> findSceneFile(const Value& name, const fs::path& folder, const LoadOptions& options,
                                      std::string_view what, Problems& problems) {
    std::vector<fs::path> roots = options.allowedRoots;
    roots.insert(roots.begin(), folder);
    const AssetRoots allowed(roots);
    for (const fs::path& root : roots) {
        const fs::path path = root / name.string();
        std::error_code error;
        if (!fs::is_regular_file(path, error)) continue;
        if (options.allowOutside || allowed.contains(path)) return path;
        problems.error(name.where(), fmt::format("'{}' lies outside the scene's folder", name.string()),
                       fmt::format("put {} beside the scene document or below it", what));
        return std::nullopt;
    }
    problems.error(name.where(), fmt::format("no file '{}'", name.string()),
                   "the path is relative to the scene document");
    return std::nullopt;
}

}  // namespace crevice
