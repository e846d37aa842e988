// What a compiled shader declares and what it really uses: the plain facts that plans, descriptor sets and materials
// are made from.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/Error.h"

namespace crevice {

enum ShaderStageBits : std::uint32_t {
    kVertexBit = 1,
    kFragmentBit = 16,
    kComputeBit = 32
};  // Cocos' and Vulkan's values

struct BindingSlot {
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    bool operator==(const BindingSlot&) const = default;
    auto operator<=>(const BindingSlot&) const = default;
};

/// Names → numbers handed down by the pipeline: set 0 (global) and set 2 (local). A name not listed goes to set 1
/// (material).
using BindingMap = std::map<std::string, BindingSlot, std::less<>>;

enum class ResourceKind : std::uint8_t { UniformBlock, CombinedSampler, StorageBuffer, StorageImage };

struct BlockMember {
    std::string name;
    std::uint32_t offset = 0;       ///< Bytes, std140 / std430.
    std::uint32_t size = 0;         ///< Bytes of the whole member.
    std::string type;               ///< "float", "vec4", "mat4", "int"…
    std::uint32_t arrayCount = 0;   ///< 0 = not an array, or one without an end.
    std::uint32_t arrayStride = 0;  ///< Bytes from one element to the next; 0 = not an array.
};

struct ShaderResource {
    std::string name;  ///< Block name, or the sampler's / image's variable name.
    ResourceKind kind = ResourceKind::UniformBlock;
    BindingSlot slot;
    std::uint32_t count = 1;
    std::uint32_t stages = 0;  ///< ShaderStageBits in which it is declared.
    bool active = false;       ///< Statically used by an entry point: what Vulkan judges, what a plan calls a read.
    bool cube = false;         ///< Samplers: samplerCube.
    bool readOnly = false;     ///< Images and buffers.
    bool writeOnly = false;
    std::uint32_t size = 0;  ///< Blocks: bytes.
    std::vector<BlockMember> members;
    SourceLoc where;     ///< The declaration in the author's file.
    SourceLoc firstUse;  ///< A line that mentions the name outside its declaration, if one was found.
};

struct ShaderVariable {
    std::string name;
    std::uint32_t location = 0;
    std::string type;  ///< "vec3"…
    bool active = false;
};

struct ShaderInfo {
    std::vector<ShaderResource> resources;   ///< Sorted by slot.
    std::vector<ShaderVariable> inputs;      ///< Vertex attributes.
    std::vector<ShaderVariable> outputs;     ///< Fragment outputs.
    std::uint32_t localSize[3] = {1, 1, 1};  ///< Compute.
    /// What the program uses and Crevice does not bind (texel buffers, subpass inputs, …), of effects in another
    /// dialect: they compile, but nothing can be drawn with them.
    std::vector<Problem> refusals;

    const ShaderResource* find(std::string_view name) const;
};

}  // namespace crevice
