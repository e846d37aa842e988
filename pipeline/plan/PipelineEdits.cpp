// `edits`: insert, set, replace, remove.
#include "plan/PipelineEdits.h"

#include <optional>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"
#include "plan/PipelineEditsTree.h"

namespace crevice {
namespace {

class Editor {
public:
    Editor(PipelineTree& tree, const PriorityLookup& defaultPriority, Problems& problems)
        : tree_(tree), flows_(treeFlows(tree.document)), defaultPriority_(defaultPriority), problems_(problems) {}

    void apply(const Value& edit);

private:
    void insert(const Value& edit);
    void insertFlow(const ObjectReader& reader, const Value& flow);
    void insertStage(const ObjectReader& reader, const Value& stage);
    void insertByPriority(const ObjectReader& reader, Value stage);
    void set(const Value& edit);
    void setStage(const Value& edit, Value& stage);
    void setFlow(const Value& edit, Value& flow);
    void replace(const Value& edit);
    void remove(const Value& edit);

    std::optional<TreePlace> findStageOrReport(const Value& name);
    /// Where `before` or `after` point: the value of the one that is there; reports when both are.
    const Value* anchorOf(const ObjectReader& reader);
    std::optional<int> priorityOf(const Value& stage) const;
    void addLast(const Value& stage);

