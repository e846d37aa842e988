// Reads the YAML of a CCEffect block: techniques, passes, properties.
#include "effect/EffectHeader.h"

#include <fmt/format.h>

#include <algorithm>

#include "effect/PriorityExpression.h"
#include "effect/RenderStateReader.h"

namespace crevice {
namespace {

class HeaderReader {
public:
    HeaderReader(EffectAsset& effect, EffectReading reading, Problems& problems)
        : effect_(effect), reading_(reading), problems_(problems) {}

    void run(const Value& header) {
        if (!header.isObject()) {
            problems_.error(header.isNull() ? effect_.where : header.where(), "the CCEffect block has no keys",
                            "begin it with: techniques:");
            return;
        }
        KeyReader reader(header, "the effect", reading_, problems_);
        for (const char* ignored : {"temporaries", "editor", "hideInEditor"}) reader.find(ignored);
        const Value* techniques = reader.array("techniques");
        reader.finish();
        if (techniques == nullptr || techniques->items().empty()) {
            if (header.find("techniques") == nullptr || techniques != nullptr)
                problems_.error(effect_.where, "the effect has no 'techniques'",
                                "techniques: - passes: - { vert: …, frag: … }");
            return;
        }
        for (const Value& item : techniques->items()) readTechnique(item);
    }

private:
    bool expectMap(const Value& value, const char* what) {
        if (value.isObject()) return true;
        problems_.error(value.where(), fmt::format("{} must be a map, not {}", what, value.typeName()),
                        "write key: value");
        return false;
    }

    void readTechnique(const Value& value) {
        EffectTechnique technique;
        if (!expectMap(value, "a technique")) return;
        KeyReader reader(value, "a technique", reading_, problems_);
        if (const Value* name = reader.string("name")) technique.name = name->string();
        const Value* passes = reader.array("passes");
        reader.finish();
        if (passes == nullptr || passes->items().empty()) {
            if (value.find("passes") == nullptr || passes != nullptr)
                problems_.error(value.where(), "a technique has no 'passes'", "passes: - { vert: …, frag: … }");
            return;
        }
        indexWhere_.clear();
        for (const Value& item : passes->items())
            if (expectMap(item, "a pass")) technique.passes.push_back(readPass(item));
        for (std::size_t i = 0; i < technique.passes.size(); ++i)
            inheritProperties(technique.passes[i], technique, indexWhere_[i]);
        effect_.techniques.push_back(std::move(technique));
    }

    EffectPass readPass(const Value& value) {
        EffectPass pass;
        pass.where = value.where();
        KeyReader reader(value, "a pass", reading_, problems_);
        readPrograms(reader, pass);
        if (const Value* phase = reader.string("phase")) pass.phase = phase->string();
        if (const Value* priority = reader.find("priority")) pass.priority = readPriority(*priority);
        if (const Value* name = reader.string("switch")) pass.switchMacro = name->string();
        if (const Value* macros = reader.object("embeddedMacros")) readMacros(*macros, pass);
        indexWhere_.push_back(pass.where);
        if (const Value* index = reader.number("propertyIndex")) readPropertyIndex(*index, pass);
        if (const Value* name = reader.string("pass")) pass.passName = name->string();
        for (const char* ignored : {"subpass", "stage", "migrations"}) reader.find(ignored);
        pass.state = readRenderState(reader);
        if (const Value* properties = reader.object("properties"))
            for (const Member& member : properties->members()) pass.properties.push_back(readProperty(member));
        reader.finish();
        return pass;
    }

    void readPrograms(KeyReader& reader, EffectPass& pass) {
        const auto read = [&](const char* key, std::string& name, SourceLoc& where) {
            const Value* value = reader.string(key);
            if (value == nullptr) return;
            name = value->string();
            where = value->where();
            where.length = std::max(1, static_cast<int>(name.size()));
        };
        read("vert", pass.vertex, pass.vertexWhere);
        read("frag", pass.fragment, pass.fragmentWhere);
        read("compute", pass.compute, pass.computeWhere);
        if (!pass.compute.empty() && (!pass.vertex.empty() || !pass.fragment.empty()))
            problems_.error(pass.where, "a pass has 'compute' beside 'vert' or 'frag'", "give it its own pass");
        else if (pass.compute.empty() && pass.vertex.empty() && pass.fragment.empty())
            problems_.error(pass.where, "a pass names no program", "give it vert and frag, or compute");
        else if (pass.compute.empty() && pass.vertex.empty())
            problems_.error(pass.where, "a pass has 'frag' without 'vert'",
                            reading_ == EffectReading::Strict ? "a full-screen pass uses vert: fullscreen-vs"
                                                              : "name its vertex program: vert: program:entry");
        else if (pass.compute.empty() && pass.fragment.empty())
            problems_.error(pass.where, "a pass has 'vert' without 'frag'",
                            "name a fragment program; for depth alone one with an empty main()");
    }

    void readPropertyIndex(const Value& index, EffectPass& pass) {
        if (!index.isInteger() || index.integer() < 0 || index.integer() > 1000)
            problems_.error(index.where(), "'propertyIndex' must be the number of a pass", "passes count from 0");
        else
            pass.propertyIndex = static_cast<int>(index.integer());
        indexWhere_.back() = index.where();
    }

