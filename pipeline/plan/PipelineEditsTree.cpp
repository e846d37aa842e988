// Merges documents and finds the parts of a pipeline tree.
#include "plan/PipelineEditsTree.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "plan/PipelineAssetKeys.h"

namespace crevice {

std::vector<Value>& treeFlows(Value& document) {
    if (!document.find("flows")) document.set("flows", Value::makeArray(document.where()), document.where());
    return document.find("flows")->items();
}

std::vector<Value>& flowStages(Value& flow) { return flow.find("stages")->items(); }
const std::vector<Value>& flowStages(const Value& flow) { return flow.find("stages")->items(); }
Value& stageAt(std::vector<Value>& flows, const TreePlace& place) { return flowStages(flows[place.flow])[place.stage]; }

const std::string& stageName(const Value& stage) {
    const Value* name = stage.find("name");
    return name ? name->string() : stage.find("stage")->string();
}

const SourceLoc& stageNameWhere(const Value& stage) {
    const Value* name = stage.find("name");
    return name ? name->where() : stage.find("stage")->where();
}

std::optional<TreePlace> findStage(const std::vector<Value>& flows, const std::string& name) {
    for (std::size_t f = 0; f < flows.size(); ++f) {
        const auto& stages = flowStages(flows[f]);
        for (std::size_t s = 0; s < stages.size(); ++s)
            if (stageName(stages[s]) == name) return TreePlace{f, s};
    }
    return std::nullopt;
}

std::optional<std::size_t> findFlow(const std::vector<Value>& flows, const std::string& name) {
    for (std::size_t f = 0; f < flows.size(); ++f)
        if (flows[f].find("flow")->string() == name) return f;
    return std::nullopt;
}

std::vector<std::string> stageNames(const std::vector<Value>& flows) {
    std::vector<std::string> names;
    for (const Value& flow : flows)
        for (const Value& stage : flowStages(flow)) names.push_back(stageName(stage));
    return names;
}

std::vector<std::string> flowNames(const std::vector<Value>& flows) {
    std::vector<std::string> names;
    for (const Value& flow : flows) names.push_back(flow.find("flow")->string());
    return names;
}

void addFlow(std::vector<Value>& flows, const Value& flow, bool byPriority, Problems& problems) {
    const Value& name = *flow.find("flow");
    if (const auto first = findFlow(flows, name.string())) {
        problems.error(name.where(), fmt::format("a second flow named '{}'", name.string()),
                       "to change the stages of the first one, use \"edits\"",
                       {{flows[*first].find("flow")->where(), "the first one is here"}});
        return;
    }
    const auto priorityOf = [](const Value& f) -> std::optional<std::int64_t> {
        const Value* priority = f.find("priority");
        return priority && priority->isInteger() ? std::optional(priority->integer()) : std::nullopt;
    };
    const auto priority = priorityOf(flow);
    const auto later = std::find_if(flows.begin(), flows.end(), [&](const Value& other) {
        const auto otherPriority = priorityOf(other);
        return byPriority && priority && otherPriority && *otherPriority > *priority;
    });
    flows.insert(later, flow);
}

void mergeKey(Value& object, const std::string& key, const Value& value, const SourceLoc& where) {
    Value* old = object.find(key);
    if (value.isNull()) {
        object.erase(key);
    } else if (old && old->isObject() && value.isObject()) {
        for (const Member& member : value.members()) mergeKey(*old, member.key, member.value, member.keyLoc);
    } else {
        object.set(key, value, where);
    }
}

namespace {

/// Ways to give a size exclude each other: the later one wins.
void mergeDefinition(Value& first, const Value& second) {
    if (second.find("scale") || second.find("like")) first.erase("size");
    if (second.find("size") || second.find("like")) first.erase("scale");
    for (const Member& member : second.members())
        if (member.key != "override") mergeKey(first, member.key, member.value, member.keyLoc);
}

/// "targets", "blocks" or "options": new names are added, known ones need "override", null takes one out.
void mergeSection(PipelineTree& tree, const Value& from, const char* section, const char* what, Problems& problems) {
    Value& document = tree.document;
    const bool isTargets = section == std::string_view("targets");
    if (!document.find(section)) document.set(section, Value::makeObject(from.where()), from.where());
    Value& into = *document.find(section);
    for (const Member& member : from.members()) {
        const Value* flag = member.value.isObject() ? member.value.find("override") : nullptr;
        const bool overrides = flag && flag->isBool() && flag->boolean();
        const auto first = std::find_if(into.members().begin(), into.members().end(),
                                        [&](const Member& other) { return other.key == member.key; });
        if (member.value.isNull() && first != into.members().end()) {
            if (isTargets) tree.reach.noteRemovedTarget(first->value, member.keyLoc);
            into.erase(member.key);
            continue;
        }
        if (first == into.members().end()) {
            into.set(member.key, member.value, member.keyLoc);
            if (overrides) into.find(member.key)->erase("override");
        } else if (overrides && first->value.isObject()) {
            for (const Member& key : member.value.members())
                if (isTargets) tree.reach.noteTargetKey(first->value, key.key, key.keyLoc);
            mergeDefinition(first->value, member.value);
        } else {
            problems.error(member.keyLoc, fmt::format("{} '{}' is defined a second time", what, member.key),
                           "add \"override\": true to change the first one, or choose another name",
                           {{first->keyLoc, "first defined here"}});
        }
    }
}

void mergePlugins(Value& document, const Value& plugins) {
    if (!document.find("plugins")) document.set("plugins", Value::makeArray(plugins.where()), plugins.where());
    auto& all = document.find("plugins")->items();
    for (const Value& plugin : plugins.items()) {
        const bool known = plugin.isString() && std::any_of(all.begin(), all.end(), [&](const Value& other) {
                               return other.isString() && other.string() == plugin.string();
                           });
        if (!known) all.push_back(plugin);
    }
}

/// A good value of such a key: bad ones were reported when the file was read.
bool isNumberOrOption(const Value& value, const KeySpec& spec) {
    if (spec.kind != KeyKind::NumberOrOption) return false;
    if (value.isString()) return value.string().starts_with('$');
    return value.isNumber() && value.number() >= spec.min && value.number() <= spec.max;
}

/// The first list of flows stands as it is written; a child's flows find their places by priority.
void mergeFlows(Value& document, const Value& flows, Problems& problems) {
    const bool first = !document.find("flows");
    if (first) document.set("flows", Value::makeArray(flows.where()), flows.where());
    for (const Value& flow : flows.items()) addFlow(treeFlows(document), flow, !first, problems);
}

}  // namespace

void mergeDocument(PipelineTree& tree, const Value& document, Problems& problems) {
    if (!tree.document.isObject()) tree.document = Value::makeObject(document.where());
    for (const Member& member : document.members()) {
        const Value& value = member.value;
        const KeySpec* spec = pipelineKeys().find(member.key);
        if (!spec) continue;  // Reported when the file was read, as are values of a wrong type.
        const bool isWord = spec->kind == KeyKind::Text || spec->kind == KeyKind::Choice;
        if (isWord && value.isString() && member.key != "extends" && member.key != "$schema")
            tree.document.set(member.key, value, member.keyLoc);
        if ((member.key == "fallbacks" || member.key == "macros") && value.isObject())
            tree.document.set(member.key, value, member.keyLoc);
        if (member.key == "macros") tree.reach.noteAll(member.keyLoc);
        if (isNumberOrOption(value, *spec)) tree.document.set(member.key, value, member.keyLoc);
        if (member.key == "plugins" && value.isArray()) mergePlugins(tree.document, value);
        if (member.key == "targets" && value.isObject()) mergeSection(tree, value, "targets", "target", problems);
        if (member.key == "blocks" && value.isObject()) mergeSection(tree, value, "blocks", "block", problems);
        if (member.key == "options" && value.isObject())
            for (const Member& option : value.members())
                if (option.value.isNull()) tree.removed.push_back("$" + option.key);
        if (member.key == "options" && value.isObject()) mergeSection(tree, value, "options", "option", problems);
        if (member.key == "flows" && value.isArray()) mergeFlows(tree.document, value, problems);
    }
}

}  // namespace crevice
