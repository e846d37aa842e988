// A table takes Cocos' classes to the code that translates them; every other class must be registered under its name.
#include "cocos/import/ImportStages.h"

#include <algorithm>

#include <fmt/format.h>

#include "cocos/assets/MtlInstance.h"
#include "cocos/assets/TexturePicture.h"
#include "cocos/assets/TextureSampler.h"
#include "core/Text.h"

namespace crevice::cocos {
namespace {

using Kind = TypedValue::Kind;

Value word(const std::string& text) { return Value::makeString(text); }

std::vector<Value> listOf(Value stage) {
    std::vector<Value> stages;
    stages.push_back(std::move(stage));
    return stages;
}

/// Skipped with a note, and why.
struct LeftOut {
    const char* type;
    const char* why;
};
constexpr LeftOut kLeftOut[] = {
    {"BloomStage", "the engine draws it only where bloom is switched on by a script"},
    {"ReflectionProbeStage", "reflection probes are not drawn"},
    {"UIStage", "user interfaces are not drawn"},
};

bool isPicture(const std::filesystem::path& path) {
    static constexpr std::string_view kEndings[] = {".png", ".jpg", ".jpeg", ".webp", ".exr", ".PNG", ".JPG", ".JPEG"};
    const std::string ending = path.extension().string();
    return std::find(std::begin(kEndings), std::end(kEndings), ending) != std::end(kEndings);
}

std::string quoted(const std::vector<std::string>& words) {
    std::vector<std::string> all;
    for (const std::string& one : words) all.push_back("'" + one + "'");
    return join(all);
}

}  // namespace

StageImporter::StageImporter(const ImportRequest& request, const VersionChoice& version, Project& project,
                             ImportTargets& targets, bool forward, Problems& problems)
    : request_(request),
      version_(version),
      project_(project),
      targets_(targets),
      forward_(forward),
      problems_(problems) {}

std::vector<Value> StageImporter::translate(const RppStage& stage) {
    using Translate = std::vector<Value> (StageImporter::*)(const RppStage&);
    struct Known {
        const char* type;
        Translate translate;
    };
    static constexpr Known kKnown[] = {
        {"ShadowStage", &StageImporter::shadowStage},           {"GbufferStage", &StageImporter::geometryStage},
        {"ForwardStage", &StageImporter::geometryStage},        {"LightingStage", &StageImporter::lightingStage},
        {"PostprocessStage", &StageImporter::postProcessStage}, {"PostProcessStage", &StageImporter::postProcessStage},
    };
    for (const Known& known : kKnown) {
        if (stage.type == known.type) return (this->*known.translate)(stage);
    }
    for (const LeftOut& left : kLeftOut) {
        // Classes of these names that a plugin brings are run.
        if (stage.type != left.type || factsOf(stage.type)) continue;
        problems_.note(stage.where, fmt::format("stage '{}' is left out: {}", stage.type, left.why));
        return {};
    }
    if (factsOf(stage.type)) return userStage(stage);
    if (!stage.type.empty()) unknownClass(stage);
    return {};
}

/// One stage for the main light; where lights are drawn one by one, before it one for the first spot light.
std::vector<Value> StageImporter::shadowStage(const RppStage& stage) {
    noteFields(stage, {});
    std::vector<Value> stages;
    if (forward_) {
        targets_.addShadowMap(version_.isV33() ? "cc_spotLightingMap" : "cc_spotShadowMap", "spotShadowDepth");
        RppStage named = stage;
        named.name = "SpotShadowStage";
        Value spot = begin("ShadowStage", named);
        Value params = Value::makeObject();
        params.set("light", word("spot"));
        spot.set("params", std::move(params));
        stages.push_back(std::move(spot));
    }
    targets_.addShadowMap("cc_shadowMap", "shadowDepth");
    stages.push_back(begin("ShadowStage", stage));
    return stages;
}

std::vector<Value> StageImporter::geometryStage(const RppStage& stage) {
    Value out = begin(stage.type, stage);
    const bool forward = stage.type == "ForwardStage";
    if (forward) {
        Value writes = Value::makeArray();
        writes.items().push_back(word("finalColor"));
        out.set("writes", writes);
    }
    const Value opaque = queuesOf(stage, false), blended = queuesOf(stage, true);
    if (!opaque.items().empty()) out.set("queues", opaque);
    noteFields(stage, {});
    std::vector<Value> stages = listOf(std::move(out));
    if (forward) addSky(stage, "finalColor", stages);
    if (forward && !blended.items().empty()) {
        Value second = begin("TransparentStage", stage, "Transparent");
        Value writes = Value::makeArray();
        writes.items().push_back(word("finalColor"));
        second.set("writes", writes);
        second.set("queues", blended);
        stages.push_back(std::move(second));
    } else if (!blended.items().empty()) {
        problems_.note(stage.where, "queues of blended passes are not drawn into the G-buffer");
    }
    return stages;
}

/// Cocos draws the sky as a model of its own among the opaque ones; here a stage does.
void StageImporter::addSky(const RppStage& stage, const char* target, std::vector<Value>& stages) {
    if (!factsOf("SkyboxStage")) return;
    Value out = begin("SkyboxStage", stage, "Sky");
    if (target) {
        Value writes = Value::makeArray();
        writes.items().push_back(word(target));
        out.set("writes", std::move(writes));
    }
    stages.push_back(std::move(out));
}

/// The sky comes first: the lighting draws where something is, and blended objects follow it.
std::vector<Value> StageImporter::lightingStage(const RppStage& stage) {
    std::vector<Value> stages;
    addSky(stage, nullptr, stages);
    Value out = begin("LightingStage", stage);
    addMaterial(out, stage, "_deferredMaterial", "pipeline/deferred-lighting");
    noteFields(stage, {"_deferredMaterial"});
    const Value blended = queuesOf(stage, true);
    if (!blended.items().empty()) out.set("queues", blended);
    stages.push_back(std::move(out));
    return stages;
}

std::vector<Value> StageImporter::postProcessStage(const RppStage& stage) {
    Value out = begin("PostProcessStage", stage);
    addMaterial(out, stage, "_postProcessMaterial", "pipeline/post-process");
    noteFields(stage, {"_postProcessMaterial"});
    return listOf(std::move(out));
}

/// A class of the user's, bound to the C++ stage that is registered under its name: a material becomes its effect,
/// fields that it has as params become those.
std::vector<Value> StageImporter::userStage(const RppStage& stage) {
    const StageFacts& facts = *factsOf(stage.type);
    Value out = begin(stage.type, stage);
    Value params = Value::makeObject();
    bool hasMaterial = false;
    for (const RppField& field : stage.fields) {
        const TypedValue& value = field.value;
        const std::string bare = field.name.substr(
            field.name.find_first_not_of('_') == std::string::npos ? 0 : field.name.find_first_not_of('_'));
        if (value.kind == Kind::Null) continue;
        if (value.kind == Kind::Asset && !hasMaterial &&
            (value.asset.expectedType.empty() || value.asset.expectedType == "cc.Material")) {
            hasMaterial = true;
            addMaterialOf(out, value.asset, fmt::format("'{}' of stage '{}'", field.name, stage.type));
            continue;
        }
        const bool plain = value.kind == Kind::Bool || value.kind == Kind::Number || value.kind == Kind::Text ||
                           value.kind == Kind::Numbers;
        if (plain && std::find(facts.params.begin(), facts.params.end(), bare) != facts.params.end()) {
            params.set(bare, value.plain, field.where);
        } else {
            problems_.note(
                field.where, fmt::format("field '{}' of stage '{}' is left out", field.name, stage.type),
                facts.params.empty() ? "the class has no params" : "params of the class: " + join(facts.params));
        }
    }
    if (!params.members().empty()) out.set("params", std::move(params));
    const Value opaque = queuesOf(stage, false), blended = queuesOf(stage, true);
    Value queues = opaque;
    for (const Value& queue : blended.items()) queues.items().push_back(queue);
    if (!queues.items().empty()) out.set("queues", queues);
    for (const std::string& name : facts.writes) {
        if (name == "cc_ssaoMap") targets_.addOcclusion(name, version_.isV33());
        targets_.add(name, "RGBA8", fmt::format("written by {}", stage.type));
    }
    return listOf(std::move(out));
}

Value StageImporter::begin(const std::string& ourClass, const RppStage& stage, const std::string& suffix) {
    Value out = Value::makeObject();
    out.set("stage", word(ourClass));
    std::string name = suffix.empty() ? (stage.name.empty() ? ourClass : stage.name) : ourClass;
    for (char& c : name) {  // a '.' would end the name in --set
        if (c == '.' || c == '$' || static_cast<unsigned char>(c) < ' ') c = '_';
    }
    std::string unique = name;
    for (int i = 2; !names_.insert(unique).second; ++i) unique = fmt::format("{}{}", name, i);
    if (unique != ourClass) out.set("name", word(unique));
    if (!stage.enabled) out.set("enabled", Value::makeBool(false));
    // Written out even where 0: the class's own priority must not judge Cocos' order.
    out.set("priority", Value::makeInteger(std::clamp<std::int64_t>(stage.priority, -1'000'000, 1'000'000)));
    return out;
}

void StageImporter::addMaterial(Value& out, const RppStage& stage, std::string_view field, const std::string& builtin) {
    const RppField* written = stage.field(field);
    if (written && written->value.kind == Kind::Asset) {
        addMaterialOf(out, written->value.asset, fmt::format("'{}' of stage '{}'", field, stage.type));
        return;
    }
    if (written && written->value.kind != Kind::Null) {
        problems_.error(written->value.where, fmt::format("'{}' must be a material or null", field),
                        R"(write { "__uuid__": "…" })");
    }
    if (!project_.findEffect(builtin)) {
        problems_.warning(
            written ? written->value.where : stage.where,
            fmt::format("effect '{}' of stage '{}' is the engine's, which is not given", builtin, stage.type),
            "name the folder of an engine: --engine DIR");
    }
    out.set("effect", word(builtin));
}

void StageImporter::addMaterialOf(Value& out, const AssetRef& ref, const std::string& what) {
    const Mtl* mtl = project_.material(ref, what, problems_);
    const MetaAsset* file = mtl ? project_.effectFile(*mtl, problems_) : nullptr;
    const EffectAsset* asset = file ? project_.effect(file->path, problems_) : nullptr;
    if (!asset) return;
    const std::string effect = project_.effectName(file->path);
    const auto textures = [&](const AssetRef& texture, const EffectProperty& property) {
        const MetaAsset* named = project_.metas().find(texture.uuid);
        const std::filesystem::path path = named ? pictureOf(*named, project_).path : std::filesystem::path();
        if (isPicture(path)) {
            const std::string words = samplerWords(samplerOf(*named, project_.metas()));
            return Value::makeString(path.string() + words, texture.where);
        }
        problems_.note(texture.where,
                       fmt::format("texture '{}' of material '{}' is left out", property.name, mtl->name),
                       "pictures must be PNG, JPEG, WebP or EXR; images of the pipeline are wired with \"reads\"");
        return Value();
    };
    const MaterialEffect values = instantiate(*mtl, *asset, effect, textures, problems_);
    out.set("effect", word(effect));
    if (mtl->technique != 0 && mtl->technique < asset->techniques.size()) {
        problems_.warning(mtl->techniqueWhere,
                          fmt::format("technique {} of effect '{}' is asked for; full-screen stages draw technique 0",
                                      mtl->technique, effect),
                          "move it to the front in the effect");
    }
    std::size_t pass = 0;
    const auto& passes = mtl->technique < asset->techniques.size() ? asset->techniques[mtl->technique].passes
                                                                   : std::vector<EffectPass>{};
    while (pass < values.passes.size() && isDropped(passes[pass], values.passes[pass].defines)) ++pass;
    if (pass >= values.passes.size()) return;
    if (!values.passes[pass].defines.members().empty()) out.set("defines", values.passes[pass].defines);
    if (!values.passes[pass].properties.members().empty()) out.set("material", values.passes[pass].properties);
    if (!values.passes[pass].states.members().empty()) out.set("states", values.passes[pass].states);
}

Value StageImporter::queuesOf(const RppStage& stage, bool transparent) {
    Value queues = Value::makeArray();
    for (const RppQueue& queue : stage.queues) {
        if (queue.transparent != transparent) continue;
        if (queue.backToFront != transparent) {
            problems_.note(queue.where,
                           fmt::format("this queue of {} passes is sorted {} here", transparent ? "blended" : "opaque",
                                       transparent ? "back to front" : "front to back"));
        }
        if (queue.phases.empty() || queue.phases == std::vector<std::string>{""}) {
            problems_.warning(queue.where,
                              fmt::format("this queue of stage '{}' draws nothing: its phases are [{}]", stage.type,
                                          quoted(queue.phases)),
                              "name a phase, such as \"default\"");
            continue;
        }
        Value out = Value::makeObject();
        if (queue.phases.size() == 1) {
            out.set("phase", word(queue.phases.front()));
        } else {
            Value phases = Value::makeArray();
            std::set<std::string> seen;
            for (const std::string& phase : queue.phases)
                if (seen.insert(phase).second) phases.items().push_back(word(phase));
            out.set("phases", std::move(phases));
        }
        out.set("sort", word(transparent ? "back-to-front" : "front-to-back"));
        queues.items().push_back(std::move(out));
    }
    return queues;
}

void StageImporter::noteFields(const RppStage& stage, std::initializer_list<std::string_view> used) {
    for (const RppField& field : stage.fields) {
        if (std::find(used.begin(), used.end(), field.name) != used.end() || field.value.kind == Kind::Null) continue;
        problems_.note(field.where, fmt::format("field '{}' of stage '{}' is left out", field.name, stage.type));
    }
}

const StageFacts* StageImporter::factsOf(const std::string& name) const {
    for (const StageFacts& facts : request_.classes) {
        if (facts.name == name) return &facts;
    }
    return nullptr;
}

void StageImporter::unknownClass(const RppStage& stage) {
    std::vector<std::string> names;
    for (const StageFacts& facts : request_.classes) names.push_back(facts.name);
    problems_.error(
        stage.where, fmt::format("no stage class '{}' is registered", stage.type),
        fmt::format("write it in C++ and load it with --plugin; {}", didYouMean(stage.type, names, "registered")));
}

}  // namespace crevice::cocos
