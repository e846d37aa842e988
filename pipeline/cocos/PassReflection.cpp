// A pass with its states in the engine's numbers.
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "cocos/Reflection.h"
#include "core/StateNames.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

using Names = std::span<const char* const>;

constexpr std::array kShadeNames = {"gourand", "flat"};

/// A word of the list as its place in it; everything else stays.
Value numbered(const Value& value, Names names) {
    if (!value.isString()) return value;
    const std::string word = lowerCase(value.string());
    for (std::size_t i = 0; i < names.size(); ++i)
        if (word == names[i]) return Value::makeInteger(static_cast<std::int64_t>(i));
    return value;
}

Value colorMask(const Value& value) {
    static const std::map<std::string, int> kBits = {{"none", 0}, {"r", 1}, {"g", 2}, {"b", 4}, {"a", 8}, {"all", 15}};
    if (!value.isString()) return value;
    const auto it = kBits.find(lowerCase(value.string()));
    return it == kBits.end() ? value : Value::makeInteger(it->second);
}

Value dynamicStates(const Value& value) {
    static const std::map<std::string, int> kBits = {{"line_width", 1},          {"depth_bias", 2},
                                                     {"blend_constants", 4},     {"depth_bounds", 8},
                                                     {"stencil_write_mask", 16}, {"stencil_compare_mask", 32}};
    if (!value.isArray()) return value;
    std::int64_t bits = 0;
    for (const Value& item : value.items())
        if (item.isString())
            if (const auto it = kBits.find(lowerCase(item.string())); it != kBits.end()) bits |= it->second;
    return Value::makeInteger(bits);
}

Value rasterizerState(const Value& written) {
    Value out = Value::makeObject();
    for (const Member& member : written.members()) {
        if (member.key == "cullMode")
            out.set(member.key, numbered(member.value, kCullNames));
        else if (member.key == "polygonMode")
            out.set(member.key, numbered(member.value, kPolygonNames));
        else if (member.key == "shadeModel")
            out.set(member.key, numbered(member.value, kShadeNames));
        else
            out.set(member.key, member.value);
    }
    return out;
}

Value depthStencilState(const Value& written) {
    Value out = Value::makeObject();
    for (const Member& member : written.members()) {
        const std::string& key = member.key;
        const bool compare = key == "depthFunc" || key.starts_with("stencilFunc");
        const bool operation = key.find("Op") != std::string::npos;
        const Value value = compare     ? numbered(member.value, kCompareNames)
                            : operation ? numbered(member.value, kStencilNames)
                                        : member.value;
        const bool both = key.starts_with("stencil") && !key.ends_with("Front") && !key.ends_with("Back");
        for (const char* side : {"Front", "Back"}) {
            // Written out for a face, a value wins over the shorthand for both.
            if (both && written.find(key + side) == nullptr) out.set(key + side, value);
        }
        if (!both) out.set(key, value);
    }
    return out;
}

Value blendTarget(const Value& written) {
    Value out = Value::makeObject();
    for (const Member& member : written.members()) {
        const std::string& key = member.key;
        const bool equation = key == "blendEq" || key == "blendAlphaEq";
        const bool factor = !equation && (key.starts_with("blendSrc") || key.starts_with("blendDst"));
        out.set(key, equation                  ? numbered(member.value, kBlendOpNames)
                     : factor                  ? numbered(member.value, kBlendFactorNames)
                     : key == "blendColorMask" ? colorMask(member.value)
                                               : member.value);
    }
    return out;
}

Value blendState(const Value& written) {
    Value out = Value::makeObject();
    for (const Member& member : written.members()) {
        if (member.key != "targets" || !member.value.isArray()) {
            out.set(member.key, member.value);
            continue;
        }
        Value targets = Value::makeArray();
        for (const Value& target : member.value.items())
            targets.items().push_back(target.isObject() ? blendTarget(target) : target);
        out.set("targets", std::move(targets));
    }
    return out;
}

Value stageQueue(const Value& value) {
    if (!value.isString()) return value;
    const std::string word = lowerCase(value.string());
    return word == "default" ? Value::makeInteger(100) : word == "ui" ? Value::makeInteger(200) : value;
}

}  // namespace

Value reflectPass(const Value& pass, const std::string& program, int priority, const UniformTypes& uniforms) {
    static constexpr std::array kAsWritten = {"phase",  "pass",          "subpass",       "subphase",
                                              "switch", "propertyIndex", "embeddedMacros"};
    Value out = Value::makeObject();
    for (const Member& member : pass.members()) {
        const std::string& key = member.key;
        const Value& value = member.value;
        if (std::find(kAsWritten.begin(), kAsWritten.end(), key) != kAsWritten.end())
            out.set(key, value);
        else if (key == "rasterizerState" && value.isObject())
            out.set(key, rasterizerState(value));
        else if (key == "depthStencilState" && value.isObject())
            out.set(key, depthStencilState(value));
        else if (key == "blendState" && value.isObject())
            out.set(key, blendState(value));
        else if (key == "primitive")
            out.set(key, numbered(value, kTopologyNames));
        else if (key == "dynamicStates")
            out.set(key, dynamicStates(value));
        else if (key == "stage")
            out.set(key, stageQueue(value));
        else if (key == "priority")
            out.set(key, Value::makeInteger(priority));
        else if (key == "properties" && value.isObject())
            out.set(key, reflectProperties(value, uniforms));
    }
    out.set("program", Value::makeString(program));
    return out;
}

}  // namespace crevice::cocos
