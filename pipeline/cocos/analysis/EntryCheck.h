// Mistakes in "program:entry" that the compiler would report in a line that nobody wrote.
#pragma once

#include <string_view>

#include "core/Error.h"
#include "effect/VariantBuilder.h"

namespace crevice::cocos {

/// An error at `where` (the pass) when the stage's text has no function of the entry's name, or none that returns what
/// a stage's result is made of. Text that pastes names together, or returns a macro, is left to the compiler.
void checkEntry(std::string_view text, const ProgramReference& program, ShaderStageBits stage, const SourceLoc& where,
                Problems& problems);

}  // namespace crevice::cocos
