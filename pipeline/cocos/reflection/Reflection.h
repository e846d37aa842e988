// What Cocos' own effect compiler says of an effect, in its key names and enum numbers: the JSON that the engine loads.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cocos/interface/Interface.h"
#include "core/Document.h"

namespace crevice::cocos {

/// One shader: name, builtins with statistics, defines, attributes, blocks with members, samplerTextures, samplers,
/// textures, buffers, images and subpassInputs, each with the macros that enclose it, its stages and Cocos' own
/// binding. `stages` as the front end makes them, before numberStages(). What the engine derives and cannot be told
/// from the rules is absent: `hash`.
Value reflectShader(const std::string& name, const std::vector<StageText>& stages, Problems& problems);

/// Cocos' `Type` of the uniforms that a shader's properties may feed: members of its material blocks and its samplers.
using UniformTypes = std::map<std::string, int, std::less<>>;
UniformTypes uniformTypesOf(const Value& shader);

/// One pass of a CCEffect header as written, with enums as numbers, shorthands written out, `program` for its shader,
/// and every property with its type and handle; uniforms that properties feed component by component get a property of
/// their own with the merged defaults. Keys that only the editor reads are left out.
Value reflectPass(const Value& pass, const std::string& program, int priority, const UniformTypes& uniforms);

/// The properties of a pass alone.
Value reflectProperties(const Value& properties, const UniformTypes& uniforms);

/// Filter, address modes and the rest of a property's `sampler` packed as the engine packs them.
std::int64_t samplerHash(const Value& sampler);

}  // namespace crevice::cocos
