// What counts as a word of a statement, and what of several alternatives the compiler sees.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "cocos/analysis/MacroWeight.h"

namespace crevice::cocos {
namespace {

using testing::HasSubstr;

const std::string kColor = "layout(location = 0) out vec4 color;\n";

std::string repeat(int count, const std::string& text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

/// The line on which a statement passes the limit, macros aside; 0 = nowhere.
int firstLongLine(const std::string& text) {
    std::string_view macro;
    const int line = MacroWeights().firstTooHeavy(text, macro);
    EXPECT_EQ(macro, "");
    return line;
}

TEST(CocosWeight, PreprocessorLinesAreNoWordsOfAStatement) {
    EXPECT_EQ(firstLongLine(repeat(3000, "#if A == 1 && B >= 2\n#define Q 1 + 1\n#endif\n#pragma x - - -\n")), 0);
    EXPECT_EQ(firstLongLine("x = 1" + repeat(3999, "\n#if A > \\\n 1 + 1\n + 1\n#endif") + ";\n"), 0);
    EXPECT_GT(firstLongLine("x = 1" + repeat(4001, "\n#if A > \\\n 1 + 1\n + 1\n#endif") + ";\n"), 0);
}

TEST(CocosWeight, OfAlternativesTheHeaviestCounts) {
    const std::string sum = repeat(2000, "+ 1 ") + "\n";  // 4000 of 8000
    EXPECT_EQ(firstLongLine("x\n#if A\n" + sum + "#elif B\n" + sum + "#else\n" + sum + "#endif\n;"), 0);
    EXPECT_EQ(firstLongLine("x\n#if A\n" + sum + "#else\n+ 1\n#endif\n" + sum + ";"), 0);
    EXPECT_EQ(firstLongLine("x\n#if A\n" + sum + "#else\n+ 1\n#endif\n" + sum + "+ 1;"), 8);
    EXPECT_EQ(firstLongLine("x\n#if A\n" + sum + "#endif\n" + sum + "+ 1;"), 6);
    EXPECT_EQ(firstLongLine("x" + sum + "#if A\n;\n#endif\n" + sum + "+ 1;"), 6);  // Not A: one statement.
    EXPECT_EQ(firstLongLine("x" + sum + "#if A\n;\n#else\n;\n#endif\n" + sum + "+ 1;"), 0);
    EXPECT_EQ(firstLongLine(sum + "#else\n#endif\n#elif\n" + sum + "+ 1"), 6);  // What nothing opens decides nothing.
}

/// A macro P1 that is chosen, and P2 … Pcount that are and call the one before.
std::string chosenChain(int count) {
    std::string text = "#if USE_1\n#define P1(x) (x + 1.0)\n#else\n#define P1(x) (x * 1.0)\n#endif\n";
    for (int i = 2; i <= count; ++i) {
        const std::string n = std::to_string(i), m = std::to_string(i - 1);
        text += "#if USE_" + n + "\n#define P" + n + "(x) P" + m + "(x + 2.0)\n#else\n#define P" + n + "(x) P" + m +
                "(x * 2.0)\n#endif\n";
    }
    return text + kColor + "void main() { color = vec4(P" + std::to_string(count) +
           "(\n#if USE_Q\n1.0\n#else\n2.0\n#endif\n)); }\n";
}

TEST(CocosWeight, ChosenMacrosThatCallChosenMacros) {
    CocosBench bench;  // 1024 alternatives in one statement, of which a variant holds one.
    bench.fragment(chosenChain(10));
    EXPECT_EQ(bench.problem().message, "");
    bench.compile({{"USE_1", "1"}, {"USE_8", "1"}, {"USE_Q", "1"}});
}

TEST(CocosWeight, TooManyAlternativesAreNoRecursion) {
    CocosBench bench;
    for (const int count : {14, 16, 20}) {
        bench.fragment(chosenChain(count));
        EXPECT_THAT(bench.problem().message, HasSubstr("too many alternatives"));
        EXPECT_EQ(bench.problem().where.line, 10 + 5 * count + 2);
    }
}

}  // namespace
}  // namespace crevice::cocos
