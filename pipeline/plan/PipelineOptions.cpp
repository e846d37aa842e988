// Declarations of options, the caller's values, and the sets that values carry.
#include "plan/PipelineOptions.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"
#include "plan/PipelineEditsTree.h"

namespace crevice {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<std::string> readChoices(const Value& choices, const OptionDesc& option, Problems& problems) {
    std::vector<std::string> names;
    const std::string what = fmt::format("option '{}'", option.name);
    if (choices.isArray()) {
        for (const Value& item : choices.items()) {
            if (item.isString()) {
                names.push_back(item.string());
            } else {
                problems.error(item.where(),
                               fmt::format("a choice of {} must be a string, found {}", what, item.typeName()),
                               "write names in quotes");
            }
        }
    } else {
        for (const Member& member : choices.members()) {
            names.push_back(member.key);
            ObjectReader(member.value, choiceKeys(), fmt::format("choice '{}' of {}", member.key, what), problems);
        }
    }
    if (names.empty()) problems.error(choices.where(), fmt::format("{} has no choices", what), "name at least one");
    return names;
}

void checkBoolChoices(const Value& choices, const OptionDesc& option, Problems& problems) {
    if (!choices.isObject()) {
        problems.error(choices.where(), fmt::format("'choices' of bool option '{}' must be an object", option.name),
                       "write { \"true\": { \"set\": … }, \"false\": { \"set\": … } }, or remove it");
        return;
    }
    for (const Member& member : choices.members()) {
        ObjectReader(member.value, choiceKeys(), fmt::format("choice '{}' of option '{}'", member.key, option.name),
                     problems);
        if (member.key != "true" && member.key != "false")
            problems.error(member.keyLoc, fmt::format("bool option '{}' has no value '{}'", option.name, member.key),
                           "use \"true\" and \"false\", or \"type\": \"choice\"");
    }
}

/// As messages show a value: 'text', 3, true.
std::string quoted(const Value& value) { return value.isString() ? "'" + value.string() + "'" : value.toJson(-1); }

/// Numbers may have a default that somebody else works out; then the caller may ask for it, too.
bool isAuto(const Value& value) { return value.isString() && value.string() == "auto"; }

/// Whether a value fits an option; says what is wrong otherwise.
bool fits(const Value& value, const OptionDesc& option, const SourceLoc& where, Problems& problems) {
    const std::string what = fmt::format("option '{}'", option.name);
    if (option.type == OptionType::Bool) {
        if (value.isBool()) return true;
        problems.error(where, fmt::format("{} must be true or false, found {}", what, quoted(value)),
                       "write true or false");
    } else if (option.type == OptionType::Number) {
        const bool inRange = value.isNumber() && value.number() >= option.min && value.number() <= option.max;
        if (inRange || (isAuto(value) && isAuto(option.defaultValue))) return true;
        std::string help = isAuto(option.defaultValue) ? "write auto or a number" : "write a number";
        if (std::isfinite(option.min) && std::isfinite(option.max))
            help += fmt::format(" from {} to {}", option.min, option.max);
        else if (std::isfinite(option.min))
            help += fmt::format(" of {} or more", option.min);
        else if (std::isfinite(option.max))
            help += fmt::format(" up to {}", option.max);
        problems.error(where,
                       value.isNumber() ? fmt::format("{} is {}, out of range", what, value.number())
                                        : fmt::format("{} must be a number, found {}", what, quoted(value)),
                       help);
    } else {
        const auto& names = option.choices;
        if (value.isString() && std::find(names.begin(), names.end(), value.string()) != names.end()) return true;
        const std::string found = value.isString() ? value.string() : value.toJson(-1);
        problems.error(where, fmt::format("{} has no choice '{}'", what, found), didYouMean(found, names, "choices"));
    }
    return false;
}

void readOption(const Member& member, std::vector<OptionDesc>& options, Problems& problems) {
    OptionDesc option;
    option.name = member.key;
    option.where = member.keyLoc;
    const ObjectReader reader(member.value, optionKeys(), fmt::format("option '{}'", member.key), problems);
    if (!isPlainName(member.key))
        problems.error(member.keyLoc, fmt::format("'{}' cannot name an option", member.key),
                       "use letters, digits, '_' and '-', beginning with a letter or '_'");
    option.help = reader.text("help");
    const std::vector<std::string> types = optionTypeNames();
    const Value* type = reader.get("type");
    const Value* choices = reader.get("choices");
    if (type) {
        option.type = static_cast<OptionType>(std::find(types.begin(), types.end(), type->string()) - types.begin());
        if (option.type == OptionType::Choice && choices) option.choices = readChoices(*choices, option, problems);
        if (option.type == OptionType::Choice && !member.value.find("choices") && !reader.isMisspelt("choices"))
            problems.error(member.value.where(), fmt::format("missing key 'choices' in option '{}'", option.name),
                           "add \"choices\": [ \"…\" ]");
        if (option.type == OptionType::Bool && choices) checkBoolChoices(*choices, option, problems);
        if (option.type == OptionType::Number && choices)
            problems.error(choices->where(), fmt::format("number option '{}' cannot have 'choices'", option.name),
                           "use \"type\": \"choice\", or \"min\" and \"max\"");
        for (const char* key : {"min", "max"})
            if (const Value* limit = reader.get(key); limit && option.type != OptionType::Number)
                problems.error(limit->where(), fmt::format("'{}' of option '{}', which is no number", key, option.name),
                               "remove it");
    }
    option.min = reader.number("min").value_or(-kInfinity);
    option.max = reader.number("max").value_or(kInfinity);
    const Value* defaultValue = reader.get("default");
    const bool known = type && (option.type != OptionType::Choice || !option.choices.empty());
    if (defaultValue) option.defaultValue = *defaultValue;
    if (defaultValue && known) fits(*defaultValue, option, defaultValue->where(), problems);
    option.value = option.defaultValue;
    options.push_back(std::move(option));
}

/// An argument for an option: choices stay text even if they look like numbers.
void requestValue(OptionDesc& option, const std::string& text, Problems& problems) {
    const SourceLoc where{.file = fmt::format("--option {}={}", option.name, text)};
    try {
        const Value value =
            option.type == OptionType::Choice ? Value::makeString(text, where) : parseArgument(text, where);
        if (fits(value, option, where, problems)) option.value = value;
    } catch (const Error& error) {
        problems.add(error);
    }
}

/// Calls visit(set object) for each choice of each option that carries one.
template <class Visit>
void forEachChoice(Value& document, Visit visit) {
    Value* options = document.find("options");
    if (!options || !options->isObject()) return;
    for (Member& option : options->members()) {
        Value* choices = option.value.isObject() ? option.value.find("choices") : nullptr;
        if (!choices || !choices->isObject()) continue;
        for (Member& choice : choices->members()) {
            Value* set = choice.value.isObject() ? choice.value.find("set") : nullptr;
            if (set && set->isObject()) visit(option.key, choice.key, *set);
        }
    }
}

/// Stage.seed and Stage.params.seed are the same value.
std::string longPath(const std::string& path) {
    const std::size_t dot = path.find('.');
    if (dot == std::string::npos || path.find('.', dot + 1) != std::string::npos) return path;
    const std::string key = path.substr(dot + 1);
    return stageKeys().find(key) ? path : path.substr(0, dot) + ".params." + key;
}

/// "$guard" among a choice's sets is what `auto` of the option guard stands for.
bool isAutoPath(const std::string& path) { return path.starts_with('$'); }

/// The option that such a set names, with a range that its value fits. A younger document may have put a number in
/// place of `auto`, which then wins.
void checkAutoSet(const PipelineTree& tree, const Member& set, Problems& problems) {
    const Value& options = *tree.document.find("options");
    const std::string name = set.key.substr(1);
    const auto declared = std::find_if(options.members().begin(), options.members().end(),
                                       [&](const Member& option) { return option.key == name; });
    if (declared == options.members().end()) {
        std::vector<std::string> names;
        for (const Member& known : options.members()) names.push_back(known.key);
        problems.error(set.keyLoc, fmt::format("'{}' names no option", set.key), didYouMean(name, names, "options"));
        return;
    }
    Problems reportedElsewhere;
    std::vector<OptionDesc> read;
    readOption(*declared, read, reportedElsewhere);
    if (read[0].type != OptionType::Number) {
        problems.error(set.keyLoc,
                       fmt::format("option '{}' is no number: a choice cannot say what auto stands for", name),
                       "set values of stages and targets by their paths");
    } else if (!isAuto(read[0].defaultValue) && !tree.reach.isYounger(read[0].defaultValue.where(), set.keyLoc)) {
        problems.error(set.keyLoc,
                       fmt::format("the default of option '{}' is {}: there is no auto for '{}' to stand for", name,
                                   quoted(read[0].defaultValue), set.key),
                       fmt::format("give '{}' the default \"auto\", or remove '{}'", name, set.key),
                       {{read[0].defaultValue.where(), "the default is here"}});
    } else if (!isAuto(set.value)) {
        fits(set.value, read[0], set.value.where(), problems);
    }
}

/// The last choice in force decides, where the caller left it open.
void applyAutoSets(const std::vector<Member>& sets, std::vector<OptionDesc>& options) {
    for (OptionDesc& option : options) {
        if (!isAuto(option.value) || option.type != OptionType::Number) continue;
        for (const Member& set : sets)
            if (set.key == "$" + option.name) option.value = set.value;
    }
}

std::string firstPart(const std::string& path) { return path.substr(0, path.find('.')); }
std::string secondPart(const std::string& path) {
    const std::string rest = path.substr(std::min(path.size(), path.find('.') + 1));
    return firstPart(rest);
}

/// What a set of a choice means for `reach`, were the choice in force.
void noteReachChange(PipelineTree& tree, const std::string& path, const SourceLoc& where) {
    const std::string name = firstPart(path);
    const Value* targets = tree.document.find("targets");
    const Value* target = targets ? targets->find(name) : nullptr;
    if (target && !findStage(treeFlows(tree.document), name)) {
        tree.reach.noteTargetKey(*target, secondPart(path), where);
    } else {
        tree.reach.noteStageKey(name, secondPart(path), where);
    }
}

/// A stale `reach`, or what `auto` stands for where nobody asks for it.
bool isWithoutUse(const PipelineTree& tree, const std::vector<OptionDesc>& options, const Member& set) {
    if (isAutoPath(set.key))
        return std::any_of(options.begin(), options.end(), [&](const OptionDesc& option) {
            return "$" + option.name == set.key && !isAuto(option.value);
        });
    return secondPart(set.key) == "reach" && tree.reach.isStale(firstPart(set.key), set.value.where());
}

}  // namespace

