// Limits as text: what `--limit` takes, and that every limit is reached by its name.
#include "core/Limits.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/Error.h"

namespace crevice {
namespace {

std::string errorOf(std::string_view text) {
    Limits limits;
    try {
        setLimit(limits, text);
    } catch (const Error& error) {
        return formatError(error);
    }
    return "no error";
}

TEST(Limits, AreSetByNameWithSuffixes) {
    Limits limits;
    setLimit(limits, "vertices=1500");
    EXPECT_EQ(limits.maxVertices, 1500u);
    setLimit(limits, "vertices=2K");
    EXPECT_EQ(limits.maxVertices, 2000u);
    setLimit(limits, "file-bytes=2K");
    EXPECT_EQ(limits.maxFileBytes, 2048u);
    setLimit(limits, "image-bytes=8G");
    EXPECT_EQ(limits.maxImageBytes, std::size_t(8) << 30);
    setLimit(limits, "node-depth=1K");
    EXPECT_EQ(limits.maxNodeDepth, 1000);
}

TEST(Limits, OtherTextIsRefused) {
    for (const char* text :
         {"vertices", "vertices=", "vertices=0", "vertices=-1", "vertices=1.5", "vertices=K", "vertices=1T",
          "vertices= 1", "vertices=99999999999999999999", "vertices=18446744073709551615K", "node-depth=4G"})
        EXPECT_NE(errorOf(text).find("is not a whole number from 1 to"), std::string::npos) << text << errorOf(text);
    EXPECT_NE(errorOf("vertexes=1").find("no limit named 'vertexes'"), std::string::npos);
    EXPECT_NE(errorOf("vertexes=1").find("did you mean 'vertices'?"), std::string::npos);
}

TEST(Limits, EveryFieldHasItsOwnName) {
    Limits limits;
    std::set<std::string> names;
    std::set<const void*> fields;
    visitLimits(limits, [&](auto& field, const LimitInfo& info) {
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_TRUE(fields.insert(&field).second) << info.name;
        // What is shown as the default is read back as the same number.
        const auto before = field;
        setLimit(limits, std::string(info.name) + "=" + limitText(static_cast<std::size_t>(field), info.unit));
        EXPECT_EQ(field, before) << info.name;
    });
    EXPECT_EQ(fields.size(), 9u);
}

}  // namespace
}  // namespace crevice
