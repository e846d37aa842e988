// Looks at descriptions first, then at the conditions.
#include "cocos/OutsideNames.h"

#include <algorithm>
#include <string>

#include "cocos/Conditions.h"
#include "cocos/EngineMacros.h"

namespace crevice::cocos {
namespace {

using Names = std::unordered_set<std::string_view>;

/// Of a condition's line: the names that it tests, and those that it compares.
struct ConditionNames {
    std::vector<std::string_view> tested;
    std::vector<std::string> compared;
};

ConditionNames namesOf(std::string_view condition) {
    ConditionNames names;
    const Directive line = readDirective(condition);
    if (line.kind == LineKind::Ifdef || line.kind == LineKind::Ifndef) {
        names.tested.push_back(leadingName(line.rest));
    } else if (line.kind == LineKind::If || line.kind == LineKind::Elif) {
        for (std::size_t at = 0; at < line.rest.size();) {
            const std::string_view word = leadingName(line.rest.substr(at));
            if (!word.empty() && word != "defined") names.tested.push_back(word);
            at += std::max<std::size_t>(1, word.size());
        }
        names.compared = keepNames(line.rest, [](std::string_view, bool) { return ConditionName{}; }).compared;
    }
    return names;
}

}  // namespace

void addWordsOf(const DefineInfo& info, MacroBodies& bodies) {
    auto& words = bodies[info.name];
    words.insert(words.end(), info.options.begin(), info.options.end());
    words.push_back(info.defaultValue);
}

void readOutsideNames(const std::vector<FlatDirective>& directives, std::string_view text, const Names& defined,
                      MacroBodies& bodies, LiveHints& hints) {
    Names described, open;
    std::unordered_set<std::string> numbers;
    for (const FlatDirective& directive : directives) {
        if (directive.kind == LineKind::PragmaDefine && directive.macro != nullptr && !directive.macro->dead)
            hints.kept.push_back(directive.line);
        if (directive.kind != LineKind::Pragma) continue;
        const DefineInfo& info = directive.meta->info;
        described.insert(info.name);
        addWordsOf(info, bodies);
        if (info.type == DefineType::String && info.options.empty()) open.insert(info.name);
    }
    Names tested;
    for (const FlatDirective& directive : directives) {
        if (!isConditional(directive.kind)) continue;
        const ConditionNames names = namesOf(text.substr(directive.offset, directive.length));
        numbers.insert(names.compared.begin(), names.compared.end());
        for (const std::string_view name : names.tested)
            if (!name.empty() && !described.contains(name) && !engineConstants().contains(name)) tested.insert(name);
    }
    for (const std::string_view name : tested)
        if (!numbers.contains(std::string(name))) open.insert(name);
    for (const std::string_view name : open)
        if (!defined.contains(name)) hints.open.push_back(name);
}

}  // namespace crevice::cocos
