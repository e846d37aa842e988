// Walks the JSON of a glTF along the tables: types, ranges, lengths and references; where extensions stand.
#include "scene/GltfSchema.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/Text.h"
#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

/// Where the walk is: written out only for messages.
struct Trail {
    const Trail* parent = nullptr;
    const char* key = "";
    std::ptrdiff_t index = -1;  ///< Of a list's item.
};

class Walk {
public:
    explicit Walk(const File& file) : file_(file) {
        for (const Value& name : listIn(file.json, "extensionsUsed"))
            if (name.isString()) declared_.insert(name.string());
    }

    void checkObject(const Value& value, std::span<const Rule> rules, const Trail& trail) {
        for (const Rule& rule : rules)
            if (rule.required && !value.find(rule.key))
                breach(rule, value, fmt::format("'{}' is missing", rule.key), trail);
        for (const Member& member : value.members()) {
            const auto rule =
                std::find_if(rules.begin(), rules.end(), [&](const Rule& r) { return member.key == r.key; });
            const bool isKnown = rule != rules.end();
            if (member.key == "extensions")
                checkExtensions(member.value, isKnown ? rule->rules : std::span<const Rule>{}, trail);
            if (isKnown)
                checkMember(member.value, *rule, Trail{&trail, rule->key, -1});
            else if (member.key != "extensions" && member.key != "extras" &&
                     std::string_view(trail.key) != "extensions")
                surplus_.push_back({&member, trail.index < 0 ? -1 : trail.index, trail.key});
        }
    }

    /// Words that the format does not have: they may be meant for another program.
    void tellSurplus() const {
        constexpr std::size_t kMost = 5;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < std::min(kMost, surplus_.size()); ++i) {
            const Surplus& s = surplus_[i];
            const std::string place = s.index < 0 ? s.list : fmt::format("{}[{}]", s.list, s.index);
            names.push_back((place.empty() ? "" : place + ".") + s.member->key.substr(0, 80));
        }
        if (surplus_.size() > kMost) names.push_back(fmt::format("{} more", surplus_.size() - kMost));
        if (!names.empty()) file_.note("glTF 2.0 has no such words, they are left out: " + join(names));
    }

