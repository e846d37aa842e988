// Every mistake in a pipeline document has its own message, with its place, near names and what to do.
#include <algorithm>

#include "PipelineTestTools.h"

namespace crevice {
namespace {

using test::document;
using test::parse;
using test::problemsOf;

/// The problems of a document contain a text, and there is exactly one problem.
void expectOne(const std::string& problems, const std::string& part) {
    EXPECT_NE(problems.find(part), std::string::npos) << "expected: " << part << "\nfound: " << problems;
    EXPECT_EQ(std::count(problems.begin(), problems.end(), '\n'), 1) << problems;
}

TEST(PipelineError, NoMistakeNoProblem) { EXPECT_EQ(problemsOf(document("", "")), ""); }

TEST(PipelineError, UnknownKeys) {
    expectOne(
        problemsOf(document(R"(, "scael": 1)", "")),
        "4:42: unknown key 'scael' in target 'out' | did you mean 'scale'? keys: format, scale, size, like, mips, "
        "layers, clear, sampler, binding, persistent, override, help");
    expectOne(problemsOf(document("", R"(, "efect": "x")")),
              "unknown key 'efect' in stage 'FullscreenStage' | did you mean 'effect'?");
    expectOne(problemsOf(document("", "", R"(, "outptu": "out")")),
              "unknown key 'outptu' in the pipeline | did you mean 'output'?");
    expectOne(problemsOf(document("", R"(, "queues": [ { "phas": "default" } ])")),
              "unknown key 'phas' in a queue of stage 'FullscreenStage'");
    expectOne(problemsOf(document("", "", R"(, "blocks": { "CCSsao": { "bindin": 3 } })")),
              "unknown key 'bindin' in block 'CCSsao'");
    expectOne(
        problemsOf(
            R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "options": { "a": { "type": "bool", "default": true, "hlep": "" } },
        "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] } ] })"),
        "unknown key 'hlep' in option 'a' | did you mean 'help'?");
    expectOne(problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } },
        "flows": [ { "flow": "F", "prioritty": 1, "stages": [ { "stage": "S" } ] } ] })"),
              "unknown key 'prioritty' in flow 'F' | did you mean 'priority'?");
}

TEST(PipelineError, MissingKeys) {
    expectOne(
        problemsOf(
            R"({ "output": "o", "targets": { "o": { "scale": 1 } }, "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] } ] })"),
        "missing key 'format' in target 'o' | add \"format\"");
    expectOne(problemsOf(document("", R"( }, { "effect": "copy")")), "missing key 'stage' in stage 2 of flow 'Main'");
    expectOne(
        problemsOf(
            R"({ "targets": { "o": { "format": "R8" } }, "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] } ] })"),
        "missing key 'output' in the pipeline");
    expectOne(problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } } })"), "the pipeline has no flows");
    expectOne(problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "flows": [] })"),
              "the pipeline has no flows");
    expectOne(
        problemsOf(
            R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "flows": [ { "flow": "F", "stages": [] } ] })"),
        "flow 'F' has no stages");
}

TEST(PipelineError, AMisspeltKeyIsNotMissingAsWell) {
    expectOne(problemsOf(document("", R"( }, { "stag": "FullscreenStage")")),
              "unknown key 'stag' in stage 2 of flow 'Main' | did you mean 'stage'");
    expectOne(problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } },
        "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] }, { "flo": "x", "stages": [] } ] })"),
              "unknown key 'flo' in flow 2 | did you mean 'flow'");
    expectOne(problemsOf(document("", "", R"(, "edits": [ { "insert": { "flo": "x", "stages": [] } } ])")),
              "unknown key 'flo' in an inserted flow | did you mean 'flow'");
}

TEST(PipelineError, WrongTypes) {
    expectOne(problemsOf(document(R"(, "scale": "1")", "")),
              "'scale' of target 'out' must be a number, found a string");
    expectOne(problemsOf(document(R"(, "mips": 1.5)", "")), "'mips' of target 'out' must be an integer");
    expectOne(problemsOf(document("", R"(, "enabled": 1)")),
              "'enabled' of stage 'FullscreenStage' must be a bool or a condition");
    expectOne(problemsOf(document("", R"(, "params": [])")),
              "'params' of stage 'FullscreenStage' must be an object, found a list");
    expectOne(problemsOf(document("", R"(, "writes": "out")")), "'writes' of stage 'FullscreenStage' must be a list");
    expectOne(problemsOf(document("", R"(, "defines": { "A": 1.5 })")),
              "define 'A' of stage 'FullscreenStage' must be a bool, an integer or a string");
    expectOne(problemsOf("[]"), "the pipeline must be an object, found a list");
    expectOne(problemsOf(document("", "", R"(, "edits": [ 3 ])")), "an edit must be an object, found a number");
    expectOne(problemsOf(document("", R"(, "name": "a.b")")), "'a.b' cannot name a stage");
    expectOne(problemsOf(document(R"( }, "a@1": { "format": "R8")", "")), "'a@1' cannot name a target");
}

