// Reading pipeline documents: defaults, extends, merging, flow files, edits.
#include <functional>

#include "PipelineTestTools.h"

namespace crevice {
namespace {

using test::AssetFolder;
using test::child;
using test::document;
using test::kBase;
using test::load;
using test::parse;
using test::stageOf;
using test::stageOrder;

std::string messageOf(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        return formatError(error);
    }
    return {};
}

TEST(PipelineAsset, Defaults) {
    const PipelineDesc desc = parse(document("", ""));
    EXPECT_EQ(desc.name, "t");
    const TargetDesc& target = desc.targets.at(0);
    EXPECT_EQ(target.format, Format::RGBA8);
    EXPECT_EQ(target.scale, 1.0f);
    EXPECT_FALSE(target.size.has_value());
    EXPECT_EQ(target.mips, 1u);
    EXPECT_EQ(target.layers, 1u);
    EXPECT_EQ(target.sampler, SamplerKind::PointClamp);
    EXPECT_EQ(target.clear, glm::vec4(0));
    const StageDesc& stage = stageOf(desc, "FullscreenStage");
    EXPECT_TRUE(stage.enabled);
    EXPECT_FALSE(stage.priority.has_value());
    EXPECT_TRUE(stage.effect.empty());
    EXPECT_TRUE(stage.params.isNull());
    EXPECT_EQ(stage.where.line, 5);
}

TEST(PipelineAsset, EveryKeyOfATargetArrives) {
    const PipelineDesc desc = parse(document(
        R"(, "mips": 3, "layers": 2, "clear": [1, 2, 3, 4], "sampler": "linear-repeat", "help": "h", "size": [7, 9] },
           "cc_x": { "format": "R8", "binding": 14, "clear": 0.5, "scale": 0.25)",
        ""));
    const TargetDesc& out = desc.targets.at(0);
    EXPECT_EQ(out.mips, 3u);
    EXPECT_EQ(out.layers, 2u);
    EXPECT_EQ(out.clear, glm::vec4(1, 2, 3, 4));
    EXPECT_EQ(out.sampler, SamplerKind::LinearRepeat);
    EXPECT_EQ(out.help, "h");
    EXPECT_EQ(out.size, glm::uvec2(7, 9));
    EXPECT_EQ(desc.targets.at(1).binding, 14u);
    EXPECT_EQ(desc.targets.at(1).clear, glm::vec4(0.5f));
    EXPECT_EQ(desc.targets.at(1).scale, 0.25f);
}

TEST(PipelineAsset, LikeCopiesWhatIsNotGiven) {
    const PipelineDesc desc = parse(document(
        R"(, "scale": 0.5 }, "a": { "like": "b", "format": "R8" }, "b": { "like": "out" }, "c": { "like": "b", "size": [2, 3])",
        ""));
    EXPECT_EQ(desc.findTarget("a")->format, Format::R8);
    EXPECT_EQ(desc.findTarget("a")->scale, 0.5f);
    EXPECT_EQ(desc.findTarget("b")->format, Format::RGBA8);
    EXPECT_EQ(desc.findTarget("c")->size, glm::uvec2(2, 3));
}

TEST(PipelineAsset, EveryKeyOfAStageArrives) {
    const PipelineDesc desc =
        parse(document(R"(, "mips": 2)",
                       R"(, "name": "N", "priority": 3, "effect": "e", "defines": { "A": 1 }, "material": { "m": 0.5 },
        "params": { "p": [1, 2] }, "reads": { "s": "out@1" }, "writes": ["out"],
        "queues": [ { "phase": "shadow-caster", "sort": "back-to-front" }, {} ])"));
    const StageDesc& stage = stageOf(desc, "N");
    EXPECT_EQ(stage.stageClass, "FullscreenStage");
    EXPECT_EQ(stage.priority, 3);
    EXPECT_EQ(stage.effect, "e");
    EXPECT_EQ(stage.defines.toJson(-1), "{\"A\":1}");
    EXPECT_EQ(stage.material.toJson(-1), "{\"m\":0.5}");
    EXPECT_EQ(stage.params.toJson(-1), "{\"p\":[1,2]}");
    EXPECT_EQ(stage.reads.at(0).shaderName, "s");
    EXPECT_EQ(stage.reads.at(0).target, "out@1");
    EXPECT_EQ(stage.writes, std::vector<std::string>{"out"});
    EXPECT_EQ(stage.queues.at(0).phases, std::vector<std::string>{"shadow-caster"});
    EXPECT_EQ(stage.queues.at(0).sort, QueueSort::BackToFront);
    EXPECT_EQ(stage.queues.at(1).phases, std::vector<std::string>{"default"});
    EXPECT_EQ(stage.queues.at(1).sort, QueueSort::FrontToBack);
}

TEST(PipelineExtends, KeepsWhatTheChildDoesNotChange) {
    const PipelineDesc desc = child(R"("name": "child")");
    EXPECT_EQ(desc.name, "child");
    EXPECT_EQ(desc.output, "out");
    EXPECT_EQ(stageOrder(desc), "First: A B\nLast: C D\n");
}

TEST(PipelineExtends, ParentTargetsComeFirst) {
    const PipelineDesc desc = child(R"("targets": { "new": { "format": "R8" } }, "output": "new")");
    EXPECT_EQ(desc.output, "new");
    EXPECT_EQ(desc.targets.at(0).name, "out");
    EXPECT_EQ(desc.targets.at(2).name, "new");
}

TEST(PipelineExtends, RedefinitionShowsTheFirstPlace) {
    const std::string message = messageOf([] { child(R"("targets": { "aux": { "format": "R8" } })"); });
    EXPECT_NE(message.find("target 'aux' is defined a second time"), std::string::npos) << message;
    EXPECT_NE(message.find("base.pipeline.json:4:46: note: first defined here"), std::string::npos) << message;
    EXPECT_NE(message.find("\"override\": true"), std::string::npos) << message;
}

TEST(PipelineExtends, OverrideChangesTheKeysItNames) {
    const PipelineDesc scaled = child(R"("targets": { "aux": { "override": true, "format": "R8" } })");
    EXPECT_EQ(scaled.findTarget("aux")->format, Format::R8);
    EXPECT_EQ(scaled.findTarget("aux")->scale, 0.5f);
    const PipelineDesc sized = child(R"("targets": { "aux": { "override": true, "size": [3, 4] } })");
    EXPECT_EQ(sized.findTarget("aux")->size, glm::uvec2(3, 4));
    EXPECT_EQ(sized.targets.size(), 2u);
}

TEST(PipelineExtends, FlowsOfAChildGoByPriority) {
    EXPECT_EQ(stageOrder(child(R"("flows": [ { "flow": "Mid", "priority": 3, "stages": [ { "stage": "M" } ] },
                                             { "flow": "End", "stages": [ { "stage": "E" } ] } ])")),
              "First: A B\nMid: M\nLast: C D\nEnd: E\n");
    const std::string message =
        messageOf([] { child(R"("flows": [ { "flow": "First", "stages": [ { "stage": "M" } ] } ])"); });
    EXPECT_NE(message.find("a second flow named 'First'"), std::string::npos) << message;
}

TEST(PipelineExtends, ByPathNextToTheDocument) {
    AssetFolder folder;
    folder.write("mine/base.pipeline.json", kBase);
    folder.write("mine/deep/a.pipeline.json", R"({ "extends": "../base.pipeline.json" })");
    folder.write("mine/b.pipeline.json", R"({ "extends": "deep/a.pipeline.json" })");
    const AssetRoots none({});
    const PipelineDesc desc = loadPipeline(
        none, {.nameOrPath = (folder.path() / "mine/b.pipeline.json").string(), .options = {}, .sets = {}});
    EXPECT_EQ(desc.name, "base");
    EXPECT_EQ(stageOrder(desc), "First: A B\nLast: C D\n");
}

TEST(PipelineExtends, StaysInsideTheRootsAndItsOwnFolder) {
    AssetFolder folder;
    folder.write("outside.pipeline.json", kBase);
    folder.write("mine/a.pipeline.json", R"({ "extends": "../outside.pipeline.json" })");
    const std::string path = (folder.path() / "mine/a.pipeline.json").string();
    const std::string message =
        messageOf([&] { loadPipeline(AssetRoots({}), {.nameOrPath = path, .options = {}, .sets = {}}); });
    EXPECT_NE(message.find("is outside of the asset roots"), std::string::npos) << message;
    std::filesystem::create_symlink(folder.path() / "outside.pipeline.json", folder.path() / "mine/link.json");
    folder.write("mine/a.pipeline.json", R"({ "extends": "link.json" })");
    EXPECT_THROW(loadPipeline(AssetRoots({}), {.nameOrPath = path, .options = {}, .sets = {}}), Error);
}

TEST(PipelineExtends, MissingParentsAndCircles) {
    AssetFolder folder;
    folder.pipeline("base", kBase);
    folder.pipeline("lost", R"({ "extends": "bsae" })");
    folder.pipeline("gone", R"({ "extends": "no.json" })");
    folder.pipeline("a", R"({ "extends": "b" })");
    folder.pipeline("b", R"({ "extends": "a" })");
    const std::string lost = messageOf([&] { load(folder, "lost"); });
    EXPECT_NE(lost.find("no pipeline named 'bsae' to extend"), std::string::npos) << lost;
    EXPECT_NE(lost.find("did you mean 'base'?"), std::string::npos) << lost;
    EXPECT_NE(messageOf([&] { load(folder, "gone"); }).find("to extend"), std::string::npos);
    const std::string circle = messageOf([&] { load(folder, "a"); });
    EXPECT_NE(circle.find("in a circle: "), std::string::npos) << circle;
    EXPECT_NE(circle.find("a.pipeline.json' → '"), std::string::npos) << circle;
    const std::string unknown = messageOf([&] { load(folder, "bas"); });
    EXPECT_NE(unknown.find("no pipeline named 'bas'"), std::string::npos) << unknown;
    EXPECT_NE(messageOf([&] { load(folder, "bas.json"); }).find("no pipeline file 'bas.json'"), std::string::npos);
}

TEST(PipelineFlowFile, BringsStagesTargetsAndOptions) {
    AssetFolder folder;
    folder.pipeline("base", kBase);
    folder.write("assets/pipelines/flows/ao/gtao.flow.json", R"({
        "priority": 3, "targets": { "ao": { "format": "R8" } }, "blocks": { "CCAo": { "binding": 20 } },
        "options": { "slices": { "type": "number", "default": 2, "min": 1, "max": 9 } },
        "stages": [ { "stage": "ComputeStage", "name": "AoMain", "defines": { "SLICES": "$slices" }, "writes": ["ao"] } ] })");
    folder.pipeline("child", R"({ "extends": "base",
        "options": { "ao": { "type": "choice", "default": "gtao", "choices": ["none", "gtao"] } },
        "flows": [ { "flow": "ao/gtao", "enabled": "$ao == gtao" } ] })");
    const PipelineDesc on = load(folder, "child", {.nameOrPath = "", .options = {{"slices", "4"}}, .sets = {}});
    EXPECT_EQ(stageOrder(on), "First: A B\nao/gtao: AoMain\nLast: C D\n");
    EXPECT_EQ(stageOf(on, "AoMain").defines.find("SLICES")->integer(), 4);
    EXPECT_NE(on.findTarget("ao"), nullptr);
    EXPECT_EQ(on.blocks.at(0).binding, 20u);
    const PipelineDesc off = load(folder, "child", {.nameOrPath = "", .options = {{"ao", "none"}}, .sets = {}});
    EXPECT_EQ(stageOrder(off), "First: A B\nao/gtao: -AoMain\nLast: C D\n");
}

