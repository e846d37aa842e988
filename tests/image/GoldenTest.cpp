// Renders every case and compares it with its golden image: byte for byte on the driver that made them.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ImageCase.h"
#include "app/Renderer.h"
#include "app/commands/ImageDifference.h"
#include "core/Files.h"

namespace crevice::image {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxGoldenBytes = 60'000;

bool updating() { return std::getenv("CREVICE_UPDATE_GOLDEN") != nullptr; }
fs::path driverPath() { return fs::path(CREVICE_IMAGE_DIR) / "golden" / "driver.txt"; }

/// Warnings and errors of a run: there may be none.
Log collectingLog(std::vector<std::string>& messages) {
    return Log(LogLevel::Warning, [&messages](LogLevel, std::string_view text) { messages.emplace_back(text); });
}

Image renderCase(const ImageCase& c, Renderer& renderer) {
    PipelineRequest request{.nameOrPath = c.pipeline, .options = c.options, .sets = {}};
    for (const auto& [path, value] : c.sets) request.sets.push_back({path, value});
    renderer.load(std::move(request));
    renderer.setScene(loadScene(c.scene, {.log = renderer.log()}));
    return renderer.render({.width = c.width, .height = c.height});
}

/// Pixels of which a channel is off by more than `limit` (0 … 255), as a share.
double shareBeyond(const Image& a, const Image& b, double limit) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
        int worst = 0;
        for (std::size_t c = 0; c < 4; ++c) {
            worst = std::max(worst, std::abs(int(a.pixels[i + c]) - int(b.pixels[i + c])));
        }
        count += worst > limit ? 1 : 0;
    }
    return static_cast<double>(count) / static_cast<double>(a.pixels.size() / 4);
}

std::string writeFailure(const ImageCase& c, const Image& image, const Image& golden, double max) {
    const fs::path folder = CREVICE_IMAGE_OUT;
    fs::create_directories(folder);
    writeImage(folder / (c.name + ".png"), image);
    writeImage(folder / (c.name + ".heat.png"), makeHeatImage(image, golden, max));
    return "the picture and its differences are in " + folder.string() + "/" + c.name + "{,.heat}.png";
}

void compareWithGolden(const ImageCase& c, const Image& image, const std::string& driver) {
    const fs::path path = goldenPath(c.name);
    ASSERT_TRUE(fs::exists(path)) << "there is no golden image; CREVICE_UPDATE_GOLDEN=1 writes it";
    EXPECT_LE(fs::file_size(path), kMaxGoldenBytes);
    const Image golden = readImage(path);
    ASSERT_EQ(golden.width, image.width);
    ASSERT_EQ(golden.height, image.height);
    const bool sameDriver = readText(driverPath()) == driver + "\n";
    const double limit = sameDriver ? 0 : c.tolerance, outliers = sameDriver ? 0 : c.outliers;
    const double share = shareBeyond(image, golden, limit);
    if (share <= outliers) return;
    const ImageDifference difference = compareImages(image, golden);
    ADD_FAILURE() << 100 * share << " % of the pixels are off by more than " << limit
                  << "/255 (allowed: " << 100 * outliers << " %), the worst by " << 255 * difference.max << "/255, on "
                  << driver << "; " << writeFailure(c, image, golden, difference.max);
}

class Golden : public testing::TestWithParam<ImageCase> {};

TEST_P(Golden, Image) {
    const ImageCase& c = GetParam();
    std::vector<std::string> messages;
    {
        Renderer renderer({.validate = true, .log = collectingLog(messages)});
        const Image image = renderCase(c, renderer);
        EXPECT_EQ(renderer.device().validationMessageCount(), 0u);
        const std::string driver = renderer.device().deviceName() + "; " + renderer.device().driverInfo();
        if (updating()) {
            fs::create_directories(goldenPath(c.name).parent_path());
            writeImage(goldenPath(c.name), image);
            std::ofstream(driverPath()) << driver << "\n";
        } else {
            compareWithGolden(c, image, driver);
        }
    }
    for (const std::string& message : messages) ADD_FAILURE() << message;
}

INSTANTIATE_TEST_SUITE_P(Case, Golden, testing::ValuesIn(readCases()),
                         [](const auto& c) { return std::regex_replace(c.param.name, std::regex("-"), "_"); });

TEST(GoldenFiles, EveryImageHasItsCase) {
    if (updating()) GTEST_SKIP() << "the images are being written";
    std::size_t count = 0;
    const std::vector<ImageCase> cases = readCases();
    for (const auto& entry : fs::directory_iterator(fs::path(CREVICE_IMAGE_DIR) / "golden")) {
        if (entry.path() == driverPath()) continue;
        ++count;
        const std::string name = entry.path().stem().string();
        const bool known = std::any_of(cases.begin(), cases.end(), [&](const ImageCase& c) { return c.name == name; });
        EXPECT_TRUE(known && entry.path() == goldenPath(name)) << entry.path() << " belongs to no case: remove it";
    }
    EXPECT_EQ(count, cases.size());
    EXPECT_GE(count, 10u);
}

/// A golden image notices change, it proves nothing; each case names a test that does.
TEST(GoldenFiles, EveryFactIsATest) {
    std::string sources;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(CREVICE_TEST_SOURCE_DIR) / "tests")) {
        if (entry.path().extension() == ".cpp") sources += readText(entry.path());
    }
    for (const ImageCase& c : readCases()) {
        const std::size_t dot = c.fact.find('.');
        ASSERT_NE(dot, std::string::npos) << c.name;
        const std::regex test("TEST(_F|_P)?\\(" + c.fact.substr(0, dot) + ",\\s*" + c.fact.substr(dot + 1) + "\\)");
        EXPECT_TRUE(std::regex_search(sources, test)) << c.name << ": there is no test " << c.fact;
        EXPECT_FALSE(c.reason.empty()) << c.name;
    }
}

}  // namespace
}  // namespace crevice::image
