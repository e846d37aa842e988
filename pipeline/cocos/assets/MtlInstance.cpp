// Merging is done on the file's own numbering of passes, before anything is dropped.
#include "cocos/assets/MtlInstance.h"

#include <algorithm>

#include <fmt/format.h>

#include "effect/PropertyTarget.h"

namespace crevice::cocos {
namespace {

using Kind = TypedValue::Kind;

Value merged(const Value& base, const Value* over) {
    Value result = base.isObject() ? base : Value::makeObject();
    if (over && over->isObject())
        for (const Member& member : over->members()) result.set(member.key, member.value, member.keyLoc);
    return result;
}

/// The pass that lends its macros and values, or null.
const MtlPass* lenderOf(const Mtl& mtl, const EffectPass& pass) {
    if (!pass.propertyIndex || *pass.propertyIndex < 0) return nullptr;
    const auto index = static_cast<std::size_t>(*pass.propertyIndex);
    return index < mtl.passes.size() ? &mtl.passes[index] : nullptr;
}

/// The editor writes empty objects for every state; what says nothing is left out.
bool saysNothing(const Value& value) {
    if (value.isObject()) {
        return std::all_of(value.members().begin(), value.members().end(),
                           [](const Member& member) { return saysNothing(member.value); });
    }
    return value.isNull() || (value.isArray() && std::all_of(value.items().begin(), value.items().end(), saysNothing));
}

Value statesOf(const MtlPass& pass) {
    Value states = Value::makeObject(pass.states.where());
    if (!pass.states.isObject()) return states;
    for (const Member& member : pass.states.members())
        if (!saysNothing(member.value)) states.set(member.key, member.value, member.keyLoc);
    return states;
}

bool isTextureProperty(const EffectProperty& property) { return property.value.isString(); }

/// How many numbers a property takes; 0 = the header does not say.
std::size_t countOf(const EffectProperty& property) {
    if (property.value.isNumber()) return 1;
    if (property.value.isArray()) return property.value.items().size();
    return swizzleOf(property).size();
}

/// All numbers of a value in order, lists of vectors joined; false when something else is in it.
bool collectNumbers(const TypedValue& value, std::vector<Value>& numbers) {
    if (value.kind == Kind::Number) return numbers.push_back(value.plain), true;
    if (value.kind == Kind::Bool)
        return numbers.push_back(Value::makeNumber(value.plain.boolean() ? 1 : 0, value.where)), true;
    if (value.kind == Kind::Numbers) {
        numbers.insert(numbers.end(), value.plain.items().begin(), value.plain.items().end());
        return true;
    }
    if (value.kind != Kind::List) return false;
    return std::all_of(value.items.begin(), value.items.end(),
                       [&](const TypedValue& item) { return collectNumbers(item, numbers); });
}

Value makeNumbers(const std::vector<Value>& numbers, std::size_t count, const SourceLoc& where) {
    const std::size_t size = count == 0 ? numbers.size() : count;
    const auto at = [&](std::size_t i) { return i < numbers.size() ? numbers[i] : Value::makeNumber(0, where); };
    if (size == 1) return at(0);
    Value list = Value::makeArray(where);
    for (std::size_t i = 0; i < size; ++i) list.items().push_back(at(i));
    return list;
}

class Instance {
public:
    Instance(const Mtl& mtl, const TextureUser& textures, Problems& problems)
        : mtl_(mtl), textures_(textures), problems_(problems) {}

    MaterialPass read(const EffectPass& pass, std::size_t index) {
        static const MtlPass kNothing;
        const MtlPass& own = index < mtl_.passes.size() ? mtl_.passes[index] : kNothing;
        const MtlPass* lender = lenderOf(mtl_, pass);
        MaterialPass result;
        result.defines = merged(own.defines, lender ? &lender->defines : nullptr);
        for (const auto& [name, value] : pass.embeddedMacros) result.defines.erase(name);
        result.states = statesOf(own);
        result.properties = Value::makeObject(mtl_.where);
        for (const MtlProperty& property : own.properties) setProperty(pass, property, result.properties);
        if (lender && lender != &own)
            for (const MtlProperty& property : lender->properties) setProperty(pass, property, result.properties);
        return result;
    }

private:
    void setProperty(const EffectPass& pass, const MtlProperty& written, Value& values) {
        if (written.value.kind == Kind::Null) return values.erase(written.name);
        for (const EffectProperty& property : pass.properties) {
            if (property.name == written.name) return setValue(property, written, 0, values);
        }
        setUniform(pass, written, values);
    }

