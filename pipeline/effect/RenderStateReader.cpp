// Reads the fixed-function states of a pass. Names and defaults are Cocos'.
#include "effect/RenderStateReader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/StateNames.h"
#include "core/Text.h"

namespace crevice {
namespace {

template <class Enum>
struct Named {
    const char* name;
    Enum value;
};

template <class Enum, std::size_t N>
constexpr std::array<Named<Enum>, N> inOrder(const std::array<const char*, N>& names) {
    std::array<Named<Enum>, N> table{};
    for (std::size_t i = 0; i < N; ++i) table[i] = {names[i], static_cast<Enum>(i)};
    return table;
}

constexpr auto kCompareOps = inOrder<CompareOp>(kCompareNames);
constexpr auto kStencilOps = inOrder<StencilOp>(kStencilNames);
constexpr auto kCullModes = inOrder<CullMode>(kCullNames);
constexpr auto kBlendFactors = inOrder<BlendFactor>(kBlendFactorNames);
constexpr auto kBlendOps = inOrder<BlendOp>(kBlendOpNames);
/// In Cocos' order, which is not that of the enum.
constexpr std::array<Named<PolygonMode>, 3> kPolygonModes = {
    {{"fill", PolygonMode::Fill}, {"point", PolygonMode::Point}, {"line", PolygonMode::Line}}};
constexpr std::array<Named<Topology>, 6> kTopologies = {{{"point_list", Topology::PointList},
                                                         {"line_list", Topology::LineList},
                                                         {"line_strip", Topology::LineStrip},
                                                         {"triangle_list", Topology::TriangleList},
                                                         {"triangle_strip", Topology::TriangleStrip},
                                                         {"triangle_fan", Topology::TriangleFan}}};
constexpr std::array<Named<std::uint8_t>, 6> kColorMasks = {
    {{"none", 0}, {"r", 1}, {"g", 2}, {"b", 4}, {"a", 8}, {"all", 15}}};

template <class Enum, std::size_t N>
std::vector<std::string> wordsOf(const std::array<Named<Enum>, N>& names) {
    std::vector<std::string> words;
    for (const auto& named : names) words.emplace_back(named.name);
    return words;
}

template <class Enum, std::size_t N>
void readEnum(KeyReader& reader, const char* key, const std::array<Named<Enum>, N>& names, Enum& out) {
    const Value* value = reader.find(key);
    if (value == nullptr || value->isNull()) return;
    if (!value->isString()) {
        // Cocos' own files may hold the number behind the name.
        const bool known = !reader.strict() && value->isInteger() && value->integer() >= 0 && value->integer() < int(N);
        if (known)
            out = names[std::size_t(value->integer())].value;
        else if (value->isNumber() && !reader.strict())
            reader.problems().error(value->where(), fmt::format("{} is no value for '{}'", value->toJson(-1), key),
                                    "numbers count these from 0: " + join(wordsOf(names)));
        else
            reader.string(key);
        return;
    }
    const std::string word = lowerCase(value->string());
    for (const auto& named : names) {
        if (word == named.name) {
            out = named.value;
            return;
        }
    }
    reader.problems().error(value->where(), fmt::format("'{}' is no value for '{}'", value->string(), key),
                            didYouMean(word, wordsOf(names), "values"));
}

void readBool(KeyReader& reader, const char* key, bool& out) {
    if (const Value* value = reader.find(key); value != nullptr && value->isNumber() && !reader.strict()) {
        out = value->number() != 0;
        return;
    }
    if (const Value* value = reader.boolean(key)) out = value->boolean();
}

/// A state that Crevice does not have: fine at its default, an error otherwise (skipped in Cocos' own files).
void expectDefault(KeyReader& reader, const char* key, const Value& standard) {
    const Value* value = reader.find(key);
    if (value == nullptr || !reader.strict()) return;
    bool same = value->type() == standard.type();
    if (same && value->isString()) same = lowerCase(value->string()) == standard.string();
    if (same && value->isBool()) same = value->boolean() == standard.boolean();
    if (same && value->isNumber()) same = value->number() == standard.number();
    if (same) return;
    reader.problems().error(value->where(), fmt::format("'{}' is not supported by Crevice", key),
                            fmt::format("remove it, or leave it at its default {}", standard.toJson(-1)));
}
void expectBool(KeyReader& reader, const char* key, bool standard) {
    expectDefault(reader, key, Value::makeBool(standard));
}
void expectNumber(KeyReader& reader, const char* key, double standard) {
    expectDefault(reader, key, Value::makeNumber(standard));
}
void expectWord(KeyReader& reader, const char* key, const char* standard) {
    expectDefault(reader, key, Value::makeString(standard));
}

void readRasterizer(KeyReader& reader, RenderState& state) {
    readEnum(reader, "cullMode", kCullModes, state.cullMode);
    readEnum(reader, "polygonMode", kPolygonModes, state.polygonMode);
    readBool(reader, "isFrontFaceCCW", state.frontFaceCcw);
    bool biased = false;
    readBool(reader, "depthBiasEnabled", biased);
    const Value* bias = reader.number("depthBias");
    const Value* slope = reader.number("depthBiasSlop");
    for (const Value* value : {bias, slope})
        if (value != nullptr && value->number() != 0 && !biased && reader.strict())
            reader.problems().error(value->where(), "a depth bias without 'depthBiasEnabled: true' does nothing",
                                    "add depthBiasEnabled: true");
    if (biased && bias != nullptr) state.depthBias = static_cast<float>(bias->number());
    if (biased && slope != nullptr) state.depthBiasSlope = static_cast<float>(slope->number());
    expectNumber(reader, "depthBiasClamp", 0);
    expectBool(reader, "isDiscard", false);
    expectBool(reader, "isDepthClip", true);
    expectBool(reader, "isMultisample", false);
    expectNumber(reader, "lineWidth", 1);
    expectWord(reader, "shadeModel", "gourand");
    reader.finish();
}

void readMask(KeyReader& reader, const std::string& key, std::uint32_t& out) {
    const Value* value = reader.number(key.c_str());
    if (value != nullptr && value->isInteger()) out = static_cast<std::uint32_t>(value->integer() & 0xffffffff);
}

void readStencil(KeyReader& reader, const std::string& side, StencilFace& face) {
    readBool(reader, ("stencilTest" + side).c_str(), face.test);
    readEnum(reader, ("stencilFunc" + side).c_str(), kCompareOps, face.func);
    readMask(reader, "stencilReadMask" + side, face.readMask);
    readMask(reader, "stencilWriteMask" + side, face.writeMask);
    readMask(reader, "stencilRef" + side, face.ref);
    readEnum(reader, ("stencilFailOp" + side).c_str(), kStencilOps, face.failOp);
    readEnum(reader, ("stencilZFailOp" + side).c_str(), kStencilOps, face.zFailOp);
    readEnum(reader, ("stencilPassOp" + side).c_str(), kStencilOps, face.passOp);
}

/// What is written without a side holds for both, whatever else is written: so does Cocos' compiler have it.
void copyStencil(KeyReader& reader, const StencilFace& both, StencilFace& face) {
    const auto copy = [&](const char* key, auto StencilFace::*member) {
        if (const Value* value = reader.find(key); value != nullptr && !value->isNull()) face.*member = both.*member;
    };
    copy("stencilTest", &StencilFace::test);
    copy("stencilFunc", &StencilFace::func);
    copy("stencilReadMask", &StencilFace::readMask);
    copy("stencilWriteMask", &StencilFace::writeMask);
    copy("stencilRef", &StencilFace::ref);
    copy("stencilFailOp", &StencilFace::failOp);
    copy("stencilZFailOp", &StencilFace::zFailOp);
    copy("stencilPassOp", &StencilFace::passOp);
}

void readDepthStencil(KeyReader& reader, RenderState& state) {
    readBool(reader, "depthTest", state.depthTest);
    readBool(reader, "depthWrite", state.depthWrite);
    readEnum(reader, "depthFunc", kCompareOps, state.depthFunc);
    if (!reader.strict()) {
        readStencil(reader, "Front", state.stencilFront);
        readStencil(reader, "Back", state.stencilBack);
        StencilFace both;
        readStencil(reader, "", both);
        copyStencil(reader, both, state.stencilFront);
        copyStencil(reader, both, state.stencilBack);
        return reader.finish();
    }
    // Without a suffix a key stands for both faces.
    for (const std::string side : {"", "Front", "Back"}) {
        expectBool(reader, ("stencilTest" + side).c_str(), false);
        expectWord(reader, ("stencilFunc" + side).c_str(), "always");
        expectNumber(reader, ("stencilReadMask" + side).c_str(), 0xffff);
        expectNumber(reader, ("stencilWriteMask" + side).c_str(), 0xffff);
        expectNumber(reader, ("stencilRef" + side).c_str(), 1);
        for (const char* op : {"stencilFailOp", "stencilZFailOp", "stencilPassOp"})
            expectWord(reader, (op + side).c_str(), "keep");
    }
    reader.finish();
}

/// "rgb" or "r | g": letters one after the other, as some of Cocos' files have them.
bool readMaskLetters(const std::string& word, std::uint8_t& mask) {
    std::uint8_t sum = 0;
    for (const char c : word) {
        if (c == '|' || c == ' ') continue;
        const auto at = std::string_view("rgba").find(c);
        if (at == std::string_view::npos) return false;
        sum = static_cast<std::uint8_t>(sum | (1u << at));
    }
    if (sum != 0) mask = sum;
    return sum != 0;
}

void readColorMask(KeyReader& reader, std::uint8_t& mask) {
    const Value* value = reader.find("blendColorMask");
    if (value == nullptr) return;
    if (value->isInteger() && value->integer() >= 0 && value->integer() <= 15)
        mask = static_cast<std::uint8_t>(value->integer());
    else if (value->isString() && !reader.strict() && readMaskLetters(lowerCase(value->string()), mask))
        return;
    else if (value->isString())
        readEnum(reader, "blendColorMask", kColorMasks, mask);
    else
        reader.problems().error(value->where(), "'blendColorMask' must be 0 to 15 or one of none, r, g, b, a, all",
                                "add up 1 for red, 2 for green, 4 for blue and 8 for alpha");
}

BlendTarget readBlendTarget(KeyReader& reader) {
    BlendTarget target;
    readBool(reader, "blend", target.blend);
    readEnum(reader, "blendSrc", kBlendFactors, target.src);
    readEnum(reader, "blendDst", kBlendFactors, target.dst);
    readEnum(reader, "blendEq", kBlendOps, target.op);
    readEnum(reader, "blendSrcAlpha", kBlendFactors, target.srcAlpha);
    readEnum(reader, "blendDstAlpha", kBlendFactors, target.dstAlpha);
    readEnum(reader, "blendAlphaEq", kBlendOps, target.alphaOp);
    readColorMask(reader, target.colorMask);
    reader.finish();
    return target;
}

void readBlend(KeyReader& reader, RenderState& state) {
    expectBool(reader, "isA2C", false);
    reader.boolean("isIndepend");  // Targets are independent in any case.
    expectNumber(reader, "blendColor", 0);
    if (const Value* targets = reader.array("targets")) {
        for (const Value& item : targets->items()) {
            if (!item.isObject()) {
                reader.problems().error(item.where(),
                                        fmt::format("a blend target must be a map, not {}", item.typeName()),
                                        "write { blend: true, blendSrc: src_alpha, … }");
                continue;
            }
            KeyReader target(item, "a blend target", reader.reading(), reader.problems());
            state.blendTargets.push_back(readBlendTarget(target));
        }
    }
    reader.finish();
}

/// The name of a primitive in Cocos' own files, which may hold its number; empty when there is none to look up.
std::string primitiveName(const Value& value) {
    if (value.isString()) return lowerCase(value.string());
    const bool known = value.isInteger() && value.integer() >= 0 && value.integer() < int(kTopologyNames.size());
    return known ? kTopologyNames[std::size_t(value.integer())] : "";
}

void readTopology(KeyReader& pass, Topology& out) {
    const Value* value = pass.find("primitive");
    if (value == nullptr || pass.strict()) return readEnum(pass, "primitive", kTopologies, out);
    const std::string word = primitiveName(*value);
    const auto drawn =
        std::find_if(kTopologies.begin(), kTopologies.end(), [&](const auto& named) { return word == named.name; });
    if (drawn != kTopologies.end())
        out = drawn->value;
    else if (std::find(kTopologyNames.begin(), kTopologyNames.end(), word) != kTopologyNames.end())
        pass.problems().warning(value->where(), fmt::format("primitive '{}' is not drawn by Crevice", word),
                                "the pass is read as one of triangles");
    else if (value->isNumber())
        pass.problems().error(value->where(), fmt::format("{} is no value for 'primitive'", value->toJson(-1)),
                              "numbers count these from 0: " + join({kTopologyNames.begin(), kTopologyNames.end()}));
    else
        readEnum(pass, "primitive", kTopologies, out);
}

}  // namespace

RenderState readRenderState(KeyReader& pass) {
    RenderState state;
    readTopology(pass, state.topology);
    const auto section = [&](const char* key, auto read) {
        const Value* object = pass.object(key);
        if (object == nullptr) return;
        KeyReader reader(*object, fmt::format("'{}'", key), pass.reading(), pass.problems());
        read(reader, state);
    };
    section("rasterizerState", readRasterizer);
    section("depthStencilState", readDepthStencil);
    section("blendState", readBlend);
    if (const Value* dynamic = pass.array("dynamicStates");
        dynamic != nullptr && !dynamic->items().empty() && pass.strict())
        pass.problems().error(dynamic->where(), "'dynamicStates' is not supported by Crevice", "remove it");
    return state;
}

}  // namespace crevice
