// Random macro programs: what glslang's preprocessor makes of the flattened text is what a C preprocessor makes of the
// source, in every variant.
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "CocosMacroPrograms.h"
#include "EffectTestTools.h"
#include "cocos/flatten/Flattener.h"

namespace crevice::cocos {
namespace {

/// Words, numbers and single characters. A `;` that ends nothing counts for nothing: one behind a call whose body ends
/// in a preprocessor line is left out.
std::string tokensOf(const std::string& text) {
    std::string all;
    char last = ';';
    const auto isWord = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    for (std::size_t i = 0; i < text.size();) {
        if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
            ++i;
            continue;
        }
        std::size_t end = i + 1;
        const bool number = text[i] >= '0' && text[i] <= '9';
        while (isWord(text[i]) && end < text.size() && (isWord(text[end]) || (number && text[end] == '.'))) ++end;
        if (text[i] != ';' || last != ';') all += text.substr(i, end - i) + ' ';
        last = text[i];
        i = end;
    }
    return all;
}

/// What glslang says of a macro's name without brackets at the end of a line in front of a preprocessor line, and what
/// the flattener says of programs that become too large.
constexpr const char* kRefused[] = {"preprocessor directive cannot be preceded by another token",
                                    "write more than it can hold",
                                    "expands without end",
                                    "is not closed within",
                                    "too many alternatives",
                                    "nests macros deeper than"};

std::string headOf(unsigned variant) {
    std::string head;
    for (std::size_t i = 0; i < kSwitches.size(); ++i)
        head += std::string("#define ") + kSwitches[i] + ((variant >> i & 1u) != 0 ? " 1\n" : " 0\n");
    return head;
}

/// Many texts through one run of the C preprocessor. Empty where there is none.
class CPreprocessor {
public:
    void add(const std::string& text) {
        input_ += "# 1 \"program" + std::to_string(count_) + "\"\n" + text + "\n# 1 \"between\"\nprogram_ends\n";
        for (const std::string& name : MacroProgram::names()) input_ += "#undef " + name + "\n";
        for (const char* const name : kSwitches) input_ += std::string("#undef ") + name + "\n";
        ++count_;
    }
    /// Tokens of each text; "error" where it is none of C's.
    std::optional<std::vector<std::string>> run() const {
        EffectFolder folder;
        folder.write("in.c", input_);
        const std::string base = (folder.path() / "").string();
        const std::string command = "cpp -P -undef -w " + base + "in.c > " + base + "out 2> " + base + "errors";
        std::vector<std::string> found;
        const int status = std::system(command.c_str());  // It fails where one of the texts is none of C's.
        if (status == -1 || WEXITSTATUS(status) == 127) return std::nullopt;
        std::ifstream errors(base + "errors"), out(base + "out");
        std::map<std::string, bool> wrong;
        for (std::string line; std::getline(errors, line);) wrong[line.substr(0, line.find(':'))] = true;
        const std::string text((std::istreambuf_iterator<char>(out)), {});
        const std::string mark = "program_ends";
        for (std::size_t at = 0, end; (end = text.find(mark, at)) != std::string::npos; at = end + mark.size())
            found.push_back(wrong.contains("program" + std::to_string(found.size()))
                                ? "error"
                                : tokensOf(text.substr(at, end - at)));
        return found;
    }
    std::size_t count() const { return count_; }

private:
    std::string input_;
    std::size_t count_ = 0;
};

/// What glslang makes of a text, or "error" and why.
std::string preprocess(const std::string& text) {
    glslang::TShader shader(EShLangFragment);
    const std::string all = "#version 450\n" + text;
    const char* const begin = all.c_str();
    shader.setStrings(&begin, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangFragment, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    std::string out;
    glslang::TShader::ForbidIncluder none;
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgOnlyPreprocessor);
    if (!shader.preprocess(GetDefaultResources(), 450, ENoProfile, false, false, messages, &out, none))
        return std::string("error ") + shader.getInfoLog();
    std::string kept;
    std::istringstream lines(out);
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("#")) kept += line + "\n";
    return tokensOf(kept);
}

