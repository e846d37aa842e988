// Which version of Cocos Creator files are of, and which of our profiles that means.
#pragma once

#include <string>

#include "cocos/assets/Rpp.h"
#include "cocos/files/Roots.h"

namespace crevice::cocos {

/// A profile of pipeline documents and how it was chosen.
struct VersionChoice {
    std::string profile{};  ///< "cocos-3.3" or "cocos-3.6"
    std::string reason{};   ///< "version 3.6.1 of ENGINE/package.json"
    bool isV33() const { return profile == "cocos-3.3"; }
};

/// `given` ("3.3.1", "3.6") wins; then the engine's package.json ("version"), the project's ("creator": { "version" }),
/// then the shape of the pipeline: flows GbufferFlow and LightingFlow are 3.3's, MainFlow is of 3.4 and later. 3.0 to
/// 3.3 are "cocos-3.3", later ones "cocos-3.6". Throws Error when `given` is no version.
VersionChoice chooseVersion(const std::string& given, const Roots& roots, const RppPipeline& pipeline);

}  // namespace crevice::cocos
