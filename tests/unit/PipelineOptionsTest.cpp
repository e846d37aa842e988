// Options, sets and flattening of pipeline documents, and their precedence.
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

TEST(PipelineOptions, ConditionsSwitchStages) {
    const auto enabled = [](const std::string& condition, std::map<std::string, std::string> options) {
        const PipelineDesc desc = parse(document("", R"(, "enabled": ")" + condition + '"'),
                                        {.nameOrPath = "", .options = std::move(options), .sets = {}});
        return stageOf(desc, "FullscreenStage").enabled;
    };
    EXPECT_TRUE(enabled("$on", {}));
    EXPECT_FALSE(enabled("$on", {{"on", "false"}}));
    EXPECT_FALSE(enabled("!$on", {}));
    EXPECT_TRUE(enabled("!$on", {{"on", "false"}}));
    EXPECT_TRUE(enabled("$mode == slow", {}));
    EXPECT_FALSE(enabled("$mode == slow", {{"mode", "fast"}}));
    EXPECT_TRUE(enabled("$mode != slow", {{"mode", "fast"}}));
    EXPECT_TRUE(enabled("$mode==slow", {}));
    EXPECT_TRUE(enabled("$on == true", {}));
    EXPECT_TRUE(enabled("$on != false", {}));
    EXPECT_TRUE(enabled("$level == 0.5", {}));
    EXPECT_FALSE(enabled("$level != 0.5", {}));
}

TEST(PipelineOptions, StandForScalarsAnywhere) {
    const PipelineDesc desc = parse(
        document(R"(, "scale": "$level")", R"(, "effect": "$mode", "params": { "list": ["$level", 1], "on": "$on" })"),
        {.nameOrPath = "", .options = {{"level", "0.25"}}, .sets = {}});
    EXPECT_EQ(desc.targets.at(0).scale, 0.25f);
    const StageDesc& stage = stageOf(desc, "FullscreenStage");
    EXPECT_EQ(stage.effect, "slow");
    EXPECT_EQ(stage.params.toJson(-1), R"({"list":[0.25,1],"on":true})");
    EXPECT_EQ(stage.params.find("on")->where().line, 5) << "the place of use";
    EXPECT_EQ(desc.options.at(1).value.number(), 0.25);
    EXPECT_EQ(desc.options.at(1).defaultValue.number(), 0.5);
}

TEST(PipelineOptions, NumbersMayBeAutoWhereTheDefaultIs) {
    const auto valueOf = [](const std::string& defaultText, std::map<std::string, std::string> options) {
        const std::string declared =
            R"("options": { "length": { "type": "number", "min": 1, "default": )" + defaultText + " } }";
        return child(declared, {.nameOrPath = "", .options = std::move(options), .sets = {}}).options.back().value;
    };
    EXPECT_EQ(valueOf("\"auto\"", {}).string(), "auto");
    EXPECT_EQ(valueOf("\"auto\"", {{"length", "2.5"}}).number(), 2.5);
    EXPECT_EQ(valueOf("\"auto\"", {{"length", "auto"}}).string(), "auto");
    EXPECT_THROW(valueOf("\"auto\"", {{"length", "0.5"}}), Error);
    EXPECT_THROW(valueOf("2", {{"length", "auto"}}), Error);
    EXPECT_THROW(valueOf("\"automatic\"", {}), Error);
}

TEST(PipelineOptions, ChoicesSetAndPrecedenceIsDocumentOptionSet) {
    const std::string keys = R"("options": { "quality": { "type": "choice", "default": "high", "choices": {
        "high": {}, "fast": { "set": { "B.material.x": 10, "aux.scale": 0.25, "B.effect": "q" } } } } })";
    const PipelineDesc document = child(keys);
    EXPECT_EQ(stageOf(document, "B").material.find("x")->integer(), 1);
    const PipelineDesc option = child(keys, {.nameOrPath = "", .options = {{"quality", "fast"}}, .sets = {}});
    EXPECT_EQ(stageOf(option, "B").material.toJson(-1), R"({"x":10,"y":2})");
    EXPECT_EQ(option.findTarget("aux")->scale, 0.25f);
    EXPECT_EQ(stageOf(option, "B").effect, "q");
    const PipelineDesc set = child(
        keys,
        {.nameOrPath = "", .options = {{"quality", "fast"}}, .sets = {{"B.material.x", "20"}, {"aux.size", "[2, 2]"}}});
    EXPECT_EQ(stageOf(set, "B").material.find("x")->integer(), 20);
    EXPECT_EQ(set.findTarget("aux")->size, glm::uvec2(2, 2));
}

