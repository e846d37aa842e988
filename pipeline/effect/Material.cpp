// Fills the uniform blocks of set 1 from property values, by name.
#include "effect/Material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "core/Text.h"
#include "effect/PropertyTarget.h"

namespace crevice {
namespace {

constexpr std::uint32_t kMaterialSet = 1;
constexpr const char* kAuto = "auto";

/// The transfer function of IEC 61966-2-1.
float linearFromSrgb(float c) { return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f); }

/// How many numbers a value holds; 0 for words.
std::uint32_t countOf(const Value& value) {
    if (value.isNumber()) return 1;
    return value.isArray() ? static_cast<std::uint32_t>(value.items().size()) : 0;
}

double component(const Value& value, std::uint32_t index) {
    return value.isNumber() ? value.number() : value.items()[index].number();
}

bool isAuto(const Value& value) { return value.isString() && value.string() == kAuto; }

struct MemberShape {
    bool known = false, integer = false;
    std::uint32_t components = 0;
};

/// Of one element.
MemberShape shapeOf(const BlockMember& member) {
    const std::string& type = member.type;
    if (type == "float") return {true, false, 1};
    if (type == "int" || type == "uint") return {true, true, 1};
    if (type == "mat4") return {true, false, 16};
    const bool integer = type.starts_with('i') || type.starts_with('u');
    if (type.size() == (integer ? 5u : 4u) && type.find("vec") != std::string::npos)
        return {true, integer, static_cast<std::uint32_t>(type.back() - '0')};
    return {};
}

std::string numbers(std::uint32_t count) { return count == 1 ? "1 number" : fmt::format("{} numbers", count); }

Value makeNumbers(std::initializer_list<float> values) {
    Value list = Value::makeArray();
    for (const float value : values) list.items().push_back(Value::makeNumber(value));
    return list;
}

}  // namespace

Material::Material(const EffectVariant& variant, LinearRule linear)
    : variant_(variant), pass_(*variant.pass), linear_(linear) {
    for (const ShaderResource& resource : variant.info.resources) {
        if (resource.slot.set != kMaterialSet) continue;
        if (resource.kind == ResourceKind::UniformBlock) {
            blocks_.push_back({resource.name, resource.slot, std::vector<std::byte>(resource.size)});
        } else if (resource.kind == ResourceKind::CombinedSampler) {
            MaterialSampler sampler;
            sampler.name = resource.name;
            sampler.slot = resource.slot;
            sampler.cube = resource.cube;
            sampler.texture = "white";
            sampler.where = resource.where;
            samplers_.push_back(std::move(sampler));
        }
    }
    if (linear_ == LinearRule::AsGiven) setIdentities();
    Problems problems;
    for (const EffectProperty& property : pass_.properties) {
        if (MaterialSampler* sampler = findSampler(uniformOf(property))) {
            sampler->isProperty = true;
            sampler->sampler = property.sampler;
        }
        if (!property.value.isNull()) setValue(property, property.value, problems, true);
    }
    problems.throwIfErrors();
}

void Material::setIdentities() {
    for (const ShaderResource& resource : variant_.info.resources) {
        for (const BlockMember& member : resource.members) {
            const auto block = std::find_if(blocks_.begin(), blocks_.end(),
                                            [&](const MaterialBlock& b) { return b.slot == resource.slot; });
            if (member.type != "mat4" || block == blocks_.end()) continue;
            constexpr glm::mat4 kIdentity(1.0f);
            for (std::size_t at = 0; at + sizeof kIdentity <= member.size; at += sizeof kIdentity)
                std::memcpy(block->bytes.data() + member.offset + at, &kIdentity, sizeof kIdentity);
        }
    }
}

void Material::apply(const Value& object, Problems& problems) {
    if (object.isNull()) return;
    if (!object.isObject()) {
        problems.error(object.where(), fmt::format("'material' must be an object, not {}", object.typeName()),
                       "write { \"property\": value, … }");
        return;
    }
    for (const Member& member : object.members()) {
        if (const EffectProperty* property = findProperty(member.key)) {
            setValue(*property, member.value, problems);
            continue;
        }
        SourceLoc where = member.keyLoc;
        where.length = std::max(1, static_cast<int>(member.key.size()));
        const auto names = propertyNames();
        problems.error(where, fmt::format("effect '{}' has no property '{}'", variant_.effect, member.key),
                       names.empty() ? "it has none" : didYouMean(member.key, names, "properties"));
    }
}