std::vector<OptionDesc> readOptions(const Value& document, const std::map<std::string, std::string>& requested,
                                    Problems& problems) {
    std::vector<OptionDesc> options;
    if (const Value* all = document.find("options"))
        for (const Member& member : all->members()) readOption(member, options, problems);
    for (const auto& [name, text] : requested) {
        const auto option =
            std::find_if(options.begin(), options.end(), [&word = name](auto& o) { return o.name == word; });
        if (option != options.end()) {
            requestValue(*option, text, problems);
            continue;
        }
        std::vector<std::string> names;
        for (const OptionDesc& known : options) names.push_back(known.name);
        problems.error({.file = fmt::format("--option {}={}", name, text)}, fmt::format("no option named '{}'", name),
                       names.empty() ? "this pipeline has no options" : didYouMean(name, names, "options"));
    }
    return options;
}

void checkChoiceSets(PipelineTree& tree, Problems& problems) {
    const std::vector<std::string>& removed = tree.removed;
    // Names may come back by a later insert or declaration: only those that are still gone count.
    std::vector<std::string> present = stageNames(treeFlows(tree.document));
    if (const Value* declared = tree.document.find("options"))
        for (const Member& option : declared->members()) present.push_back("$" + option.key);
    const auto isGone = [&](const std::string& name) {
        return std::find(removed.begin(), removed.end(), name) != removed.end() &&
               std::find(present.begin(), present.end(), name) == present.end();
    };
    forEachChoice(tree.document, [&](auto&, auto&, Value& set) {
        std::erase_if(set.members(), [&](const Member& member) { return isGone(firstPart(member.key)); });
        const Value copy = set;  // The tree must not change under the path that is checked.
        for (const Member& member : copy.members()) {
            if (isAutoPath(member.key))
                checkAutoSet(tree, member, problems);
            else
                applySet(tree, member.key, member.value, member.keyLoc, problems, true);
        }
    });
}