TEST(PipelineOptions, SetsOfFlowFilesApplyBeforeThoseOfDocuments) {
    const auto option = [](const std::string& name, const std::string& scale) {
        return "\"" + name +
               R"(": { "type": "choice", "default": "auto", "choices": { "auto": {}, "on": { "set": { "aux.scale": )" +
               scale + " } } } }";
    };
    AssetFolder folder;
    std::string base = kBase;
    base.replace(base.find("\"options\": {"), 12, "\"options\": { " + option("older", "0.75") + ",");
    folder.pipeline("base", base);
    folder.write("assets/pipelines/flows/preset.flow.json",
                 "{ \"options\": { " + option("preset", "0.25") + R"( }, "stages": [ { "stage": "P" } ] })");
    folder.pipeline("child", R"({ "extends": "base", "options": { )" + option("own", "1.5") +
                                 R"( }, "flows": [ { "flow": "preset" } ] })");
    const auto scale = [&](std::map<std::string, std::string> options) {
        const PipelineRequest request{.nameOrPath = "child", .options = std::move(options), .sets = {}};
        const float loaded = loadPipeline(folder.roots(), request).findTarget("aux")->scale;
        const std::string flat = flattenText(flattenPipeline(folder.roots(), request));
        EXPECT_EQ(parse(flat).findTarget("aux")->scale, loaded) << flat;
        return loaded;
    };
    EXPECT_EQ(scale({{"preset", "on"}}), 0.25f);
    EXPECT_EQ(scale({{"preset", "on"}, {"own", "on"}}), 1.5f) << "the document that names the flow";
    EXPECT_EQ(scale({{"preset", "on"}, {"older", "on"}}), 0.75f) << "its parent";
    EXPECT_EQ(scale({{"preset", "on"}, {"older", "on"}, {"own", "on"}}), 1.5f) << "documents in order";
}

TEST(PipelineOptions, SetsOnRemovedStagesAreDropped) {
    const PipelineDesc desc = child(
        R"("options": { "q": { "type": "bool", "default": true, "choices": { "true": { "set": { "B.effect": "z" } } } } },
                                       "edits": [ { "remove": "B" } ])");
    EXPECT_EQ(stageOrder(desc), "First: A\nLast: C D\n");
}

TEST(PipelineSets, ReachEveryKindOfValue) {
    const auto with = [](const char* path, const char* value) {
        return child(R"("name": "c")", {.nameOrPath = "", .options = {}, .sets = {{path, value}}});
    };
    EXPECT_EQ(stageOf(with("A.params.seed", "3"), "A").params.toJson(-1), R"({"seed":3})");
    EXPECT_EQ(stageOf(with("A.seed", "3"), "A").params.toJson(-1), R"({"seed":3})");
    EXPECT_EQ(stageOf(with("A.material.c", "[1, 0.5]"), "A").material.toJson(-1), R"({"c":[1,0.5]})");
    EXPECT_EQ(stageOf(with("A.material.radius", "auto"), "A").material.toJson(-1), R"({"radius":"auto"})");
    EXPECT_EQ(stageOf(with("A.material.name", "\"3\""), "A").material.toJson(-1), R"({"name":"3"})");
    EXPECT_FALSE(stageOf(with("A.enabled", "false"), "A").enabled);
    EXPECT_FALSE(stageOf(with("A.enabled", "$fast"), "A").enabled);
    EXPECT_EQ(stageOf(with("A.writes", "[\"aux\"]"), "A").writes, std::vector<std::string>{"aux"});
    EXPECT_FALSE(stageOf(with("Last.enabled", "false"), "D").enabled);
    EXPECT_EQ(with("aux.format", "R32F").findTarget("aux")->format, Format::R32F);
}

TEST(PipelineFlatten, KeepsOptionsAndMarksOrigins) {
    AssetFolder folder;
    folder.pipeline("base", kBase);
    folder.pipeline(
        "child",
        "{ \"extends\": \"base\",\n\"edits\": [ { \"set\": \"B\", \"effect\": \"new\",\n\"enabled\": \"$fast\" } ] }");
    const PipelineRequest request{.nameOrPath = "child", .options = {{"fast", "true"}}, .sets = {{"A.seed", "3"}}};
    const Value flat = flattenPipeline(folder.roots(), request);
    const std::string text = flattenText(flat);
    EXPECT_NE(text.find("\"enabled\": \"$fast\""), std::string::npos) << text;
    EXPECT_NE(text.find("child.pipeline.json:2\n"), std::string::npos) << text;
    EXPECT_NE(text.find("child.pipeline.json:3\n"), std::string::npos) << text;
    EXPECT_NE(text.find("// --set A.seed=3\n"), std::string::npos) << text;
    EXPECT_EQ(flat.find("options")->find("fast")->find("default")->boolean(), true);
    EXPECT_EQ(parseJson(text, "flat").toJson(), flat.toJson());
    const PipelineDesc again = parse(text);
    EXPECT_TRUE(stageOf(again, "B").enabled);
    EXPECT_EQ(stageOf(again, "A").params.toJson(-1), R"({"seed":3})");
}

TEST(PipelineFlatten, ResolvesOptions) {
    const Value flat = flattenParsed(document(R"(, "scale": "$level")", R"(, "enabled": "$mode == fast")"), "t.json",
                                     AssetRoots({}), {}, FlattenOptions::Resolve);
    EXPECT_EQ(flat.find("options"), nullptr);
    EXPECT_EQ(flat.find("targets")->find("out")->find("scale")->number(), 0.5);
    EXPECT_EQ(flat.find("flows")->items()[0].find("stages")->items()[0].find("enabled")->boolean(), false);
}

TEST(PipelineFlatten, AKeptSetWinsOverAChoice) {
    const std::string text = document("", R"(, "name": "A")", R"(, "blocks": {})");
    std::string withSets = text;
    withSets.replace(withSets.find(R"(["slow", "fast"])"), 16,
                     R"({ "slow": {}, "fast": { "set": { "A.params.n": 1 } } })");
    const Value flat =
        flattenParsed(withSets, "t.json", AssetRoots({}), {.nameOrPath = "", .options = {}, .sets = {{"A.n", "2"}}});
    const PipelineDesc desc = parse(flattenText(flat), {.nameOrPath = "", .options = {{"mode", "fast"}}, .sets = {}});
    EXPECT_EQ(stageOf(desc, "A").params.toJson(-1), R"({"n":2})");
}

TEST(PipelineFlatten, ALineBreakInAnArgumentStaysInTheComment) {
    const Value flat = flattenParsed(document("", R"(, "name": "A")"), "t.json", AssetRoots({}),
                                     {.nameOrPath = "", .options = {}, .sets = {{"A.effect", "x\ny"}}});
    EXPECT_EQ(parseJson(flattenText(flat), "flat").toJson(), flat.toJson());
}

}  // namespace
}  // namespace crevice
