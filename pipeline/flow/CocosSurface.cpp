// Cocos' rules for passes, macros and values of materials.
#include "flow/CocosSurface.h"

#include <algorithm>

#include "effect/PropertyTarget.h"
#include "flow/CocosMacros.h"
#include "flow/MaterialStates.h"

namespace crevice {
namespace {

constexpr std::uint32_t kSubModelPriority = 128;  // Cocos' default; nothing imported sets another

const MaterialPass* passOf(const MaterialEffect& material, std::size_t pass) {
    return pass < material.passes.size() ? &material.passes[pass] : nullptr;
}

bool isOn(const std::string& value) { return !value.empty() && value != "0"; }

/// `switch: NAME` drops a pass unless the macro is on, the pass' embedded macros counted.
bool isSwitchedOff(const EffectPass& pass, const Defines& defines) {
    if (pass.switchMacro.empty()) return false;
    const auto embedded = pass.embeddedMacros.find(pass.switchMacro);
    if (embedded != pass.embeddedMacros.end()) return !isOn(embedded->second);
    const auto given = defines.find(pass.switchMacro);
    return given == defines.end() || !isOn(given->second);
}

Value squared(const Value& value) {
    if (value.isNumber()) return Value::makeReal(value.number() * value.number(), value.where());
    Value result = value;
    for (std::size_t i = 0; i < result.items().size() && i < 3; ++i) {
        const double number = result.items()[i].isNumber() ? result.items()[i].number() : 0;
        result.items()[i] = Value::makeReal(number * number, value.where());
    }
    return result;
}

bool isTexture(const EffectProperty& property) { return property.value.isString(); }

}  // namespace

std::vector<ChosenPass> choosePasses(const EffectTechnique& technique, const MaterialEffect& material,
                                     const QueueDesc& queue, Problems& problems) {
    std::vector<ChosenPass> chosen;
    for (std::size_t i = 0; i < technique.passes.size(); ++i) {
        const EffectPass& pass = technique.passes[i];
        if (std::find(queue.phases.begin(), queue.phases.end(), pass.phase) == queue.phases.end()) continue;
        if (!pass.passName.empty() && pass.passName != "default") continue;
        if (isSwitchedOff(pass, materialDefines(material, i))) continue;
        const MaterialPass* own = passOf(material, i);
        const Value states = own ? own->states : Value{};
        ChosenPass taken{.pass = i, .state = withStates(pass.state, states, problems)};
        const bool blends = !taken.state.blendTargets.empty() && taken.state.blendTargets[0].blend;
        if (blends != (queue.sort == QueueSort::BackToFront)) continue;
        const auto priority = static_cast<std::uint32_t>(std::clamp(priorityOf(pass.priority, states), 0, 255));
        taken.order =
            priority << 16 | kSubModelPriority << 8 | static_cast<std::uint32_t>(std::min<std::size_t>(i, 255));
        chosen.push_back(std::move(taken));
    }
    return chosen;
}

Defines materialDefines(const MaterialEffect& material, std::size_t pass) {
    Defines defines;
    const MaterialPass* own = passOf(material, pass);
    if (!own || !own->defines.isObject()) return defines;
    for (const Member& member : own->defines.members()) defines[member.key] = defineText(member.value, member.key);
    return defines;
}

PassValues passValues(const Value& properties, const EffectPass& pass) {
    PassValues values{.numbers = Value::makeObject(), .textures = {}};
    if (!properties.isObject()) return values;
    for (const Member& member : properties.members()) {
        const auto property = std::find_if(pass.properties.begin(), pass.properties.end(),
                                           [&](const EffectProperty& p) { return p.name == member.key; });
        if (property == pass.properties.end() || member.value.isNull()) continue;
        if (isTexture(*property) && member.value.isInteger()) {
            TextureRef ref;
            ref.texture = static_cast<int>(member.value.integer());
            values.textures.emplace_back(uniformOf(*property), ref);
            continue;
        }
        const bool convert = property->linear && (member.value.isNumber() || member.value.isArray());
        values.numbers.set(member.key, convert ? squared(member.value) : member.value, member.keyLoc);
    }
    return values;
}

}  // namespace crevice
