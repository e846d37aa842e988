// Finds what an #include names, by the five rules of Cocos, and keeps the texts that were read.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cocos/files/FileIndex.h"
#include "cocos/files/Roots.h"
#include "cocos/text/SourceText.h"
#include "effect/EffectAsset.h"

namespace crevice::cocos {

/// Chunks are read once: a file that changes on disk later is not read again.
class ChunkLibrary {
public:
    /// A chunk may have as many bytes, all of them together kMaxTotal.
    static constexpr std::size_t kMaxBytes = 4u << 20;
    static constexpr std::size_t kMaxTotal = 256u << 20;

    explicit ChunkLibrary(const Roots& roots);

    struct Found {
        const SourceText* source = nullptr;
        std::string help;  ///< Why there is none: what was looked for, or what is ambiguous.
    };
    /// `name` as it stands between the brackets, in a text that lies in `folder`:
    /// 1. a CCProgram of the effect; 2. with a '.' in front: relative to the including file, else to a chunk folder,
    /// else rule 5 without the dots; 3. below a chunk folder; 4. relative to the including file; 5. the one chunk whose
    /// path ends with the name. Throws Error for a file that cannot be read.
    Found find(const EffectAsset& effect, const std::string& name, const std::filesystem::path& folder);

    /// True for a file of the engine: its mistakes are not the author's.
    bool isOfEngine(const SourceText& source) const;

private:
    Found findRelative(const EffectAsset& effect, const std::string& name, const std::filesystem::path& folder);
    const SourceText* readFile(const std::filesystem::path& path, const std::string& name);
    std::filesystem::path nameOfSystem(const std::filesystem::path& path);
    const SourceText* readProgram(const EffectAsset& effect, const std::string& name);
    const SourceText* readBeside(const std::string& name, const std::filesystem::path& folder);
    const FileIndex& index();
    bool mayRead(const std::filesystem::path& path, const EffectAsset& effect) const;

    Roots roots_;
    std::filesystem::path engine_;            ///< As the system names it, like those of own_.
    std::vector<std::filesystem::path> own_;  ///< The author's folders.
    std::optional<FileIndex> index_;
    std::map<std::string, std::filesystem::path> realFolders_;
    std::map<std::string, std::unique_ptr<SourceText>> files_;  ///< As the system names them.
    std::map<std::pair<std::string, std::string>, std::unique_ptr<SourceText>> programs_;  ///< By effect path and name.
    std::map<std::string, std::map<std::string, Found>> found_;                            ///< By folder, by name.
    std::size_t bytes_ = 0;
};

/// The name in what follows `#include`: "<name>" or "\"name\"", without an ending; empty = malformed.
std::string_view includedName(std::string_view rest);

}  // namespace crevice::cocos
