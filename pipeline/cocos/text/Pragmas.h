// What the pragmas of Cocos' dialects say.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cocos/text/StageText.h"

namespace crevice::cocos {

/// One pragma taken apart. At most one of the members is set; a pragma that says nothing here sets none.
struct Pragma {
    std::optional<StageMacro> meta;  ///< define-meta, and `define` with a describing tail.
    std::optional<PragmaMark> mark;  ///< Without line.
    std::string extension;           ///< "#extension NAME : level", for version 450.
    std::string mistake;             ///< What is wrong with it.
};

/// `rest` is what follows `#pragma`.
Pragma readPragma(std::string_view rest);

/// How a pragma that is written wrongly should look: a help.
std::string_view pragmaExample(std::string_view rest);

/// The input attachment, or with `output` the location, of a subpass pragma among all of a stage. Attachments count
/// over inputs, colours by name and then depth, and behind them over colours that are read and written; locations over
/// these and then over what is only written, as it stands.
int subpassNumber(const std::vector<PragmaMark>& marks, const PragmaMark& mark, bool output);

}  // namespace crevice::cocos
