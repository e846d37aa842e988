// YAML documents: types of scalars, anchors and merge keys, places, limits and messages.
#include "DocumentTools.h"

namespace crevice {
namespace {

using test::expectExplained;
using test::expectPlace;
using test::onlyProblem;
using test::SyntaxCase;

std::string compact(const std::string& text) { return parseYaml(text, "doc.yaml").toJson(-1); }

Problem problemOf(const std::string& text, const DocumentLimits& limits = {}) {
    return onlyProblem(text, [&](const std::string& t) { return parseYaml(t, "doc.yaml", 1, limits); });
}

TEST(Yaml, ScalarsFollowYaml12) {
    EXPECT_EQ(compact("[0x1f, 0o17, 010, -3, +4, 1.5, .5, 1., 1e3, -1.5e-3]"),
              "[31,15,10,-3,4,1.5,0.5,1.0,1000.0,-0.0015]");
    EXPECT_EQ(compact("[true, false, null, ~, ]"), "[true,false,null,null]");
    EXPECT_EQ(compact("[yes, no, on, off, 1_000, 0x, 1e, '-', 1.2.3, 0b1]"),
              R"(["yes","no","on","off","1_000","0x","1e","-","1.2.3","0b1"])");
}

TEST(Yaml, QuotedScalarsAreStrings) {
    EXPECT_EQ(compact("['7', \"0x1f\", 'true', \"null\", '', '~', !!str 7]"),
              R"(["7","0x1f","true","null","","~","7"])");
}

TEST(Yaml, IntegersBeyond64BitsAreReals) {
    const Value list = parseYaml("[9223372036854775807, 9223372036854775808]", "f");
    EXPECT_TRUE(list.items()[0].isInteger());
    EXPECT_FALSE(list.items()[1].isInteger());
}

TEST(Yaml, BlocksAndFlowsMayMix) {
    EXPECT_EQ(compact("a:\n- b: {c: [1, 2]}\n  d: x y\n- |\n  text\n   more\n- >\n  fold\n  ed\n"),
              R"({"a":[{"b":{"c":[1,2]},"d":"x y"},"text\n more\n","fold ed\n"]})");
}

TEST(Yaml, AliasesCopyAndTheLastAnchorOfANameWins) {
    EXPECT_EQ(compact("a: &x 1\nb: *x\nc: &x {d: 2}\ne: *x"), R"({"a":1,"b":1,"c":{"d":2},"e":{"d":2}})");
}

TEST(Yaml, MergeKeysFillInWhatIsMissing) {
    EXPECT_EQ(compact("x: &x {p: 1, q: 2}\ny: {<<: *x, q: 3}"), R"({"x":{"p":1,"q":2},"y":{"p":1,"q":3}})");
    EXPECT_EQ(compact("x: &x {p: 1, q: 2}\ny: {q: 3, <<: *x}"), R"({"x":{"p":1,"q":2},"y":{"q":3,"p":1}})");
}

TEST(Yaml, MergedListsPreferTheEarlierSource) {
    EXPECT_EQ(compact("- &a {p: 1}\n- &b {p: 2, q: 2}\n- {<<: [*a, *b], r: 3}"),
              R"([{"p":1},{"p":2,"q":2},{"p":1,"q":2,"r":3}])");
}

TEST(Yaml, QuotedMergeKeyIsAnOrdinaryKey) { EXPECT_EQ(compact("{'<<': 1}"), R"({"<<":1})"); }

TEST(Yaml, MergingSomethingElseIsAnError) {
    EXPECT_EQ(problemOf("a: {<<: 3}").message, "'<<' must merge objects, found a number");
    EXPECT_EQ(problemOf("a: {<<: [1]}").message, "'<<' must merge objects, found a list");
}

TEST(Yaml, PlacesCountFromTheFirstLineOfTheFile) {
    const Value root = parseYaml("é: x\nlist:\n  - 0x10\n  - 'q'\n", "doc.yaml", 5);
    EXPECT_EQ(root.where().file, "doc.yaml");
    expectPlace(root.members()[0].keyLoc, 5, 1, 1);
    expectPlace(root.find("é")->where(), 5, 4, 1);
    expectPlace(root.members()[1].keyLoc, 6, 1, 4);
    expectPlace(root.find("list")->items()[0].where(), 7, 5, 4);
    expectPlace(root.find("list")->items()[1].where(), 8, 5, 3);
}

TEST(Yaml, TabsAndWindowsLineEndingsAreHarmless) {
    EXPECT_EQ(compact("a:\t1\r\nb:\r\n\t- x\r\n\t- y\r\nc: |\r\n  t\r\n"), R"({"a":1,"b":["x","y"],"c":"t\n"})");
}

TEST(Yaml, EmptyTextIsNull) {
    EXPECT_TRUE(parseYaml("", "f").isNull());
    EXPECT_TRUE(parseYaml("# nothing\n", "f").isNull());
    EXPECT_EQ(compact("--- # begins\na: 1"), R"({"a":1})");
}

TEST(Yaml, DuplicateKeysShowBothPlaces) {
    const Problem problem = problemOf("a: 1\nb: 2\na: 3");
    EXPECT_EQ(problem.message, "key 'a' stands twice in this object");
    expectPlace(problem.where, 3, 1, 1);
    ASSERT_EQ(problem.remarks.size(), 1u);
    expectPlace(problem.remarks[0].where, 1, 1, 1);
}

class YamlSyntax : public testing::TestWithParam<SyntaxCase> {};

TEST_P(YamlSyntax, IsExplained) { expectExplained(problemOf(GetParam().text), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Mistakes, YamlSyntax,
    testing::Values(SyntaxCase{"a: *nope", 1, 4, "this alias names no anchor above it"},
                    SyntaxCase{"a: &x [*x]", 1, 8, "this alias stands inside the value it repeats"},
                    SyntaxCase{"a: [1, 2", 1, 9, "the list that begins with '[' is not closed before this"},
                    SyntaxCase{"a: {b: 1\n", 1, 9, "the object that begins with '{' is not closed before this"},
                    SyntaxCase{"a: \"x", 1, 6, "the text ends inside quotes"},
                    SyntaxCase{"a: b: c", 1, 5, "a ':' stands where no key is before it"},
                    SyntaxCase{"a: \"\\q\"", 1, 7, "this backslash begins no escape"},
                    SyntaxCase{"a: @x", 1, 4, "this character cannot begin a value"},
                    SyntaxCase{"a: ]", 1, 4, "this bracket closes nothing"},
                    SyntaxCase{"- a\nb: 1", 2, 1, "this line does not continue the value above it"},
                    SyntaxCase{"a: 1\n---\nb: 2", 2, 1, "a second document begins here"},
                    SyntaxCase{"? [1]\n: 2", 1, 3, "a key must be a word, found a list"},
                    SyntaxCase{": 3", 1, 1, "a key is missing before ':'"},
                    SyntaxCase{"a: .nan", 1, 4, "'.nan' is not a finite number"},
                    SyntaxCase{"a: -.inf", 1, 4, "'-.inf' is not a finite number"},
                    SyntaxCase{"a: 1e999", 1, 4, "the number '1e999' is too large or too small"},
                    SyntaxCase{"a: !tag 1", 1, 4, "tag '!tag' is not known here"},
                    SyntaxCase{"a: \x01", 1, 4, "a control character (0x01) stands in the text"},
                    SyntaxCase{"a: \xc3(", 1, 4, "this byte is not UTF-8"}));

TEST(Yaml, AliasBombsAreStopped) {
    std::string text = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n";
    for (int i = 1; i < 12; ++i) {
        const std::string below = "*a" + std::to_string(i - 1);
        text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + below;
        for (int k = 1; k < 10; ++k) text += "," + below;
        text += "]\n";
    }
    EXPECT_EQ(problemOf(text).message, "the aliases of this document stand for more than 200000 values");
}

TEST(Yaml, AliasesOfLongTextAreStopped) {
    std::string text = "- &a " + std::string(1'000'000, 'x') + "\n";
    for (int i = 0; i < 1000; ++i) text += "- *a\n";
    EXPECT_NE(problemOf(text).message.find("aliases"), std::string::npos);
}

TEST(Yaml, DepthSizeAndNumberOfValuesAreLimited) {
    EXPECT_NO_THROW(parseYaml("a: [[1]]", "f", 1, {.maxDepth = 3}));
    EXPECT_EQ(problemOf("a: [[[1]]]", {.maxDepth = 3}).message, "the document nests deeper than 3 levels");
    EXPECT_NE(problemOf("a: [1]", {.maxBytes = 5}).message.find("6 bytes"), std::string::npos);
    EXPECT_EQ(problemOf("[1, 2, 3]", {.maxNodes = 3}).message, "the document holds more than 3 values");
    EXPECT_THROW(parseYaml("a: " + std::string(100'000, '['), "f"), Error);
}

}  // namespace
}  // namespace crevice