private:
    struct Surplus {
        const Member* member;
        std::ptrdiff_t index;
        const char* list;
    };

    // Each must be declared, and those that are read may stand only where they mean something.
    void checkExtensions(const Value& value, std::span<const Rule> rules, const Trail& trail) {
        const Rule mild{.key = "extensions", .harmless = true};
        if (!value.isObject()) {
            const Rule hard{.key = "extensions", .shape = Shape::Object};
            return wrongType(hard, value, "an object", trail);
        }
        for (const Member& member : value.members()) {
            if (!declared_.contains(member.key) && undeclared_.insert(member.key).second)
                breach(mild, value, fmt::format("'{}' is not in 'extensionsUsed'", member.key.substr(0, 80)), trail);
            const bool fits =
                std::any_of(rules.begin(), rules.end(), [&](const Rule& r) { return member.key == r.key; });
            if (!fits && isSupportedExtension(member.key))
                breach(mild, value, fmt::format("'{}' has no meaning here", member.key), trail);
            if (!member.value.isObject())
                breach(
                    mild, value,
                    fmt::format("'{}' must be an object, found {}", member.key.substr(0, 80), member.value.typeName()),
                    trail);
        }
    }

    // Throws an Error, or tells a fault of what does no harm.
    void breach(const Rule& rule, const Value& value, const std::string& what, const Trail& trail) const {
        // The outermost list and its index are the place; the rest of the path goes into the message.
        std::string path, list;
        std::size_t index = 0;
        for (const Trail* at = &trail; at && at->parent; at = at->parent) {
            const bool outermost = !at->parent->parent || (list.empty() && std::string_view(at->key) == "lights");
            if (outermost && at->index >= 0) {
                list = at->key;
                index = std::size_t(at->index);
                break;
            }
            const std::string step = at->index >= 0 ? fmt::format("{}[{}]", at->key, at->index) : at->key;
            path = path.empty() ? step : step + "." + path;
        }
        const bool named = path.empty() || what.starts_with("'" + path + "'");
        const std::string message = named ? what : fmt::format("in '{}': {}", path, what);
        if (rule.harmless && !list.empty()) return file_.fault(list, index, message);
        if (rule.harmless) return file_.fault(value.where(), message);
        if (!list.empty()) file_.fail(list, index, message);
        throw Error(file_.binary ? SourceLoc{file_.name} : value.where(), message,
                    "this breaks a rule of glTF 2.0: repair the entry, or export the file again");
    }

    void checkMember(const Value& value, const Rule& rule, const Trail& trail) {
        switch (rule.shape) {
            case Shape::Any:
                return;
            case Shape::Flag:
                if (!value.isBool()) wrongType(rule, value, "true or false", trail);
                return;
            case Shape::Text:
                return checkText(value, rule, trail);
            case Shape::Integer:
                return checkInteger(value, rule, trail);
            case Shape::Number:
                checkNumber(value, rule, trail);
                return;
            case Shape::Index:
                return checkIndex(value, rule, trail);
            case Shape::Object:
                if (!value.isObject()) return wrongType(rule, value, "an object", trail);
                return checkObject(value, rule.rules, trail);
            case Shape::IndexMap:
                return checkMap(value, rule, trail);
            case Shape::Numbers:
            case Shape::Indices:
            case Shape::Objects:
            case Shape::IndexMaps:
                return checkList(value, rule, trail);
        }
    }

    void wrongType(const Rule& rule, const Value& value, const char* wanted, const Trail& trail) const {
        breach(rule, value, fmt::format("'{}' must be {}, found {}", rule.key, wanted, value.typeName()), trail);
    }

    void checkText(const Value& value, const Rule& rule, const Trail& trail) const {
        if (!value.isString()) return wrongType(rule, value, "a string", trail);
        if (!rule.words || std::string_view(rule.words).find(" " + value.string() + " ") != std::string_view::npos)
            return;
        Rule mild = rule;
        mild.harmless = true;  // what cannot do without it says so
        breach(mild, value,
               fmt::format("'{}' is '{}'; known are{:.{}}", rule.key, value.string().substr(0, 80), rule.words,
                           std::string_view(rule.words).size() - 1),
               trail);
    }

    bool checkNumber(const Value& value, const Rule& rule, const Trail& trail, const char* type = "a number") const {
        if (!value.isNumber()) return wrongType(rule, value, type, trail), false;
        const double number = value.number();
        const bool low = rule.aboveMin ? !(number > rule.min) : !(number >= rule.min);
        if (!low && number <= rule.max) return true;
        if (rule.shape == Shape::Integer && number == 0 && rule.min == 1)
            return breach(rule, value, fmt::format("'{}' is 0", rule.key), trail), false;
        breach(rule, value,
               fmt::format("'{}' is {}, outside {} … {}{}", rule.key, number, rule.min, rule.max,
                           rule.aboveMin ? " (without the first)" : ""),
               trail);
        return false;
    }
    bool checkWhole(const Value& value, const Rule& rule, const Trail& trail) const {
        constexpr double kMax = 9007199254740992.0;
        if (value.isNumber() && value.number() >= 0 && value.number() < kMax &&
            value.number() == double(std::size_t(value.number())))
            return true;  // 1.0 and 1e0 are integers, too: glTF 2.0 specification, 2.7
        breach(rule, value, fmt::format("'{}' is not a non-negative integer", rule.key), trail);
        return false;
    }

    void checkInteger(const Value& value, const Rule& rule, const Trail& trail) const {
        if (!checkWhole(value, rule, trail) || !checkNumber(value, rule, trail, "an integer")) return;
        if (rule.oneOf.empty() || std::count(rule.oneOf.begin(), rule.oneOf.end(), int(value.number()))) return;
        breach(rule, value,
               fmt::format("'{}' is {}; known are {}", rule.key, value.number(), fmt::join(rule.oneOf, ", ")), trail);
    }

    std::size_t listSize(std::string_view list) const {
        if (list != "lights") return listIn(file_.json, list).size();
        const Value* lights = extensionOf(file_.json, "KHR_lights_punctual");
        return lights ? listIn(*lights, list).size() : 0;
    }

    void checkIndex(const Value& value, const Rule& rule, const Trail& trail) const {
        if (!checkWhole(value, rule, trail)) return;
        const std::size_t count = listSize(rule.list);
        if (value.number() >= double(count))
            breach(rule, value,
                   fmt::format("'{}' names {}[{}], the file has {}", rule.key, rule.list, std::size_t(value.number()),
                               count),
                   trail);
    }

    void checkMap(const Value& value, const Rule& rule, const Trail& trail) {
        if (!value.isObject()) return wrongType(rule, value, "an object", trail);
        if (value.members().empty()) {
            Rule mild = rule;
            mild.harmless = true;
            breach(mild, value, fmt::format("'{}' is empty", rule.key), trail);
        }
        for (const Member& member : value.members()) {
            Rule each{.key = member.key.c_str(), .shape = Shape::Index, .list = rule.list};
            checkIndex(member.value, each, trail);
        }
    }

    void checkList(const Value& value, const Rule& rule, const Trail& trail) {
        if (!value.isArray()) return wrongType(rule, value, "a list", trail);
        const std::size_t count = value.items().size();
        Rule mild = rule;
        mild.harmless = mild.harmless || (count == 0 && rule.most == 0);
        if (count < rule.least || (rule.most && count > rule.most))
            breach(mild, value,
                   rule.most == 0 ? fmt::format("'{}' is empty", rule.key)
                                  : fmt::format("'{}' has {} numbers, not {}", rule.key, count, rule.least),
                   trail);
        for (std::size_t i = 0; i < count; ++i) {
            const Value& item = value.items()[i];
            const Trail next{trail.parent, rule.key, std::ptrdiff_t(i)};
            if (rule.shape == Shape::Numbers) checkNumber(item, rule, trail);
            if (rule.shape == Shape::Indices) checkIndex(item, rule, trail);
            if (rule.shape == Shape::IndexMaps) checkMap(item, rule, next);
            if (rule.shape != Shape::Objects) continue;
            if (item.isObject())
                checkObject(item, rule.rules, next);
            else
                breach(rule, item, fmt::format("it must be an object, found {}", item.typeName()), next);
        }
    }

    const File& file_;
    std::set<std::string, std::less<>> declared_;    ///< In extensionsUsed
    std::set<std::string, std::less<>> undeclared_;  ///< Told already
    std::vector<Surplus> surplus_;
};

}  // namespace

