// A parsed .effect file in Cocos' format: a YAML header with techniques and passes, GLSL programs, properties.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/Document.h"
#include "core/RenderState.h"

namespace crevice {

struct EffectProperty {
    std::string name;
    Value
        value;  ///< Number, array of 2-4 numbers, or a texture keyword (white, black, grey, normal); null = none given.
    std::string target;   ///< Uniform it feeds, with an optional swizzle; empty = its own name.
    bool linear = false;  ///< Colours given in sRGB are converted.
    Value sampler;        ///< Filter and address modes of a texture property as written; null = none given.
    double min = -std::numeric_limits<double>::infinity();  ///< editor.range
    double max = std::numeric_limits<double>::infinity();
    std::string help;  ///< editor.tooltip
    SourceLoc where;
};

struct EffectPass {
    std::string vertex, fragment, compute;  ///< "program" or "program:entry"
    SourceLoc vertexWhere, fragmentWhere, computeWhere;
    std::string phase = "default";
    std::string
        passName;  ///< Cocos' `pass`: a render graph's pass; empty or "default" = drawn by the pipelines we read.
    int priority = 128;
    std::vector<EffectProperty> properties;
    std::optional<int> propertyIndex;
    std::map<std::string, std::string> embeddedMacros;
    std::string switchMacro;
    RenderState state;
    SourceLoc where;
};

struct EffectTechnique {
    std::string name;
    std::vector<EffectPass> passes;
};

struct EffectProgram {
    std::string text;
    int firstLine = 1;  ///< Line of the file on which `text` begins.
};

struct EffectAsset {
    std::string name;  ///< Name under effects/, without ending.
    std::string path;
    std::vector<EffectTechnique> techniques;
    std::map<std::string, EffectProgram, std::less<>> programs;
    SourceLoc where;
};

/// Strict reading: an unknown key is an error; Tolerant (Cocos' own files): unknown keys and states without effect are
/// skipped.
enum class EffectReading { Strict, Tolerant };

/// Collects into `problems`; the result is usable only when it has no errors.
EffectAsset parseEffect(std::string_view text, const std::string& name, const std::string& path, Problems& problems,
                        EffectReading reading = EffectReading::Strict);

}  // namespace crevice
