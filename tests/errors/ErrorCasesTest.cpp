// Every mistaken input is answered with exactly the text of its case, its exit code and nothing written.
#include <cstdlib>

#include <gtest/gtest.h>

#include "CaseFile.h"
#include "CaseRun.h"

namespace crevice::errors {
namespace {

/// CREVICE_UPDATE_GOLDEN=1 writes what the program says into the cases: read the difference before it is committed.
bool isUpdating() {
    const char* text = std::getenv("CREVICE_UPDATE_GOLDEN");
    return text && std::string(text) == "1";
}

class ErrorCases : public testing::TestWithParam<std::string> {};

TEST_P(ErrorCases, AnswerWithTheirText) {
    std::size_t count = 0;
    for (const Case& c : readAllCases()) {
        if (c.area != GetParam()) continue;
        ++count;
        SCOPED_TRACE(c.id());
        const Answer answer = runCase(c);
        if (isUpdating() && answer.exitCode > 0) writeExpected(c, answer.messages);
        EXPECT_EQ(answer.exitCode, c.exitCode) << answer.end << "\n" << answer.messages;
        EXPECT_EQ(answer.results, "") << "an input that is refused has no results";
        EXPECT_EQ(answer.newFiles, std::vector<std::string>{}) << "nothing may be left behind";
        if (isUpdating()) continue;
        EXPECT_NE(c.expected, "") << "a case without expected text: run with CREVICE_UPDATE_GOLDEN=1 and read it";
        EXPECT_EQ(answer.messages, c.expected);
    }
    EXPECT_GT(count, 0u) << "the folder holds no case";
}

std::string nameOf(const testing::TestParamInfo<std::string>& area) { return area.param; }

INSTANTIATE_TEST_SUITE_P(All, ErrorCases, testing::ValuesIn(listAreas()), nameOf);

}  // namespace
}  // namespace crevice::errors