std::string flatten(const std::string& source, Problems& problems) {
    EffectAsset effect;
    effect.path = "none/t.effect";
    effect.programs["main"] = {source, 1};
    ChunkLibrary chunks(Roots{});
    return flattenStage(effect, "main", {}, chunks, {}, problems).flat.text;
}

std::string alone(const std::string& text) {
    CPreprocessor cpp;
    cpp.add(text);
    return cpp.run().value().front();
}

/// What differs in a variant, but where glslang's preprocessor differs from C: it may expand a name that stands in an
/// argument and in what this becomes. Empty where nothing does. `expected` has a text for each variant.
std::string difference(const MacroProgram& program, const std::string* expected, int* compared = nullptr) {
    Problems problems;
    const std::string source = program.source(), flat = flatten(source, problems);
    for (unsigned variant = 0; variant < kVariantCount; ++variant) {
        if (expected[variant] == "error") continue;
        if (compared != nullptr) ++*compared;
        const std::string found =
            problems.hasErrors() ? "error " + problems.all().front().message : preprocess(headOf(variant) + flat);
        if (found == expected[variant]) continue;
        if (std::any_of(std::begin(kRefused), std::end(kRefused),
                        [&](const char* message) { return found.find(message) != std::string::npos; }))
            continue;
        if (found.starts_with("error") || alone(headOf(variant) + flat) != expected[variant])
            return headOf(variant) + source + "\nflattened:\n" + flat + "\nC:    " + expected[variant] +
                   "\nours: " + found;
    }
    return {};
}

std::string differenceAlone(const MacroProgram& program) {
    CPreprocessor cpp;
    for (unsigned variant = 0; variant < kVariantCount; ++variant) cpp.add(headOf(variant) + program.plain(variant));
    const std::vector<std::string> expected = cpp.run().value();
    return expected.size() == kVariantCount ? difference(program, expected.data()) : std::string();
}

/// Takes away what a failing program does not need to fail.
std::string smallestDifference(MacroProgram program, std::string found) {
    for (bool shrunk = true; shrunk;) {
        shrunk = false;
        for (std::size_t item = program.itemCount(); item-- > 0;) {
            if (item >= program.itemCount()) continue;
            const MacroProgram less = program.without(item);
            const std::string left = differenceAlone(less);
            if (left.empty()) continue;
            program = less;
            found = left;
            shrunk = true;
        }
    }
    return found;
}

int numberFrom(const char* variable, int usual) {
    const char* const given = std::getenv(variable);
    return given != nullptr ? std::atoi(given) : usual;
}

void checkPrograms(bool crossing) {
    keepCompilerWarm();
    const int count = numberFrom("CREVICE_MACRO_PROGRAMS", 400), first = numberFrom("CREVICE_MACRO_SEED", 0);
    std::vector<MacroProgram> programs;
    CPreprocessor cpp;
    for (int seed = first; seed < first + count; ++seed) {
        programs.emplace_back(static_cast<std::uint32_t>(seed), 4 + seed % 24, crossing);
        for (unsigned variant = 0; variant < kVariantCount; ++variant)
            cpp.add(headOf(variant) + programs.back().plain(variant));
    }
    const auto answer = cpp.run();
    if (!answer) GTEST_SKIP() << "there is no C preprocessor 'cpp'";
    const std::vector<std::string>& expected = *answer;
    ASSERT_EQ(expected.size(), cpp.count());
    int compared = 0, failed = 0;
    for (std::size_t i = 0; i < programs.size() && failed < 5; ++i) {
        const std::string found = difference(programs[i], &expected[i * kVariantCount], &compared);
        if (found.empty()) continue;
        ADD_FAILURE() << "program " << first + int(i) << "\n" << smallestDifference(programs[i], found);
        ++failed;
    }
    EXPECT_TRUE(failed > 0 || compared > count * 4) << "most programs are C's";
}

TEST(CocosMacroProperty, EveryVariantIsThatOfTheSource) { checkPrograms(false); }

TEST(CocosMacroProperty, ConditionsThatCrossCalls) { checkPrograms(true); }

}  // namespace
}  // namespace crevice::cocos
