// The properties of a pass as handles: what a value feeds, from which component on, and the defaults put together.
#include <algorithm>

#include "cocos/reflection/Reflection.h"
#include "core/StateNames.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

constexpr int kFloat = 13, kFloat4 = 16, kSampler2D = 28;

/// FLOAT … FLOAT4, INT … INT4, UINT … UINT4, BOOL … BOOL4: how many components; 0 = no vector.
int componentsOf(int type) { return type >= 1 && type <= kFloat4 ? (type - 1) % 4 + 1 : 0; }

/// Numbers in a default: of a vector its components, of MAT2 … MAT4 (17 … 25, columns of 2 to 4) rows times columns.
int numbersIn(int type) {
    constexpr int kFirstMatrix = 17, kLastMatrix = 25;
    if (type < kFirstMatrix || type > kLastMatrix) return componentsOf(type);
    return ((type - kFirstMatrix) / 3 + 2) * ((type - kFirstMatrix) % 3 + 2);
}

struct Target {
    std::string uniform;
    int offset = 0;      ///< In components.
    int components = 0;  ///< Of the swizzle; 0 = the whole uniform.
};

Target parseTarget(const std::string& text) {
    const std::size_t dot = text.find('.');
    Target target{text.substr(0, dot), 0, 0};
    if (dot == std::string::npos) return target;
    const std::string swizzle = text.substr(dot + 1);
    const std::size_t first = std::string_view("xyzwrgba").find(swizzle.empty() ? 'x' : swizzle.front());
    target.offset = first == std::string_view::npos ? 0 : static_cast<int>(first % 4);
    target.components = static_cast<int>(std::clamp<std::size_t>(swizzle.size(), 1, 4));
    return target;
}

/// Numbers as JSON has them: 1.0 is 1.
Value plainNumber(const Value& value) {
    if (value.isBool()) return Value::makeInteger(value.boolean() ? 1 : 0);
    return value.isNumber() ? Value::makeNumber(value.number()) : value;
}

Value listOf(const Value& value) {
    if (value.isString()) return value;
    Value list = Value::makeArray();
    if (!value.isArray()) list.items().push_back(plainNumber(value));
    if (value.isArray())
        for (const Value& item : value.items()) list.items().push_back(plainNumber(item));
    return list;
}

int typeOfValue(const Value* value) {
    if (value == nullptr) return 0;
    if (value->isString()) return kSampler2D;
    const std::size_t count = value->isArray() ? value->items().size() : 1;
    return count >= 1 && count <= 4 ? kFloat + static_cast<int>(count) - 1 : 0;
}

int packed(const Value& sampler, const char* key, const std::vector<const char*>& names, int usual) {
    const Value* value = sampler.find(key);
    if (value == nullptr) return usual;
    if (value->isNumber()) return static_cast<int>(value->number());
    if (!value->isString()) return usual;
    const std::string word = lowerCase(value->string());
    for (std::size_t i = 0; i < names.size(); ++i)
        if (word == names[i]) return static_cast<int>(i);
    return usual;
}

/// No property, but what the editor is told about all of them.
constexpr std::string_view kOfAll = "__metadata__";

class PropertyReflection {
public:
    PropertyReflection(const Value& properties, const UniformTypes& uniforms)
        : properties_(properties), uniforms_(uniforms) {}

    Value run() {
        Value all = Value::makeObject();
        for (const Member& member : properties_.members())
            if (member.value.isObject() && member.key != kOfAll)
                all.set(member.key, property(member.key, member.value));
        for (const Fed& fed : fed_) merge(all, fed);
        return all;
    }

private:
    int uniformType(const std::string& name) const {
        const auto it = uniforms_.find(name);
        return it == uniforms_.end() ? 0 : it->second;
    }

