// Walks asset folders once.
#include "cocos/files/FileIndex.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/Error.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

std::string_view baseOf(std::string_view name) { return name.substr(name.rfind('/') + 1); }

/// "a/effects/b/c" → "b/c"; without such a folder the name itself.
std::string publicName(const std::string& name) {
    if (name.starts_with("effects/")) return name.substr(8);
    const auto at = name.rfind("/effects/");
    return at == std::string::npos ? name : name.substr(at + 9);
}

}  // namespace

FileIndex::FileIndex(const std::vector<fs::path>& folders, const std::string& ending) {
    std::size_t seen = 0;
    for (std::size_t folder = 0; folder < folders.size(); ++folder) {
        const std::size_t first = entries_.size();
        const auto keep = [&](const fs::directory_entry& file) {
            const std::string& path = file.path().native();
            std::error_code error;
            if (!baseOf(path).ends_with(ending) || !file.is_regular_file(error)) return;
            // The walk writes the folder's own name in front of every path.
            std::string_view name = std::string_view(path).substr(folders[folder].native().size());
            while (name.starts_with('/')) name.remove_prefix(1);
            name.remove_suffix(ending.size());
            entries_.push_back({std::string(name), file.path(), folder});
        };
        if (walkFiles(folders[folder], seen, keep) == WalkEnd::TooMany)
            throw Error(fmt::format("the folder '{}' holds more than {} files", folders[folder].string(), kMaxFiles),
                        "name a project or engine folder, not one above it");
        std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first), entries_.end(),
                  [](const Entry& a, const Entry& b) { return a.name < b.name; });
    }
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        byName_.emplace(entries_[i].name, i);
        byBase_.emplace(baseOf(entries_[i].name), i);
    }
}

const FileIndex::Entry* FileIndex::find(std::string_view name) const {
    const auto it = byName_.find(name);
    return it == byName_.end() ? nullptr : &entries_[it->second];
}

std::vector<const FileIndex::Entry*> FileIndex::endingWith(std::string_view name) const {
    std::vector<const Entry*> found;
    const std::string tail = "/" + std::string(name);
    const auto [first, last] = byBase_.equal_range(baseOf(name));
    std::size_t folder = entries_.size() + 1;
    for (auto it = first; it != last; ++it) {
        const Entry& entry = entries_[it->second];
        if (entry.name != name && !entry.name.ends_with(tail)) continue;
        if (entry.folder < folder) found.clear();
        if (entry.folder > folder) continue;
        folder = entry.folder;
        // Links may give one file several names.
        const auto same = [&](const Entry* other) {
            std::error_code error;
            return other->path == entry.path || fs::equivalent(other->path, entry.path, error);
        };
        if (std::none_of(found.begin(), found.end(), same)) found.push_back(&entry);
    }
    return found;
}

std::vector<std::string> FileIndex::names() const {
    std::vector<std::string> all;
    for (const auto& [name, index] : byName_) all.push_back(name);
    return all;
}

EffectNames::EffectNames(const Roots& roots) : folders_(roots.assetFolders()), files_(folders_, ".effect") {
    std::error_code error;
    for (fs::path& folder : folders_) folder = fs::weakly_canonical(folder, error);
    for (std::size_t i = 0; i < files_.entries().size(); ++i) named_.emplace(publicName(files_.entries()[i].name), i);
}

std::optional<fs::path> EffectNames::find(std::string_view name) const {
    if (const auto it = named_.find(name); it != named_.end()) return files_.entries()[it->second].path;
    if (const auto* entry = files_.find(name)) return entry->path;
    return std::nullopt;
}

std::optional<fs::path> EffectNames::findShort(std::string_view name) const {
    const auto found = files_.endingWith(name);
    if (found.size() != 1) return std::nullopt;
    return found.front()->path;
}

std::optional<std::string> EffectNames::nameOf(const fs::path& path) const {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(path, error);
    for (const fs::path& folder : folders_) {
        const fs::path relative = real.lexically_relative(folder);
        if (relative.empty() || *relative.begin() == "..") continue;
        std::string name = relative.generic_string();
        if (name.ends_with(".effect")) name.resize(name.size() - 7);
        return publicName(name);
    }
    return std::nullopt;
}

std::vector<std::string> EffectNames::names() const {
    std::vector<std::string> all;
    for (const auto& [name, index] : named_) all.push_back(name);
    return all;
}

}  // namespace crevice::cocos
