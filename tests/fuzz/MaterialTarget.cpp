// Fuzzes material values: a document's "material" object against an effect that has a property of every kind.
#include "FuzzTargets.h"
#include "effect/Material.h"

namespace crevice::fuzz {
namespace {

/// A pass with properties of all kinds, with the block and the samplers they feed, as a compiler would reflect them.
struct Sample {
    EffectPass pass;
    EffectVariant variant;

    Sample() {
        const auto number = [](double value) { return Value::makeNumber(value); };
        const auto list = [&](std::initializer_list<double> values) {
            Value value = Value::makeArray();
            for (const double item : values) value.items().push_back(number(item));
            return value;
        };
        const auto add = [&](const char* name, Value value, const char* target = "") -> EffectProperty& {
            EffectProperty& property = pass.properties.emplace_back();
            property.name = name;
            property.value = std::move(value);
            property.target = target;
            return property;
        };
        add("radius", number(0.5)).max = 2;
        add("count", number(8)).min = 1;
        add("tint", list({1, 1, 1, 1})).linear = true;
        add("pair", list({0, 0}), "packed.xy");
        add("third", number(0), "packed.z");
        add("automatic", Value::makeString("auto"));
        add("map", Value::makeString("white"));
        add("sky", Value::makeString("black"));
        add("unused", number(1));

        ShaderResource block;
        block.name = "Params";
        block.slot = {1, 0};
        block.stages = kFragmentBit;
        block.active = true;
        block.size = 64;
        block.members = {{"radius", 0, 4, "float"},
                         {"count", 4, 4, "int"},
                         {"automatic", 8, 4, "float"},
                         {"tint", 16, 16, "vec4"},
                         {"packed", 32, 16, "vec4"}};
        ShaderResource map;
        map.name = "map";
        map.kind = ResourceKind::CombinedSampler;
        map.slot = {1, 1};
        map.active = true;
        ShaderResource sky = map;
        sky.name = "sky";
        sky.slot = {1, 2};
        sky.cube = true;
        variant.name = variant.effect = "sample";
        variant.pass = &pass;
        variant.info.resources = {block, map, sky};
    }
};

}  // namespace

void material(std::string_view input) {
    static const Sample kSample;
    expectAnswer([&] {
        const Value object = parseJson(input, "fuzz.json");
        Material material(kSample.variant);
        Problems problems;
        material.apply(object, problems);
        (void)material.autoProperties();
        problems.throwIfErrors();
    });
}

}  // namespace crevice::fuzz
