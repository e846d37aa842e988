// The lines in front of a stage's text.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "cocos/CocosEffects.h"
#include "cocos/analysis/StageAnalysis.h"
#include "cocos/text/EngineMacros.h"

namespace crevice::cocos {
namespace {

/// Chunks use 32-bit vectors of integers without asking for them (`u32vec4 a_joints`).
constexpr std::string_view kAlways = "#extension GL_EXT_shader_explicit_arithmetic_types_int32 : require";

bool isInteger(std::string_view text) {
    long long value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

std::string valueOf(const DefineInfo& info, const std::string& given) {
    if (given == "true") return "1";
    if (given == "false") return "0";
    if (given.empty() || (info.type == DefineType::Number && !isInteger(given))) return info.defaultValue;
    return given;
}

bool defines(const StageText& stage, const std::string& name) {
    return std::binary_search(stage.defined.begin(), stage.defined.end(), name);
}

/// What a second stage knows of a macro: of several descriptions the last that says something holds, as within a stage,
/// and what one of them compares is a number.
void join(StageMacro& macro, const StageMacro& other) {
    const bool tested = macro.info.tested || other.info.tested;
    const bool inferred = macro.inferred || other.inferred;
    const bool says = (other.info.type != DefineType::Bool && !other.inferred) || other.hasDefault;
    if (other.info.described && (says || !macro.info.described)) {
        macro.info = other.info;
        macro.inferred = other.inferred;
        macro.hasDefault = other.hasDefault;
        macro.constant = other.constant;
    }
    macro.info.tested = tested;
    if (inferred) inferNumber(macro);
}

}  // namespace

std::vector<StageMacro> joinMacros(const std::vector<StageText>& stages) {
    std::vector<StageMacro> joined;
    for (const StageText& stage : stages) {
        for (const StageMacro& macro : stage.macros) {
            const auto same = std::find_if(joined.begin(), joined.end(),
                                           [&](const StageMacro& other) { return other.info.name == macro.info.name; });
            if (same == joined.end())
                joined.push_back(macro);
            else
                join(*same, macro);
        }
    }
    return joined;
}

std::vector<StageMacro> mergeMacros(const std::vector<StageText>& stages) {
    std::vector<StageMacro> merged = joinMacros(stages);
    for (StageMacro& macro : merged)
        if (const auto value = engineDefault(macro.info.name); !value.empty()) macro.info.defaultValue = value;
    return merged;
}

std::string makeHead(const StageText& stage, const std::vector<StageMacro>& macros, const Defines& values) {
    std::string head = "#version 450\n";
    head.append(kAlways).push_back('\n');
    for (const std::string& extension : stage.extensions)
        if (!extension.starts_with("#extension GL_EXT_shader_explicit_arithmetic_types_int32"))
            head.append(extension).push_back('\n');
    for (const auto& [name, standard] : engineConstants()) {
        const auto given = values.find(name);
        if (!defines(stage, name))
            head += fmt::format("#define {} {}\n", name,
                                given == values.end() ? standard : valueOf(DefineInfo{}, given->second));
    }
    for (const StageMacro& macro : macros) {
        const auto given = values.find(macro.info.name);
        if (defines(stage, macro.info.name)) continue;
        const std::string value = given == values.end() ? macro.info.defaultValue : valueOf(macro.info, given->second);
        // `#ifndef SURFACE_HAS_OWN` asks for a definition, not for a value.
        const bool onlyIfDefined = !macro.info.tested && !macro.info.described && value == "0";
        if (!onlyIfDefined) head += fmt::format("#define {} {}\n", macro.info.name, value);
    }
    return head;
}

}  // namespace crevice::cocos
