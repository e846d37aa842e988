// Where the article's projects lie.
#include "CocosFixture.h"

namespace crevice {

cocos::Roots CocosTest::rootsOf(const std::string& article) {
    const std::filesystem::path folder = std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "tests/cocos" / article;
    return {.chunks = {}, .project = folder / "project", .engine = folder / "engine"};
}

}  // namespace crevice
