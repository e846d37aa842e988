// Looks assets up by name below a list of folders, which no name can leave.
#include <algorithm>
#include <cstdlib>
#include <set>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/Files.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

struct KindPlace {
    const char* folder;
    const char* ending;
};

KindPlace placeOf(AssetKind kind) {
    switch (kind) {
        case AssetKind::Pipeline:
            return {"assets/pipelines", ".pipeline.json"};
        case AssetKind::Flow:
            return {"assets/pipelines/flows", ".flow.json"};
        case AssetKind::Effect:
            return {"effects", ".effect"};
        case AssetKind::Chunk:
            return {"effects/chunks", ".chunk"};
        case AssetKind::Scene:
            return {"assets/scenes", ".scene.json"};
        case AssetKind::Material:
            return {"assets/materials", ".mtl.json"};
    }
    return {"", ""};
}

/// A name is words between single slashes; none of them leads upwards.
bool isSafeName(std::string_view name) {
    if (name.empty() || name.find('\0') != std::string_view::npos || name.find('\\') != std::string_view::npos) {
        return false;
    }
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string_view part = name.substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return false;
        begin = end + 1;
    }
    return true;
}

bool isInside(const fs::path& path, const fs::path& root) {
    std::error_code failed;
    const fs::path realRoot = fs::canonical(root, failed);
    if (failed) return false;
    const fs::path realPath = fs::weakly_canonical(path, failed);
    if (failed) return false;
    const auto [rootEnd, ignored] = std::mismatch(realRoot.begin(), realRoot.end(), realPath.begin(), realPath.end());
    return rootEnd == realRoot.end();
}

/// share/crevice of the installation that holds this code: beside lib, or one higher for lib/ARCHITECTURE.
std::optional<fs::path> installedShare() {
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&installedShare), &info) == 0 || !info.dli_fname) return std::nullopt;
    std::error_code failed;
    const fs::path folder = fs::canonical(info.dli_fname, failed).parent_path();
    if (failed) return std::nullopt;
    for (const char* up : {"..", "../.."}) {
        const fs::path share = (folder / up / "share/crevice").lexically_normal();
        if (fs::is_directory(share, failed)) return share;
    }
    return std::nullopt;
}

enum class Depth { Tree, OneFolder };

/// The names of a kind below one root. Folders that cannot be read hold nothing.
void collectNames(const fs::path& root, const KindPlace& place, std::set<std::string>& names,
                  Depth depth = Depth::Tree) {
    const std::string ending = place.ending;
    const fs::path folder = root / place.folder;
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        if (depth == Depth::OneFolder) entry.disable_recursion_pending();
        std::error_code ignored;
        if (!entry->is_regular_file(ignored)) continue;
        std::string name = entry->path().lexically_relative(folder).generic_string();
        if (!name.ends_with(ending)) continue;
        name.resize(name.size() - ending.size());
        if (isSafeName(name)) names.insert(std::move(name));
    }
}

}  // namespace

AssetRoots::AssetRoots(std::vector<fs::path> roots) : roots_(std::move(roots)) {}

AssetRoots AssetRoots::standard() {
    if (const char* named = std::getenv("CREVICE_DATA_DIR"); named && *named) {
        std::error_code failed;
        if (!fs::is_directory(named, failed)) {
            throw Error(fmt::format("CREVICE_DATA_DIR names '{}', which is not a folder", named),
                        "set it to the folder that holds assets/ and effects/, or unset it");
        }
        return AssetRoots({fs::path(named)});
    }
    if (auto share = installedShare()) return AssetRoots({*std::move(share)});
    return AssetRoots({fs::path(CREVICE_SOURCE_DIR)});
}

AssetRoots AssetRoots::forDocument(const std::string& nameOrPath) const {
    AssetRoots roots = *this;
    if (!nameOrPath.ends_with(".json")) return roots;
    const fs::path folder = (fs::path(nameOrPath).parent_path() / ".").lexically_normal();
    if (documentFolder_ == folder) return roots;
    std::error_code failed;
    const fs::path whole = fs::absolute(folder / ".", failed).lexically_normal().parent_path();
    if (!failed && whole.filename() == "pipelines" && whole.parent_path().filename() == "assets") {
        roots.prepend((folder / "../..").lexically_normal());
    }
    roots.prepend(folder);
    roots.documentFolder_ = folder;
    return roots;
}

std::optional<fs::path> AssetRoots::besideDocument(AssetKind kind, std::string_view name) const {
    if (!documentFolder_ || (kind != AssetKind::Effect && kind != AssetKind::Chunk)) return std::nullopt;
    fs::path path = (*documentFolder_ / (std::string(name) + placeOf(kind).ending)).lexically_normal();
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored) || !contains(path)) return std::nullopt;
    return path;
}

std::optional<fs::path> AssetRoots::find(AssetKind kind, std::string_view name) const {
    if (!isSafeName(name)) return std::nullopt;
    if (auto beside = besideDocument(kind, name)) return beside;
    const KindPlace place = placeOf(kind);
    for (const fs::path& root : roots_) {
        fs::path path = root / place.folder / (std::string(name) + place.ending);
        std::error_code ignored;
        if (fs::is_regular_file(path, ignored) && contains(path)) return path;
    }
    return std::nullopt;
}

std::vector<std::string> AssetRoots::list(AssetKind kind) const {
    std::set<std::string> names;
    for (const fs::path& root : roots_) collectNames(root, placeOf(kind), names);
    if (documentFolder_ && (kind == AssetKind::Effect || kind == AssetKind::Chunk)) {
        collectNames(*documentFolder_, {"", placeOf(kind).ending}, names, Depth::OneFolder);
    }
    return {names.begin(), names.end()};
}

void AssetRoots::prepend(fs::path root) { roots_.insert(roots_.begin(), std::move(root)); }

bool AssetRoots::contains(const fs::path& path) const {
    return std::any_of(roots_.begin(), roots_.end(), [&](const fs::path& root) { return isInside(path, root); });
}

}  // namespace crevice