/// Two techniques, chosen by an option of the parent.
void writeTechniques(const AssetFolder& folder) {
    folder.write("assets/pipelines/flows/ao/off.flow.json", R"({ "stages": [] })");
    for (const std::string name : {"gtao", "vbao"})
        folder.write("assets/pipelines/flows/ao/" + name + ".flow.json",
                     R"({ "options": { "power": { "type": "number", "default": )" +
                         std::string(name == "gtao" ? "1" : "2") + R"( } },
        "stages": [ { "stage": "ComputeStage", "name": "AoMain", "effect": ")" +
                         name + R"(",
                      "material": { "power": "$power" } } ] })");
    folder.pipeline("parent", R"({ "output": "out", "targets": { "out": { "format": "RGBA8" } },
        "options": { "ao": { "type": "choice", "default": "gtao", "choices": ["off", "gtao", "vbao", "hbao"] } },
        "flows": [ { "flow": "ao/$ao" }, { "flow": "Last", "stages": [ { "stage": "A" } ] } ] })");
}

TEST(PipelineFlowFile, OptionChoosesIt) {
    AssetFolder folder;
    writeTechniques(folder);
    const auto order = [&](std::map<std::string, std::string> options) {
        return stageOrder(load(folder, "parent", {.nameOrPath = "", .options = std::move(options), .sets = {}}));
    };
    EXPECT_EQ(order({}), "ao/gtao: AoMain\nLast: A\n");
    EXPECT_EQ(order({{"ao", "vbao"}}), "ao/vbao: AoMain\nLast: A\n");
    EXPECT_EQ(order({{"ao", "off"}}), "Last: A\n") << "a file without stages is no flow";
    const PipelineDesc vbao =
        load(folder, "parent", {.nameOrPath = "", .options = {{"ao", "vbao"}, {"power", "3"}}, .sets = {}});
    EXPECT_EQ(stageOf(vbao, "AoMain").material.find("power")->number(), 3) << "the file's own option";
}