    PipelineTree& tree_;
    std::vector<Value>& flows_;
    const PriorityLookup& defaultPriority_;
    Problems& problems_;
};

constexpr const char* kVerbs[] = {"insert", "set", "replace", "remove"};

void Editor::apply(const Value& edit) {
    if (!edit.isObject()) {
        problems_.error(edit.where(), fmt::format("an edit must be an object, found {}", edit.typeName()),
                        "an edit has one of the keys insert, set, replace, remove");
        return;
    }
    std::vector<std::string> verbs;
    for (const char* verb : kVerbs)
        if (edit.find(verb)) verbs.push_back(verb);
    if (verbs.empty()) {
        const std::string first = edit.members().empty() ? "" : edit.members()[0].key;
        problems_.error(edit.where(), "an edit says nothing to do",
                        didYouMean(first, {std::begin(kVerbs), std::end(kVerbs)}, "verbs"));
    } else if (verbs.size() > 1) {
        problems_.error(edit.where(), fmt::format("an edit has {} verbs: '{}'", verbs.size(), join(verbs, "', '")),
                        "write one edit for each; they apply in order");
    } else if (verbs[0] == "insert") {
        insert(edit);
    } else if (verbs[0] == "set") {
        set(edit);
    } else if (verbs[0] == "replace") {
        replace(edit);
    } else {
        remove(edit);
    }
}

std::optional<TreePlace> Editor::findStageOrReport(const Value& name) {
    const auto place = findStage(flows_, name.string());
    if (place) return place;
    std::string help = didYouMean(name.string(), stageNames(flows_), "stages");
    if (findFlow(flows_, name.string())) help = fmt::format("'{}' is a flow; ", name.string()) + help;
    if (const Value* targets = tree_.document.find("targets"); targets && targets->find(name.string()))
        help = fmt::format("'{}' is a target: change it under \"targets\" with \"override\": true", name.string());
    problems_.error(name.where(), fmt::format("no stage named '{}'", name.string()), help);
    return std::nullopt;
}

const Value* Editor::anchorOf(const ObjectReader& reader) {
    const Value* before = reader.get("before");
    const Value* after = reader.get("after");
    if (before && after)
        problems_.error(after->where(), "an insert has both 'before' and 'after'", "keep one of them",
                        {{before->where(), "'before' is here"}});
    return before ? before : after;
}

void Editor::insert(const Value& edit) {
    const ObjectReader reader(edit, insertKeys(), "an insert", problems_);
    const Value* inserted = reader.get("insert");
    if (!inserted) return;
    if (inserted->find("flow") || (inserted->find("stages") && !inserted->find("stage"))) {
        insertFlow(reader, *inserted);
    } else if (checkStageShape(*inserted, "an inserted stage", problems_)) {
        insertStage(reader, *inserted);
    }
}

void Editor::insertFlow(const ObjectReader& reader, const Value& flow) {
    if (!checkFlowShape(flow, "an inserted flow", problems_)) return;
    if (!flow.find("stages")) {
        problems_.error(flow.where(), fmt::format("inserted flow '{}' has no 'stages'", flow.find("flow")->string()),
                        "name flow files under \"flows\"; their \"priority\" places them");
        return;
    }
    for (const Value& stage : flow.find("stages")->items())
        if (!checkStageShape(stage, "a stage of an inserted flow", problems_)) return;
    const Value* anchor = anchorOf(reader);
    if (!anchor) {
        addFlow(flows_, flow, true, problems_);
        return;
    }
    const auto place = findFlow(flows_, anchor->string());
    if (!place) {
        problems_.error(anchor->where(), fmt::format("no flow named '{}'", anchor->string()),
                        didYouMean(anchor->string(), flowNames(flows_), "flows"));
        return;
    }
    const std::size_t at = *place + (reader.get("before") ? 0 : 1);
    flows_.insert(flows_.begin() + static_cast<std::ptrdiff_t>(at), flow);
}

void Editor::insertStage(const ObjectReader& reader, const Value& stage) {
    if (const auto clash = findStage(flows_, stageName(stage))) {
        const Value& first = stageAt(flows_, *clash);
        problems_.error(stageNameWhere(stage), fmt::format("a second stage named '{}'", stageName(stage)),
                        "give it another \"name\"", {{stageNameWhere(first), "the first one is here"}});
        return;
    }
    const Value* anchor = anchorOf(reader);
    if (!anchor) {
        insertByPriority(reader, stage);
        return;
    }
    const auto place = findStageOrReport(*anchor);
    if (!place) {
        addLast(stage);  // Later edits may name it.
        return;
    }
    auto& stages = flowStages(flows_[place->flow]);
    const std::size_t at = place->stage + (reader.get("before") ? 0 : 1);
    stages.insert(stages.begin() + static_cast<std::ptrdiff_t>(at), stage);
}

void Editor::addLast(const Value& stage) {
    if (!flows_.empty()) flowStages(flows_.back()).push_back(stage);
}

std::optional<int> Editor::priorityOf(const Value& stage) const {
    if (const Value* explicitOne = stage.find("priority"); explicitOne && explicitOne->isInteger())
        return static_cast<int>(explicitOne->integer());
    if (!defaultPriority_) return std::nullopt;
    return defaultPriority_(stage.find("stage")->string());
}

/// In front of the first stage with a greater priority; behind the last stage of known priority when there is none.
void Editor::insertByPriority(const ObjectReader& reader, Value stage) {
    if (const Value* given = reader.get("priority"); given && !stage.find("priority"))
        stage.set("priority", *given, given->where());
    const std::optional<int> priority = priorityOf(stage);
    std::optional<TreePlace> lastKnown;
    for (std::size_t f = 0; priority && f < flows_.size(); ++f) {
        auto& stages = flowStages(flows_[f]);
        for (std::size_t s = 0; s < stages.size(); ++s) {
            const std::optional<int> other = priorityOf(stages[s]);
            if (!other) continue;
            if (*other > *priority) {
                stages.insert(stages.begin() + static_cast<std::ptrdiff_t>(s), stage);
                return;
            }
            lastKnown = TreePlace{f, s};
        }
    }
    if (lastKnown) {
        auto& stages = flowStages(flows_[lastKnown->flow]);
        stages.insert(stages.begin() + static_cast<std::ptrdiff_t>(lastKnown->stage) + 1, stage);
        return;
    }
    problems_.error(stage.where(), fmt::format("nothing says where to insert stage '{}'", stageName(stage)),
                    "add \"before\" or \"after\" with the name of a stage, or a \"priority\"");
    addLast(stage);
}

void Editor::set(const Value& edit) {
    const Value& name = *edit.find("set");
    if (!name.isString()) {
        problems_.error(name.where(), fmt::format("'set' must name a stage or a flow, found {}", name.typeName()), "");
        return;
    }
    if (const auto flow = findFlow(flows_, name.string()); flow && !findStage(flows_, name.string())) {
        setFlow(edit, flows_[*flow]);
    } else if (const auto place = findStageOrReport(name)) {
        setStage(edit, stageAt(flows_, *place));
    }
}

void Editor::setStage(const Value& edit, Value& stage) {
    if (edit.find("effect")) stage.erase("reach");  // how far it reads is a property of the effect
    for (const Member& member : edit.members()) {
        if (member.key == "set") continue;
        if (member.key == "stage" || member.key == "name") {
            problems_.error(member.keyLoc, fmt::format("'set' cannot change '{}' of a stage", member.key),
                            "use { \"replace\": \"…\", \"with\": { … } }");
        } else if (!stageKeys().find(member.key)) {
            problems_.error(member.keyLoc, fmt::format("unknown key '{}' in stage '{}'", member.key, stageName(stage)),
                            didYouMean(member.key, stageKeys().names(), "keys"));
        } else {
            mergeKey(stage, member.key, member.value, member.keyLoc);
            tree_.reach.noteStageKey(stageName(stage), member.key, member.keyLoc);
        }
    }
}

void Editor::setFlow(const Value& edit, Value& flow) {
    for (const Member& member : edit.members()) {
        if (member.key == "set") continue;
        if (member.key != "enabled" && member.key != "priority") {
            problems_.error(member.keyLoc, fmt::format("'set' cannot change '{}' of a flow", member.key),
                            "it changes 'enabled' and 'priority'");
        } else {
            mergeKey(flow, member.key, member.value, member.keyLoc);
        }
    }
}

void Editor::replace(const Value& edit) {
    const ObjectReader reader(edit, replaceKeys(), "a replace", problems_);
    const Value* name = reader.get("replace");
    const Value* with = reader.get("with");
    if (!name || !with || !checkStageShape(*with, "a replacing stage", problems_)) return;
    const auto place = findStageOrReport(*name);
    if (!place) return;
    if (stageName(*with) != name->string()) tree_.removed.push_back(name->string());
    stageAt(flows_, *place) = *with;
    tree_.reach.noteStageKey(stageName(*with), "effect", edit.where());
}

void Editor::remove(const Value& edit) {
    const ObjectReader reader(edit, removeKeys(), "a remove", problems_);
    const Value* name = reader.get("remove");
    if (!name) return;
    if (const auto flow = findFlow(flows_, name->string()); flow && !findStage(flows_, name->string())) {
        tree_.removed.push_back(name->string());
        for (const Value& stage : flowStages(flows_[*flow])) tree_.removed.push_back(stageName(stage));
        flows_.erase(flows_.begin() + static_cast<std::ptrdiff_t>(*flow));
        return;
    }
    const auto place = findStageOrReport(*name);
    if (!place) return;
    tree_.removed.push_back(name->string());
    auto& stages = flowStages(flows_[place->flow]);
    stages.erase(stages.begin() + static_cast<std::ptrdiff_t>(place->stage));
    if (!stages.empty()) return;
    tree_.removed.push_back(flows_[place->flow].find("flow")->string());
    flows_.erase(flows_.begin() + static_cast<std::ptrdiff_t>(place->flow));
}

}  // namespace

void applyEdits(PipelineTree& tree, const Value& document, const PriorityLookup& defaultPriority, Problems& problems) {
    const Value* edits = document.find("edits");
    if (!edits || !edits->isArray()) return;
    Editor editor(tree, defaultPriority, problems);
    for (const Value& edit : edits->items()) editor.apply(edit);
}

}  // namespace crevice
