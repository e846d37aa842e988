// A pass with its words in the engine's numbers, by the one rule that Cocos' compiler has for all of them.
#include <array>
#include <charconv>
#include <cmath>
#include <map>

#include "cocos/reflection/Reflection.h"
#include "core/StateNames.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

using Words = std::map<std::string, Value, std::less<>>;

template <std::size_t N>
void addInOrder(Words& words, const std::array<const char*, N>& names) {
    for (std::size_t i = 0; i < N; ++i) words.emplace(names[i], Value::makeInteger(static_cast<std::int64_t>(i)));
}

/// All words of a pass: each means one number wherever it stands.
Words makeWords() {
    Words words;
    addInOrder(words, kBlendFactorNames);
    addInOrder(words, kBlendOpNames);
    addInOrder(words, kStencilNames);
    addInOrder(words, kCompareNames);
    addInOrder(words, kCullNames);
    addInOrder(words, kPolygonNames);
    addInOrder(words, kTopologyNames);
    addInOrder(words, std::array{"gourand", "flat"});
    addInOrder(words, std::array{"none", "point", "linear", "anisotropic"});
    addInOrder(words, std::array{"wrap", "mirror", "clamp", "border"});
    for (const auto& [word, number] : {std::pair("line_width", 1),
                                       {"depth_bias", 2},
                                       {"blend_constants", 4},
                                       {"depth_bounds", 8},
                                       {"stencil_write_mask", 16},
                                       {"stencil_compare_mask", 32},
                                       {"default", 100},
                                       {"ui", 200}})
        words.emplace(word, Value::makeInteger(number));
    for (int mask = 1; mask < 15; ++mask) words.emplace(colorMaskWord(mask), Value::makeInteger(mask));
    words.emplace("all", Value::makeInteger(15));
    words.emplace("true", Value::makeBool(true));
    words.emplace("false", Value::makeBool(false));
    return words;
}

/// A number at the front, as JavaScript's parseInt() reads it; else a word of the table; else what it is.
Value mapWord(const Value& value) {
    static const Words kWords = makeWords();
    const std::string word = lowerCase(value.string());
    std::string_view digits(word);
    const bool hex = digits.starts_with("0x");
    std::int64_t number = 0;
    if (hex) digits.remove_prefix(2);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), number, hex ? 16 : 10).ec == std::errc{})
        return Value::makeInteger(number);
    const auto it = kWords.find(word);
    return it == kWords.end() ? value : it->second;
}

/// Numbers of a list are a colour: a byte each, red in front.
Value packColor(const Value& list) {
    std::uint32_t color = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Value* item = i < list.items().size() ? &list.items()[i] : nullptr;
        double part = item != nullptr && item->isNumber() ? item->number() : 0;
        if (!(std::abs(part) < 1e9)) part = 0;
        if (i == 3 && part == 0) part = 255;  // as the engine has it
        color |= static_cast<std::uint32_t>(static_cast<std::int64_t>(part * 255)) << (24 - 8 * i);
    }
    return Value::makeInteger(color);
}

Value mapAny(const Value& value) {
    if (value.isString()) return mapWord(value);
    if (value.isObject()) {
        Value out = Value::makeObject();
        for (const Member& member : value.members()) out.set(member.key, mapAny(member.value));
        return out;
    }
    if (!value.isArray() || value.items().empty()) return value;
    if (value.items().front().isNumber()) return packColor(value);
    Value out = Value::makeArray();
    for (const Value& item : value.items()) out.items().push_back(mapAny(item));
    return out;
}

/// A key without a face is for both, whatever else is written.
Value bothFaces(const Value& written) {
    Value out = Value::makeObject();
    const auto isShort = [](const std::string& key) {
        return key.starts_with("stencil") && !key.ends_with("Front") && !key.ends_with("Back");
    };
    for (const Member& member : written.members())
        if (!isShort(member.key)) out.set(member.key, member.value);
    for (const Member& member : written.members())
        for (const char* side : {"Front", "Back"})
            if (isShort(member.key)) out.set(member.key + side, member.value);
    return out;
}

}  // namespace

Value reflectPass(const Value& pass, const std::string& program, int priority, const UniformTypes& uniforms) {
    Value out = Value::makeObject();
    for (const Member& member : pass.members()) {
        const std::string& key = member.key;
        const Value& value = member.value;
        if (key == "vert" || key == "frag" || key == "compute" || key == "migrations") continue;
        if (key == "depthStencilState" && value.isObject())
            out.set(key, mapAny(bothFaces(value)));
        else if (key == "priority")
            out.set(key, Value::makeInteger(priority));
        else if (key == "switch")
            out.set(key, value);
        else if (key == "properties" && value.isObject())
            out.set(key, reflectProperties(value, uniforms));
        else if (key != "properties")
            out.set(key, mapAny(value));
    }
    out.set("program", Value::makeString(program));
    return out;
}

}  // namespace crevice::cocos