void Material::setValue(const EffectProperty& property, const Value& value, Problems& problems, bool isDefault) {
    if (MaterialSampler* sampler = findSampler(uniformOf(property)))
        return setTexture(property, *sampler, value, problems);
    const bool isTexture = property.value.isString() && !isAuto(property.value);
    if (isAuto(value) && isAuto(property.value)) {
        values_[property.name] = value;
        return;
    }
    if (isTexture && value.isString()) {  // The sampler is not in this variant.
        values_[property.name] = value;
        return;
    }
    if (isTexture) {
        problems.error(value.where(),
                       fmt::format("property '{}' is a texture and cannot be {}", property.name, value.typeName()),
                       "give white, black, grey or normal");
        return;
    }
    if (!checkNumbers(property, value, problems)) return;
    const std::uint32_t wanted = countOf(property.value);
    Place place;
    const bool placed = findPlace(property, place, problems);
    const std::uint32_t expected = placed ? place.components : wanted;
    const bool fits = linear_ == LinearRule::AsGiven ? countOf(value) >= expected : countOf(value) == expected;
    if (expected != 0 && !fits) {
        problems.error(value.where(),
                       fmt::format("property '{}' takes {}, not {}", property.name, numbers(expected), countOf(value)),
                       expected == 1 ? "give one number" : fmt::format("give a list of {}: [ … ]", numbers(expected)));
        return;
    }
    values_[property.name] = value;
    if (placed) writeNumbers(property, value, place, isDefault);
}

void Material::writeNumbers(const EffectProperty& property, const Value& value, const Place& place, bool isDefault) {
    const std::uint32_t given = countOf(value) / place.components;  // whole elements
    const std::uint32_t elements = isDefault ? place.elements : std::min(given, place.elements);
    for (std::uint32_t i = 0; i < elements * place.components; ++i) {
        const std::uint32_t element = i / place.components, part = i % place.components;
        const double written = component(value, element % given * place.components + part);
        auto number = static_cast<float>(written);
        if (linear_ == LinearRule::FromSrgb && property.linear && part < 3 && place.components >= 3)
            number = linearFromSrgb(number);
        const auto integer =
            static_cast<std::int32_t>(std::clamp(written, double(std::numeric_limits<std::int32_t>::min()),
                                                 double(std::numeric_limits<std::int32_t>::max())));
        std::byte* out =
            blocks_[place.block].bytes.data() + place.offset + element * place.stride + part * sizeof(float);
        std::memcpy(out, place.integer ? static_cast<const void*>(&integer) : &number, sizeof(float));
    }
}

void Material::setTexture(const EffectProperty& property, MaterialSampler& sampler, const Value& value,
                          Problems& problems) {
    if (!value.isString() || value.string().empty()) {
        problems.error(value.where(),
                       fmt::format("property '{}' is a texture and cannot be {}", property.name, value.typeName()),
                       "give white, black, grey or normal");
        return;
    }
    sampler.texture = value.string();
    sampler.where = value.where();
    values_[property.name] = value;
}

bool Material::checkNumbers(const EffectProperty& property, const Value& value, Problems& problems) const {
    bool good = value.isNumber() || (value.isArray() && !value.items().empty());
    if (value.isArray())
        for (const Value& item : value.items()) good = good && item.isNumber();
    if (!good) {
        const std::string orAuto = isAuto(property.value) ? " or the word auto" : "";
        problems.error(value.where(),
                       fmt::format("property '{}' takes numbers{}, not {}", property.name, orAuto,
                                   value.isArray() ? "this list" : value.typeName()),
                       fmt::format("give {}, as its default {}", numbers(std::max(1u, countOf(property.value))),
                                   property.value.toJson(-1)));
        return false;
    }
    for (std::uint32_t i = 0; i < countOf(value); ++i) {
        const double number = component(value, i);
        const SourceLoc& where = value.isNumber() ? value.where() : value.items()[i].where();
        if (!fitsFloat(number)) {
            problems.error(where, fmt::format("property '{}' is {}, more than a float holds", property.name, number),
                           "give a number that a shader can compute with");
            return false;
        }
        if (number >= property.min && number <= property.max) continue;
        problems.error(where, fmt::format("property '{}' is {}, outside its range", property.name, number),
                       fmt::format("give {} to {}", property.min, property.max));
        return false;
    }
    return true;
}

