// What a flattened stage says about macros: which are asked of the outside, which conditions every line stands under,
// which definitions hold for the whole stage.
#pragma once

#include "cocos/flatten/Flattener.h"
#include "cocos/text/StageText.h"

namespace crevice::cocos {

/// Puts `#pragma define`s in front of the text, as #define lines; a name that is defined differently in several
/// branches keeps their conditions. Fills macros and conditions. Reports macros that GLSL's preprocessor could not
/// expand in bounded memory. Functions that `entry` (empty = main) does not reach are taken out, and what their
/// conditions and pragmas say of macros is not heard. `others` are described by the pass' other stages: words that they
/// may stand for here too.
StageText analyzeStage(ShaderStageBits stage, Flattened flattened, std::string_view entry,
                       const std::vector<DefineInfo>& others, Problems& problems);

/// A macro that is compared and has no tag is a number from 0 to 3 for Cocos' compiler; others stay as they are.
void inferNumber(StageMacro& macro);

}  // namespace crevice::cocos
