// A mixed-radix count over the values of all free macros.
#include "app/commands/EffectVariants.h"

namespace crevice {
namespace {

struct FreeMacro {
    std::string name;
    std::vector<std::string> values;
};

std::vector<std::string> valuesOf(const DefineInfo& info) {
    switch (info.type) {
        case DefineType::Bool:
            return {"0", "1"};
        case DefineType::Number:
            if (!info.range) return {};
            return {std::to_string(info.range->first), std::to_string(info.range->second)};
        case DefineType::String:
            return info.options;
    }
    return {};
}

std::vector<Defines> combineAll(const std::vector<FreeMacro>& macros, const Defines& fixed) {
    std::vector<Defines> variants{fixed};
    for (const FreeMacro& macro : macros) {
        std::vector<Defines> grown;
        for (const Defines& variant : variants) {
            for (const std::string& value : macro.values) {
                grown.push_back(variant);
                grown.back()[macro.name] = value;
            }
        }
        variants = std::move(grown);
    }
    return variants;
}

std::vector<Defines> tryEachAlone(const std::vector<FreeMacro>& macros, const Defines& fixed) {
    std::vector<Defines> variants{fixed};
    for (const FreeMacro& macro : macros) {
        for (const std::string& value : macro.values) {
            variants.push_back(fixed);
            variants.back()[macro.name] = value;
        }
    }
    return variants;
}

}  // namespace

std::vector<Defines> enumerateVariants(const std::vector<DefineInfo>& infos, const Defines& fixed) {
    std::vector<FreeMacro> macros;
    std::size_t combinations = 1;
    for (const DefineInfo& info : infos) {
        std::vector<std::string> values = valuesOf(info);
        if (values.empty() || fixed.contains(info.name)) continue;
        if (combinations <= kMaxCombinations) combinations *= values.size();
        macros.push_back({info.name, std::move(values)});
    }
    return combinations <= kMaxCombinations ? combineAll(macros, fixed) : tryEachAlone(macros, fixed);
}

}  // namespace crevice
