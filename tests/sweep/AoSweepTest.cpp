// Every technique, quality and resolution of ao-deferred on the models of the test scenes: each map in range, twice the
// same bits, no validation message. One model of every folder takes a third of the variants, models in turn, so that
// every variant meets a third of the folders; with ctest -L long all models take all.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <ostream>
#include <utility>

#include "app/Renderer.h"
#include "core/Files.h"
#include "scene/GltfLoader.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

Value readDocument(const std::string& path) {
    const fs::path file = fs::path(CREVICE_TEST_SOURCE_DIR) / "assets/pipelines" / path;
    return parseJson(readText(file), file.string());
}

std::vector<std::string> choicesOf(const Value& document, const char* option) {
    const Value& choices = *document.find("options")->find(option)->find("choices");
    std::vector<std::string> names;
    if (choices.isArray()) {
        for (const Value& choice : choices.items()) names.push_back(choice.string());
    } else {
        for (const Member& choice : choices.members()) names.push_back(choice.key);
    }
    return names;
}

using Options = std::map<std::string, std::string>;

/// As the caller's options.
std::vector<Options> variants() {
    std::vector<Options> all;
    for (const std::string& ao : choicesOf(readDocument("ao-deferred.pipeline.json"), "ao")) {
        if (ao == "off") continue;
        for (const std::string& quality : choicesOf(readDocument("flows/ao/" + ao + ".flow.json"), "quality"))
            for (const char* resolution : {"full", "half"})
                all.push_back({{"ao", ao}, {"quality", quality}, {"resolution", resolution}});
    }
    return all;
}

bool isModel(const fs::path& file) { return file.extension() == ".gltf" || file.extension() == ".glb"; }

/// All models below the folder of test scenes; none where it is absent.
std::vector<fs::path> allModels() {
    std::vector<fs::path> all;
    if (!fs::is_directory(CREVICE_SCENES_DIR)) return all;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(CREVICE_SCENES_DIR))
        if (isModel(file.path())) all.push_back(file.path());
    std::sort(all.begin(), all.end());
    return all;
}

fs::path folderOf(const fs::path& model) { return *fs::relative(model, CREVICE_SCENES_DIR).begin(); }

/// How many shares the variants are dealt out in.
constexpr std::size_t kShares = 3;

struct Sweep {
    fs::path model;
    std::optional<std::size_t> share;  ///< Every kShares-th variant from this one on; all without it.
};

/// For the names of tests.
void PrintTo(const Sweep& sweep, std::ostream* out) { *out << sweep.model.filename(); }

std::vector<Sweep> oneOfAFolder() {
    std::vector<Sweep> chosen;
    fs::path folder;
    for (const fs::path& model : allModels()) {
        if (folderOf(model) != folder) chosen.push_back({model, chosen.size() % kShares});
        folder = folderOf(model);
    }
    return chosen;
}

std::vector<Sweep> everything() {
    std::vector<Sweep> all;
    for (const fs::path& model : allModels()) all.push_back({model, std::nullopt});
    return all;
}

std::vector<Options> variantsOf(const Sweep& sweep) {
    if (!sweep.share) return variants();
    std::vector<Options> chosen, all = variants();
    for (std::size_t i = *sweep.share; i < all.size(); i += kShares) chosen.push_back(all[i]);
    return chosen;
}

class AoSweep : public testing::TestWithParam<Sweep> {};

// A checkout without the scenes has nothing to sweep over.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(AoSweep);

/// Nothing where the file is refused, which only broken ones may be.
std::optional<Scene> load(const fs::path& model, const Log& log) {
    try {
        return loadGltf(model, {.log = log});
    } catch (const Error& refused) {
        EXPECT_EQ(folderOf(model), "bad_bounds_tinygltf") << refused.what();
        return std::nullopt;
    }
}

TEST_P(AoSweep, EveryMapIsInRangeAndTwiceTheSame) {
    Renderer renderer({.validate = true, .log = Log(LogLevel::Error)});
    std::optional<Scene> scene = load(GetParam().model, renderer.log());
    if (!scene) return;
    View view{.width = 160, .height = 90};
    view.keep = {"cc_ssaoBlurMap"};
    for (const Options& options : variantsOf(GetParam())) {
        std::string what;
        for (const auto& [name, value] : options) what += name + "=" + value + " ";
        renderer.load({.nameOrPath = "ao-deferred", .options = options, .sets = {{"cc_ssaoBlurMap.format", "R32F"}}},
                      {.width = view.width, .height = view.height});
        if (scene) renderer.setScene(*std::exchange(scene, std::nullopt));
        const Image picture = renderer.render(view);
        const Image map = renderer.target("cc_ssaoBlurMap");
        for (std::uint32_t y = 0; y < map.height; ++y)
            for (std::uint32_t x = 0; x < map.width; ++x) {
                const float openness = map.at(x, y).x;
                // Written so that NaN fails, too.
                ASSERT_TRUE(openness >= 0 && openness <= 1) << what << x << ", " << y << ": " << openness;
            }
        ASSERT_EQ(picture.pixels, renderer.render(view).pixels) << what;
        ASSERT_EQ(map.pixels, renderer.target("cc_ssaoBlurMap").pixels) << what;
    }
    for (const std::string& message : renderer.device().validationMessages()) ADD_FAILURE() << message;
    EXPECT_EQ(renderer.device().validationMessageCount(), 0u);
}

std::string nameOf(const testing::TestParamInfo<Sweep>& sweep) {
    std::string name = fs::relative(sweep.param.model, CREVICE_SCENES_DIR).string();
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(OneOfAFolder, AoSweep, testing::ValuesIn(oneOfAFolder()), nameOf);
INSTANTIATE_TEST_SUITE_P(Everything, AoSweep, testing::ValuesIn(everything()), nameOf);

}  // namespace
}  // namespace crevice
