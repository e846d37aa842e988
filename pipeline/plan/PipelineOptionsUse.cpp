// What `$name` and conditions stand for once options have their values.
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"
#include "plan/PipelineOptions.h"

namespace crevice {
namespace {

std::string trim(const std::string& text) {
    const auto isSpace = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    const auto first = std::find_if_not(text.begin(), text.end(), isSpace);
    const auto last = std::find_if_not(text.rbegin(), std::string::const_reverse_iterator(first), isSpace).base();
    return {first, last};
}

class Substitution {
public:
    Substitution(const std::vector<OptionDesc>& options, Problems& problems) : options_(options), problems_(problems) {}

    /// Every string "$name" inside. Keys in `skipped` of the top object stay as they are.
    void replaceIn(Value& value, const std::vector<std::string>& skipped = {}) {
        if (value.isArray()) {
            auto& items = value.items();
            std::erase_if(items, [&](Value& item) { return !replaceOne(item); });
        } else if (value.isObject()) {
            std::erase_if(value.members(), [&](Member& member) {
                const bool skip = std::find(skipped.begin(), skipped.end(), member.key) != skipped.end();
                return !skip && !replaceOne(member.value);
            });
        }
    }

    /// The value of one key of an object.
    void replaceKey(Value& owner, const char* key) {
        if (Value* value = owner.find(key); value && !replaceOne(*value)) owner.erase(key);
    }

    /// `enabled` of a flow or stage becomes a bool.
    void replaceCondition(Value& owner) {
        Value* enabled = owner.find("enabled");
        if (!enabled || !enabled->isString()) return;
        const SourceLoc where = enabled->where();
        *enabled = Value::makeBool(evaluate(enabled->string(), where), where);
    }

private:
    /// False when the value has to go because its option does not exist (reported).
    bool replaceOne(Value& value) {
        if (value.isString() && value.string().starts_with('$')) {
            const OptionDesc* option = find(value.string().substr(1), value.where());
            if (!option || option->value.isNull()) return false;
            const SourceLoc where = value.where();
            value = option->value;
            value.setWhere(where);
        } else {
            replaceIn(value);
        }
        return true;
    }

    const OptionDesc* find(const std::string& name, const SourceLoc& where) {
        std::vector<std::string> names;
        for (const OptionDesc& option : options_) {
            if (option.name == name) return &option;
            names.push_back(option.name);
        }
        problems_.error(where, fmt::format("'${}' names no option", name),
                        names.empty() ? "declare it under \"options\"" : didYouMean(name, names, "options"));
        return nullptr;
    }

    bool evaluate(const std::string& condition, const SourceLoc& where) {
        for (const char* op : {"==", "!="}) {
            const std::size_t at = condition.find(op);
            if (at == std::string::npos) continue;
            const bool equal = compare(trim(condition.substr(0, at)), trim(condition.substr(at + 2)), condition, where);
            return op[0] == '=' ? equal : !equal;
        }
        const std::string text = trim(condition);
        const bool negated = text.starts_with('!');
        const std::string use = trim(negated ? text.substr(1) : text);
        if (!isUse(use)) {
            bad(condition, where);
            return true;
        }
        const OptionDesc* option = find(use.substr(1), where);
        if (!option) return true;
        if (option->type != OptionType::Bool) {
            problems_.error(where,
                            fmt::format("condition '{}' needs a bool, option '{}' is none", condition, option->name),
                            fmt::format("compare it: \"${} == value\"", option->name),
                            {{option->where, fmt::format("'{}' is declared here", option->name)}});
            return true;
        }
        return (option->value.isBool() && option->value.boolean()) != negated;
    }

    bool compare(const std::string& use, const std::string& text, const std::string& condition,
                 const SourceLoc& where) {
        if (!isUse(use) || text.empty() || text.find_first_of("$=!&| ") != std::string::npos) {
            bad(condition, where);
            return true;
        }
        const OptionDesc* option = find(use.substr(1), where);
        if (!option) return true;
        if (option->type == OptionType::Choice) {
            if (std::find(option->choices.begin(), option->choices.end(), text) == option->choices.end())
                problems_.error(where, fmt::format("option '{}' has no choice '{}'", option->name, text),
                                didYouMean(text, option->choices, "choices"));
            return option->value.isString() && option->value.string() == text;
        }
        const Value value = parseWord(text);
        const bool sameType = option->type == OptionType::Bool ? value.isBool() : value.isNumber();
        if (!sameType) {
            problems_.error(where,
                            fmt::format("condition '{}' compares option '{}' with '{}'", condition, option->name, text),
                            option->type == OptionType::Bool ? "a bool is true or false" : "write a number");
            return true;
        }
        if (option->value.type() != value.type()) return true;
        return value.isBool() ? option->value.boolean() == value.boolean() : option->value.number() == value.number();
    }

    static Value parseWord(const std::string& text) {
        try {
            return parseJson(text, "");
        } catch (const Error&) {
            return Value::makeString(text);
        }
    }

    static bool isUse(const std::string& text) { return text.starts_with('$') && isPlainName(text.substr(1)); }

    void bad(const std::string& condition, const SourceLoc& where) {
        problems_.error(where, fmt::format("'{}' is no condition", condition),
                        "write a bool, \"$option\", \"!$option\", \"$option == value\" or \"$option != value\"");
    }

    const std::vector<OptionDesc>& options_;
    Problems& problems_;
};

}  // namespace

void substituteOptions(Value& document, const std::vector<OptionDesc>& options, Problems& problems) {
    Substitution substitution(options, problems);
    substitution.replaceKey(document, "guard");
    if (Value* targets = document.find("targets"))
        for (Member& target : targets->members()) substitution.replaceIn(target.value, {"help"});
    Value* flows = document.find("flows");
    if (!flows) return;
    for (Value& flow : flows->items()) {
        substitution.replaceCondition(flow);
        for (Value& stage : flow.find("stages")->items()) {
            substitution.replaceCondition(stage);
            substitution.replaceIn(stage, {"stage", "name", "enabled"});
        }
    }
}

}  // namespace crevice
