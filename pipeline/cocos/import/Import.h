// A Cocos pipeline (.rpp) with its materials, written as one of our pipeline documents: readable, and meant to be
// edited.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cocos/assets/Project.h"
#include "cocos/assets/Rpp.h"
#include "cocos/assets/Version.h"

namespace crevice::cocos {

/// What the importer has to know of a registered stage class.
struct StageFacts {
    std::string name{};
    std::vector<std::string> params{};  ///< Keys of "params".
    std::vector<std::string> writes{};  ///< Images it declares to write, in order.
};

struct ImportRequest {
    std::filesystem::path rpp{};
    std::vector<StageFacts> classes{};  ///< The registered ones.
    std::string version{};              ///< "3.3.1"; empty = found out.
};

struct ImportedPipeline {
    std::string name{};
    std::string text{};  ///< The document.
    VersionChoice version{};
};

/// Throws Error when the file is no pipeline; other errors (unknown classes, missing assets) are collected, and the
/// text is to be used only when there are none. What is left out or changed is a note in `problems` and a "help" beside
/// it.
ImportedPipeline importPipeline(const ImportRequest& request, Project& project, Problems& problems);

}  // namespace crevice::cocos
