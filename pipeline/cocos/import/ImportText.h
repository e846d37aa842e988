// JSON for people: what fits into a line stands in one.
#pragma once

#include <string>

#include "core/Document.h"

namespace crevice::cocos {

/// Objects and lists whose text has at most `width` columns are written in one line. Ends with a newline.
std::string readableJson(const Value& value, std::size_t width = 120);

}  // namespace crevice::cocos