void applyChoiceSets(PipelineTree& tree, std::vector<OptionDesc>& options) {
    std::vector<Member> sets;
    forEachChoice(tree.document, [&](const std::string& name, const std::string& choice, Value& set) {
        for (const OptionDesc& option : options) {
            if (option.name != name) continue;
            const std::string inForce = option.value.isString() ? option.value.string() : option.value.toJson(-1);
            if (inForce == choice) sets.insert(sets.end(), set.members().begin(), set.members().end());
        }
    });
    Problems reportedBefore;  // checkChoiceSets() has checked these paths.
    for (const Member& member : sets)
        if (!isAutoPath(member.key)) applySet(tree, member.key, member.value, member.keyLoc, reportedBefore);
    applyAutoSets(sets, options);
}

void keepOptions(PipelineTree& tree, const std::vector<OptionDesc>& options, const std::vector<std::string>& setPaths) {
    for (const OptionDesc& option : options)
        if (Value* kept = tree.document.find("options")->find(option.name))
            kept->set("default", option.value, option.value.where());
    // The ages of documents are lost in one text: what a choice would make stale goes at once.
    forEachChoice(tree.document, [&](auto&, auto&, Value& set) {
        for (const Member& member : set.members()) noteReachChange(tree, member.key, member.keyLoc);
    });
    forEachChoice(tree.document, [&](auto&, auto&, Value& set) {
        std::erase_if(set.members(), [&](const Member& member) {
            return isWithoutUse(tree, options, member) ||
                   std::any_of(setPaths.begin(), setPaths.end(),
                               [&](const std::string& path) { return longPath(path) == longPath(member.key); });
        });
    });
}

}  // namespace crevice
