// What Cocos' compiler demands of uniforms: blocks without holes, no arrays of blocks, nothing outside of blocks.
#pragma once

#include "cocos/Interface.h"

namespace crevice::cocos {

/// An array of blocks is an error. A member that std140 moves is a warning: Crevice uploads by the compiled offsets,
/// but Cocos' runtime sums the sizes of the members.
void checkBlock(const InterfaceDeclaration& block, Problems& problems);

/// A uniform of a type that is no sampler, texture or image, outside of a block.
void reportLooseUniform(const SourceLoc& where, Problems& problems);

}  // namespace crevice::cocos
