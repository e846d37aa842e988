// Messages as the user reads them: place, source line, caret, remarks, help.
#include "core/Error.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/Log.h"

namespace crevice {
namespace {

/// A file that is gone when the test ends.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& content)
        : path_(testing::TempDir() + "crevice-error-test-" + std::to_string(::getpid())) {
        std::ofstream(path_, std::ios::binary) << content;
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { std::filesystem::remove(path_); }
    const std::string& path() const { return path_; }

private:
    std::string path_;
};

Problem makeProblem(SourceLoc where, std::string message, std::string help = {}) {
    Problem problem;
    problem.where = std::move(where);
    problem.message = std::move(message);
    problem.help = std::move(help);
    return problem;
}

TEST(Error, WithoutPlaceIsOneLine) {
    EXPECT_EQ(formatProblem(makeProblem({}, "no device")), "error: no device");
    EXPECT_EQ(formatProblem(makeProblem({}, "no device", "install one")), "error: no device\nhelp: install one");
}

TEST(Error, UnreadableFileShowsThePlaceOnly) {
    EXPECT_EQ(formatProblem(makeProblem({"no/such.json", 3, 7, 2}, "bad 'x'")), "no/such.json:3:7: error: bad 'x'");
    EXPECT_EQ(formatProblem(makeProblem({"no/such.json", 3, 0, 1}, "bad")), "no/such.json:3: error: bad");
    EXPECT_EQ(formatProblem(makeProblem({"no/such.json", 0, 0, 1}, "bad")), "no/such.json: error: bad");
}

TEST(Error, ShowsSourceLineAndCaret) {
    const TemporaryFile file("{\n\t\"formt\": \"R8\"\r\n}\n");
    Problem problem = makeProblem({file.path(), 2, 2, 7}, "unknown key 'formt'", "did you mean 'format'?");
    const SourceLoc opener{file.path(), 1, 1, 1};
    problem.remarks.resize(1);
    problem.remarks[0].where = opener;
    problem.remarks[0].message = "the object begins here";
    EXPECT_EQ(formatProblem(problem), file.path() +
                                          ":2:2: error: unknown key 'formt'\n"
                                          "     \"formt\": \"R8\"\n"
                                          "     ^~~~~~~\n" +
                                          file.path() +
                                          ":1:1: note: the object begins here\n"
                                          "help: did you mean 'format'?");
}

TEST(Error, ColumnsCountCodePointsAndUnderlineStopsAtTheLineEnd) {
    const TemporaryFile file("ä: é\n");
    EXPECT_EQ(formatProblem(makeProblem({file.path(), 1, 4, 50}, "bad")),
              file.path() + ":1:4: error: bad\n    ä: é\n       ^");
}

TEST(Error, LineBeyondTheFileShowsNoExcerpt) {
    const TemporaryFile file("one line\n");
    EXPECT_EQ(formatProblem(makeProblem({file.path(), 9, 1, 1}, "bad")), file.path() + ":9:1: error: bad");
}

TEST(Error, LongLinesAreCutAroundTheCaret) {
    const TemporaryFile file(std::string(5000, 'a') + "X" + std::string(5000, 'b'));
    const std::string text = formatProblem(makeProblem({file.path(), 1, 5001, 1}, "bad"));
    EXPECT_LT(text.size(), 700u);
    const std::size_t excerpt = text.find('\n') + 1;
    const std::size_t caretLine = text.find('\n', excerpt) + 1;
    // The cut mark before the window is three bytes and one column.
    EXPECT_EQ(text.find('X') - excerpt - 2, text.find('^') - caretLine);
}

TEST(Error, TerminalEscapesAreNotReplayed) {
    EXPECT_EQ(formatProblem(makeProblem({}, "name '\x1b[31m'")), "error: name '?[31m'");
}

TEST(Error, WhatNamesTheFirstError) {
    Problem warning = makeProblem({"a", 1, 1, 1}, "odd");
    warning.severity = Severity::Warning;
    const Error error(std::vector<Problem>{warning, makeProblem({"b", 2, 3, 1}, "wrong")});
    EXPECT_STREQ(error.what(), "b:2:3: wrong");
    EXPECT_EQ(formatError(error), "a:1:1: warning: odd\nb:2:3: error: wrong");
}

TEST(Problems, CollectsAndThrowsOnlyForErrors) {
    Problems problems;
    problems.warning({}, "odd");
    problems.note({}, "by the way");
    EXPECT_NO_THROW(problems.throwIfErrors());
    problems.error({}, "wrong", "repair it");
    try {
        problems.throwIfErrors();
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        ASSERT_EQ(error.problems().size(), 3u);
        EXPECT_EQ(error.problems().back().help, "repair it");
    }
}

TEST(Problems, CountsErrorsBeyondTheLimit) {
    Problems problems;
    for (int i = 0; i < 23; ++i) problems.error({}, "wrong " + std::to_string(i));
    problems.add(Error("another"));
    try {
        problems.throwIfErrors();
        FAIL() << "nothing was thrown";
    } catch (const Error& error) {
        ASSERT_EQ(error.problems().size(), Problems::kMaxErrors + 1);
        EXPECT_EQ(error.problems().back().message, "4 more errors are not shown");
        EXPECT_EQ(error.problems().back().severity, Severity::Note);
    }
}

TEST(Log, FiltersByDetailAndPrefixes) {
    std::vector<std::string> heard;
    Log log(LogLevel::Warning, [&](LogLevel, std::string_view text) { heard.emplace_back(text); });
    log.error("a");
    log.warning("b");
    log.note("c");
    log.setDetail(LogLevel::Verbose);
    log.note("d");
    log.verbose("e");
    EXPECT_EQ(heard, (std::vector<std::string>{"error: a", "warning: b", "note: d", "e"}));
}

TEST(Log, WritesCollectedWarningsWithTheirPlaces) {
    std::vector<std::string> heard;
    const Log log(LogLevel::Warning, [&](LogLevel, std::string_view text) { heard.emplace_back(text); });
    Problems problems;
    problems.warning({"f", 1, 2, 1}, "odd");
    problems.note({}, "too quiet");
    log.write(problems);
    EXPECT_EQ(heard, std::vector<std::string>{"f:1:2: warning: odd"});
}

TEST(Log, DefaultSinkIsStderr) {
    testing::internal::CaptureStderr();
    Log().warning("50 % of {}");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: 50 % of {}\n");
}

}  // namespace
}  // namespace crevice
