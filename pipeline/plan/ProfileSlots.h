// The numbers that names have in sets 0 and 2 before a document adds its own: Crevice's, and those of Cocos' versions.
#pragma once

#include <cstdint>
#include <span>

#include "plan/PipelineDesc.h"

namespace crevice {

enum class GlobalKind : std::uint8_t { UniformBlock, StorageBuffer, Sampler2D, SamplerCube };

struct BuiltInSlot {
    const char* name;
    GlobalKind kind;
    std::uint32_t binding;
    std::uint32_t size;  ///< Uniform blocks: bytes.
};

/// Set 0 of a profile.
struct GlobalNumbers {
    std::span<const BuiltInSlot> builtIns;  ///< Always there.
    std::span<const BuiltInSlot> targets;   ///< Numbers that targets of these names have, where a document has them.
    std::uint32_t firstFree;                ///< Cocos' COUNT: names of the document's own start here.
};
GlobalNumbers globalNumbers(Profile profile);

enum class LocalKind : std::uint8_t { DynamicBlock, Block, Sampler2D, StorageImage };

/// A name of set 2. Several names may share a number: shaders that use either are drawn.
struct LocalSlot {
    const char* name;
    LocalKind kind;
    std::uint32_t binding;
    std::uint32_t size;  ///< Blocks: bytes.
};
std::span<const LocalSlot> localSlots(Profile profile);

}  // namespace crevice