namespace {

// 1.0 and 1e0 are integers, too (glTF 2.0 specification, 2.7), but not to tinygltf.
void writeWhole(Value& value) {
    if (value.isNumber() && !value.isInteger()) value = Value::makeNumber(value.number(), value.where());
}

void normalise(Value& value, std::span<const Rule> rules);

void normalise(Value& value, const Rule& rule) {
    const bool isIndex = rule.shape == Shape::Index || rule.shape == Shape::Integer;
    if (isIndex) return writeWhole(value);
    if (rule.shape == Shape::Object) return normalise(value, rule.rules);
    if (rule.shape == Shape::IndexMap && value.isObject())
        for (Member& member : value.members()) writeWhole(member.value);
    if (!value.isArray()) return;
    const Rule each{.key = rule.key,
                    .shape = rule.shape == Shape::Objects     ? Shape::Object
                             : rule.shape == Shape::Indices   ? Shape::Index
                             : rule.shape == Shape::IndexMaps ? Shape::IndexMap
                                                              : Shape::Any,
                    .rules = rule.rules};
    if (each.shape == Shape::Any) return;
    for (Value& item : value.items()) normalise(item, each);
}

void normalise(Value& value, std::span<const Rule> rules) {
    if (!value.isObject()) return;
    const auto ruleOf = [&](const Member& member) {
        return std::find_if(rules.begin(), rules.end(), [&](const Rule& r) { return member.key == r.key; });
    };
    std::erase_if(value.members(), [&](const Member& member) { return ruleOf(member) == rules.end(); });
    for (Member& member : value.members()) normalise(member.value, *ruleOf(member));
}

}  // namespace

void normalise(Value& json) {
    normalise(json, documentRules());
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        Value* names = json.find(key);
        if (!names || !names->isArray()) continue;
        std::set<std::string> seen;
        std::erase_if(names->items(), [&](const Value& name) { return !seen.insert(name.string()).second; });
    }
}

void checkSchema(const File& file) {
    Walk walk(file);
    walk.checkObject(file.json, documentRules(), Trail{});
    walk.tellSurplus();
}

}  // namespace crevice::gltf
