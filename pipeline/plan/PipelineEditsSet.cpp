// One value by its path: `--set`, and what choices of options set.
#include <algorithm>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/PipelineAssetKeys.h"
#include "plan/PipelineEdits.h"
#include "plan/PipelineEditsTree.h"

namespace crevice {
namespace {

std::vector<std::string> splitPath(const std::string& path) {
    std::vector<std::string> parts{""};
    for (const char c : path) {
        if (c == '.') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

bool isMapKey(const std::string& key) {
    return key == "params" || key == "material" || key == "states" || key == "defines" || key == "reads";
}

/// Whether one letter more, less or changed makes `a` into `b`: a typing mistake rather than another word.
bool isOneLetterOff(const std::string& a, const std::string& b) {
    const std::string& longer = a.size() >= b.size() ? a : b;
    const std::string& shorter = a.size() >= b.size() ? b : a;
    if (longer.size() - shorter.size() > 1) return false;
    std::size_t i = 0;
    while (i < shorter.size() && shorter[i] == longer[i]) ++i;
    const std::size_t skip = longer.size() == shorter.size() ? 1 : 0;
    return i + skip <= shorter.size() ? shorter.substr(i + skip) == longer.substr(i + 1) : false;
}

void setDeep(Value& object, const std::string& key, const Value& value, const SourceLoc& where) {
    if (value.isNull()) {
        object.erase(key);
    } else {
        object.set(key, value, where);
    }
}

class PathSetter {
public:
    PathSetter(PipelineTree& tree, const std::string& path, const Value& value, const SourceLoc& where,
               Problems& problems, bool dryRun)
        : tree_(tree),
          path_(path),
          parts_(splitPath(path)),
          value_(value),
          where_(where),
          problems_(problems),
          dryRun_(dryRun) {}

    void apply() {
        if (path_ == "guard") {
            if (!dryRun_) setDeep(tree_.document, path_, value_, where_);
            return;
        }
        if (parts_.size() < 2 || std::any_of(parts_.begin(), parts_.end(), [](auto& p) { return p.empty(); })) {
            fail(fmt::format("'{}' is no path of a value", path_),
                 "write it as 'Stage.params.name', 'Stage.material.name', 'Stage.key', 'target.key' or 'guard'");
            return;
        }
        std::vector<Value>& flows = treeFlows(tree_.document);
        Value* targets = tree_.document.find("targets");
        if (const auto place = findStage(flows, parts_[0])) {
            setStage(stageAt(flows, *place));
            if (!dryRun_) tree_.reach.noteStageKey(parts_[0], parts_[1], where_);
        } else if (Value* target = targets ? targets->find(parts_[0]) : nullptr) {
            if (target->isObject()) setTarget(*target);
        } else if (const auto flow = findFlow(flows, parts_[0])) {
            setFlow(flows[*flow]);
        } else {
            std::vector<std::string> names = stageNames(flows);
            if (targets)
                for (const Member& member : targets->members()) names.push_back(member.key);
            fail(fmt::format("no stage or target named '{}'", parts_[0]),
                 didYouMean(parts_[0], names, "stages and targets"));
        }
    }

private:
    void fail(std::string message, std::string help) { problems_.error(where_, std::move(message), std::move(help)); }

    void setStage(Value& stage) {
        const std::string& key = parts_[1];
        const std::string what = fmt::format("stage '{}'", parts_[0]);
        if (key == "stage" || key == "name") {
            fail(fmt::format("'{}' of {} cannot be set", key, what), "use an edit of the document: replace");
        } else if (isMapKey(key)) {
            setInMap(stage, key, what);
        } else if (stageKeys().find(key)) {
            setOwnKey(stage, what);
            // How far it reads is a property of the effect.
            if (!dryRun_ && key == "effect") stage.erase("reach");
        } else if (parts_.size() == 2 && !looksMistyped(key)) {
            setParam(stage, key);  // Stage.seed is short for Stage.params.seed; the class knows its own parameters.
        } else {
            fail(fmt::format("unknown key '{}' in {}", key, what),
                 didYouMean(key, stageKeys().names(), "keys") +
                     fmt::format("; parameters: '{}.params.NAME'", parts_[0]));
        }
    }

    void setInMap(Value& stage, const std::string& key, const std::string& what) {
        if (parts_.size() > 3) {
            fail(fmt::format("'{}' goes deeper than a value of '{}'", path_, key),
                 fmt::format("write '{}.{}.{}' and a scalar or a list", parts_[0], key, parts_[2]));
        } else if (parts_.size() == 2 && !value_.isObject() && !(key == "reads" && value_.isArray())) {
            fail(fmt::format("'{}' of {} is a group of values, found {}", key, what, value_.typeName()),
                 fmt::format("name one of them: '{}.{}.NAME'", parts_[0], key));
        } else if (!dryRun_) {
            Value* map = stage.find(key);
            if (parts_.size() == 2) {
                setDeep(stage, key, value_, where_);
            } else {
                if (!map || !map->isObject()) stage.set(key, Value::makeObject(where_), where_);
                setDeep(*stage.find(key), parts_[2], value_, where_);
            }
        }
    }

    void setParam(Value& stage, const std::string& name) {
        if (dryRun_) return;
        if (!stage.find("params")) stage.set("params", Value::makeObject(where_), where_);
        if (Value* params = stage.find("params"); params->isObject()) setDeep(*params, name, value_, where_);
    }

    bool looksMistyped(const std::string& key) const {
        const std::vector<std::string> keys = stageKeys().names();
        return std::any_of(keys.begin(), keys.end(),
                           [&](const std::string& known) { return isOneLetterOff(key, known); });
    }

    void setOwnKey(Value& object, const std::string& what) {
        if (parts_.size() > 2) {
            fail(fmt::format("'{}' of {} holds no values with names", parts_[1], what),
                 fmt::format("write '{}.{}'", parts_[0], parts_[1]));
        } else if (!dryRun_) {
            setDeep(object, parts_[1], value_, where_);
        }
    }

    void setTarget(Value& target) {
        const std::string& key = parts_[1];
        const std::string what = fmt::format("target '{}'", parts_[0]);
        if (!targetKeys().find(key) || key == "override") {
            fail(fmt::format("unknown key '{}' in {}", key, what), didYouMean(key, targetKeys().names(), "keys"));
            return;
        }
        if (!dryRun_) tree_.reach.noteTargetKey(target, key, where_);
        if (!dryRun_ && (key == "scale" || key == "size")) target.erase(key == "scale" ? "size" : "scale");
        setOwnKey(target, what);
    }

    void setFlow(Value& flow) {
        const std::string what = fmt::format("flow '{}'", parts_[0]);
        if (parts_[1] == "enabled" || parts_[1] == "priority") {
            setOwnKey(flow, what);
        } else {
            fail(fmt::format("'{}' of {} cannot be set", parts_[1], what), "keys: enabled, priority");
        }
    }

    PipelineTree& tree_;
    const std::string& path_;
    const std::vector<std::string> parts_;
    const Value& value_;
    const SourceLoc& where_;
    Problems& problems_;
    const bool dryRun_;
};

void placeAt(Value& value, const SourceLoc& where) {
    value.setWhere(where);
    if (value.isArray())
        for (Value& item : value.items()) placeAt(item, where);
    if (value.isObject())
        for (Member& member : value.members()) {
            member.keyLoc = where;
            placeAt(member.value, where);
        }
}

}  // namespace

void applySet(PipelineTree& tree, const std::string& path, const Value& value, const SourceLoc& where,
              Problems& problems, bool dryRun) {
    PathSetter(tree, path, value, where, problems, dryRun).apply();
}

Value parseArgument(const std::string& text, const SourceLoc& where) {
    Value value;
    try {
        value = parseJson(text, where.file);
    } catch (const Error& error) {
        const char first = text.empty() ? ' ' : text[0];
        if (first == '[' || first == '{' || first == '"')
            throw Error(where, fmt::format("'{}' is no JSON value: {}", text, error.problems()[0].message),
                        "write a number, true, false, a list such as '[1, 2]', or a word");
        value = Value::makeString(text);
    }
    placeAt(value, where);
    return value;
}

void applySets(PipelineTree& tree, const std::vector<StageSet>& sets, Problems& problems) {
    for (const StageSet& set : sets) {
        const SourceLoc where{.file = fmt::format("--set {}={}", set.path, set.value)};
        try {
            applySet(tree, set.path, parseArgument(set.value, where), where, problems);
        } catch (const Error& error) {
            problems.add(error);
        }
    }
}

}  // namespace crevice
