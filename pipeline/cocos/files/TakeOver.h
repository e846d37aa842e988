// Problems collected aside join those of the caller.
#pragma once

#include "core/Error.h"

namespace crevice::cocos {

/// Appends everything in `own`: warnings and notes too.
void takeOver(const Problems& own, Problems& problems);
/// The same, but what is said twice (a file that is walked twice) is appended once.
void takeOverOnce(const Problems& own, Problems& problems);

}  // namespace crevice::cocos
