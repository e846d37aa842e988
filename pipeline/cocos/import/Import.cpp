// The pipeline's flows in the order of the file; what its class adds in code is not in the file and is said so.
#include "cocos/import/Import.h"

#include <fmt/format.h>

#include "cocos/import/ImportStages.h"
#include "cocos/import/ImportTargets.h"
#include "cocos/import/ImportText.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

Value word(const std::string& text) { return Value::makeString(text); }

bool isOneOf(const std::string& type, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        if (type == name) return true;
    }
    return false;
}

/// What DeferredPipeline and ForwardPipeline make in code when the asset has no flows.
RppFlow makeFlow(const std::string& type, std::initializer_list<RppStage> stages, const SourceLoc& where) {
    RppFlow flow{.type = type, .name = type, .where = where};
    flow.stages = stages;
    return flow;
}

RppStage makeStage(const std::string& type, const SourceLoc& where, std::vector<RppQueue> queues = {}) {
    return {.type = type, .name = type, .queues = std::move(queues), .where = where};
}

void addDefaultFlows(RppPipeline& pipeline, bool v33) {
    const SourceLoc& at = pipeline.where;
    const RppQueue opaque{.phases = {"default"}, .where = at};
    const RppQueue blended{.transparent = true, .backToFront = true, .phases = {"default"}, .where = at};
    pipeline.flows.push_back(makeFlow("ShadowFlow", {makeStage("ShadowStage", at)}, at));
    if (pipeline.type == "ForwardPipeline") {
        pipeline.flows.push_back(makeFlow("ForwardFlow", {makeStage("ForwardStage", at, {opaque, blended})}, at));
        return;
    }
    RppQueue gbuffer = opaque;
    if (v33) gbuffer.phases = {"deferred"};
    const RppStage geometry = makeStage("GbufferStage", at, {gbuffer}),
                   light = makeStage("LightingStage", at, {blended}), post = makeStage("PostProcessStage", at);
    if (v33) {
        pipeline.flows.push_back(makeFlow("GbufferFlow", {geometry}, at));
        pipeline.flows.push_back(makeFlow("LightingFlow", {light, post}, at));
    } else {
        pipeline.flows.push_back(makeFlow("MainFlow", {geometry, light, post}, at));
    }
}

class Importer {
public:
    Importer(const ImportRequest& request, Project& project, Problems& problems)
        : request_(request), project_(project), problems_(problems) {}

    ImportedPipeline run() {
        RppPipeline pipeline = readRpp(request_.rpp, problems_);
        version_ = chooseVersion(request_.version, project_.roots(), pipeline);
        checkClass(pipeline);
        const bool forwardOnly =
            hasStage(pipeline, {"ForwardStage"}) &&
            !hasStage(pipeline, {"GbufferStage", "LightingStage", "PostProcessStage", "PostprocessStage"});
        ImportTargets targets(version_.isV33(), !forwardOnly);
        targets.addOf(pipeline, project_, problems_);
        StageImporter stages(request_, version_, project_, targets, hasStage(pipeline, {"ForwardStage"}), problems_);
        Value flows = Value::makeArray();
        for (const RppFlow& flow : pipeline.flows) addFlow(flow, stages, flows);
        if (flows.items().empty() && !problems_.hasErrors())
            problems_.error(pipeline.where, fmt::format("no stage of pipeline '{}' is drawn", pipeline.name),
                            "list stages in '_stages'; notes say which ones are left out");
        return {pipeline.name, readableJson(makeDocument(pipeline, targets, std::move(flows))), version_};
    }

private:
    static bool hasStage(const RppPipeline& pipeline, std::initializer_list<const char*> types) {
        for (const RppFlow& flow : pipeline.flows)
            for (const RppStage& stage : flow.stages)
                if (isOneOf(stage.type, types)) return true;
        return false;
    }

    void checkClass(RppPipeline& pipeline) {
        const bool builtin = isOneOf(pipeline.type, {"ForwardPipeline", "DeferredPipeline"});
        if (pipeline.flows.empty() && problems_.hasErrors()) {
            // Its flows could not be read: they are not those that it has by default.
        } else if (pipeline.flows.empty() && builtin) {
            addDefaultFlows(pipeline, version_.isV33());
            problems_.note(pipeline.where, fmt::format("'{}' without flows has its default ones", pipeline.type));
        } else if (pipeline.flows.empty()) {
            problems_.error(pipeline.where, fmt::format("pipeline '{}' has no flows", pipeline.name),
                            R"(list them: "_flows": [ { "__id__": N } ])");
        }
        if (builtin || pipeline.type == "cc.RenderPipeline") return;
        problems_.note(pipeline.where,
                       fmt::format("'{}' is a script: what it does beside its flows is not done here", pipeline.type),
                       "images and blocks that it makes come from the stages that use them");
    }

    void addFlow(const RppFlow& flow, StageImporter& stages, Value& flows) {
        if (flow.type == "ReflectionProbeFlow") {
            problems_.note(flow.where, "flow 'ReflectionProbeFlow' is left out: reflection probes are not drawn");
            return;
        }
        if (!flow.moved.empty())
            problems_.note(flow.where, fmt::format("'_priority' puts stages of '{}' into another order: {}", flow.type,
                                                   join(flow.moved)));
        Value list = Value::makeArray();
        for (const RppStage& stage : flow.stages)
            for (Value& translated : stages.translate(stage)) list.items().push_back(std::move(translated));
        if (list.items().empty()) return;
        Value out = Value::makeObject();
        std::string name = flow.name.empty() ? flow.type : flow.name, unique = name;
        for (int i = 2; !flowNames_.insert(unique).second; ++i) unique = fmt::format("{}{}", name, i);
        out.set("flow", word(unique));
        out.set("stages", std::move(list));
        flows.items().push_back(std::move(out));
    }

    Value makeDocument(const RppPipeline& pipeline, ImportTargets& targets, Value flows) {
        Value document = Value::makeObject();
        document.set("name", word(pipeline.name));
        document.set("help",
                     word(fmt::format("Translated from {} ({}).", request_.rpp.filename().string(), pipeline.type)));
        document.set("profile", word(version_.profile));
        document.set("output", word("finalColor"));
        document.set("targets", targets.take());
        document.set("flows", std::move(flows));
        return document;
    }

    const ImportRequest& request_;
    Project& project_;
    Problems& problems_;
    VersionChoice version_;
    std::set<std::string> flowNames_;
};

}  // namespace

ImportedPipeline importPipeline(const ImportRequest& request, Project& project, Problems& problems) {
    return Importer(request, project, problems).run();
}

}  // namespace crevice::cocos
