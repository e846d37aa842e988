// What Cocos' compiler demands of uniforms: blocks without holes, no arrays of blocks, nothing outside of blocks.
#pragma once

#include "cocos/interface/Interface.h"

namespace crevice::cocos {

/// An array of blocks is an error. A member that std140 moves is a warning: Crevice uploads by the compiled offsets,
/// but Cocos' runtime sums the sizes of the members.
void checkBlock(const InterfaceDeclaration& block, Problems& problems);

/// vec4 registers that a stage's blocks take, of all branches, as Cocos counts them: each member rounded up; arrays
/// whose size a macro decides at run time are left out.
std::int64_t uniformVectors(const StageInterface& stage);

/// A uniform of a type that is no sampler, texture or image, outside of a block.
void reportLooseUniform(const SourceLoc& where, Problems& problems);

}  // namespace crevice::cocos