TEST(PipelineFlowFile, ChildChangesTheChoiceOfItsParent) {
    AssetFolder folder;
    writeTechniques(folder);
    folder.pipeline("child",
                    R"({ "extends": "parent", "options": { "ao": { "override": true, "default": "vbao" } } })");
    const PipelineDesc desc = load(folder, "child");
    EXPECT_EQ(stageOrder(desc), "ao/vbao: AoMain\nLast: A\n");
    EXPECT_EQ(stageOf(desc, "AoMain").material.find("power")->number(), 2);
    folder.pipeline("user", R"({ "extends": "parent", "flows": [ { "flow": "more/$ao" } ] })");
    folder.write("assets/pipelines/flows/more/gtao.flow.json", R"({ "stages": [ { "stage": "B" } ] })");
    EXPECT_EQ(stageOrder(load(folder, "user")), "ao/gtao: AoMain\nLast: A\nmore/gtao: B\n")
        << "an option of the parent";
}

TEST(PipelineFlowFile, ChildAddsAChoiceWithAFileBesideIt) {
    AssetFolder folder;
    writeTechniques(folder);
    folder.write("mine/own.pipeline.json", R"({ "extends": "parent",
        "options": { "ao": { "override": true, "default": "mine", "choices": ["gtao", "mine"] } } })");
    folder.write("mine/flows/ao/mine.flow.json", R"({ "stages": [ { "stage": "B" } ] })");
    const std::string path = (folder.path() / "mine/own.pipeline.json").string();
    EXPECT_EQ(stageOrder(load(folder, path)), "ao/mine: B\nLast: A\n");
    EXPECT_EQ(stageOrder(load(folder, path, {.nameOrPath = "", .options = {{"ao", "gtao"}}, .sets = {}})),
              "ao/gtao: AoMain\nLast: A\n");
}

