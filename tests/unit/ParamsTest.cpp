// One field list, many uses: reading with messages, rows for documentation, JSON Schema.
#include "core/Params.h"

#include <gtest/gtest.h>

namespace crevice {
namespace {

constexpr const char* kQualities[] = {"fast", "medium", "high"};

struct Settings {
    bool enabled = true;
    std::int32_t offset = -1;
    std::uint32_t samples = 16;
    float radius = 0.1f;
    glm::vec3 tint{1, 0.5f, 0};
    std::string name = "ao";
    int quality = 1;

    void params(ParamVisitor& visitor) {
        visitor.field("enabled", enabled, {.help = "On or off."});
        visitor.field("offset", offset, {.min = -8, .max = 8});
        visitor.field("samples", samples, {.min = 1, .max = 64, .help = "Rays per pixel."});
        visitor.field("radius", radius, {.min = 0, .unit = "metres", .help = "Reach."});
        visitor.field("tint", tint, {.min = 0, .max = 1});
        visitor.field("name", name, {});
        visitor.choice("quality", quality, kQualities, {});
    }
};

struct Outcome {
    Settings settings;
    std::vector<Problem> problems;
};

Outcome read(const std::string& json) {
    const Value object = parseJson(json, "p.json");
    Outcome outcome;
    Problems problems;
    ParamReader reader(object, "params of stage 'SsaoStage'", problems);
    outcome.settings.params(reader);
    reader.finish();
    outcome.problems = problems.all();
    return outcome;
}

Problem onlyProblem(const std::string& json) {
    const Outcome outcome = read(json);
    EXPECT_EQ(outcome.problems.size(), 1u) << json;
    return outcome.problems.empty() ? Problem{} : outcome.problems.front();
}

TEST(ParamReader, ReadsEveryType) {
    const Outcome outcome = read(R"({"enabled": false, "offset": -8, "samples": 64, "radius": 2, "tint": [0, 0.25, 1],
                                     "name": "x", "quality": "high"})");
    EXPECT_TRUE(outcome.problems.empty());
    EXPECT_FALSE(outcome.settings.enabled);
    EXPECT_EQ(outcome.settings.offset, -8);
    EXPECT_EQ(outcome.settings.samples, 64u);
    EXPECT_EQ(outcome.settings.radius, 2.0f);
    EXPECT_EQ(outcome.settings.tint, glm::vec3(0, 0.25f, 1));
    EXPECT_EQ(outcome.settings.name, "x");
    EXPECT_EQ(outcome.settings.quality, 2);
}

TEST(ParamReader, MissingFieldsKeepTheirDefaults) {
    const Outcome outcome = read("{}");
    EXPECT_TRUE(outcome.problems.empty());
    EXPECT_EQ(outcome.settings.samples, 16u);
    EXPECT_EQ(outcome.settings.quality, 1);
}

TEST(ParamReader, AbsentObjectReadsAsEmpty) {
    const Value none;
    Problems problems;
    Settings settings;
    ParamReader reader(none, "params", problems);
    settings.params(reader);
    reader.finish();
    EXPECT_TRUE(problems.all().empty());
}

struct MistakeCase {
    const char* json;
    const char* message;
    const char* help;
};

class ParamMistake : public testing::TestWithParam<MistakeCase> {};

TEST_P(ParamMistake, HasItsOwnMessage) {
    const Problem problem = onlyProblem(GetParam().json);
    EXPECT_EQ(problem.message, GetParam().message);
    EXPECT_EQ(problem.help, GetParam().help);
}

INSTANTIATE_TEST_SUITE_P(
    All, ParamMistake,
    testing::Values(
        MistakeCase{R"({"radius": "1"})", "'radius' in params of stage 'SsaoStage' must be a number, found a string",
                    "write a number without quotes, such as \"radius\": 0.1"},
        MistakeCase{R"({"samples": 99})", "'samples' in params of stage 'SsaoStage' is 99, outside 1 … 64",
                    "write a number from 1 to 64"},
        MistakeCase{R"({"samples": -3})", "'samples' in params of stage 'SsaoStage' is -3, outside 1 … 64",
                    "write a number from 1 to 64"},
        MistakeCase{R"({"samples": 2.5})", "'samples' in params of stage 'SsaoStage' must be a whole number, found 2.5",
                    "write it without fraction or exponent, such as \"samples\": 16"},
        MistakeCase{R"({"samples": true})",
                    "'samples' in params of stage 'SsaoStage' must be a whole number, found a bool",
                    "write a number without quotes, such as \"samples\": 16"},
        MistakeCase{R"({"radius": -0.5})", "'radius' in params of stage 'SsaoStage' is -0.5, outside ≥ 0",
                    "write a number of at least 0, in metres"},
        MistakeCase{R"({"enabled": 1})", "'enabled' in params of stage 'SsaoStage' must be true or false, found 1",
                    "write \"enabled\": true or \"enabled\": false"},
        MistakeCase{R"({"name": 7})", "'name' in params of stage 'SsaoStage' must be a string, found 7",
                    "write it in double quotes: \"name\": \"ao\""},
        MistakeCase{R"({"tint": [1, 2]})",
                    "'tint' in params of stage 'SsaoStage' must be a list of 3 numbers, found a list of 2",
                    "write a list of 3 numbers, such as \"tint\": [1, 0.5, 0]"},
        MistakeCase{R"({"tint": 1})", "'tint' in params of stage 'SsaoStage' must be a list of 3 numbers, found 1",
                    "write a list of 3 numbers, such as \"tint\": [1, 0.5, 0]"},
        MistakeCase{R"({"tint": [1, "x", 0]})",
                    "item 2 of 'tint' in params of stage 'SsaoStage' must be a number, found a string",
                    "write a list of 3 numbers, such as \"tint\": [1, 0.5, 0]"},
        MistakeCase{R"({"tint": [1, 0, 1.5]})", "item 3 of 'tint' in params of stage 'SsaoStage' is 1.5, outside 0 … 1",
                    "write a number from 0 to 1"},
        MistakeCase{R"({"quality": "hihg"})", "'quality' in params of stage 'SsaoStage' has no choice 'hihg'",
                    "did you mean 'high'? choices: fast, medium, high"},
        MistakeCase{R"({"quality": 2})",
                    "'quality' in params of stage 'SsaoStage' must name one of its choices, found 2",
                    "write one of these strings: fast, medium, high"},
        MistakeCase{R"({"radis": 2})", "unknown key 'radis' in params of stage 'SsaoStage'",
                    "did you mean 'radius'? keys: enabled, offset, samples, radius, tint, name, quality"},
        MistakeCase{"[]", "params of stage 'SsaoStage' must be an object, found a list of 0",
                    "write { \"key\": value, … }"}));

TEST(ParamReader, MistakesKeepTheDefaultAndHaveAPlace) {
    const Outcome outcome = read("{\n  \"samples\": 99,\n  \"bogus\": 1\n}");
    EXPECT_EQ(outcome.settings.samples, 16u);
    ASSERT_EQ(outcome.problems.size(), 2u);
    EXPECT_EQ(outcome.problems[0].where.line, 2);
    EXPECT_EQ(outcome.problems[0].where.column, 14);
    EXPECT_EQ(outcome.problems[1].where.line, 3);
    EXPECT_EQ(outcome.problems[1].where.column, 3);
}

TEST(ParamReader, NumbersMustFitTheirType) {
    const Value object = parseJson(R"({"a": 3000000000, "b": 1e39, "c": -1, "d": 4294967295})", "p.json");
    Problems problems;
    ParamReader reader(object, "x", problems);
    std::int32_t a = 0;
    float b = 0;
    std::uint32_t c = 0;
    std::uint32_t d = 0;
    reader.field("a", a, {});
    reader.field("b", b, {});
    reader.field("c", c, {});
    reader.field("d", d, {});
    ASSERT_EQ(problems.all().size(), 3u);
    EXPECT_EQ(problems.all()[0].message, "'a' in x is 3000000000, outside ≤ 2147483647");
    EXPECT_EQ(problems.all()[1].message, "'b' in x is 1e+39, outside ≤ 3.4028234663852886e+38");
    EXPECT_EQ(problems.all()[2].message, "'c' in x is -1, outside ≥ 0");
    EXPECT_EQ(d, 4294967295u);
}

TEST(ParamReader, TakenKeysAreKnown) {
    const Value object = parseJson(R"({"own": [1]})", "p.json");
    Problems problems;
    ParamReader reader(object, "x", problems);
    ASSERT_NE(reader.take("own"), nullptr);
    EXPECT_EQ(reader.take("other"), nullptr);
    reader.finish();
    EXPECT_FALSE(problems.hasErrors());
}

TEST(ParamTable, RowsShowTypeDefaultRangeUnitAndHelp) {
    Settings settings;
    ParamTable table;
    settings.params(table);
    ASSERT_EQ(table.rows().size(), 7u);
    const ParamRow& samples = table.rows()[2];
    EXPECT_EQ(samples.key, "samples");
    EXPECT_EQ(samples.type, "uint");
    EXPECT_EQ(samples.defaultValue, "16");
    EXPECT_EQ(samples.range, "1 … 64");
    EXPECT_EQ(samples.help, "Rays per pixel.");
    const ParamRow& radius = table.rows()[3];
    EXPECT_EQ(radius.defaultValue, "0.1");
    EXPECT_EQ(radius.range, "≥ 0");
    EXPECT_EQ(radius.unit, "metres");
    EXPECT_EQ(table.rows()[0].range, "");
    EXPECT_EQ(table.rows()[4].defaultValue, "[1, 0.5, 0]");
    EXPECT_EQ(table.rows()[6].type, "fast | medium | high");
    EXPECT_EQ(table.rows()[6].defaultValue, "\"medium\"");
}

TEST(ParamTable, SchemaNamesEveryField) {
    Settings settings;
    ParamTable table;
    settings.params(table);
    const Value schema = table.schema();
    EXPECT_FALSE(schema.find("additionalProperties")->boolean());
    const Value& properties = *schema.find("properties");
    EXPECT_EQ(properties.find("samples")->toJson(-1),
              R"({"type":"integer","minimum":1,"maximum":64,"default":16,"description":"Rays per pixel."})");
    EXPECT_EQ(properties.find("radius")->toJson(-1),
              R"({"type":"number","minimum":0,"default":0.1,"description":"Reach. In metres."})");
    EXPECT_EQ(properties.find("quality")->toJson(-1), R"({"enum":["fast","medium","high"],"default":"medium"})");
    EXPECT_EQ(properties.find("tint")->toJson(-1),
              R"({"type":"array","items":{"type":"number","minimum":0,"maximum":1},"minItems":3,"maxItems":3,)"
              R"("default":[1,0.5,0]})");
    EXPECT_EQ(properties.members().size(), 7u);
}

}  // namespace
}  // namespace crevice
