// The schema and the tables of the docs come from the key tables that reading uses.
#include "PipelineTestTools.h"
#include "core/Params.h"
#include "plan/PipelineAssetKeys.h"
#include "plan/Schema.h"

namespace crevice {
namespace {

Value sample() {
    ParamTable table;
    std::uint32_t seed = 1;
    table.field("seed", seed, {.help = "Kernel seed."});
    return pipelineSchema({{"SsaoStage", "Occlusion.", table.schema()}});
}

const Value& at(const Value& value, std::initializer_list<const char*> path) {
    const Value* current = &value;
    for (const char* key : path) {
        current = current->find(key);
        if (!current) throw Error(std::string("no ") + key);
    }
    return *current;
}

TEST(PipelineSchema, HasEveryKeyOfEveryTable) {
    const Value schema = sample();
    for (const std::string& key : pipelineKeys().names())
        EXPECT_NO_THROW(at(schema, {"properties", key.c_str()})) << key;
    for (const std::string& key : targetKeys().names())
        EXPECT_NO_THROW(at(schema, {"$defs", "target", "properties", key.c_str()})) << key;
    for (const std::string& key : stageKeys().names())
        EXPECT_NO_THROW(at(schema, {"$defs", "stage", "properties", key.c_str()})) << key;
    EXPECT_FALSE(at(schema, {"$defs", "target", "additionalProperties"}).boolean());
    EXPECT_EQ(at(schema, {"$defs", "target", "properties", "scale", "anyOf"}).items()[0].toJson(-1),
              R"({"type":"number","exclusiveMinimum":0,"maximum":4})");
    const Value& formats = at(at(schema, {"$defs", "target", "properties", "format", "anyOf"}).items()[0], {"enum"});
    EXPECT_EQ(formats.items().size(), allFormats().size());
}

TEST(PipelineSchema, HasTheParametersOfStages) {
    const Value schema = sample();
    const Value& seed = at(schema, {"$defs", "SsaoStage", "properties", "params", "properties", "seed"});
    EXPECT_EQ(at(seed, {"description"}).string(), "Kernel seed.");
    EXPECT_EQ(at(seed, {"anyOf"}).items().size(), 2u);
    EXPECT_EQ(at(schema, {"$defs", "stage", "allOf"}).items().size(), 1u);
}

/// Every reference leads somewhere.
void checkReferences(const Value& value, const Value& definitions) {
    if (value.isArray())
        for (const Value& item : value.items()) checkReferences(item, definitions);
    if (!value.isObject()) return;
    for (const Member& member : value.members()) {
        if (member.key == "$ref") {
            EXPECT_NE(definitions.find(member.value.string().substr(std::string("#/$defs/").size())), nullptr)
                << member.value.string();
        }
        checkReferences(member.value, definitions);
    }
}

TEST(PipelineSchema, ReferencesAreDefined) {
    const Value schema = sample();
    checkReferences(schema, at(schema, {"$defs"}));
    EXPECT_EQ(parseJson(schema.toJson(), "schema").toJson(), schema.toJson());
}

TEST(PipelineSchema, TheDocsShowTheTables) {
    const AssetRoots roots = AssetRoots::standard();
    for (const auto& root : roots.roots()) {
        const auto path = root / "docs/pipeline-format.md";
        if (!std::filesystem::exists(path)) continue;
        EXPECT_NE(readText(path).find(pipelineKeysMarkdown()), std::string::npos)
            << "docs/pipeline-format.md is stale; its tables should be:\n"
            << pipelineKeysMarkdown();
        return;
    }
    FAIL() << "docs/pipeline-format.md not found";
}

}  // namespace
}  // namespace crevice