TEST(PipelineFlowFile, MistakesInTheOptionThatChoosesIt) {
    AssetFolder folder;
    writeTechniques(folder);
    const auto message = [&](const std::string& name, std::map<std::string, std::string> options) {
        return messageOf([&] { load(folder, name, {.nameOrPath = "", .options = options, .sets = {}}); });
    };
    const std::string lost = message("parent", {{"ao", "hbao"}});
    EXPECT_NE(lost.find("no flow file named 'ao/hbao', which 'ao/$ao' stands for"), std::string::npos) << lost;
    EXPECT_NE(lost.find("ao/gtao, ao/off, ao/vbao"), std::string::npos) << lost;
    const std::string wrong = message("parent", {{"ao", "gtoa"}});
    EXPECT_NE(wrong.find("option 'ao' has no choice 'gtoa'"), std::string::npos) << wrong;
    EXPECT_EQ(wrong.find("flow file"), std::string::npos) << "one mistake, one message: " << wrong;
    folder.pipeline("unknown", R"({ "extends": "parent", "flows": [ { "flow": "more/$oa" } ] })");
    const std::string unknown = message("unknown", {});
    EXPECT_NE(unknown.find("'$oa' in the name of a flow names no option"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("did you mean 'ao'?"), std::string::npos) << unknown;
    EXPECT_NE(message("parent", {{"ao", "../gtao"}}).find("has no choice"), std::string::npos);
}

TEST(PipelineFlowFile, MistakesInIt) {
    AssetFolder folder;
    folder.pipeline("lost",
                    R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "flows": [ { "flow": "ao/gtoa" } ] })");
    folder.write("assets/pipelines/flows/ao/gtao.flow.json", R"({ "stagse": [] })");
    folder.pipeline("bad",
                    R"({ "output": "o", "targets": { "o": { "format": "R8" } }, "flows": [ { "flow": "ao/gtao" } ] })");
    const std::string lost = messageOf([&] { load(folder, "lost"); });
    EXPECT_NE(lost.find("no flow file named 'ao/gtoa'"), std::string::npos) << lost;
    EXPECT_NE(lost.find("did you mean 'ao/gtao'?"), std::string::npos) << lost;
    const std::string bad = messageOf([&] { load(folder, "bad"); });
    EXPECT_NE(bad.find("gtao.flow.json:1:3: error: unknown key 'stagse' in flow file 'ao/gtao'"), std::string::npos)
        << bad;
    EXPECT_NE(bad.find("did you mean 'stages'?"), std::string::npos) << bad;
    EXPECT_EQ(bad.find("missing key"), std::string::npos) << "one mistake, one message: " << bad;
}

