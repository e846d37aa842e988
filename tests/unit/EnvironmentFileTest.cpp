// Environment files: Radiance .hdr written here byte by byte, EXR, and everything that is refused.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "SceneTestTools.h"
#include "core/Hdr.h"
#include "scene/EnvironmentCube.h"
#include "scene/SceneAsset.h"

namespace crevice {
namespace {

using test::contains;
using test::errorOf;

std::string header(std::uint32_t width, std::uint32_t height, const std::string& lines = {}) {
    return "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n";
}

/// Mantissas r, g, b and exponent e stand for (r, g, b) / 256 * 2^(e - 128).
std::string pixel(int r, int g, int b, int e) { return {char(r), char(g), char(b), char(e)}; }

/// Four rows of eight pixels, run-length encoded: red counts up, green 64, blue 0, exponent 129 + row.
std::string encodedRows() {
    std::string rows;
    for (int y = 0; y < 4; ++y) {
        rows += std::string{2, 2, 0, 8};
        rows += char(8);
        for (int x = 0; x < 8; ++x) rows += char(16 * x);
        rows += {char(128 + 8), 64};
        rows += {char(128 + 5), 0, char(128 + 3), 0};
        rows += {char(128 + 8), char(129 + y)};
    }
    return rows;
}

Environment load(const std::string& name, const std::string& bytes) {
    const test::TempFolder folder;
    return loadEnvironment(folder.write(name, bytes), Log(LogLevel::Error));
}
std::string refusal(const std::string& bytes, const std::string& name = "x.hdr") {
    return errorOf([&] { load(name, bytes); });
}

TEST(EnvironmentFile, RunLengthEncodedPixels) {
    const Environment environment = load("x.hdr", header(8, 4) + encodedRows());
    ASSERT_EQ(environment.radiance.width, 8u);
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const double scale = std::exp2(1.0 + y) / 256;
            EXPECT_FLOAT_EQ(environment.radiance.at(x, y).r, float(16 * x * scale)) << x << ' ' << y;
            EXPECT_FLOAT_EQ(environment.radiance.at(x, y).g, float(64 * scale));
            EXPECT_EQ(environment.radiance.at(x, y).b, 0);
            EXPECT_EQ(environment.radiance.at(x, y).a, 1);
        }
}

TEST(EnvironmentFile, PlainPixelsAndExposure) {
    const std::string pixels = pixel(128, 64, 32, 129) + pixel(255, 0, 0, 142);
    EXPECT_FLOAT_EQ(load("x.hdr", header(2, 1) + pixels).radiance.at(0, 0).r, 1.0f);
    EXPECT_FLOAT_EQ(load("x.hdr", header(2, 1) + pixels).radiance.at(1, 0).r, 16320.0f);  // 255 / 256 * 2^14
    const Environment exposed = load("x.hdr", header(2, 1, "EXPOSURE=2\nSOFTWARE=a test\nEXPOSURE= 2.0\n") + pixels);
    EXPECT_FLOAT_EQ(exposed.radiance.at(0, 0).r, 0.25f);
    EXPECT_FLOAT_EQ(exposed.radiance.at(0, 0).g, 0.125f);
    EXPECT_EQ(exposed.radiance.at(0, 0).a, 1.0f);
}

TEST(EnvironmentFile, EveryCutIsRefused) {
    const std::string whole = header(8, 4) + encodedRows();
    for (std::size_t length = 11; length < whole.size(); ++length) {
        const std::string message = refusal(whole.substr(0, length));
        EXPECT_TRUE(contains(message, "as Radiance .hdr")) << length << ": " << message;
    }
    EXPECT_TRUE(contains(refusal(header(2, 1) + pixel(1, 1, 1, 128)), "it is cut off"));
}

TEST(EnvironmentFile, ScanLinesOfNothingEnd) {
    // Runs of length 0 make stb_image 2.27 wait for ever at the end of a file.
    const std::string zeroes = header(32, 16) + std::string{2, 2, 0, 32} + std::string(4000, '\0');
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(contains(refusal(zeroes), "as Radiance .hdr"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    // A run beyond the end of its line.
    EXPECT_TRUE(contains(refusal(header(8, 4) + std::string{2, 2, 0, 8} + std::string(400, char(255))), "damaged"));
}

TEST(EnvironmentFile, HeadersAreJudgedBeforeAnythingIsDecoded) {
    EXPECT_TRUE(contains(refusal(header(16000, 8000)), "16000 x 8000 pixels, the limit is 33554432"));
    EXPECT_TRUE(contains(refusal(header(70000, 35000)), "the limit is 16384 a side"));
    EXPECT_TRUE(contains(refusal(header(8, 8)), "8 x 8 pixels, and a panorama of all directions is twice as wide"));
    EXPECT_TRUE(contains(refusal(header(0, 0)), "its size is 0 x 0"));
    EXPECT_TRUE(
        contains(refusal("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 99999999999999999999 +X 2\n"), "is no size"));
    EXPECT_TRUE(contains(refusal("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 4 +X 8\n"), "do not run from the top left"));
    EXPECT_TRUE(
        contains(refusal("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 8\n"), "its format is '32-bit_rle_xyze'"));
    EXPECT_TRUE(contains(refusal("#?RADIANCE\n\n-Y 4 +X 8\n"), "names no FORMAT"));
    EXPECT_TRUE(contains(refusal("#?RADIANCE\n" + std::string(5000, 'x')), "does not end"));
    EXPECT_TRUE(contains(refusal(header(2, 1, "EXPOSURE=nan\n") + "12345678"), "EXPOSURE is no usable number"));
    EXPECT_TRUE(contains(refusal("hello", "x.hdr"), "neither a Radiance .hdr nor an EXR file"));
}

TEST(EnvironmentFile, ExrWithBadTexels) {
    Image image(8, 4, Format::RGBA32F);
    auto* texels = reinterpret_cast<glm::vec4*>(image.pixels.data());
    for (int i = 0; i < 32; ++i) texels[i] = glm::vec4(0.5f, 2e4f, 0.25f, 1);
    texels[5].r = std::numeric_limits<float>::quiet_NaN();
    texels[6].r = -1;
    const test::TempFolder folder;
    const std::filesystem::path file = folder.path() / "sky.exr";
    writeImage(file, image);
    test::Listener listener;
    const Environment environment = loadEnvironment(file, listener.log);
    EXPECT_EQ(environment.radiance.at(0, 0), glm::vec4(0.5f, 2e4f, 0.25f, 1));
    EXPECT_EQ(environment.radiance.at(5, 0).r, 0);
    EXPECT_EQ(environment.radiance.at(6, 0).r, 0);
    EXPECT_TRUE(contains(listener.text, "1 texel not a number")) << listener.text;
    EXPECT_TRUE(contains(listener.text, "1 texel negative")) << listener.text;
    writeImage(file, Image(4, 4, Format::RGBA32F));
    EXPECT_TRUE(contains(errorOf([&] { loadEnvironment(file, listener.log); }), "4 x 4 pixels"));
}

TEST(EnvironmentFile, SceneDocumentsNameThem) {
    const test::TempFolder folder;
    folder.write("maps/x.hdr", header(8, 4) + encodedRows());
    const auto read = [&](const std::string& text) {
        return readSceneAsset(parseJson(text, "s.scene.json"), folder.path(), {.log = Log(LogLevel::Error)});
    };
    const Scene scene = read(R"({"environment": {"file": "maps/x.hdr", "rotation": 90, "intensity": 3, "visible": false,
        "blur": 0.5}})");
    ASSERT_TRUE(scene.environment);
    EXPECT_EQ(scene.environment->radiance.width, 8u);
    EXPECT_NEAR(scene.environment->rotation, 1.5707963, 1e-6);
    EXPECT_EQ(scene.environment->intensity, 3);
    EXPECT_FALSE(scene.environment->visible);
    EXPECT_EQ(scene.environment->blur, 0.5f);
    const Scene sky = read(R"({"environment": {}, "sky": {"zenith": [1, 2, 3]}})");
    ASSERT_TRUE(sky.environment);
    EXPECT_EQ(sky.environment->name, "sky");
    EXPECT_NEAR(sampleEquirect(sky.environment->radiance, {0, 1, 0}).b, 3, 0.3);
    EXPECT_FALSE(read("{}").environment);
    const auto errorIn = [&](const std::string& text) { return errorOf([&] { read(text); }); };
    EXPECT_TRUE(contains(errorIn(R"({"environment": {"file": "no.hdr"}})"), "no file 'no.hdr'"));
    EXPECT_TRUE(contains(errorIn(R"({"environment": {"blur": 2}})"), "'blur' in the environment is 2"));
    EXPECT_TRUE(contains(errorIn(R"({"environment": {"brightness": 2}})"), "brightness"));
}

}  // namespace
}  // namespace crevice
