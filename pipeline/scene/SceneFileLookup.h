// Where the files that a scene document names may lie.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/Document.h"
#include "scene/GltfLoader.h"

namespace crevice {

/// The file that a string of a document in `folder` names: there or in an allowed root, and inside of it unless the
/// options say otherwise. Nothing, with an error at the value's place, when there is none. `what` stands in messages:
/// "the glTF".
std::optional<std::filesystem::path> findSceneFile(const Value& name, const std::filesystem::path& folder,
                                                   const LoadOptions& options, std::string_view what,
                                                   Problems& problems);

}  // namespace crevice
