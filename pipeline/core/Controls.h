// Text from input made fit for a terminal.
#pragma once

#include <string>

namespace crevice {

/// Control characters as '?', line ends and tabs excepted: input may hold terminal escapes, and a message must not
/// replay them.
std::string withoutControls(std::string text);

}  // namespace crevice