/// Where a property's numbers go. False when this variant has no such member; a property that does not fit is reported.
bool Material::findPlace(const EffectProperty& property, Place& place, Problems& problems) const {
    const std::string uniform = uniformOf(property), swizzle = swizzleOf(property);
    for (const ShaderResource& resource : variant_.info.resources) {
        if (resource.slot.set != kMaterialSet || resource.kind != ResourceKind::UniformBlock) continue;
        const auto member = std::find_if(resource.members.begin(), resource.members.end(),
                                         [&](const BlockMember& m) { return m.name == uniform; });
        if (member == resource.members.end()) continue;
        const MemberShape shape = shapeOf(*member);
        const int start = firstComponent(swizzle);
        const auto count = static_cast<std::uint32_t>(swizzle.empty() ? shape.components : swizzle.size());
        const bool array = member->arrayCount != 0;
        const bool good = shape.known && (!array || (linear_ == LinearRule::AsGiven && swizzle.empty()));
        if (!good || start < 0 || static_cast<std::uint32_t>(start) + count > shape.components) {
            problems.error(
                property.where,
                fmt::format("property '{}' cannot feed '{}' of type {}{}", property.name,
                            property.target.empty() ? uniform : property.target, member->type, array ? " array" : ""),
                "targets are scalars and vectors, or a run of components such as .xy",
                {{resource.where, fmt::format("the block '{}'", resource.name)}});
            return false;
        }
        const auto block = std::find_if(blocks_.begin(), blocks_.end(),
                                        [&](const MaterialBlock& b) { return b.slot == resource.slot; });
        const std::size_t stride = array ? member->arrayStride : 0;
        const std::uint32_t elements = std::max(1u, member->arrayCount);
        const std::size_t offset = member->offset + static_cast<std::size_t>(start) * sizeof(float);
        if (offset + (elements - 1) * stride + count * sizeof(float) > block->bytes.size())
            throw std::logic_error(fmt::format("member '{}' reaches over the end of its block", uniform));
        place = {.block = static_cast<std::size_t>(block - blocks_.begin()),
                 .offset = offset,
                 .stride = stride,
                 .components = count,
                 .elements = elements,
                 .integer = shape.integer};
        return true;
    }
    return false;
}

void Material::setFromCode(std::string_view name, Value value) {
    const EffectProperty* property = findProperty(name);
    if (property == nullptr)
        throw Error(pass_.where, fmt::format("effect '{}' has no property '{}'", variant_.effect, name),
                    didYouMean(name, propertyNames(), "properties"));
    Problems problems;
    value.setWhere(property->where);
    setValue(*property, value, problems);
    problems.throwIfErrors();
}

void Material::set(std::string_view name, float value) { setFromCode(name, Value::makeNumber(value)); }
void Material::set(std::string_view name, std::int32_t value) { setFromCode(name, Value::makeNumber(value)); }
void Material::set(std::string_view name, const glm::vec2& v) { setFromCode(name, makeNumbers({v.x, v.y})); }
void Material::set(std::string_view name, const glm::vec3& v) { setFromCode(name, makeNumbers({v.x, v.y, v.z})); }
void Material::set(std::string_view name, const glm::vec4& v) { setFromCode(name, makeNumbers({v.x, v.y, v.z, v.w})); }
void Material::set(std::string_view name, const std::string& texture) { setFromCode(name, Value::makeString(texture)); }

std::vector<std::string> Material::autoProperties() const {
    std::vector<std::string> names;
    for (const auto& [name, value] : values_)
        if (isAuto(value)) names.push_back(name);
    return names;
}

const Value* Material::value(std::string_view name) const {
    const auto it = values_.find(name);
    return it == values_.end() ? nullptr : &it->second;
}

const EffectProperty* Material::findProperty(std::string_view name) const {
    for (const EffectProperty& property : pass_.properties)
        if (property.name == name) return &property;
    return nullptr;
}

std::vector<std::string> Material::propertyNames() const {
    std::vector<std::string> names;
    for (const EffectProperty& property : pass_.properties) names.push_back(property.name);
    return names;
}

MaterialSampler* Material::findSampler(std::string_view name) {
    for (MaterialSampler& sampler : samplers_)
        if (sampler.name == name) return &sampler;
    return nullptr;
}

}  // namespace crevice