    /// A name that is no property may be the uniform that properties feed, whole or in parts.
    void setUniform(const EffectPass& pass, const MtlProperty& written, Value& values) {
        for (const EffectProperty& property : pass.properties) {
            if (uniformOf(property) != written.name) continue;
            const int first = firstComponent(swizzleOf(property));
            if (first >= 0) setValue(property, written, static_cast<std::size_t>(first), values);
        }
    }

    void setValue(const EffectProperty& property, const MtlProperty& written, std::size_t first, Value& values) {
        if (written.value.kind == Kind::Asset) return setTexture(property, written, values);
        std::vector<Value> numbers;
        if (isTextureProperty(property) || !collectNumbers(written.value, numbers) || numbers.empty()) {
            return wrongKind(property, written);
        }
        numbers.erase(numbers.begin(), numbers.begin() + std::ptrdiff_t(std::min(first, numbers.size())));
        std::size_t count = countOf(property);
        // Elements of an array follow each other; the rest of a value that is too long is nothing.
        if (written.value.kind == Kind::List && count > 0 && numbers.size() % count == 0) count = numbers.size();
        values.set(property.name, makeNumbers(numbers, count, written.where), written.where);
    }

    void setTexture(const EffectProperty& property, const MtlProperty& written, Value& values) {
        if (!property.value.isNull() && !isTextureProperty(property)) return wrongKind(property, written);
        Value texture = textures_ ? textures_(written.value.asset, property) : Value();
        if (texture.isNull()) return values.erase(property.name);
        texture.setWhere(written.where);
        values.set(property.name, std::move(texture), written.where);
    }

    void wrongKind(const EffectProperty& property, const MtlProperty& written) {
        const bool texture = isTextureProperty(property);
        problems_.error(written.where,
                        fmt::format("property '{}' is {}, but the effect takes {}", written.name,
                                    kindName(written.value), texture ? "a texture" : "numbers"),
                        texture ? R"(name a texture: { "__uuid__": "…" }, or null for the default)"
                                : "give a number, a cc.Color or a vector, or null for the default");
    }

    static std::string kindName(const TypedValue& value) {
        if (value.kind == Kind::Asset) return "an asset";
        if (value.kind == Kind::Text) return "a word";
        if (value.kind == Kind::Other) return fmt::format("of type '{}'", value.type);
        if (value.kind == Kind::List) return "a list";
        return "a number";
    }

    const Mtl& mtl_;
    const TextureUser& textures_;
    Problems& problems_;
};

}  // namespace

bool isTruthy(const Value& value) {
    if (value.isBool()) return value.boolean();
    if (value.isNumber()) return value.number() != 0;
    return value.isString() && !value.string().empty();
}

bool isDropped(const EffectPass& pass, const Value& defines) {
    if (pass.switchMacro.empty()) return false;
    if (const auto fixed = pass.embeddedMacros.find(pass.switchMacro); fixed != pass.embeddedMacros.end())
        return fixed->second == "0" || fixed->second == "false" || fixed->second.empty();
    const Value* value = defines.isObject() ? defines.find(pass.switchMacro) : nullptr;
    return !value || !isTruthy(*value);
}

MaterialEffect instantiate(const Mtl& mtl, const EffectAsset& asset, const std::string& effectName,
                           const TextureUser& textures, Problems& problems) {
    MaterialEffect effect;
    effect.effect = effectName;
    effect.technique = mtl.technique;
    if (mtl.technique >= asset.techniques.size()) {
        problems.error(mtl.techniqueWhere,
                       fmt::format("material '{}' uses technique {}, but effect '{}' has {}", mtl.name, mtl.technique,
                                   effectName, asset.techniques.size()),
                       "techniques count from 0: correct '_techIdx'");
        return effect;
    }
    const std::vector<EffectPass>& passes = asset.techniques[mtl.technique].passes;
    Instance instance(mtl, textures, problems);
    for (std::size_t i = 0; i < passes.size(); ++i) effect.passes.push_back(instance.read(passes[i], i));
    return effect;
}

}  // namespace crevice::cocos
