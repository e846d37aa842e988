// Looks at descriptions first, then at the conditions.
#include "cocos/analysis/OutsideNames.h"

#include <algorithm>
#include <utility>

#include "cocos/text/EngineMacros.h"

namespace crevice::cocos {
namespace {

using Names = std::unordered_set<std::string_view>;

/// Of a condition's line: the names whose values it tests, and those that it only asks for.
struct ConditionNames {
    std::vector<std::string_view> tested, asked;
};

ConditionNames namesOf(std::string_view condition) {
    ConditionNames names;
    const Directive line = readDirective(condition);
    if (line.kind == LineKind::Ifdef || line.kind == LineKind::Ifndef) {
        names.asked.push_back(leadingName(line.rest));
    } else if (line.kind == LineKind::If || line.kind == LineKind::Elif) {
        bool asks = false;
        for (std::size_t at = 0; at < line.rest.size();) {
            const std::string_view word = leadingName(line.rest.substr(at));
            if (word == "defined")
                asks = true;
            else if (!word.empty())
                (std::exchange(asks, false) ? names.asked : names.tested).push_back(word);
            at += std::max<std::size_t>(1, word.size());
        }
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
    for (const FlatDirective& directive : directives) {
        if (directive.kind == LineKind::PragmaDefine && directive.macro != nullptr && !directive.macro->dead)
            hints.kept.push_back(directive.line);
        if (directive.kind != LineKind::Pragma) continue;
        const DefineInfo& info = directive.meta->info;
        described.insert(info.name);
        addWordsOf(info, bodies);
        if (info.type == DefineType::String && info.options.empty()) open.insert(info.name);
    }
    // What a condition takes the value of is a number: it names no function.
    Names tested, asked;
    for (const FlatDirective& directive : directives) {
        if (!isConditional(directive.kind)) continue;
        const ConditionNames names = namesOf(text.substr(directive.offset, directive.length));
        tested.insert(names.tested.begin(), names.tested.end());
        asked.insert(names.asked.begin(), names.asked.end());
    }
    for (const std::string_view name : asked)
        if (!name.empty() && !tested.contains(name) && !described.contains(name) && !engineConstants().contains(name))
            open.insert(name);
    for (const std::string_view name : open)
        if (!defined.contains(name)) hints.open.push_back(name);
}

}  // namespace crevice::cocos
