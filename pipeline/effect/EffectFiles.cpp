// Front ends by name, then our own folders, then front ends by the end of a path.
#include "effect/EffectFiles.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Text.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

fs::path findFile(const AssetRoots& roots, const FrontEnds& frontEnds, const std::string& effect,
                  const SourceLoc& where) {
    if (effect.ends_with(".effect")) {
        fs::path path = effect;
        std::error_code error;
        const bool fromDocument = !where.file.empty() && fs::is_regular_file(where.file, error);
        if (fromDocument && path.is_relative()) {
            const fs::path beside = fs::path(where.file).parent_path() / path;
            if (fs::is_regular_file(beside, error)) path = beside;
        }
        if (fromDocument && !roots.contains(path))
            throw Error(where, fmt::format("effect '{}' lies outside of the asset folders", effect),
                        "name an effect below effects/");
        if (!fs::is_regular_file(path, error))
            throw Error(where, fmt::format("no effect file '{}'", effect), "check the spelling of the path");
        return path;
    }
    if (const auto path = roots.find(AssetKind::Effect, effect)) return *path;
    throw Error(where, fmt::format("no effect '{}'", effect),
                didYouMean(effect, effectNames(roots, frontEnds), "effects"));
}

}  // namespace

FoundEffect findEffect(const AssetRoots& roots, const FrontEnds& frontEnds, const std::string& effect,
                       const SourceLoc& where) {
    const bool isPath = effect.ends_with(".effect");
    std::error_code error;
    std::string asked = effect;
    if (isPath && fs::path(effect).is_relative() && !where.file.empty()) {
        const fs::path beside = fs::path(where.file).parent_path() / effect;
        if (fs::is_regular_file(beside, error)) asked = beside.string();
    }
    for (const auto& frontEnd : frontEnds)
        if (auto path = frontEnd->find(asked)) return {std::move(*path), frontEnd.get()};
    if (!isPath && !roots.find(AssetKind::Effect, effect))
        for (const auto& frontEnd : frontEnds)
            if (auto path = frontEnd->findShort(effect)) return {std::move(*path), frontEnd.get()};
    return {findFile(roots, frontEnds, effect, where), nullptr};
}

std::vector<std::string> effectNames(const AssetRoots& roots, const FrontEnds& frontEnds) {
    std::vector<std::string> all = roots.list(AssetKind::Effect);
    for (const auto& frontEnd : frontEnds) {
        const auto more = frontEnd->names();
        all.insert(all.end(), more.begin(), more.end());
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace crevice
