// Folders are walked, roots are guessed from paths where the options leave them out.
#include "app/commands/EffectPaths.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cocos/assets/Project.h"
#include "cocos/files/FolderWalk.h"
#include "core/Error.h"
#include "core/Files.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

fs::path existingFolder(const char* option, const std::string& path) {
    std::error_code error;
    if (path.empty() || fs::is_directory(path, error)) return path;
    throw Error(fmt::format("{}: no folder '{}'", option, path), "name a folder that exists");
}

bool liesIn(const fs::path& path, const fs::path& folder) {
    if (folder.empty()) return false;
    std::error_code error;
    const fs::path relative = fs::weakly_canonical(path, error).lexically_relative(fs::weakly_canonical(folder, error));
    return !relative.empty() && *relative.begin() != "..";
}

std::vector<std::string> effectsBelow(const fs::path& folder) {
    std::vector<std::string> found;
    std::size_t entries = 0;
    const auto keep = [&](const fs::directory_entry& file) {
        std::error_code error;
        if (file.path().extension() == ".effect" && file.is_regular_file(error)) found.push_back(file.path().string());
    };
    if (cocos::walkFiles(folder, entries, keep) == cocos::WalkEnd::TooMany)
        throw Error(fmt::format("'{}' holds more than {} files", folder.string(), cocos::kMaxWalkedEntries),
                    "name a smaller folder");
    std::sort(found.begin(), found.end());
    // Links may give one file several names.
    std::set<fs::path> real;
    std::erase_if(found, [&](const std::string& path) {
        std::error_code error;
        return !real.insert(fs::weakly_canonical(path, error)).second;
    });
    if (found.empty())
        throw Error(fmt::format("no .effect file below '{}'", folder.string()),
                    "name a folder that holds .effect files, or one of them");
    return found;
}

/// The part of a path up to `editor/assets`, which every engine checkout has; empty when there is none.
fs::path engineOf(const fs::path& path) {
    std::error_code error;
    for (fs::path at = fs::weakly_canonical(path, error); at.has_relative_path(); at = at.parent_path())
        if (at.filename() == "assets" && at.parent_path().filename() == "editor") return at;
    return {};
}

}  // namespace

void addCocosOptions(CLI::App& command, CocosOptions& options) {
    command.add_option("--chunks", options.chunks, "Folder of Cocos chunks, searched first (repeatable)")
        ->type_name("DIR")
        ->allow_extra_args(false);
    command.add_option("--engine", options.engine, "A Cocos engine checkout: its effects and chunks")->type_name("DIR");
    command.add_option("--project", options.project, "A Cocos project: its effects and chunks")->type_name("DIR");
}

std::vector<std::string> expandEffects(const std::vector<std::string>& words, const AssetRoots& own) {
    std::vector<std::string> effects;
    for (const std::string& word : words) {
        std::error_code error;
        if (!fs::is_directory(word, error) || own.find(AssetKind::Effect, word)) {
            effects.push_back(word);
            continue;
        }
        const auto below = effectsBelow(word);
        effects.insert(effects.end(), below.begin(), below.end());
    }
    return effects;
}

bool readsCocos(const CocosOptions& options, const std::vector<std::string>& effects, const AssetRoots& own) {
    if (options.given()) return true;
    return std::any_of(effects.begin(), effects.end(), [&](const std::string& effect) {
        return effect.ends_with(".effect") && !own.contains(effect) &&
               (!engineOf(effect).empty() || cocos::findProjectFolder(effect));
    });
}

cocos::Roots cocosRoots(const CocosOptions& options, const std::vector<std::string>& effects) {
    cocos::Roots roots;
    for (const std::string& folder : options.chunks) roots.chunks.push_back(existingFolder("--chunks", folder));
    roots.engine = cocos::engineFolder(existingFolder("--engine", options.engine));
    roots.project = existingFolder("--project", options.project);
    for (const std::string& effect : effects) {
        if (!effect.ends_with(".effect")) continue;
        const fs::path engine = engineOf(effect);
        if (roots.engine.empty()) roots.engine = engine;
        if (roots.project.empty() && engine.empty())
            roots.project = cocos::findProjectFolder(effect).value_or(fs::path());
        std::vector<fs::path> known = roots.assetFolders();
        known.insert(known.end(), roots.chunks.begin(), roots.chunks.end());
        const bool inside =
            std::any_of(known.begin(), known.end(), [&](const fs::path& folder) { return liesIn(effect, folder); });
        std::error_code error;
        if (!inside && fs::is_regular_file(effect, error)) roots.chunks.push_back(fs::absolute(effect).parent_path());
    }
    return roots;
}

}  // namespace crevice
