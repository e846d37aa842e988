// Reads state overrides; the orders of Cocos' enums are those of ours, primitives aside.
#include "flow/MaterialStates.h"

#include <fmt/format.h>

#include <optional>
#include <span>

#include "core/StateNames.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr PolygonMode kPolygons[] = {PolygonMode::Fill, PolygonMode::Point, PolygonMode::Line};
/// Of kTopologyNames as far as Crevice draws them.
constexpr Topology kTopologies[] = {
    Topology::PointList, Topology::LineList, Topology::LineStrip,    Topology::LineStrip,     Topology::LineList,
    Topology::LineStrip, Topology::LineList, Topology::TriangleList, Topology::TriangleStrip, Topology::TriangleFan};

class StateReader {
public:
    StateReader(const Value& object, Problems& problems) : object_(object), problems_(problems) {}

    void flag(const char* key, bool& out) const {
        const Value* value = object_.find(key);
        if (value && value->isBool()) out = value->boolean();
        if (value && value->isNumber()) out = value->number() != 0;
    }
    void number(const char* key, float& out) const {
        const Value* value = object_.find(key);
        if (value && value->isNumber()) out = static_cast<float>(value->number());
    }
    void bits(const char* key, std::uint32_t& out) const {
        const Value* value = object_.find(key);
        if (value && value->isInteger()) out = static_cast<std::uint32_t>(value->integer());
    }
    /// Place of the word or number in `names`; nothing when the key is missing or wrong.
    std::optional<std::size_t> index(const char* key, std::span<const char* const> names) const {
        const Value* value = object_.find(key);
        if (!value || value->isNull()) return std::nullopt;
        if (value->isInteger() && value->integer() >= 0 && value->integer() < static_cast<std::int64_t>(names.size()))
            return static_cast<std::size_t>(value->integer());
        if (value->isString()) {
            const std::string word = lowerCase(value->string());
            for (std::size_t i = 0; i < names.size(); ++i)
                if (word == names[i]) return i;
        }
        problems_.error(value->where(), fmt::format("{} is no value for '{}'", value->toJson(-1), key),
                        fmt::format("give one of {}, or a number below {}",
                                    join(std::vector<std::string>(names.begin(), names.end())), names.size()));
        return std::nullopt;
    }
    template <class Enum>
    void word(const char* key, std::span<const char* const> names, Enum& out) const {
        if (const auto found = index(key, names)) out = static_cast<Enum>(*found);
    }

private:
    const Value& object_;
    Problems& problems_;
};

void readRasterizer(const StateReader& reader, RenderState& state) {
    reader.word("cullMode", kCullNames, state.cullMode);
    if (const auto mode = reader.index("polygonMode", kPolygonNames)) state.polygonMode = kPolygons[*mode];
    reader.flag("isFrontFaceCCW", state.frontFaceCcw);
    bool biased = state.depthBias != 0 || state.depthBiasSlope != 0;
    reader.flag("depthBiasEnabled", biased);
    reader.number("depthBias", state.depthBias);
    reader.number("depthBiasSlop", state.depthBiasSlope);
    if (!biased) state.depthBias = state.depthBiasSlope = 0;
}

void readStencil(const StateReader& reader, const std::string& side, StencilFace& face) {
    const auto key = [&](const char* name) { return name + side; };
    reader.flag(key("stencilTest").c_str(), face.test);
    reader.word(key("stencilFunc").c_str(), kCompareNames, face.func);
    reader.bits(key("stencilReadMask").c_str(), face.readMask);
    reader.bits(key("stencilWriteMask").c_str(), face.writeMask);
    reader.bits(key("stencilRef").c_str(), face.ref);
    reader.word(key("stencilFailOp").c_str(), kStencilNames, face.failOp);
    reader.word(key("stencilZFailOp").c_str(), kStencilNames, face.zFailOp);
    reader.word(key("stencilPassOp").c_str(), kStencilNames, face.passOp);
}

void readDepth(const StateReader& reader, RenderState& state) {
    reader.flag("depthTest", state.depthTest);
    reader.flag("depthWrite", state.depthWrite);
    reader.word("depthFunc", kCompareNames, state.depthFunc);
    // A key without a side is for both.
    for (StencilFace* face : {&state.stencilFront, &state.stencilBack}) readStencil(reader, "", *face);
    readStencil(reader, "Front", state.stencilFront);
    readStencil(reader, "Back", state.stencilBack);
}

void readBlendTarget(const Value& item, BlendTarget& target, Problems& problems) {
    const StateReader reader(item, problems);
    reader.flag("blend", target.blend);
    reader.word("blendSrc", kBlendFactorNames, target.src);
    reader.word("blendDst", kBlendFactorNames, target.dst);
    reader.word("blendEq", kBlendOpNames, target.op);
    reader.word("blendSrcAlpha", kBlendFactorNames, target.srcAlpha);
    reader.word("blendDstAlpha", kBlendFactorNames, target.dstAlpha);
    reader.word("blendAlphaEq", kBlendOpNames, target.alphaOp);
    const Value* mask = item.find("blendColorMask");
    if (mask && mask->isInteger()) target.colorMask = static_cast<std::uint8_t>(mask->integer() & 0xf);
}

const Value* objectIn(const Value& states, const char* key) {
    const Value* value = states.find(key);
    return value && value->isObject() ? value : nullptr;
}

}  // namespace

RenderState withStates(RenderState state, const Value& states, Problems& problems) {
    if (!states.isObject()) return state;
    if (const auto primitive =
            StateReader(states, problems).index("primitive", std::span(kTopologyNames).first(std::size(kTopologies))))
        state.topology = kTopologies[*primitive];
    if (const Value* raster = objectIn(states, "rasterizerState"))
        readRasterizer(StateReader(*raster, problems), state);
    if (const Value* depth = objectIn(states, "depthStencilState")) readDepth(StateReader(*depth, problems), state);
    const Value* blend = objectIn(states, "blendState");
    const Value* targets = blend ? blend->find("targets") : nullptr;
    if (!targets || !targets->isArray()) return state;
    for (std::size_t i = 0; i < targets->items().size(); ++i) {
        if (!targets->items()[i].isObject()) continue;
        if (state.blendTargets.size() <= i) state.blendTargets.resize(i + 1);
        readBlendTarget(targets->items()[i], state.blendTargets[i], problems);
    }
    return state;
}

int priorityOf(int passPriority, const Value& states) {
    const Value* priority = states.isObject() ? states.find("priority") : nullptr;
    return priority && priority->isInteger() ? static_cast<int>(priority->integer()) : passPriority;
}

}  // namespace crevice