TEST(PipelineError, TargetValues) {
    expectOne(problemsOf(document(R"( }, "b": { "format": "RGBA9")", "")),
              "unknown format 'RGBA9' in target 'b' | did you mean 'RGBA8'");
    expectOne(problemsOf(document(R"(, "sampler": "point")", "")), "unknown sampler 'point' in target 'out'");
    for (const char* scale : {"0", "-1", "4.01"})
        expectOne(problemsOf(document(std::string(R"(, "scale": )") + scale, "")), "'scale' of target 'out' is");
    EXPECT_EQ(problemsOf(document(R"(, "scale": 4)", "")), "");
    for (const char* size : {"[0, 1]", "[1, 16385]", "[1.5, 2]", "[\"a\", 2]"})
        expectOne(problemsOf(document(std::string(R"(, "size": )") + size, "")), "'size' of target 'out' holds");
    expectOne(problemsOf(document(R"(, "size": [1, 2, 3])", "")),
              "'size' of target 'out' must have 2 numbers, found 3");
    EXPECT_EQ(problemsOf(document(R"(, "size": [16384, 1])", "")), "");
    expectOne(problemsOf(document(R"(, "size": [1, 2], "scale": 1)", "")),
              "target 'out' has both 'scale' and 'size' [4: 'scale' is here] | keep");
    expectOne(problemsOf(document(R"(, "clear": [1, 2])", "")),
              "'clear' of target 'out' must be one number or a list of 4 numbers");
    expectOne(problemsOf(document(R"(, "persistent": true)", "")), "'persistent' of target 'out' is not supported yet");
    expectOne(problemsOf(document(R"(, "binding": 3)", "")),
              "'binding' on target 'out', which is a private wire | only targets whose name starts with 'cc_'");
}

TEST(PipelineError, Like) {
    expectOne(problemsOf(document(R"( }, "b": { "like": "uot")", "")),
              "target 'b' is like 'uot', which is no target | did you mean 'out'?");
    expectOne(problemsOf(document(R"( }, "b": { "like": "c" }, "c": { "like": "b")", "")),
              "targets are like each other in a circle: 'b' → 'c' → 'b'");
    expectOne(problemsOf(document(R"( }, "b": { "like": "b")", "")),
              "targets are like each other in a circle: 'b' → 'b'");
}

TEST(PipelineError, Names) {
    expectOne(problemsOf(document("", R"( }, { "stage": "FullscreenStage")")),
              "a second stage named 'FullscreenStage' [5: the first one is here] | give it another \"name\"");
    expectOne(problemsOf(document("", R"(, "writes": ["uot"])")),
              "'writes' of stage 'FullscreenStage' names 'uot', which is no target | did you mean 'out'?");
    expectOne(problemsOf(document("", R"(, "reads": { "a": "uot" })")),
              "'reads' of stage 'FullscreenStage' names 'uot'");
    expectOne(problemsOf(document("", R"(, "reads": ["uot"])")), "'reads' of stage 'FullscreenStage' names 'uot'");
    expectOne(problemsOf(document("", R"(, "reads": { "a": 1 })")),
              "'reads' of stage 'FullscreenStage' must name targets, found a number");
    expectOne(problemsOf(document("", R"(, "writes": ["out@1"])")), "names mip level 1 of 'out', which has 1");
    expectOne(problemsOf(document("", R"(, "writes": ["out@x"])")), "names 'out@x', which is no mip level of 'out'");
    expectOne(problemsOf(document("", R"(, "writes": ["out", "out"])")), "names 'out' twice");
    EXPECT_EQ(problemsOf(document(R"(, "mips": 2)", R"(, "writes": ["out@1"])")), "");
    expectOne(
        problemsOf(
            R"({ "output": "a", "targets": { "o": { "format": "R8" } }, "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] } ] })"),
        "'output' names 'a', which is no target");
}

