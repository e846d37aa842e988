// The key tables of pipeline documents.
#include "plan/PipelineAssetKeys.h"

#include "core/Format.h"

namespace crevice {
namespace {

constexpr const char* kNameList = R"({"type":"array","items":{"type":"string"}})";
constexpr const char* kVersionedNames = R"({"type":"array","items":{"type":"string"},"uniqueItems":true})";

const KeySpec kPipelineKeys[] = {
    {.key = "$schema", .kind = KeyKind::Text, .help = "For editors; not read."},
    {.key = "name", .kind = KeyKind::Text, .help = "The pipeline's name.", .defaultText = "the file's name"},
    {.key = "help", .kind = KeyKind::Text, .help = "What it is for."},
    {.key = "extends", .kind = KeyKind::Text, .help = "The one parent: a name, or a path relative to this file."},
    {.key = "output",
     .kind = KeyKind::Text,
     .help = "Target that a frame is read back from. Needed unless the parent has one."},
    {.key = "guard",
     .kind = KeyKind::NumberOrOption,
     .help = "Border that is rendered around the frame and cut off from every picture: percent of the frame's height "
             "on each side, rounded up to a multiple of 4 pixels.",
     .min = 0,
     .max = 100,
     .defaultText = "0"},
    {.key = "profile",
     .kind = KeyKind::Choice,
     .help = "Numbers and block layouts of sets 0 and 2, units and conventions: those of a Cocos Creator version, for "
             "its effects. See [Cocos at run time](cocos-runtime.md).",
     .names = profileNames,
     .defaultText = "Crevice's own"},
    {.key = "fallbacks",
     .kind = KeyKind::Object,
     .help = "What a Cocos profile does where a project's files contradict each other.",
     .schema = R"({"$ref":"#/$defs/fallbacks"})"},
    {.key = "macros",
     .kind = KeyKind::Object,
     .help =
         "Macros for every effect of a Cocos profile that knows them; they win over the materials', as the pipeline's "
         "macros do in Cocos.",
     .schema = R"({"type":"object","additionalProperties":{"type":["boolean","integer","string"]}})"},
    {.key = "plugins",
     .kind = KeyKind::Array,
     .help = "Plugins the document needs; the caller has to allow each.",
     .schema = kNameList,
     .type = "list of names"},
    {.key = "targets",
     .kind = KeyKind::Object,
     .help = "Images by name. A name that starts with `cc_` enters set 0.",
     .schema = R"({"type":"object","additionalProperties":{"$ref":"#/$defs/target"}})"},
    {.key = "blocks",
     .kind = KeyKind::Object,
     .help = "Pinned numbers of uniform blocks of set 0, by name.",
     .schema = R"({"type":"object","additionalProperties":{"$ref":"#/$defs/block"}})"},
    {.key = "options",
     .kind = KeyKind::Object,
     .help = "Switches for the caller, by name.",
     .schema = R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/option"},{"type":"null"}]}})"},
    {.key = "flows",
     .kind = KeyKind::Array,
     .help = "Groups of stages, in the order they run.",
     .schema = R"({"type":"array","items":{"$ref":"#/$defs/flow"}})",
     .type = "list of flows"},
    {.key = "edits",
     .kind = KeyKind::Array,
     .help = "Changes to the parent's stages, applied in order.",
     .schema = R"({"type":"array","items":{"$ref":"#/$defs/edit"}})",
     .type = "list of edits"},
};

const KeySpec kFallbackKeys[] = {
    {.key = "rebindLiterals",
     .kind = KeyKind::Bool,
     .help = "A number of set 0 or 2 that a shader writes out and another name has: the shader's name decides, with a "
             "note. Off: an error.",
     .defaultText = "true"},
    {.key = "globalSamplers",
     .kind = KeyKind::Bool,
     .help = "A material's sampler that nothing feeds takes the target of set 0 that has its name, with a warning. "
             "Off: it shows the default texture.",
     .defaultText = "true"},
};

const KeySpec kTargetKeys[] = {
    {.key = "format",
     .kind = KeyKind::Choice,
     .help = "Pixel format. May be left out with `like`.",
     .names = formatNames},
    {.key = "scale",
     .kind = KeyKind::Number,
     .help = "Size relative to the frame.",
     .min = 0,
     .max = 4,
     .exclusiveMin = true,
     .defaultText = "1"},
    {.key = "size",
     .kind = KeyKind::Array,
     .help = "Fixed size in pixels instead of `scale`.",
     .schema = R"({"type":"array","items":{"type":"integer","minimum":1,"maximum":16384},"minItems":2,"maxItems":2})",
     .type = "[width, height], 1 … 16384"},
    {.key = "like",
     .kind = KeyKind::Text,
     .help = "Target whose format, scale and size are taken where this one gives none."},
    {.key = "mips",
     .kind = KeyKind::Integer,
     .help = "Mip levels. A wire names one as `name@level`.",
     .min = 1,
     .max = 15,
     .defaultText = "1"},
    {.key = "layers", .kind = KeyKind::Integer, .help = "Array layers.", .min = 1, .max = 64, .defaultText = "1"},
    {.key = "clear",
     .kind = KeyKind::NumberOrArray,
     .help = "What the first write of a frame clears to, and what the target "
             "holds when nobody writes it.",
     .schema = R"({"anyOf":[{"type":"number"},{"type":"array","items":{"type":"number"},"minItems":4,"maxItems":4}]})",
     .type = "number, or list of 4 numbers",
     .defaultText = "0"},
    {.key = "sampler",
     .kind = KeyKind::Choice,
     .help = "How shaders sample it.",
     .names = samplerNames,
     .defaultText = "point-clamp"},
    {.key = "binding",
     .kind = KeyKind::Integer,
     .help = "Pinned number in set 0; only for names that start with `cc_`.",
     .min = 0,
     .max = 63,
     .defaultText = "the lowest free"},
    {.key = "persistent",
     .kind = KeyKind::Bool,
     .help = "Keep the content for the next frame. Not supported yet: an error."},
    {.key = "override",
     .kind = KeyKind::Bool,
     .help = "Allows to change a target that an earlier document defines: the keys "
             "given here win.",
     .defaultText = "false"},
    {.key = "help", .kind = KeyKind::Text, .help = "What it holds."},
};

const KeySpec kBlockKeys[] = {
    {.key = "binding",
     .kind = KeyKind::Integer,
     .help = "Pinned number in set 0.",
     .min = 0,
     .max = 63,
     .defaultText = "the lowest free"},
    {.key = "override",
     .kind = KeyKind::Bool,
     .help = "Allows to change a block that an earlier document pins.",
     .defaultText = "false"},
    {.key = "help", .kind = KeyKind::Text, .help = "What it holds."},
};

const KeySpec kOptionKeys[] = {
    {.key = "type",
     .kind = KeyKind::Choice,
     .help = "What kind of value it takes.",
     .required = true,
     .names = optionTypeNames},
    {.key = "default",
     .kind = KeyKind::Any,
     .help = "Value when the caller says nothing. A number whose default is \"auto\" takes numbers and that word.",
     .required = true,
     .schema = R"({"type":["boolean","number","string"]})",
     .type = "bool, number, auto or choice"},
    {.key = "min", .kind = KeyKind::Number, .help = "Smallest number allowed."},
    {.key = "max", .kind = KeyKind::Number, .help = "Largest number allowed."},
    {.key = "choices",
     .kind = KeyKind::ObjectOrArray,
     .help = "Names to choose from: a list, or an object whose values may "
             "carry `set`. On a bool: what `true` and `false` set.",
     .schema = R"({"anyOf":[{"type":"array","items":{"type":"string"},"minItems":1},)"
               R"({"type":"object","additionalProperties":{"$ref":"#/$defs/choice"},"minProperties":1}]})",
     .type = "list of names, or object of choices"},
    {.key = "override",
     .kind = KeyKind::Bool,
     .help = "Allows to change an option that an earlier document declares.",
     .defaultText = "false"},
    {.key = "help", .kind = KeyKind::Text, .help = "What it does."},
};

const KeySpec kChoiceKeys[] = {
    {.key = "set",
     .kind = KeyKind::Object,
     .help = "Values set while this choice is in force, by path: "
             "`\"AoMain.defines.SLICES\": 1`. `\"$NAME\": 6` is what `auto` of the number option NAME stands for."},
    {.key = "help", .kind = KeyKind::Text, .help = "What it does."},
};

const KeySpec kFlowKeys[] = {
    {.key = "flow",
     .kind = KeyKind::Text,
     .help = "Name. Without `stages`: the flow file `flows/NAME.flow.json`; `$option` in the name stands for the "
             "option's value.",
     .required = true},
    {.key = "priority",
     .kind = KeyKind::Integer,
     .help = "Must not decrease from flow to flow; places a flow that a child "
             "document adds.",
     .min = -1e6,
     .max = 1e6},
    {.key = "enabled", .kind = KeyKind::Condition, .help = "Switches all its stages.", .defaultText = "true"},
    {.key = "help", .kind = KeyKind::Text, .help = "What it is for."},
    {.key = "stages",
     .kind = KeyKind::Array,
     .help = "Stages, in the order they run.",
     .schema = R"({"type":"array","items":{"$ref":"#/$defs/stage"},"minItems":1})",
     .type = "list of stages"},
};

const KeySpec kFlowFileKeys[] = {
    {.key = "$schema", .kind = KeyKind::Text, .help = "For editors; not read."},
    {.key = "help", .kind = KeyKind::Text, .help = "What it is for."},
    {.key = "priority",
     .kind = KeyKind::Integer,
     .help = "Priority where the document that names the flow gives none.",
     .min = -1e6,
     .max = 1e6},
    {.key = "targets",
     .kind = KeyKind::Object,
     .help = "Targets that the flow brings along.",
     .schema = R"({"type":"object","additionalProperties":{"$ref":"#/$defs/target"}})"},
    {.key = "blocks",
     .kind = KeyKind::Object,
     .help = "Blocks that the flow brings along.",
     .schema = R"({"type":"object","additionalProperties":{"$ref":"#/$defs/block"}})"},
    {.key = "options",
     .kind = KeyKind::Object,
     .help = "Options that the flow brings along.",
     .schema = R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/option"},{"type":"null"}]}})"},
    {.key = "stages",
     .kind = KeyKind::Array,
     .help = "Stages, in the order they run.",
     .required = true,
     .schema = R"({"type":"array","items":{"$ref":"#/$defs/stage"},"minItems":1})",
     .type = "list of stages"},
};

const KeySpec kStageKeys[] = {
    {.key = "stage", .kind = KeyKind::Text, .help = "Class: `crevice stages` lists them.", .required = true},
    {.key = "name", .kind = KeyKind::Text, .help = "Unique in the pipeline.", .defaultText = "the class"},
    {.key = "enabled",
     .kind = KeyKind::Condition,
     .help = "A disabled stage is checked and keeps its numbers, but does not run.",
     .defaultText = "true"},
    {.key = "priority",
     .kind = KeyKind::Integer,
     .help = "Must not decrease within a flow.",
     .min = -1e6,
     .max = 1e6,
     .defaultText = "the class's"},
    {.key = "effect", .kind = KeyKind::Text, .help = "Effect by name.", .defaultText = "the class's"},
    {.key = "defines",
     .kind = KeyKind::Object,
     .help = "Macros of the effect: bools, integers or strings.",
     .schema = R"({"type":"object","additionalProperties":{"type":["boolean","integer","string"]}})"},
    {.key = "material",
     .kind = KeyKind::Object,
     .help = "Properties of the effect: `crevice effects NAME` lists them."},
    {.key = "states",
     .kind = KeyKind::Object,
     .help = "Fixed-function states over those of a full-screen effect's pass: `rasterizerState`, `depthStencilState`, "
             "`blendState`."},
    {.key = "params", .kind = KeyKind::Object, .help = "Parameters of the class: `crevice stages NAME` lists them."},
    {.key = "reads",
     .kind = KeyKind::ObjectOrArray,
     .help = "Wires: sampler in the shader → target. As a list: the list of "
             "targets read, checked against the shader.",
     .schema = R"({"anyOf":[{"type":"object","additionalProperties":{"type":"string"}},)"
               R"({"type":"array","items":{"type":"string"},"uniqueItems":true}]})",
     .type = "object of targets, or list of targets"},
    {.key = "writes",
     .kind = KeyKind::Array,
     .help = "Targets written, in the order of the shader's outputs; `name@level` is "
             "one mip level.",
     .schema = kVersionedNames,
     .type = "list of targets",
     .defaultText = "the class's"},
    {.key = "queues",
     .kind = KeyKind::Array,
     .help = "What a scene stage draws, in order.",
     .schema = R"({"type":"array","items":{"$ref":"#/$defs/queue"}})",
     .type = "list of queues",
     .defaultText = "the class's"},
    {.key = "reach",
     .kind = KeyKind::Integer,
     .help =
         "How far from its own pixel the stage reads targets, in pixels of what it writes: with a guard, the stages "
         "before it draw no more of it than is read.",
     .min = 0,
     .max = 4096,
     .defaultText = "unknown: the whole guard is drawn"},
};

const KeySpec kQueueKeys[] = {
    {.key = "phase",
     .kind = KeyKind::Text,
     .help = "Passes of scene materials with this phase.",
     .defaultText = "default"},
    {.key = "phases",
     .kind = KeyKind::Array,
     .help = "Several phases instead of the one.",
     .schema = R"({"type":"array","items":{"type":"string"},"minItems":1,"uniqueItems":true})",
     .type = "list of names"},
    {.key = "sort",
     .kind = KeyKind::Choice,
     .help = "Order of draws; `back-to-front` draws the passes that blend, "
             "`front-to-back` those that do not.",
     .names = sortNames,
     .defaultText = "front-to-back"},
};

const KeySpec kInsertKeys[] = {
    {.key = "insert",
     .kind = KeyKind::Object,
     .help = "The stage, or a flow.",
     .required = true,
     .schema = R"({"anyOf":[{"$ref":"#/$defs/stage"},{"$ref":"#/$defs/flow"}]})",
     .type = "stage or flow"},
    {.key = "before", .kind = KeyKind::Text, .help = "Stage (or flow, for a flow) in front of which it goes."},
    {.key = "after", .kind = KeyKind::Text, .help = "Stage (or flow, for a flow) behind which it goes."},
    {.key = "priority",
     .kind = KeyKind::Integer,
     .help = "Place by priority, without `before` and `after`.",
     .min = -1e6,
     .max = 1e6,
     .defaultText = "the class's"},
};

const KeySpec kReplaceKeys[] = {
    {.key = "replace", .kind = KeyKind::Text, .help = "Stage that goes.", .required = true},
    {.key = "with",
     .kind = KeyKind::Object,
     .help = "Stage that comes in its place.",
     .required = true,
     .schema = R"({"$ref":"#/$defs/stage"})",
     .type = "stage"},
};

const KeySpec kRemoveKeys[] = {
    {.key = "remove",
     .kind = KeyKind::Text,
     .help = "Stage or flow that goes. A flow goes with its last stage.",
     .required = true},
};

const KeyTable kPipelineTable{"pipeline", kPipelineKeys};
const KeyTable kFallbackTable{"fallbacks", kFallbackKeys};
const KeyTable kTargetTable{"target", kTargetKeys};
const KeyTable kBlockTable{"block", kBlockKeys};
const KeyTable kOptionTable{"option", kOptionKeys};
const KeyTable kChoiceTable{"choice", kChoiceKeys};
const KeyTable kFlowTable{"flow", kFlowKeys};
const KeyTable kFlowFileTable{"flow file", kFlowFileKeys};
const KeyTable kStageTable{"stage", kStageKeys};
const KeyTable kQueueTable{"queue", kQueueKeys};
const KeyTable kInsertTable{"insert", kInsertKeys};
const KeyTable kReplaceTable{"replace", kReplaceKeys};
const KeyTable kRemoveTable{"remove", kRemoveKeys};

}  // namespace

const KeyTable& pipelineKeys() { return kPipelineTable; }
const KeyTable& fallbackKeys() { return kFallbackTable; }
const KeyTable& targetKeys() { return kTargetTable; }
const KeyTable& blockKeys() { return kBlockTable; }
const KeyTable& optionKeys() { return kOptionTable; }
const KeyTable& choiceKeys() { return kChoiceTable; }
const KeyTable& flowKeys() { return kFlowTable; }
const KeyTable& flowFileKeys() { return kFlowFileTable; }
const KeyTable& stageKeys() { return kStageTable; }
const KeyTable& queueKeys() { return kQueueTable; }
const KeyTable& insertKeys() { return kInsertTable; }
const KeyTable& replaceKeys() { return kReplaceTable; }
const KeyTable& removeKeys() { return kRemoveTable; }

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const FormatInfo& info : allFormats()) names.push_back(info.name);
    return names;
}
// In the order of Profile, from Cocos33 on; of SamplerKind, QueueSort and OptionType.
std::vector<std::string> profileNames() { return {"cocos-3.3", "cocos-3.6"}; }
std::vector<std::string> samplerNames() { return {"point-clamp", "linear-clamp", "linear-repeat", "shadow-compare"}; }
std::vector<std::string> sortNames() { return {"front-to-back", "back-to-front"}; }
std::vector<std::string> optionTypeNames() { return {"bool", "number", "choice"}; }

}  // namespace crevice
