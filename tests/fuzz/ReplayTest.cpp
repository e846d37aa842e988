// Replays the corpora: every input that fuzzing found worth keeping is answered, with a result or with an Error.
#include <map>

#include <gtest/gtest.h>

#include "FuzzTargets.h"
#include "core/Files.h"

namespace crevice::fuzz {
namespace {

namespace fs = std::filesystem;

using Target = void (*)(std::string_view);

const std::map<std::string, Target> kTargets = {
    {"pipeline", pipeline}, {"effect", effect}, {"material", material},       {"scene", scene},
    {"gltf", gltf},         {"image", image},   {"cocosEffect", cocosEffect}, {"cocosAsset", cocosAsset}};

class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, EveryInputIsAnswered) {
    std::size_t count = 0;
    for (const auto& file : fs::directory_iterator(fs::path(CREVICE_FUZZ_CORPUS) / GetParam())) {
        SCOPED_TRACE(file.path().string());
        EXPECT_NO_THROW(kTargets.at(GetParam())(readText(file.path())));
        ++count;
    }
    EXPECT_GE(count, 10u) << "the corpus is thin";
}

std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& [name, target] : kTargets) all.push_back(name);
    return all;
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Corpus, testing::ValuesIn(names()), [](const auto& item) { return item.param; });

// A folder without a target would never be replayed.
TEST(FuzzCorpora, EveryFolderHasATarget) {
    for (const auto& folder : fs::directory_iterator(CREVICE_FUZZ_CORPUS))
        EXPECT_TRUE(kTargets.contains(folder.path().filename().string())) << folder.path();
}

}  // namespace
}  // namespace crevice::fuzz
