// Control characters of input do not reach the terminal through messages.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/Controls.h"
#include "core/Log.h"
#include "scene/GltfModel.h"

namespace crevice {
namespace {

TEST(Controls, AreQuestionMarksAndOthersStay) {
    EXPECT_EQ(withoutControls(std::string("a\x1b[31m\x7f\0b", 9)), "a?[31m??b");
    EXPECT_EQ(withoutControls("line\n\ttab, \xc3\xa4"), "line\n\ttab, \xc3\xa4");
}

TEST(Controls, DoNotPassALog) {
    std::vector<std::string> lines;
    const Log log(LogLevel::Note, [&](LogLevel, std::string_view message) { lines.emplace_back(message); });
    log.warning("key '\x1b[2J' stands twice");
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "warning: key '?[2J' stands twice");
}

TEST(Controls, ANameOfTwoLinesForgesNoMessage) { EXPECT_EQ(gltf::shortened("x\nerror: forged"), "x error: forged"); }

}  // namespace
}  // namespace crevice
