// pipeline → flows → stages → queues; an object that is met inside itself is an error, so the walk ends.
#include "cocos/assets/Rpp.h"

#include <algorithm>

#include <fmt/format.h>

#include "cocos/assets/RppDescs.h"

namespace crevice::cocos {
namespace {

constexpr DocumentLimits kRppLimits{.maxBytes = 16u << 20, .maxDepth = 64, .maxNodes = 500'000};
constexpr std::size_t kMaxObjects = 4096;

/// Every field that any version's classes have in common; what is left belongs to a class of its own.
constexpr std::string_view kKnown[] = {"__type__",     "_name",        "_objFlags", "_native",    "__editorExtras__",
                                       "_tag",         "_flows",       "_stages",   "_priority",  "renderTextures",
                                       "renderQueues", "materials",    "textures",  "_enabled",   "enabled",
                                       "renderPasses", "framebuffers", "__id__",    "frameBuffer"};

SourceLoc whereTyped(const Value& object) {
    const Value* type = object.find("__type__");
    return type ? type->where() : object.where();
}

class RppReader {
public:
    RppReader(const ObjectGraph& graph, Problems& problems)
        : graph_(graph), descs_(graph, problems), problems_(problems) {}

    RppPipeline read(const std::string& file) {
        const Value& root = graph_.root();
        const FieldReader fields(root, problems_);
        RppPipeline pipeline{
            .type = typeOf(root), .name = fields.text("_name"), .path = file, .where = whereTyped(root)};
        if (pipeline.name.empty()) pipeline.name = std::filesystem::path(file).stem().string();
        pipeline.tag = fields.integer("_tag", 0);
        readDescs(root, pipeline);
        pipeline.fields = readFields(root);
        path_ = {&root};
        for (const Value* flow : entered(fields.list("_flows"), "'_flows'")) {
            pipeline.flows.push_back(readFlow(*flow));
            path_.pop_back();
        }
        return pipeline;
    }

private:
    void readDescs(const Value& root, RppPipeline& pipeline) {
        // Up to 3.0 descriptions stood in this list; "textures" has them later.
        for (const Value* item : descs_.objects(root, "renderTextures", {"RenderTextureConfig", "RenderTextureDesc"})) {
            if (typeOf(*item) == "RenderTextureDesc")
                pipeline.textures.push_back(descs_.textureDesc(*item));
            else
                pipeline.renderTextures.push_back(descs_.renderTexture(*item));
        }
        for (const Value* item : descs_.objects(root, "textures", {"RenderTextureDesc"}))
            pipeline.textures.push_back(descs_.textureDesc(*item));
        for (const Value* item : descs_.objects(root, "materials", {"MaterialConfig"}))
            pipeline.materials.push_back(descs_.material(*item));
        for (const Value* item : descs_.objects(root, "renderPasses", {"RenderPassDesc"}))
            pipeline.renderPasses.push_back(descs_.renderPass(*item));
        for (const Value* item : descs_.objects(root, "framebuffers", {"FrameBufferDesc"}))
            pipeline.frameBuffers.push_back(descs_.frameBuffer(*item));
    }

    /// The objects of a list, those left out that the walk is inside of; each is to be popped from path_ when done.
    std::vector<const Value*> entered(const Value* list, const std::string& what) {
        std::vector<const Value*> found;
        for (const Value* object : graph_.resolveList(list, what, problems_)) {
            if (std::find(path_.begin(), path_.end(), object) != path_.end()) {
                problems_.error(whereTyped(*object), fmt::format("this object is one of its own {}", what),
                                "let '__id__' name another object");
            } else if (++objects_ > kMaxObjects) {
                problems_.error(object->where(), fmt::format("more than {} flows and stages", kMaxObjects),
                                "a pipeline has a handful");
                break;
            } else {
                found.push_back(object);
            }
        }
        return found;
    }

    RppFlow readFlow(const Value& object) {
        path_.push_back(&object);
        const FieldReader fields(object, problems_);
        RppFlow flow{.type = typeOf(object), .name = fields.text("_name"), .where = whereTyped(object)};
        flow.priority = fields.integer("_priority", 0);
        flow.tag = fields.integer("_tag", 0);
        flow.material = fields.asset("_material");
        checkType(object, flow.type, "a flow");
        for (const Value* stage : entered(fields.list("_stages"), "'_stages'"))
            flow.stages.push_back(readStage(*stage));
        sortStages(flow);
        return flow;
    }

    RppStage readStage(const Value& object) {
        const FieldReader fields(object, problems_);
        RppStage stage{.type = typeOf(object), .name = fields.text("_name"), .where = whereTyped(object)};
        stage.priority = fields.integer("_priority", 0);
        stage.tag = fields.integer("_tag", 0);
        stage.enabled = fields.boolean(fields.firstOf({"_enabled", "enabled"}), true);
        checkType(object, stage.type, "a stage");
        for (const Value* queue : descs_.objects(object, "renderQueues", {"RenderQueueDesc"}))
            stage.queues.push_back(descs_.queue(*queue));
        stage.fields = readFields(object);
        return stage;
    }

    void checkType(const Value& object, const std::string& type, const char* what) {
        if (type.empty()) problems_.error(object.where(), fmt::format("{} without '__type__'", what), "name its class");
    }

    std::vector<RppField> readFields(const Value& object) {
        std::vector<RppField> fields;
        for (const Member& member : object.members()) {
            if (std::find(std::begin(kKnown), std::end(kKnown), member.key) != std::end(kKnown)) continue;
            const Value* value = &member.value;
            if (value->isObject() && value->find("__id__"))
                value = graph_.resolve(*value, fmt::format("'{}'", member.key), problems_);
            if (value) fields.push_back({member.key, readTyped(*value, problems_), member.keyLoc});
        }
        return fields;
    }

    /// RenderFlow.activate sorts its stages by ascending priority and keeps the order of equal ones.
    static void sortStages(RppFlow& flow) {
        std::vector<std::size_t> order(flow.stages.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return flow.stages[a].priority < flow.stages[b].priority;
        });
        std::vector<RppStage> sorted;
        for (std::size_t i = 0; i < order.size(); ++i) {
            if (order[i] != i) flow.moved.push_back(flow.stages[order[i]].type);
            sorted.push_back(flow.stages[order[i]]);
        }
        flow.stages = std::move(sorted);
    }

    const ObjectGraph& graph_;
    RppDescReader descs_;
    Problems& problems_;
    std::vector<const Value*> path_;
    std::size_t objects_ = 0;
};

RppPipeline readGraph(const ObjectGraph& graph, const std::string& file, Problems& problems) {
    const std::string type = typeOf(graph.root());
    const bool isPipeline = graph.root().find("_flows") != nullptr || type.ends_with("Pipeline");
    if (!isPipeline) {
        throw Error(whereTyped(graph.root()), fmt::format("'{}' is no render pipeline: its type is '{}'", file, type),
                    "the first object of a .rpp is the pipeline, with '_flows'");
    }
    return RppReader(graph, problems).read(file);
}

}  // namespace

const RppField* RppStage::field(std::string_view wanted) const {
    for (const RppField& candidate : fields) {
        if (candidate.name == wanted) return &candidate;
    }
    return nullptr;
}

RppPipeline readRpp(const std::filesystem::path& path, Problems& problems) {
    return readGraph(ObjectGraph::read(path, kRppLimits), path.string(), problems);
}

RppPipeline parseRpp(std::string_view text, const std::string& file, Problems& problems) {
    return readGraph(ObjectGraph::parse(text, file, kRppLimits), file, problems);
}

}  // namespace crevice::cocos
