// The effects and chunks below a set of folders, by full name, by the end of their path, by base name.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cocos/files/FolderWalk.h"
#include "cocos/files/Roots.h"

namespace crevice::cocos {

/// Files of one ending, behind links too (see FolderWalk.h). Folders are walked once; at most kMaxFiles entries are
/// seen.
class FileIndex {
public:
    static constexpr std::size_t kMaxFiles = kMaxWalkedEntries;

    /// Names are paths below a folder without the ending; the first folder that has a name wins. Throws Error when the
    /// folders hold more than kMaxFiles entries.
    FileIndex(const std::vector<std::filesystem::path>& folders, const std::string& ending);

    struct Entry {
        std::string name;
        std::filesystem::path path;
        std::size_t folder = 0;  ///< Which of the folders it was found in.
    };
    const std::vector<Entry>& entries() const { return entries_; }

    const Entry* find(std::string_view name) const;
    /// Entries whose name is `name` or ends with "/NAME", those of the first folder that has any, each file once.
    std::vector<const Entry*> endingWith(std::string_view name) const;
    std::vector<std::string> names() const;

private:
    std::vector<Entry> entries_;
    std::map<std::string, std::size_t, std::less<>> byName_;
    std::multimap<std::string, std::size_t, std::less<>> byBase_;
};

/// Effects by Cocos' names: below a folder called effects/ the path behind it, else the path below the assets folder.
class EffectNames {
public:
    explicit EffectNames(const Roots& roots);

    std::optional<std::filesystem::path> find(std::string_view name) const;
    /// By the end of the path, when one file alone has it.
    std::optional<std::filesystem::path> findShort(std::string_view name) const;
    /// The name of a file that lies in one of the folders, or nothing.
    std::optional<std::string> nameOf(const std::filesystem::path& path) const;
    std::vector<std::string> names() const;

private:
    std::vector<std::filesystem::path> folders_;
    FileIndex files_;
    std::map<std::string, std::size_t, std::less<>> named_;
};

}  // namespace crevice::cocos
