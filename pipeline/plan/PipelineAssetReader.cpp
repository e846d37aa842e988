// Reads flows and stages into structs and checks every target they name.
#include "plan/PipelineAssetReader.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "core/Text.h"
#include "plan/ObjectReader.h"
#include "plan/PipelineAsset.h"
#include "plan/TargetFields.h"

namespace crevice {
namespace {

class TreeReader {
public:
    TreeReader(PipelineDesc& desc, Problems& problems) : desc_(desc), problems_(problems) {
        for (const TargetDesc& target : desc.targets) targetNames_.push_back(target.name);
    }

    void readFlows(const Value* flows, const SourceLoc& document);
    void checkTarget(const std::string& text, const SourceLoc& where, const std::string& what, bool versioned);
    void checkDefines(const Value& defines, const std::string& what);

private:
    void readFlow(const Value& value);
    StageDesc readStage(const Value& value);
    void readReads(const Value& reads, const std::string& what, StageDesc& stage);
    void readWrites(const Value& writes, const std::string& what, StageDesc& stage);
    void readPhases(const ObjectReader& reader, QueueDesc& queue);
    void readQueues(const Value& queues, const std::string& what, StageDesc& stage);
    bool isTargetText(const Value& value, const std::string& what);

    PipelineDesc& desc_;
    Problems& problems_;
    std::vector<std::string> targetNames_;
    std::map<std::string, SourceLoc> stagePlaces_;
};

/// "name" or "name@mip".
void TreeReader::checkTarget(const std::string& text, const SourceLoc& where, const std::string& what, bool versioned) {
    const std::size_t at = text.find('@');
    const std::string name = text.substr(0, at);
    const TargetDesc* target = desc_.findTarget(name);
    if (!target) {
        problems_.error(where, fmt::format("{} names '{}', which is no target", what, name),
                        targetNames_.empty() ? "add it under \"targets\"" : didYouMean(name, targetNames_, "targets"));
        return;
    }
    if (at == std::string::npos) return;
    const std::string level = text.substr(at + 1);
    const bool isNumber = !level.empty() && level.size() <= 2 &&
                          std::all_of(level.begin(), level.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!versioned || !isNumber) {
        problems_.error(where, fmt::format("{} names '{}', which is no mip level of '{}'", what, text, name),
                        versioned ? fmt::format("write '{}@0'", name) : fmt::format("write '{}'", name));
    } else if (std::stoul(level) >= target->mips) {
        problems_.error(where,
                        fmt::format("{} names mip level {} of '{}', which has {}", what, level, name, target->mips),
                        fmt::format("levels count from 0; \"mips\" of the target sets their number"),
                        {{target->where, "the target is defined here"}});
    }
}

bool TreeReader::isTargetText(const Value& value, const std::string& what) {
    if (value.isString()) return true;
    problems_.error(value.where(), fmt::format("{} must name targets, found {}", what, value.typeName()),
                    "write names in quotes");
    return false;
}

void TreeReader::readReads(const Value& reads, const std::string& what, StageDesc& stage) {
    const std::string place = fmt::format("'reads' of {}", what);
    const auto add = [&](const std::string& shaderName, const Value& value, const SourceLoc& where) {
        if (!isTargetText(value, place)) return;
        checkTarget(value.string(), value.where(), place, true);
        stage.reads.push_back({shaderName, value.string(), where});
    };
    if (reads.isArray()) {
        for (const Value& item : reads.items()) add("", item, item.where());
    } else {
        for (const Member& member : reads.members()) add(member.key, member.value, member.keyLoc);
    }
}

void TreeReader::readWrites(const Value& writes, const std::string& what, StageDesc& stage) {
    const std::string place = fmt::format("'writes' of {}", what);
    for (const Value& item : writes.items()) {
        if (!isTargetText(item, place)) continue;
        checkTarget(item.string(), item.where(), place, true);
        if (std::find(stage.writes.begin(), stage.writes.end(), item.string()) != stage.writes.end())
            problems_.error(item.where(), fmt::format("{} names '{}' twice", place, item.string()), "remove one");
        stage.writes.push_back(item.string());
    }
}

void TreeReader::readPhases(const ObjectReader& reader, QueueDesc& queue) {
    const Value* phases = reader.get("phases");
    if (!phases) {
        queue.phases = {reader.text("phase", "default")};
        return;
    }
    if (reader.get("phase"))
        problems_.error(phases->where(), fmt::format("{} has both 'phase' and 'phases'", reader.what()),
                        "keep the list");
    queue.phases.clear();
    for (const Value& phase : phases->items()) {
        if (phase.isString()) {
            queue.phases.push_back(phase.string());
        } else {
            problems_.error(phase.where(), fmt::format("a phase must be a name, found {}", phase.typeName()),
                            "write names in quotes");
        }
    }
}

void TreeReader::readQueues(const Value& queues, const std::string& what, StageDesc& stage) {
    for (const Value& item : queues.items()) {
        const ObjectReader reader(item, queueKeys(), fmt::format("a queue of {}", what), problems_);
        QueueDesc queue{.where = item.where()};
        readPhases(reader, queue);
        if (reader.text("sort") == sortNames()[1]) queue.sort = QueueSort::BackToFront;
        stage.queues.push_back(std::move(queue));
    }
}

void TreeReader::checkDefines(const Value& defines, const std::string& what) {
    for (const Member& member : defines.members())
        if (!member.value.isBool() && !member.value.isInteger() && !member.value.isString())
            problems_.error(member.value.where(),
                            fmt::format("define '{}' of {} must be a bool, an integer or a string, found {}",
                                        member.key, what, member.value.toJson(-1)),
                            "macros that hold other numbers are written as strings");
}

StageDesc TreeReader::readStage(const Value& value) {
    StageDesc stage;
    stage.where = value.where();
    stage.stageClass = value.find("stage")->string();
    const Value* name = value.find("name");
    stage.name = name ? name->string() : stage.stageClass;
    const SourceLoc& nameWhere = name ? name->where() : value.find("stage")->where();
    const std::string what = fmt::format("stage '{}'", stage.name);
    const auto [first, isNew] = stagePlaces_.emplace(stage.name, nameWhere);
    if (!isNew)
        problems_.error(nameWhere, fmt::format("a second stage named '{}'", stage.name), "give it another \"name\"",
                        {{first->second, "the first one is here"}});

    const ObjectReader reader(value, stageKeys(), what, problems_);
    stage.enabled = reader.flag("enabled", true);
    stage.priority = reader.integer("priority");
    if (const auto reach = reader.integer("reach")) stage.reach = static_cast<std::uint32_t>(*reach);
    stage.effect = reader.text("effect");
    if (const Value* effect = reader.get("effect")) stage.effectWhere = effect->where();
    if (const Value* defines = reader.get("defines")) {
        checkDefines(*defines, what);
        stage.defines = *defines;
    }
    if (const Value* material = reader.get("material")) stage.material = *material;
    if (const Value* states = reader.get("states")) stage.states = *states;
    if (const Value* params = reader.get("params")) stage.params = *params;
    if (const Value* reads = reader.get("reads")) readReads(*reads, what, stage);
    if (const Value* writes = reader.get("writes")) readWrites(*writes, what, stage);
    if (const Value* queues = reader.get("queues")) readQueues(*queues, what, stage);
    return stage;
}

void TreeReader::readFlow(const Value& value) {
    FlowDesc flow;
    flow.where = value.where();
    flow.name = value.find("flow")->string();
    const ObjectReader reader(value, flowKeys(), fmt::format("flow '{}'", flow.name), problems_);
    flow.priority = reader.integer("priority");
    flow.enabled = reader.flag("enabled", true);
    for (const Value& stage : value.find("stages")->items()) {
        flow.stages.push_back(readStage(stage));
        flow.stages.back().enabled = flow.stages.back().enabled && flow.enabled;
    }
    if (flow.stages.empty())
        problems_.error(value.where(), fmt::format("flow '{}' has no stages", flow.name),
                        "add one, or remove the flow");
    desc_.flows.push_back(std::move(flow));
}

void TreeReader::readFlows(const Value* flows, const SourceLoc& document) {
    if (flows)
        for (const Value& flow : flows->items()) readFlow(flow);
    if (desc_.flows.empty() && !problems_.hasErrors())  // A flow with a mistake may have been left out.
        problems_.error(flows ? flows->where() : document, "the pipeline has no flows",
                        "add \"flows\": [ { \"flow\": \"MainFlow\", \"stages\": [ … ] } ], or \"extends\"");
    const FlowDesc* last = nullptr;
    for (const FlowDesc& flow : desc_.flows) {
        if (last && flow.priority && *flow.priority < *last->priority)
            problems_.error(flow.where,
                            fmt::format("flow '{}' with priority {} follows '{}' with priority {}", flow.name,
                                        *flow.priority, last->name, *last->priority),
                            "flows run in list order: move one, or correct a priority",
                            {{last->where, fmt::format("'{}' is here", last->name)}});
        if (flow.priority) last = &flow;
    }
}

/// What an option stood for is seen only now.
void readGuard(const Value& value, PipelineDesc& desc, Problems& problems) {
    const KeySpec& spec = *pipelineKeys().find("guard");
    desc.guardWhere = value.where();
    // An option that nothing gave a number.
    if (value.isString() && value.string() == "auto") return;
    if (value.isNumber() && value.number() >= spec.min && value.number() <= spec.max) {
        desc.guard = value.number();
    } else if (!value.isNumber()) {
        problems.error(value.where(),
                       fmt::format("'guard' of the pipeline must be a number, found {}",
                                   value.isString() ? "'" + value.string() + "'" : value.toJson(-1)),
                       fmt::format("expected: {}", keyTypeName(spec)));
    } else {
        problems.error(value.where(), fmt::format("'guard' of the pipeline is {}, out of range", value.number()),
                       fmt::format("write a number from {} to {}", spec.min, spec.max));
    }
}

void readProfile(const Value& document, PipelineDesc& desc, Problems& problems) {
    if (const Value* profile = document.find("profile")) {
        const std::vector<std::string> names = profileNames();
        const auto found = std::find(names.begin(), names.end(), profile->string());
        if (found != names.end())  // Another word is reported with the document's keys.
            desc.profile = static_cast<Profile>(found - names.begin() + static_cast<int>(Profile::Cocos33));
    }
    for (const char* key : {"fallbacks", "macros"})
        if (const Value* value = document.find(key); value && !isCocos(desc.profile))
            problems.error(value->where(), fmt::format("'{}' without 'profile' has no effect", key),
                           "add \"profile\", or remove it");
    if (const Value* macros = document.find("macros")) desc.macros = *macros;
    const Value* fallbacks = document.find("fallbacks");
    if (!fallbacks) return;
    const ObjectReader reader(*fallbacks, fallbackKeys(), "'fallbacks'", problems);
    desc.fallbacks.rebindLiterals = reader.flag("rebindLiterals", true);
    desc.fallbacks.globalSamplers = reader.flag("globalSamplers", true);
}

}  // namespace

PipelineDesc readPipelineTree(const Value& document, std::vector<OptionDesc> options, const std::string& file,
                              Problems& problems) {
    PipelineDesc desc;
    desc.path = file;
    desc.options = std::move(options);
    const std::string stem = std::filesystem::path(file).filename().string();
    const Value* name = document.find("name");
    desc.name = name ? name->string() : stem.substr(0, stem.find('.'));
    if (const Value* help = document.find("help")) desc.help = help->string();
    if (const Value* plugins = document.find("plugins"))
        for (const Value& plugin : plugins->items()) {
            if (plugin.isString()) {
                desc.plugins.push_back(plugin.string());
            } else {
                problems.error(plugin.where(), fmt::format("a plugin must be a name, found {}", plugin.typeName()),
                               "write names in quotes");
            }
        }
    if (const Value* targets = document.find("targets")) desc.targets = readTargets(*targets, problems);
    if (const Value* blocks = document.find("blocks")) desc.blocks = readBlocks(*blocks, problems);

    readProfile(document, desc, problems);
    TreeReader reader(desc, problems);
    if (desc.macros.isObject()) reader.checkDefines(desc.macros, "'macros'");
    reader.readFlows(document.find("flows"), document.where());
    if (const Value* output = document.find("output")) {
        desc.output = output->string();
        desc.outputWhere = output->where();
        reader.checkTarget(desc.output, desc.outputWhere, "'output'", false);
    } else {
        problems.error(document.where(), "missing key 'output' in the pipeline",
                       "add \"output\" with the name of the target that holds the picture");
    }
    if (const Value* guard = document.find("guard")) readGuard(*guard, desc, problems);
    checkPriorities(desc, {}, problems);
    return desc;
}

void checkPriorities(const PipelineDesc& desc, const PriorityLookup& defaultPriority, Problems& problems) {
    for (const FlowDesc& flow : desc.flows) {
        const StageDesc* last = nullptr;
        int lastPriority = 0;
        for (const StageDesc& stage : flow.stages) {
            std::optional<int> priority = stage.priority;
            if (!priority && defaultPriority) priority = defaultPriority(stage.stageClass);
            if (!priority) continue;
            if (last && *priority < lastPriority)
                problems.error(stage.where,
                               fmt::format("stage '{}' with priority {} follows '{}' with priority {}", stage.name,
                                           *priority, last->name, lastPriority),
                               fmt::format("stages run in list order: move '{}' before '{}', or give it a \"priority\"",
                                           stage.name, last->name),
                               {{last->where, fmt::format("'{}' is here", last->name)}});
            last = &stage;
            lastPriority = *priority;
        }
    }
}

}  // namespace crevice