TEST(PipelineError, Edits) {
    const auto edit = [](const std::string& text) {
        return problemsOf(document("", "", R"(, "edits": [ )" + text + " ]"));
    };
    expectOne(edit(R"({ "before": "FullscreenStage" })"), "an edit says nothing to do");
    expectOne(edit(R"({ "inser": { "stage": "S" } })"), "an edit says nothing to do | did you mean 'insert'?");
    expectOne(edit(R"({ "set": "FullscreenStage", "remove": "FullscreenStage" })"),
              "an edit has 2 verbs: 'set', 'remove'");
    expectOne(edit(R"({ "insert": { "stage": "S" }, "before": "FullscreenStage", "after": "FullscreenStage" })"),
              "an insert has both 'before' and 'after'");
    expectOne(edit(R"({ "insert": { "stage": "S" }, "before": "FulscreenStage" })"),
              "no stage named 'FulscreenStage' | did you mean 'FullscreenStage'?");
    expectOne(edit(R"({ "set": "FulscreenStage", "effect": "x" })"), "no stage named 'FulscreenStage'");
    expectOne(edit(R"({ "set": "out", "scale": 1 })"),
              "no stage named 'out' | 'out' is a target: change it under \"targets\"");
    expectOne(edit(R"({ "set": "FullscreenStage", "efect": "x" })"), "unknown key 'efect' in stage 'FullscreenStage'");
    expectOne(edit(R"({ "set": "FullscreenStage", "name": "x" })"), "'set' cannot change 'name' of a stage");
    expectOne(edit(R"({ "set": "Main", "stages": [] })"), "'set' cannot change 'stages' of a flow");
    expectOne(edit(R"({ "replace": "Nope", "with": { "stage": "S" } })"), "no stage named 'Nope'");
    expectOne(edit(R"({ "replace": "FullscreenStage" })"), "missing key 'with' in a replace");
    expectOne(edit(R"({ "remove": "Nope" })"), "no stage named 'Nope'");
    expectOne(edit(R"({ "insert": { "stage": "FullscreenStage" }, "before": "FullscreenStage" })"),
              "a second stage named 'FullscreenStage'");
    expectOne(edit(R"({ "insert": { "stage": "S" } })"),
              "nothing says where to insert stage 'S' | add \"before\" or \"after\"");
    expectOne(edit(R"({ "insert": { "stage": "S" }, "after": "FullscreenStage", "flow": "Main" })"),
              "unknown key 'flow' in an insert");
}

TEST(PipelineError, OptionDeclarations) {
    const auto option = [](const std::string& text) {
        return problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "options": { "a": { )" + text +
                          R"( } }, "flows": [ { "flow": "F", "stages": [ { "stage": "S" } ] } ] })");
    };
    expectOne(option(R"("type": "boo", "default": true)"), "unknown type 'boo' in option 'a' | did you mean 'bool'?");
    expectOne(option(R"("type": "bool")"), "missing key 'default' in option 'a'");
    expectOne(option(R"("type": "bool", "default": 1)"), "option 'a' must be true or false, found 1");
    expectOne(option(R"("type": "number", "default": 3, "max": 2)"),
              "option 'a' is 3, out of range | write a number up to 2");
    expectOne(option(R"("type": "choice", "default": "x")"), "missing key 'choices' in option 'a'");
    expectOne(option(R"("type": "choice", "default": "x", "choices": ["y"])"), "option 'a' has no choice 'x'");
    expectOne(option(R"("type": "choice", "default": "x", "choices": [])"), "option 'a' has no choices");
    expectOne(option(R"("type": "bool", "default": true, "choices": { "yes": {} })"),
              "bool option 'a' has no value 'yes'");
    expectOne(option(R"("type": "bool", "default": true, "min": 0)"), "'min' of option 'a', which is no number");
    expectOne(option(R"("type": "choice", "default": "x", "choices": { "x": { "set": { "T.effect": "e" } } })"),
              "no stage or target named 'T'");
    expectOne(option(R"("type": "choice", "default": "x", "choices": { "x": {}, "y": { "set": { "o.formt": "e" } } })"),
              "unknown key 'formt' in target 'o'");
}

TEST(PipelineError, OptionValues) {
    const auto with = [](const char* name, const char* value) {
        return problemsOf(document("", ""), {.nameOrPath = "", .options = {{name, value}}, .sets = {}});
    };
    EXPECT_EQ(with("on", "false"), "");
    EXPECT_EQ(with("level", "0.25"), "");
    expectOne(with("onn", "false"), "no option named 'onn' | did you mean 'on'? options: on, level, mode");
    expectOne(with("on", "1"), "option 'on' must be true or false, found 1");
    expectOne(with("on", "yes"), "option 'on' must be true or false, found 'yes'");
    expectOne(with("level", "9"), "option 'level' is 9, out of range | write a number from 0 to 8");
    expectOne(with("level", "much"), "option 'level' must be a number");
    expectOne(with("mode", "fats"), "option 'mode' has no choice 'fats' | did you mean 'fast'? choices: slow, fast");
}

