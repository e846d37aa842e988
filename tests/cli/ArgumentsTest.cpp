// Arguments that are broken in every way: whatever they say, the program ends by itself with an exit code of its own,
// and what it refuses leaves no file.
#include <algorithm>
#include <cstdint>

#include "CliTools.h"

namespace crevice::cli {
namespace {

class ArgumentsTest : public CliTest {
protected:
    std::uint32_t random(std::size_t below) {
        state_ = state_ * 1664525u + 1013904223u;
        return std::uint32_t((state_ >> 8) % below);
    }

    void expectAnswer(const std::vector<std::string>& arguments) {
        std::string text;
        for (const std::string& argument : arguments) text += "[" + argument.substr(0, 60) + "] ";
        SCOPED_TRACE(text);
        const std::vector<std::string> before = files();
        const Outcome outcome = run(arguments);
        EXPECT_TRUE(outcome.code >= 0 && outcome.code <= 2) << outcome.code << outcome.err;
        if (outcome.code == 2) {
            EXPECT_NE(outcome.err.find("error"), std::string::npos) << outcome.err;
            EXPECT_EQ(files(), before);
        }
    }

private:
    std::uint32_t state_ = 2024;
};

const std::vector<std::string> kValues = {"",
                                          "-1",
                                          "0",
                                          "nan",
                                          "1e999",
                                          "99999999999999999999",
                                          "\xff\xfe",
                                          "%s%n",
                                          "a=b=c",
                                          "../../..",
                                          "/dev/null/x",
                                          "\n",
                                          "--",
                                          "é\x01",
                                          "=",
                                          ",,,",
                                          std::string(5000, 'x'),
                                          "0x10",
                                          "1,2,3",
                                          "{",
                                          "[[[[[[[[[[",
                                          "-",
                                          "."};

// No command renders here: what would is asked for something else that is wrong.
const std::vector<std::vector<std::string>> kCommands = {{"render", "none-such", "-o", "a.png", "--size", "8x8"},
                                                         {"sheet", "none-such", "-o", "a.png"},
                                                         {"validate", "none-such"},
                                                         {"flatten", "deferred", "--set", "a.b=1"},
                                                         {"plan", "none-such", "--size", "8x8"},
                                                         {"import", "none.rpp", "-o", "a.json"},
                                                         {"stages", "--json"},
                                                         {"effects", "show", "none-such"},
                                                         {"schema", "-o", "none/a.json"},
                                                         {"info", "none.gltf"},
                                                         {"limits", "--limit", "vertices=9"},
                                                         {"reference", "none.gltf", "-o", "a.exr"},
                                                         {"compare", "a.png", "b.png", "--tolerance", "1"},
                                                         {"bench-ao", "--scene", "none.gltf"}};

TEST_F(ArgumentsTest, OneValueOfACommandMayBeAnything) {
    for (std::size_t i = 0; i < 70; ++i) {
        std::vector<std::string> arguments = kCommands[i % kCommands.size()];
        arguments[1 + random(arguments.size() - 1)] = kValues[random(kValues.size())];
        expectAnswer(arguments);
    }
}

TEST_F(ArgumentsTest, WordsMayStandInAnyOrderAndNumber) {
    for (std::size_t i = 0; i < 50; ++i) {
        std::vector<std::string> arguments = kCommands[i % kCommands.size()];
        const std::vector<std::string>& other = kCommands[random(kCommands.size())];
        arguments.insert(arguments.begin() + random(arguments.size()), other[random(other.size())]);
        if (i % 3 == 0) arguments.pop_back();
        if (i % 5 == 0) std::reverse(arguments.begin() + 1, arguments.end());
        expectAnswer(arguments);
    }
}

}  // namespace
}  // namespace crevice::cli
