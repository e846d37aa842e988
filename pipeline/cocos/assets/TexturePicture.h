// The picture behind a texture asset: parts of models name pictures elsewhere in the project.
#pragma once

#include "cocos/assets/Project.h"

namespace crevice::cocos {

/// The asset of the file that holds the picture: the one that `imageUuidOrDatabaseUri` of a texture names by uuid or as
/// "db://assets/…" (project) or "db://internal/…" (engine), else the texture itself. Pictures that are stored inside of
/// a model have the model's path.
const MetaAsset& pictureOf(const MetaAsset& texture, const Project& project);

}  // namespace crevice::cocos
