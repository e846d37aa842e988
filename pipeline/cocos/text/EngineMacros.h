// The macros that the engine itself gives to every shader, with values that suit a frame without the feature.
#pragma once

#include <string_view>

#include "effect/Defines.h"

namespace crevice::cocos {

/// Constants of the device and the pipeline: always defined, never listed among a shader's macros. The values are those
/// of a desktop device without input attachments and clustered lights; a request may give others.
const Defines& engineConstants();

/// The value of an engine macro that nobody sets, where it is not the first of its range: fog is `none`.
/// Empty = the macro's own default.
std::string_view engineDefault(std::string_view name);

}  // namespace crevice::cocos
