// A mixed-radix count over the values of all free macros.
#include "app/commands/EffectVariants.h"

namespace crevice {
namespace {

struct FreeMacro {
    std::string name, usual;
    std::vector<std::string> values;  ///< To combine.
    std::vector<std::string> alone;   ///< To try one by one.
};

FreeMacro freeMacro(const DefineInfo& info) {
    FreeMacro macro{info.name, info.defaultValue, {}, {}};
    if (info.type == DefineType::Bool) macro.values = {"0", "1"};
    if (info.type == DefineType::String) macro.values = info.options;
    if (info.type == DefineType::Number && info.range)
        macro.values = {std::to_string(info.range->first), std::to_string(info.range->second)};
    macro.alone = macro.values;
    if (info.type == DefineType::Number && info.range && info.range->second - info.range->first < kMaxValues) {
        macro.alone.clear();
        for (int value = info.range->first; value <= info.range->second; ++value)
            macro.alone.push_back(std::to_string(value));
    }
    return macro;
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
        for (const std::string& value : macro.alone) {
            if (value == macro.usual) continue;
            variants.push_back(fixed);
            variants.back()[macro.name] = value;
        }
    }
    return variants;
}

}  // namespace

VariantList enumerateVariants(const std::vector<DefineInfo>& infos, const Defines& fixed) {
    std::vector<FreeMacro> macros;
    std::size_t combinations = 1;
    for (const DefineInfo& info : infos) {
        FreeMacro macro = freeMacro(info);
        if (macro.values.empty() || fixed.contains(info.name)) continue;
        if (combinations <= kMaxCombinations) combinations *= macro.values.size();
        macros.push_back(std::move(macro));
    }
    const bool alone = combinations > kMaxCombinations;
    return {alone ? tryEachAlone(macros, fixed) : combineAll(macros, fixed), macros.size(), alone};
}

}  // namespace crevice
