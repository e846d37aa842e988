// Which effects a command's words name: names, .effect files, whole folders; and where Cocos' own files are looked up.
#pragma once

#include <string>
#include <vector>

#include "cocos/files/Roots.h"

namespace CLI {
class App;
}

namespace crevice {

class AssetRoots;

/// --chunks, --engine, --project.
struct CocosOptions {
    std::vector<std::string> chunks;
    std::string engine, project;
    bool given() const { return !chunks.empty() || !engine.empty() || !project.empty(); }
};
void addCocosOptions(CLI::App& command, CocosOptions& options);

/// The effects behind the words. A folder that is no effect's name stands for all .effect files below it, sorted.
/// Throws Error for a folder without effects or with too many files.
std::vector<std::string> expandEffects(const std::vector<std::string>& words, const AssetRoots& own);

/// Effects written in Cocos' dialect: the options say so, or a path lies in no folder of ours.
bool readsCocos(const CocosOptions& options, const std::vector<std::string>& effects, const AssetRoots& own);

/// The options' folders. A file's own folder counts as one of chunks when it lies in none of them; an engine is
/// recognised by `editor/assets` in a path.
cocos::Roots cocosRoots(const CocosOptions& options, const std::vector<std::string>& effects);

}  // namespace crevice
