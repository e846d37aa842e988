// The guard: its key in documents, its pixels, the widened view and what is cropped.
#include <gtest/gtest.h>

#include <random>

#include "PipelineTestTools.h"
#include "core/Image.h"
#include "flow/FrameData.h"
#include "plan/TargetSize.h"

namespace crevice {
namespace {

using test::AssetFolder;
using test::child;
using test::document;
using test::load;
using test::parse;
using test::problemsOf;

std::string withGuard(const std::string& value) { return document("", "", R"(, "guard": )" + value); }

PipelineRequest request(std::map<std::string, std::string> options, std::vector<StageSet> sets = {}) {
    return {.nameOrPath = "", .options = std::move(options), .sets = std::move(sets)};
}

TEST(Guard, IsANumberOrAnOption) {
    EXPECT_EQ(parse(document("", "")).guard, 0);
    EXPECT_EQ(parse(withGuard("12.5")).guard, 12.5);
    EXPECT_EQ(parse(withGuard("\"$level\"")).guard, 0.5);
    EXPECT_EQ(parse(withGuard("\"$level\""), request({{"level", "8"}})).guard, 8);
    EXPECT_EQ(parse(withGuard("\"$level\"")).guardWhere.line, 5) << "the place of use";
}

TEST(Guard, IsInheritedAndTheChildWins) {
    AssetFolder folder;
    folder.pipeline("parent", withGuard("\"$level\""));
    folder.pipeline("same", R"({ "extends": "parent" })");
    folder.pipeline("other", R"({ "extends": "parent", "guard": 30 })");
    EXPECT_EQ(load(folder, "same", request({{"level", "4"}})).guard, 4);
    EXPECT_EQ(load(folder, "other", request({{"level", "4"}})).guard, 30);
}

TEST(Guard, IsSetByChoicesAndTheCaller) {
    const std::string keys = R"("guard": 1, "options": { "wide": { "type": "bool", "default": true,
        "choices": { "true": { "set": { "guard": 25 } } } } })";
    EXPECT_EQ(child(keys).guard, 25);
    EXPECT_EQ(child(keys, request({{"wide", "false"}})).guard, 1);
    EXPECT_EQ(child(keys, request({}, {{"guard", "10"}})).guard, 10);
}

TEST(Guard, BadValuesAreReportedOnce) {
    EXPECT_EQ(problemsOf(withGuard("101")),
              "5:89: 'guard' of the pipeline is 101, out of range | write a number from 0 to 100\n");
    EXPECT_EQ(problemsOf(withGuard("-1")),
              "5:89: 'guard' of the pipeline is -1, out of range | write a number from 0 to 100\n");
    EXPECT_EQ(problemsOf(withGuard("\"wide\"")),
              "5:89: 'guard' of the pipeline must be a number, found a string | "
              "expected: number or \"$option\", 0 … 100\n");
    EXPECT_EQ(problemsOf(withGuard("[10]")),
              "5:89: 'guard' of the pipeline must be a number, found a list | "
              "expected: number or \"$option\", 0 … 100\n");
    EXPECT_EQ(problemsOf(withGuard("\"$mode\"")),
              "5:89: 'guard' of the pipeline must be a number, found 'slow' | "
              "expected: number or \"$option\", 0 … 100\n");
    EXPECT_EQ(problemsOf(withGuard("\"$levle\"")).substr(0, 38), "5:89: '$levle' names no option | did y");
    const std::string set = problemsOf(withGuard("5"), request({}, {{"guard", "200"}}));
    EXPECT_NE(set.find("'guard' of the pipeline is 200, out of range"), std::string::npos) << set;
}

TEST(Guard, FlattenKeepsItOrPutsItsValue) {
    const std::string text = withGuard("\"$level\"");
    const auto flat = [&](FlattenOptions mode) {
        return flattenParsed(text, "t.pipeline.json", AssetRoots({}), request({{"level", "6"}}), mode);
    };
    EXPECT_EQ(flat(FlattenOptions::Keep).find("guard")->string(), "$level");
    EXPECT_EQ(flat(FlattenOptions::Resolve).find("guard")->number(), 6);
    EXPECT_EQ(parse(flattenText(flat(FlattenOptions::Keep))).guard, 6) << "the requested value became the default";
}

TEST(Guard, PixelsAreRoundedUpToFour) {
    EXPECT_EQ(guardPixels(0, 720), 0u);
    EXPECT_EQ(guardPixels(10, 720), 72u);
    EXPECT_EQ(guardPixels(25, 720), 180u);
    EXPECT_EQ(guardPixels(25, 90), 24u);
    EXPECT_EQ(guardPixels(0.1, 90), 4u);
    EXPECT_EQ(guardPixels(100, 91), 92u);
    for (int percent = 0; percent <= 100; ++percent) EXPECT_EQ(guardPixels(percent, 400), unsigned(4 * percent));
}

