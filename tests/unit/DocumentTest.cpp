// JSON documents: values, their places, limits, and the message for each kind of syntax mistake.
#include <limits>

#include "DocumentTools.h"

namespace crevice {
namespace {

using test::expectExplained;
using test::expectPlace;
using test::onlyProblem;
using test::SyntaxCase;

Problem problemOf(const std::string& text, const DocumentLimits& limits = {}) {
    return onlyProblem(text, [&](const std::string& t) { return parseJson(t, "doc.json", limits); });
}

std::string compact(const std::string& text) { return parseJson(text, "doc.json").toJson(-1); }

TEST(Json, ReadsEveryKindOfValue) {
    const std::string text = R"({"n":null,"t":true,"f":false,"i":-3,"r":2.5,"s":"x","a":[1,[],{}],"o":{"k":0}})";
    EXPECT_EQ(compact(text), text);
}

TEST(Json, KeepsTheOrderOfKeys) { EXPECT_EQ(compact(R"({"b":1,"a":2,"c":3})"), R"({"b":1,"a":2,"c":3})"); }

TEST(Json, TellsIntegersFromReals) {
    const Value list = parseJson("[3, 3.0, 3e0, 9223372036854775807, -9223372036854775808, 9223372036854775808]", "f");
    EXPECT_TRUE(list.items()[0].isInteger());
    EXPECT_FALSE(list.items()[1].isInteger());
    EXPECT_FALSE(list.items()[2].isInteger());
    EXPECT_EQ(list.items()[3].integer(), std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(list.items()[4].integer(), std::numeric_limits<std::int64_t>::min());
    EXPECT_FALSE(list.items()[5].isInteger());
    EXPECT_EQ(list.items()[5].number(), 9223372036854775808.0);
}

TEST(Json, WritesWhatReadsBackEqual) {
    const std::string text = R"([0.1,1e+300,3.0,-0.0,5e-324,"\"\\\n\r\t\u0001é😀"])";
    EXPECT_EQ(compact(text), text);
    EXPECT_EQ(compact(parseJson(text, "f").toJson(4)), text);
}

TEST(Json, IndentsObjectsAndKeepsFlatListsOnALine) {
    EXPECT_EQ(parseJson(R"({"a":[1,2],"b":{},"c":[{"d":1}]})", "f").toJson(2),
              "{\n  \"a\": [1, 2],\n  \"b\": {},\n  \"c\": [\n    {\n      \"d\": 1\n    }\n  ]\n}");
}

TEST(Json, DecodesEscapes) { EXPECT_EQ(parseJson(R"("\u00e9\ud83d\ude00\/")", "f").string(), "é😀/"); }

TEST(Json, EveryValueAndKeyHasItsPlace) {
    const Value root =
        parseJson("{\n  \"name\": \"x\",\n  \"list\": [1, true ,{}], // comment\n \"é\": null}", "doc.json");
    EXPECT_EQ(root.where().file, "doc.json");
    expectPlace(root.where(), 1, 1, 1);
    expectPlace(root.members()[0].keyLoc, 2, 3, 6);
    expectPlace(root.find("name")->where(), 2, 11, 3);
    const Value& list = *root.find("list");
    expectPlace(list.where(), 3, 11, 1);
    expectPlace(list.items()[0].where(), 3, 12, 1);
    expectPlace(list.items()[1].where(), 3, 15, 4);
    expectPlace(list.items()[2].where(), 3, 21, 1);
    expectPlace(root.members()[2].keyLoc, 4, 2, 3);
    expectPlace(root.find("é")->where(), 4, 7, 4);
}

TEST(Json, PlacesSurviveCommentsTrickyStringsAndByteOrderMark) {
    const Value root = parseJson("\xef\xbb\xbf{ /* { \" */ \"a\\\"}\": \"//, :\", // }\n\"b\": 1}", "doc.json");
    expectPlace(root.where(), 1, 1, 1);
    expectPlace(root.members()[0].keyLoc, 1, 13, 6);
    expectPlace(root.find("a\"}")->where(), 1, 21, 7);
    expectPlace(root.find("b")->where(), 2, 6, 1);
}

TEST(Json, DuplicateKeysShowBothPlaces) {
    const Problem problem = problemOf("{\"a\": 1,\n \"b\": 2,\n \"a\": 3}");
    EXPECT_EQ(problem.message, "key 'a' stands twice in this object");
    expectPlace(problem.where, 3, 2, 3);
    ASSERT_EQ(problem.remarks.size(), 1u);
    expectPlace(problem.remarks[0].where, 1, 2, 3);
}

TEST(Json, EqualKeysInDifferentObjectsAreNoDuplicates) {
    EXPECT_NO_THROW(parseJson(R"({"a": {"a": 1}, "b": {"a": 2}})", "f"));
}

class JsonSyntax : public testing::TestWithParam<SyntaxCase> {};

TEST_P(JsonSyntax, IsExplained) { expectExplained(problemOf(GetParam().text), GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Mistakes, JsonSyntax,
    testing::Values(
        SyntaxCase{"", 1, 1, "the document is empty"}, SyntaxCase{" // only\n", 2, 1, "the document is empty"},
        SyntaxCase{"{\"a\": 1,}", 1, 8, "a comma stands before '}'"},
        SyntaxCase{"[1,\n]", 1, 3, "a comma stands before ']'"},
        SyntaxCase{"{,}", 1, 2, "a comma stands where a key is expected"},
        SyntaxCase{"{\"a\": 1 \"b\": 2}", 1, 9, "expected ',' or '}' after the value, found the string 'b'"},
        SyntaxCase{"{\"a\": 1\n \"b\": 2}", 1, 8, "expected ',' or '}' after the value, found the string 'b'"},
        SyntaxCase{"[1 2]", 1, 4, "expected ',' or ']' after the value, found '2'"},
        SyntaxCase{"[1}", 1, 3, "expected ',' or ']' after the value, found '}'"},
        SyntaxCase{"{\"a\" 1}", 1, 6, "expected ':' after key 'a', found '1'"},
        SyntaxCase{"{\"a\":}", 1, 6, "expected a value, found '}'"},
        SyntaxCase{"{a: 1}", 1, 2, "expected a key in double quotes, found 'a'"},
        SyntaxCase{"{'a': 1}", 1, 2, "expected a key in double quotes, found 'a'"},
        SyntaxCase{"['a']", 1, 2, "a string stands in single quotes"},
        SyntaxCase{"{\"a\": yes}", 1, 7, "unknown word 'yes'"},
        SyntaxCase{"{\"a\": truefalse}", 1, 7, "unknown word 'truefalse'"},
        SyntaxCase{"[NaN]", 1, 2, "'NaN' is not a number that JSON can hold"},
        SyntaxCase{"[-Infinity]", 1, 2, "'-Infinity' is not a number that JSON can hold"},
        SyntaxCase{"[1e999]", 1, 2, "the number '1e999' is too large"},
        SyntaxCase{"[01]", 1, 2, "'01' is not a number as JSON writes it"},
        SyntaxCase{"[.5]", 1, 2, "'.5' is not a number as JSON writes it"},
        SyntaxCase{"[+1]", 1, 2, "'+1' is not a number as JSON writes it"},
        SyntaxCase{"[1.]", 1, 2, "'1.' is not a number as JSON writes it"},
        SyntaxCase{"[\"a\nb\"]", 1, 2, "the string that begins here is not closed on its line"},
        SyntaxCase{"[\"abc", 1, 2, "the string that begins here is not closed on its line"},
        SyntaxCase{"[\"a\\q\"]", 1, 5, "this backslash begins no escape"},
        SyntaxCase{"[\"\\ud800x\"]", 1, 9, "'\\u' is not followed by a code point"},
        SyntaxCase{"[\"a\xff\"]", 1, 4, "the string holds a byte that is not UTF-8"},
        SyntaxCase{"[\"a\tb\"]", 1, 4, "a control character (0x09) stands in a string"},
        SyntaxCase{"{} {}", 1, 4, "unexpected '{' after the end of the document"},
        SyntaxCase{"[1, 2", 1, 6, "the text ends where ',' or ']' is expected"},
        SyntaxCase{"{\"a\": ", 1, 6, "the text ends where a value is expected"},
        SyntaxCase{"{\"a\"", 1, 5, "the text ends where ':' and a value is expected"},
        SyntaxCase{"{", 1, 2, "the text ends where a key or '}' is expected"},
        SyntaxCase{"[1, /* x", 1, 5, "the comment that begins here is not closed"},
        SyntaxCase{"[/]", 1, 2, "this '/' begins no comment"}));

TEST(Json, UnclosedTextShowsWhereItBegan) {
    const Problem problem = problemOf("{\n  \"a\": [1,\n");
    ASSERT_EQ(problem.remarks.size(), 1u);
    expectPlace(problem.remarks[0].where, 2, 8, 1);
}

TEST(Json, DepthIsLimited) {
    const DocumentLimits limits{.maxDepth = 3};
    EXPECT_NO_THROW(parseJson("[[[1]]]", "doc.json", limits));
    const Problem problem = problemOf("[[[\n[1]]]]", limits);
    EXPECT_EQ(problem.message, "the document nests deeper than 3 levels");
    expectPlace(problem.where, 2, 1, 1);
    EXPECT_NE(problemOf(std::string(1'000'000, '[')).message.find("nests deeper"), std::string::npos);
}

TEST(Json, SizeAndNumberOfValuesAreLimited) {
    EXPECT_NE(problemOf("[1, 2, 3]", {.maxBytes = 8}).message.find("9 bytes"), std::string::npos);
    EXPECT_NO_THROW(parseJson("[1, 2, 3]", "doc.json", {.maxNodes = 4}));
    EXPECT_EQ(problemOf("[1, 2, 3]", {.maxNodes = 3}).message, "the document holds more than 3 values");
}

TEST(Json, LongLinesAreReadInLinearTime) {
    std::string text = "[";
    for (int i = 0; i < 200'000; ++i) text += "1,";
    text += "2]";
    const Value value = parseJson(text, "doc.json");
    EXPECT_EQ(value.items().back().where().column, 400'002);
}

TEST(Value, MembersAreSetReplacedAndErased) {
    Value object = Value::makeObject();
    object.set("a", Value::makeNumber(1));
    object.set("b", Value::makeString("x"));
    object.set("a", Value::makeBool(true));
    EXPECT_EQ(object.toJson(-1), R"({"a":true,"b":"x"})");
    object.erase("a");
    EXPECT_EQ(object.find("a"), nullptr);
    EXPECT_EQ(object.toJson(-1), R"({"b":"x"})");
}

TEST(Value, WholeNumbersAreIntegers) {
    EXPECT_TRUE(Value::makeNumber(3).isInteger());
    EXPECT_EQ(Value::makeNumber(-3).integer(), -3);
    EXPECT_FALSE(Value::makeNumber(3.5).isInteger());
    EXPECT_FALSE(Value::makeNumber(1e300).isInteger());
    EXPECT_FALSE(Value::makeReal(3).isInteger());
    EXPECT_EQ(Value::makeReal(3).toJson(), "3.0");
}

TEST(Value, NamesItsType) {
    EXPECT_STREQ(Value().typeName(), "null");
    EXPECT_STREQ(Value::makeArray().typeName(), "a list");
    EXPECT_STREQ(Value::makeObject().typeName(), "an object");
}

}  // namespace
}  // namespace crevice
