// One short text that changes with every file an effect may be made of, and with the program that reads them.
#pragma once

#include <string>

#include "cocos/files/Roots.h"

namespace crevice::cocos {

/// Over the paths, sizes and times of all .effect and .chunk files below the roots; of those written within the last
/// seconds, whose time may not change once more, over their content. Also over the program's own file: rules of an
/// older build answer nothing. Empty when a folder cannot be walked.
std::string fingerprintOf(const Roots& roots);

}  // namespace crevice::cocos