TEST(Guard, CropIsTheFrameInEveryTarget) {
    TargetDesc target;
    const auto expectCrop = [&](glm::uvec2 offset, glm::uvec2 extent) {
        const FrameCrop crop = frameCrop(target, 1279, 719, 72);
        EXPECT_EQ(crop.offset, offset) << target.scale;
        EXPECT_EQ(crop.extent, extent) << target.scale;
    };
    expectCrop({72, 72}, {1279, 719});
    target.scale = 0.5f;
    expectCrop({36, 36}, {640, 360});
    target.scale = 0.25f;
    expectCrop({18, 18}, {320, 180});
    target.scale = 2;
    expectCrop({144, 144}, {2558, 1438});
    target.size = glm::uvec2(512, 256);
    expectCrop({0, 0}, {512, 256});
    target.size.reset();
    for (int i = 1; i < 400; ++i) {  // Scales at which the border is no whole number of pixels.
        target.scale = 0.01f * static_cast<float>(i);
        const FrameCrop crop = frameCrop(target, 1279, 719, 72);
        const glm::uvec2 whole = targetExtent(target, 1279 + 144, 719 + 144);
        EXPECT_LE(crop.offset.x + crop.extent.x, whole.x) << target.scale;
        EXPECT_LE(crop.offset.y + crop.extent.y, whole.y) << target.scale;
        EXPECT_NEAR(float(crop.offset.x), 72 * target.scale, 1.0f);
    }
}

TEST(Guard, CroppedCopiesThePart) {
    Image image(5, 4, Format::RG8);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<std::byte>(i);
    const Image part = cropped(image, {1, 2}, {3, 2});
    EXPECT_EQ(part.width, 3u);
    EXPECT_EQ(part.height, 2u);
    EXPECT_EQ(part.format, Format::RG8);
    for (std::uint32_t y = 0; y < 2; ++y)
        for (std::uint32_t x = 0; x < 3; ++x) EXPECT_EQ(part.at(x, y), image.at(x + 1, y + 2)) << x << ',' << y;
}

glm::vec2 pixelOf(const FrameView& view, const glm::mat4& projection, const glm::vec4& point) {
    const glm::vec4 clip = projection * point;
    return (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(view.extent);
}

float depthOf(const glm::mat4& projection, const glm::vec4& point) {
    const glm::vec4 clip = projection * point;
    return clip.z / clip.w;
}

TEST(Guard, EveryPointMovesByTheBorder) {
    std::mt19937 random(5);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    for (int i = 0; i < 200; ++i) {
        FrameView view;
        view.extent = {unsigned(uniform(20, 2000)), unsigned(uniform(20, 2000))};
        view.camera.orthographic = i % 2 == 1;
        view.camera.fovY = uniform(0.2f, 2.2f);
        view.camera.orthoHeight = uniform(0.5f, 20);
        view.camera.lensShift = {uniform(-1, 1), uniform(-1, 1)};
        view.camera.near = 0.5f;
        view.camera.far = 100;
        view.projection = view.camera.projection(float(view.extent.x) / float(view.extent.y));
        const auto guard = 4 * unsigned(uniform(1, 100));
        const FrameView wide = guardedView(view, guard);
        EXPECT_EQ(wide.extent, view.extent + 2 * guard);
        // The camera that stages see is the widened one, too.
        const glm::mat4 again = wide.camera.projection(float(wide.extent.x) / float(wide.extent.y));
        for (int p = 0; p < 20; ++p) {
            const glm::vec4 point(uniform(-3, 3), uniform(-3, 3), uniform(-50, -1), 1);
            const glm::vec2 expected = pixelOf(view, view.projection, point) + float(guard);
            const float tolerance = 1e-5f * (glm::length(expected) + float(wide.extent.x + wide.extent.y));
            EXPECT_LT(glm::distance(pixelOf(wide, wide.projection, point), expected), tolerance);
            EXPECT_LT(glm::distance(pixelOf(wide, again, point), expected), tolerance);
            EXPECT_EQ(depthOf(wide.projection, point), depthOf(view.projection, point));
        }
    }
}

TEST(Guard, NoneLeavesTheViewAsItIs) {
    FrameView view;
    view.projection = view.camera.projection(1.5f);
    const FrameView same = guardedView(view, 0);
    EXPECT_EQ(same.extent, view.extent);
    EXPECT_EQ(same.projection, view.projection);
}

}  // namespace
}  // namespace crevice