TEST(PipelineEdits, InsertBeforeAndAfter) {
    EXPECT_EQ(
        stageOrder(child(
            R"("edits": [ { "insert": { "stage": "X" }, "before": "C" }, { "insert": { "stage": "Y" }, "after": "X" },
                                             { "insert": { "stage": "Z" }, "after": "B" } ])")),
        "First: A B Z\nLast: X Y C D\n");
}

TEST(PipelineEdits, InsertByPriority) {
    const PriorityLookup lookup = [](const std::string& name) -> std::optional<int> {
        if (name == "A") return 10;
        if (name == "C") return 15;
        if (name == "D") return 19;
        return name == "X" ? std::optional(15) : std::nullopt;
    };
    const auto order = [&](const std::string& edit) {
        return stageOrder(child(R"("edits": [ )" + edit + " ]",
                                {.nameOrPath = "", .options = {}, .sets = {}, .defaultPriority = lookup}));
    };
    EXPECT_EQ(order(R"({ "insert": { "stage": "X" } })"), "First: A B\nLast: C X D\n") << "behind its equals";
    EXPECT_EQ(order(R"({ "insert": { "stage": "Q" }, "priority": 12 })"), "First: A B\nLast: Q C D\n");
    EXPECT_EQ(order(R"({ "insert": { "stage": "Q", "priority": 5 } })"), "First: Q A B\nLast: C D\n");
    EXPECT_EQ(order(R"({ "insert": { "stage": "Q" }, "priority": 99 })"), "First: A B\nLast: C D Q\n");
    EXPECT_EQ(
        order(R"({ "insert": { "stage": "Q" }, "priority": 16 }, { "insert": { "stage": "R" }, "priority": 17 })"),
        "First: A B\nLast: C Q R D\n");
}

TEST(PipelineEdits, SetMergesMapsAndReplacesTheRest) {
    const StageDesc b = stageOf(
        child(R"("edits": [ { "set": "B", "effect": "c", "material": { "y": 3, "z": 4 }, "enabled": false } ])"), "B");
    EXPECT_EQ(b.effect, "c");
    EXPECT_FALSE(b.enabled);
    EXPECT_EQ(b.material.toJson(-1), R"({"x":1,"y":3,"z":4})");
    const StageDesc without =
        stageOf(child(R"("edits": [ { "set": "B", "effect": null, "material": { "y": null } } ])"), "B");
    EXPECT_EQ(without.effect, "");
    EXPECT_EQ(without.material.toJson(-1), R"({"x":1})");
}

TEST(PipelineEdits, ReplaceAndRemove) {
    EXPECT_EQ(stageOrder(child(R"("edits": [ { "replace": "B", "with": { "stage": "X" } }, { "remove": "A" } ])")),
              "First: X\nLast: C D\n");
    EXPECT_EQ(stageOrder(child(R"("edits": [ { "remove": "A" }, { "remove": "B" } ])")), "Last: C D\n");
    EXPECT_EQ(stageOrder(child(R"("edits": [ { "remove": "First" } ])")), "Last: C D\n");
}

TEST(PipelineEdits, FlowsCanBeInsertedAndSet) {
    EXPECT_EQ(
        stageOrder(child(R"("edits": [ { "insert": { "flow": "M", "stages": [ { "stage": "X" } ] }, "before": "Last" },
                                             { "set": "First", "enabled": false } ])")),
        "First: -A -B\nM: X\nLast: C D\n");
}

}  // namespace
}  // namespace crevice