    void inheritProperties(EffectPass& pass, const EffectTechnique& technique, const SourceLoc& where) {
        if (!pass.propertyIndex) return;
        const auto index = static_cast<std::size_t>(*pass.propertyIndex);
        if (index >= technique.passes.size())
            problems_.error(
                where,
                fmt::format("'propertyIndex' is {}, but the technique has {} passes", index, technique.passes.size()),
                fmt::format("passes count from 0: the last one is {}", technique.passes.size() - 1));
        else if (pass.properties.empty() && &technique.passes[index] != &pass)
            pass.properties = technique.passes[index].properties;
    }

    /// A number or Cocos' little expressions: `max`, `max - 10`, `min + 11`.
    int readPriority(const Value& value) {
        constexpr int kMin = 0, kMax = 255, kDefault = 128;
        std::optional<int> priority;
        if (value.isInteger()) priority = static_cast<int>(std::clamp<std::int64_t>(value.integer(), -1, kMax + 1));
        if (value.isString()) priority = evaluatePriority(value.string());
        if (priority && *priority >= kMin && *priority <= kMax) return *priority;
        if (priority && reading_ == EffectReading::Tolerant) {
            problems_.warning(value.where(), "'priority' is beyond 0 to 255", "the nearer end is taken");
            return std::clamp(*priority, kMin, kMax);
        }
        problems_.error(value.where(), "'priority' must be 0 to 255 or an expression such as 'max - 10'",
                        "min is 0, max is 255, default is 128");
        return kDefault;
    }

    void readMacros(const Value& macros, EffectPass& pass) {
        for (const Member& member : macros.members()) {
            const Value& value = member.value;
            if (value.isBool())
                pass.embeddedMacros[member.key] = std::to_string(value.boolean() ? 1 : 0);
            else if (value.isInteger())
                pass.embeddedMacros[member.key] = std::to_string(value.integer());
            else if (value.isString())
                pass.embeddedMacros[member.key] = value.string();
            else if (reading_ == EffectReading::Tolerant)
                problems_.warning(value.where(), fmt::format("macro '{}' has no usable value", member.key));
            else
                problems_.error(value.where(),
                                fmt::format("macro '{}' must be a bool, an integer or a word", member.key),
                                "such as true, 3 or LINEAR");
        }
    }

    EffectProperty readProperty(const Member& member) {
        EffectProperty property;
        property.name = member.key;
        property.where = member.keyLoc;
        property.where.length = std::max(1, static_cast<int>(member.key.size()));
        if (reading_ == EffectReading::Tolerant && member.value.isNull()) return property;
        if (!expectMap(member.value, "a property")) return property;
        KeyReader reader(member.value, fmt::format("property '{}'", member.key), reading_, problems_);
        if (const Value* value = reader.find("value")) readPropertyValue(*value, property);
        if (const Value* target = reader.string("target")) property.target = target->string();
        if (const Value* linear = reader.boolean("linear")) property.linear = linear->boolean();
        reader.string("type");
        if (const Value* sampler = reader.object("sampler")) property.sampler = *sampler;
        if (const Value* editor = reader.object("editor")) readEditor(*editor, property);
        if (reading_ == EffectReading::Tolerant)  // Some of Cocos' files have these one level too high.
            for (const char* misplaced : {"slide", "range", "step"}) reader.find(misplaced);
        reader.finish();
        return property;
    }

    void readPropertyValue(const Value& value, EffectProperty& property) {
        const bool tolerant = reading_ == EffectReading::Tolerant;
        bool good = value.isNumber() || value.isString() || value.isNull();
        if (tolerant && value.isBool()) {
            property.value = Value::makeInteger(value.boolean() ? 1 : 0, value.where());
            return;
        }
        if (value.isArray()) {
            const std::size_t count = value.items().size();
            good = (count >= 2 && count <= 4) || count == 16 || (tolerant && count >= 1);
            for (const Value& item : value.items()) good = good && item.isNumber();
            if (good && tolerant && count > 4 && count != 9 && count != 16)
                problems_.warning(value.where(),
                                  fmt::format("the value of property '{}' has {} numbers", property.name, count),
                                  "uniforms have 1 to 4, matrices 9 or 16; the rest is not read");
        }
        if (!good)
            problems_.error(
                value.where(),
                fmt::format("the value of property '{}' must be a number, 2 to 4 numbers or a word", property.name),
                "value: 0.5, value: [1, 0, 0], or for a texture value: white");
        else
            property.value = value;
    }

    void readEditor(const Value& editor, EffectProperty& property) {
        KeyReader reader(editor, fmt::format("'editor' of property '{}'", property.name), reading_, problems_);
        for (const char* ignored : {"type", "displayName", "parent", "slide", "step", "visible", "deprecated"})
            reader.find(ignored);
        for (const char* key : {"tooltip", "tooltips"})
            if (const Value* text = reader.string(key)) property.help = text->string();
        if (const Value* range = reader.array("range")) {
            const auto& items = range->items();
            const bool good = (items.size() == 2 || items.size() == 3) && items[0].isNumber() && items[1].isNumber() &&
                              items[0].number() <= items[1].number();
            if (!good) {
                problems_.error(range->where(), "'range' must be two ascending numbers", "range: [0, 1]");
            } else {
                property.min = items[0].number();
                property.max = items[1].number();
            }
        }
        reader.finish();
    }

    EffectAsset& effect_;
    EffectReading reading_;
    Problems& problems_;
    std::vector<SourceLoc> indexWhere_;  ///< Of `propertyIndex` of the present technique's passes.
};

}  // namespace

void readEffectHeader(const Value& header, EffectAsset& effect, EffectReading reading, Problems& problems) {
    HeaderReader(effect, reading, problems).run(header);
}

}  // namespace crevice