    Value property(const std::string& name, const Value& written) {
        const Value* value = written.find("value");
        if (value != nullptr && value->isNull()) value = nullptr;
        const Value* linear = written.find("linear");
        const Value* targetText = written.find("target");
        const bool targeted = targetText != nullptr && targetText->isString();
        const Target target = parseTarget(targeted ? targetText->string() : name);

        int type = uniformType(target.uniform);
        if (target.components > 0) {
            const int scalar = componentsOf(type) > 0 ? type - componentsOf(type) + 1 : kFloat;
            type = scalar + target.components - 1;
        }
        if (type == 0) type = typeOfValue(value);

        Value out = Value::makeObject();
        if (value != nullptr) out.set("value", listOf(*value));
        if (linear != nullptr && linear->isBool()) out.set("linear", *linear);
        out.set("type", Value::makeInteger(type));
        if (const Value* sampler = written.find("sampler"); sampler != nullptr && sampler->isObject())
            out.set("samplerHash", Value::makeInteger(samplerHash(*sampler)));
        if (targeted) {
            Value handle = Value::makeArray();
            handle.items() = {Value::makeString(target.uniform), Value::makeInteger(target.offset),
                              Value::makeInteger(type)};
            out.set("handleInfo", std::move(handle));
            fed_.push_back({target, type, value});
        }
        return out;
    }

    /// A property that feeds a uniform.
    struct Fed {
        Target target;
        int type = 0;
        const Value* value = nullptr;
    };

    /// The uniform's own entry, which its properties may have or not: zeros, and what they say of their components.
    void merge(Value& all, const Fed& fed) const {
        const Target& target = fed.target;
        int type = uniformType(target.uniform);
        if (type == 0) type = target.components > 0 ? kFloat4 : fed.type;
        if (all.find(target.uniform) == nullptr) {
            Value made = Value::makeObject();
            made.set("type", Value::makeInteger(type));
            all.set(target.uniform, std::move(made));
        }
        Value& entry = *all.find(target.uniform);
        if (numbersIn(type) > 0 && entry.find("value") == nullptr) {
            Value zeros = Value::makeArray();
            zeros.items().assign(static_cast<std::size_t>(numbersIn(type)), Value::makeInteger(0));
            entry.set("value", std::move(zeros));
        }
        if (fed.value == nullptr) return;
        const Value list = listOf(*fed.value);
        if (list.isString()) return entry.set("value", list);
        Value* defaults = entry.find("value");
        if (defaults == nullptr || !defaults->isArray()) return;
        for (std::size_t i = 0; i < list.items().size(); ++i) {
            const std::size_t component = static_cast<std::size_t>(target.offset) + i;
            if (component < defaults->items().size()) defaults->items()[component] = list.items()[i];
        }
    }

    const Value& properties_;
    const UniformTypes& uniforms_;
    std::vector<Fed> fed_;
};

}  // namespace

std::int64_t samplerHash(const Value& sampler) {
    static const std::vector<const char*> kFilters = {"none", "point", "linear", "anisotropic"};
    static const std::vector<const char*> kAddresses = {"wrap", "mirror", "clamp", "border"};
    static const std::vector<const char*> kComparisons(kCompareNames.begin(), kCompareNames.end());
    // Bits from 0 on: three filters and three addresses of 2 bits, anisotropy, comparison, LOD range and bias of 4.
    struct Field {
        const char* key;
        const std::vector<const char*>& names;
        int usual, shift;
    };
    const std::vector<const char*> none;
    const Field fields[] = {
        {"minFilter", kFilters, 2, 0},  {"magFilter", kFilters, 2, 2},    {"mipFilter", kFilters, 0, 4},
        {"addressU", kAddresses, 0, 6}, {"addressV", kAddresses, 0, 8},   {"addressW", kAddresses, 0, 10},
        {"maxAnisotropy", none, 8, 12}, {"cmpFunc", kComparisons, 0, 16}, {"minLOD", none, 0, 20},
        {"maxLOD", none, 0, 24},        {"mipLODBias", none, 0, 28}};
    std::int64_t hash = 0;
    for (const Field& field : fields) {
        int value = packed(sampler, field.key, field.names, field.usual);
        if (value == 0) value = field.usual;  // as the engine: 0 means "not given"
        hash |= std::int64_t(value & (field.shift < 12 ? 3 : 15)) << field.shift;
    }
    return hash;
}

Value reflectProperties(const Value& properties, const UniformTypes& uniforms) {
    return PropertyReflection(properties, uniforms).run();
}

}  // namespace crevice::cocos
