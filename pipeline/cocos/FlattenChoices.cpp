// Which definitions of a macro to be expanded hold, as #define, #undef and conditions follow each other.
#include <fmt/format.h>

#include "cocos/FlattenRun.h"

namespace crevice::cocos {

void Flattener::noteChoice(const MacroDefinition& macro, Origin origin) {
    const std::size_t number = choices_.add(macro, places_.here(), !table_->isChosen(macro.name));
    const std::string name = choiceOf(macro.name);
    emitDirective("#undef " + name, origin, *macro.source);
    emitDirective(fmt::format("#define {} {}", name, number), origin, *macro.source);
}

const MacroDefinition* Flattener::definitionOf(std::string_view name) const {
    if (choices_.contains(name) && !choices_.isTaken(name)) {
        const auto possible = choices_.possible(name, places_);
        return possible.empty() ? nullptr : possible.back().macro;
    }
    if (const auto latest = latest_.find(name); latest != latest_.end()) return latest->second;
    const MacroDefinition* first = table_->find(name);
    return first != nullptr && first->fromPragma ? first : nullptr;
}

void Flattener::undefine(std::string_view name, Origin origin, const SourceText& source) {
    if (!table_->isExpanded(name)) return;
    const bool conditional = places_.isConditional();
    if (choices_.contains(name)) emitDirective("#undef " + choiceOf(name), origin, source);
    places_.undefine(name);
    choices_.undefine(name, conditional);
    if (const auto latest = latest_.find(name); latest != latest_.end() && !conditional) latest_.erase(latest);
}

}  // namespace crevice::cocos
