// References are resolved here and nowhere else, so that a missing asset is reported in one way.
#include "cocos/assets/Project.h"

#include <system_error>

#include <fmt/format.h>

#include "cocos/files/TakeOver.h"
#include "cocos/files/Uuid.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

bool isFolder(const fs::path& path) {
    std::error_code failed;
    return fs::is_directory(path, failed);
}

bool isFile(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed);
}

std::string searched(const Roots& roots) {
    if (roots.project.empty() && roots.engine.empty()) return "name the folders: --project DIR --engine DIR";
    if (roots.engine.empty()) return "assets of the engine are found with --engine DIR";
    if (roots.project.empty()) return "assets of the project are found with --project DIR";
    return fmt::format("searched: '{}' and '{}'", roots.projectAssets().string(), roots.engineAssets().string());
}

}  // namespace

std::optional<fs::path> findProjectFolder(const fs::path& file) {
    std::error_code failed;
    fs::path folder = fs::absolute(file, failed).lexically_normal().parent_path();
    for (; !failed; folder = folder.parent_path()) {
        if (isFolder(folder / "assets") && isFile(folder / "package.json")) return folder;
        if (folder == folder.parent_path()) break;
    }
    return std::nullopt;
}

Project::Project(Roots roots, EffectReader effects, Problems& problems)
    : roots_(std::move(roots)), effects_(std::move(effects)) {
    metas_ = MetaIndex::build(roots_.assetFolders(), problems);
}

const MetaAsset* Project::find(const AssetRef& ref, const std::string& what, Problems& problems) const {
    if (!normalizeUuid(ref.uuid)) {
        problems.error(ref.where, fmt::format("'{}' of {} is no uuid", ref.uuid, what),
                       "uuids have 36 characters, or 22 in their short form");
        return nullptr;
    }
    if (const MetaAsset* asset = metas_.findNearest(ref.uuid)) return asset;
    problems.error(ref.where, fmt::format("no .meta has the uuid '{}' of {}", ref.uuid, what), searched(roots_));
    return nullptr;
}

const Mtl* Project::material(const AssetRef& ref, const std::string& what, Problems& problems) {
    const MetaAsset* asset = find(ref, what, problems);
    if (!asset) return nullptr;
    if (asset->path.extension() != ".mtl") {
        problems.error(ref.where, fmt::format("{} is '{}', which is no material", what, asset->path.string()),
                       "name a .mtl file");
        return nullptr;
    }
    auto [known, isNew] = materials_.try_emplace(asset->path);
    if (!isNew) return known->second.get();
    Problems inside;
    try {
        Mtl mtl = readMtl(asset->path, inside);
        if (!inside.hasErrors()) known->second = std::make_unique<Mtl>(std::move(mtl));
    } catch (const Error& error) {
        problems.add(error);
    }
    takeOver(inside, problems);
    return known->second.get();
}

const MetaAsset* Project::effectFile(const Mtl& mtl, Problems& problems) const {
    if (!mtl.effect) {
        problems.error(mtl.where, fmt::format("material '{}' names no effect", mtl.name),
                       R"(set '_effectAsset' to { "__uuid__": "…" })");
        return nullptr;
    }
    const MetaAsset* asset = find(mtl.effect, fmt::format("the effect of material '{}'", mtl.name), problems);
    if (!asset || asset->path.extension() == ".effect") return asset;
    problems.error(mtl.effect.where,
                   fmt::format("the effect of material '{}' is '{}', which is none", mtl.name, asset->path.string()),
                   "name an .effect file");
    return nullptr;
}

const EffectAsset* Project::effect(const fs::path& path, Problems& problems) {
    auto [known, isNew] = effectAssets_.try_emplace(path);
    if (!isNew) return known->second.get();
    Problems inside;
    try {
        EffectAsset asset = effects_(path, effectName(path), inside);
        if (!inside.hasErrors()) known->second = std::make_unique<EffectAsset>(std::move(asset));
    } catch (const Error& error) {
        problems.add(error);
    }
    if (inside.hasErrors()) takeOver(inside, problems);
    return known->second.get();
}

std::string Project::effectName(const fs::path& path) const {
    for (const fs::path& root : roots_.assetFolders()) {
        const fs::path relative = path.lexically_normal().lexically_relative(root.lexically_normal());
        if (relative.empty() || *relative.begin() == "..") continue;
        std::string name = fs::path(relative).replace_extension().generic_string();
        if (name.starts_with("effects/")) name.erase(0, 8);
        return name;
    }
    return path.stem().string();
}

std::optional<fs::path> Project::findEffect(const std::string& name) const {
    for (const fs::path& root : roots_.assetFolders()) {
        for (const fs::path& path : {root / "effects" / (name + ".effect"), root / (name + ".effect")}) {
            if (isFile(path)) return path;
        }
    }
    return std::nullopt;
}

}  // namespace crevice::cocos