TEST(PipelineError, OptionUses) {
    expectOne(problemsOf(document(R"(, "scale": "$levle")", "")), "'$levle' names no option | did you mean 'level'?");
    expectOne(problemsOf(document(R"(, "scale": "$mode")", "")),
              "4:51: 'scale' of target 'out' must be a number, found a string");
    expectOne(problemsOf(document("", R"(, "enabled": "$level")")),
              "condition '$level' needs a bool, option 'level' is none");
    expectOne(problemsOf(document("", R"(, "enabled": "$mode == fats")")),
              "option 'mode' has no choice 'fats' | did you mean 'fast'?");
    for (const char* bad :
         {"on", "$", "", "! on", "$on == ", "== 1", "$on && $on", "$mode == fast || $on", "$mode == a == b"})
        expectOne(problemsOf(document("", std::string(R"(, "enabled": ")") + bad + '"')), "is no condition");
    expectOne(problemsOf(document("", R"(, "enabled": "$on == fast")")),
              "condition '$on == fast' compares option 'on' with 'fast'");
    expectOne(problemsOf(document("", R"(, "enabled": "$off")")), "'$off' names no option");
}

TEST(PipelineError, Sets) {
    const auto set = [](const char* path, const char* value) {
        return problemsOf(document("", R"(, "name": "A")"), {.nameOrPath = "", .options = {}, .sets = {{path, value}}});
    };
    EXPECT_EQ(set("A.params.seed", "3"), "");
    expectOne(set("B.params.seed", "3"), "no stage or target named 'B'");
    expectOne(set("otu.scale", "3"), "no stage or target named 'otu' | did you mean 'out'?");
    expectOne(set("out.scael", "3"), "unknown key 'scael' in target 'out' | did you mean 'scale'?");
    expectOne(set("A.efect", "x"), "unknown key 'efect' in stage 'A' | did you mean 'effect'?");
    expectOne(set("A.parms.seed", "3"), "unknown key 'parms' in stage 'A' | did you mean 'params'?");
    expectOne(set("A.params.seed.x", "3"), "goes deeper");
    expectOne(set("A.params", "3"), "'params' of stage 'A' is a group of values, found a number");
    expectOne(set("A.stage", "X"), "'stage' of stage 'A' cannot be set");
    expectOne(set("A", "3"), "'A' is no path of a value");
    expectOne(set("A..x", "3"), "'A..x' is no path of a value");
    expectOne(set("Main.stages", "3"), "'stages' of flow 'Main' cannot be set");
    expectOne(set("A.effect.x", "3"), "'effect' of stage 'A' holds no values with names");
    expectOne(set("A.params.x", "[1, "), "'[1, ' is no JSON value");
    expectOne(set("out.scale", "5"), "0:0: 'scale' of target 'out' is 5, out of range");
}

TEST(PipelineError, Priorities) {
    expectOne(problemsOf(document("", R"(, "name": "A", "priority": 5 }, { "stage": "B", "priority": 4)")),
              "stage 'B' with priority 4 follows 'A' with priority 5 [5: 'A' is here]");
    EXPECT_EQ(problemsOf(document("", R"(, "name": "A", "priority": 5 }, { "stage": "B", "priority": 5)")), "");
    expectOne(problemsOf(R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "flows": [
        { "flow": "F", "priority": 2, "stages": [ { "stage": "S" } ] }, { "flow": "G", "priority": 1, "stages": [ { "stage": "T" } ] } ] })"),
              "flow 'G' with priority 1 follows 'F' with priority 2");
}

TEST(PipelineError, PrioritiesOfClasses) {
    const PipelineDesc desc = parse(document("", R"(, "name": "A" }, { "stage": "Data" }, { "stage": "B")"));
    const PriorityLookup falling = [](const std::string& name) -> std::optional<int> {
        if (name == "FullscreenStage") return 7;
        return name == "B" ? std::optional(6) : std::nullopt;
    };
    Problems problems;
    checkPriorities(desc, falling, problems);
    ASSERT_EQ(problems.all().size(), 1u);
    EXPECT_EQ(problems.all()[0].message, "stage 'B' with priority 6 follows 'A' with priority 7");
    Problems none;
    checkPriorities(
        desc, [](const std::string&) { return std::optional(1); }, none);
    EXPECT_FALSE(none.hasErrors());
}

TEST(PipelineError, SeveralMistakesAreReportedInOneRun) {
    const std::string all =
        problemsOf(document(R"(, "scale": 9, "formt": "R8")", R"(, "effect": 3, "enabled": "$nope")"));
    EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 4) << all;
}

TEST(PipelineError, AtMostTwentyErrorsAreShown) {
    std::string keys;
    for (int i = 0; i < 30; ++i) keys += ", \"wrong" + std::to_string(i) + "\": 1";
    try {
        parse(document(keys, ""));
        FAIL();
    } catch (const Error& error) {
        EXPECT_LE(error.problems().size(), Problems::kMaxErrors + 1);
    }
}

}  // namespace
}  // namespace crevice
