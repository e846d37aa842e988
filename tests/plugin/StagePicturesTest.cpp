// What the stages of users draw, pixel by pixel: the outline plugin, the tutorial's stages, the library's example.
#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "PackageTools.h"
#include "core/Files.h"

namespace crevice::package {
namespace {

double smoothstep(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// The criterion of outline.effect on the dumped targets, in double precision.
class Edges {
public:
    Edges(const Image& depth, const Image& normal, int reach, double depthJump, double angleDegrees)
        : depth_(depth),
          normal_(normal),
          reach_(reach),
          jump_(depthJump),
          cosine_(std::cos(angleDegrees * M_PI / 180)) {}

    enum Answer { kNo, kYes, kTooCloseToSay };
    Answer at(int x, int y) const {
        Answer answer = kNo;
        for (const glm::ivec2 offset : {glm::ivec2(reach_, 0), glm::ivec2(0, reach_)}) {
            const glm::ivec2 pixel(x, y);
            const double own = 1.0 / depth(pixel);
            const double jump = std::abs(1 / depth(pixel - offset) + 1 / depth(pixel + offset) - 2 * own) / own;
            for (const Answer one : {compare(jump, jump_), bend(pixel, pixel - offset), bend(pixel, pixel + offset)}) {
                if (one == kYes || answer == kNo) answer = answer == kYes ? kYes : one;
            }
        }
        return answer;
    }

private:
    static Answer compare(double value, double limit) {
        if (std::abs(value - limit) < 1e-3) return kTooCloseToSay;
        return value > limit ? kYes : kNo;
    }
    Answer bend(glm::ivec2 a, glm::ivec2 b) const {
        if (depth(a) >= 1e8 || depth(b) >= 1e8) return kNo;
        return compare(-glm::dot(glm::dvec3(at(normal_, a)), glm::dvec3(at(normal_, b))), -cosine_);
    }
    double depth(glm::ivec2 pixel) const { return at(depth_, pixel).r; }
    static glm::vec4 at(const Image& image, glm::ivec2 pixel) {
        pixel = glm::clamp(pixel, glm::ivec2(0), glm::ivec2(image.width, image.height) - 1);
        return image.at(std::uint32_t(pixel.x), std::uint32_t(pixel.y));
    }

    const Image& depth_;
    const Image& normal_;
    int reach_;
    double jump_, cosine_;
};

struct LineCount {
    int drawn = 0, undecided = 0;
};

/// Off the lines `after` has the bytes of `before`; on them the colour at its opacity.
LineCount checkLines(const Image& before, const Image& after, const Edges& edges, const glm::vec4& color) {
    LineCount count;
    int wrong = 0;
    for (std::uint32_t y = 0; y < before.height; ++y) {
        for (std::uint32_t x = 0; x < before.width; ++x) {
            const Edges::Answer edge = edges.at(int(x), int(y));
            count.drawn += edge == Edges::kYes;
            count.undecided += edge == Edges::kTooCloseToSay;
            if (edge == Edges::kTooCloseToSay) continue;
            for (int c = 0; c < 3; ++c) {
                const int old = byteAt(before, x, y, c), now = byteAt(after, x, y, c);
                const double line = old + (double(color[c]) * 255 - old) * double(color.a);
                wrong += edge == Edges::kYes ? std::abs(now - line) > 1.0 : now != old;
            }
        }
    }
    EXPECT_EQ(wrong, 0);
    return count;
}

TEST(OutlinePlugin, TwoEntriesOfOneClassDrawTheirOwnLinesAndNothingElse) {
    const Outcome outcome = crevice(
        "outline",
        "render crease -p outline.pipeline.json --plugin build/liboutline.so --size 320x180 --validate -o outlined.png "
        "--dump finalColor=before.png --dump inked=inked.png --dump viewDepth=depth.exr "
        "--dump cc_gbuffer_normalMap=normal.exr");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(outcome.text.find("warning"), std::string::npos) << outcome.text;
    const Image depth = picture("outline/depth.exr"), normal = picture("outline/normal.exr");
    const Image before = picture("outline/before.png"), inked = picture("outline/inked.png");
    const int pixels = int(before.width * before.height);

    const LineCount ink = checkLines(before, inked, Edges(depth, normal, 1, 0.1, 40), {0.1f, 0.1f, 0.15f, 0.8f});
    EXPECT_GT(ink.drawn, 500);
    EXPECT_LT(ink.drawn, pixels / 4);
    EXPECT_LT(ink.undecided, pixels / 100);

    const LineCount silhouette =
        checkLines(inked, picture("outline/outlined.png"), Edges(depth, normal, 3, 0.5, 180), {0.9f, 0.3f, 0.1f, 1});
    EXPECT_GT(silhouette.drawn, 500);
    EXPECT_LT(silhouette.drawn, pixels / 4);
    EXPECT_LT(silhouette.undecided, pixels / 100);
}

TEST(OutlinePlugin, TransparentLinesLeaveThePictureOfTheParent) {
    const Outcome with =
        crevice("outline",
                "render crease -p outline.pipeline.json --plugin-path build --size 160x90 -o clear.png "
                "--set Ink.params.color=[0,0,0,0] --set Silhouette.color=[1,1,1,0]");
    ASSERT_EQ(with.code, 0) << with.text;
    const Outcome parent = crevice("outline", "render crease -p ssao-deferred --size 160x90 -o parent.png");
    ASSERT_EQ(parent.code, 0) << parent.text;
    EXPECT_EQ(picture("outline/clear.png"), picture("outline/parent.png"));
}

TEST(OutlinePlugin, SaysWhereItsClassComesFrom) {
    const Outcome outcome = crevice("outline", "stages OutlineStage --plugin build/liboutline.so");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    for (const char* words : {"OutlineStage: Lines along edges.", "from build/liboutline.so", "1 … 8", "pixels"})
        EXPECT_NE(outcome.text.find(words), std::string::npos) << words << "\n" << outcome.text;
}

TEST(Tutorial, VignetteDarkensByItsFormula) {
    const Image before = picture("stages/before.png"), after = picture("stages/vignette.png");
    ASSERT_EQ(after.width, 320u);
    ASSERT_EQ(after.height, 180u);
    int darkest = 0;
    for (std::uint32_t y = 0; y < after.height; ++y) {
        for (std::uint32_t x = 0; x < after.width; ++x) {
            const double d = std::hypot((x + 0.5) / after.width - 0.5, (y + 0.5) / after.height - 0.5);
            const double factor = 1 - 0.4 * smoothstep(0.3, 0.8, d);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(byteAt(after, x, y, c), byteAt(before, x, y, c) * factor, 0.6) << x << "," << y;
                darkest = std::max(darkest, byteAt(before, x, y, c) - byteAt(after, x, y, c));
            }
        }
    }
    EXPECT_GT(darkest, 20) << "the corners are darker";
    EXPECT_LT(byteAt(picture("stages/strong.png"), 0, 0, 0), byteAt(after, 0, 0, 0)) << "--set reaches the effect";
}

TEST(Tutorial, LetterboxLeavesTheMiddleAsItWas) {
    const Image before = picture("stages/unboxed.png"), after = picture("stages/linked.png");
    const std::uint32_t bar = 10;  // (180 - 320 / 2.0) / 2
    int wrong = 0;
    for (std::uint32_t y = 0; y < after.height; ++y) {
        for (std::uint32_t x = 0; x < after.width; ++x) {
            const bool isBar = y < bar || y >= after.height - bar;
            for (int c = 0; c < 3; ++c) wrong += byteAt(after, x, y, c) != (isBar ? 0 : byteAt(before, x, y, c));
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(byteAt(before, 0, 0, 2) + byteAt(before, 160, 175, 1), 0) << "there was something to cover";
}

TEST(Tutorial, LinkedStageAndPluginDrawTheSame) {
    EXPECT_EQ(picture("stages/linked.png"), picture("stages/plugin.png"));
}

TEST(Tutorial, HeightsAreThoseOfTheGeometry) {
    const Outcome outcome =
        crevice("stages",
                "render crease -p deferred --size 320x180 -o unused.png --dump cc_gbuffer_positionMap=positions.exr "
                "--dump viewDepth=depth.exr");
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const Image heights = picture("stages/heights.png"), positions = picture("stages/positions.exr");
    const Image depth = picture("stages/depth.exr");
    std::set<int> levels;
    int sky = 0;
    for (std::uint32_t y = 0; y < heights.height; ++y) {
        for (std::uint32_t x = 0; x < heights.width; ++x) {
            if (depth.at(x, y).r > 1e8f) {
                ++sky;
                ASSERT_EQ(heights.at(x, y), glm::vec4(0, 0, 1, 1)) << x << "," << y;
                continue;
            }
            // Positions are 16-bit floats: half a step below 4 is 1/1024.
            const double expected = std::clamp(positions.at(x, y).g / 1.5, 0.0, 1.0) * 255;
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(byteAt(heights, x, y, c), expected, 0.8) << x << "," << y;
            levels.insert(byteAt(heights, x, y, 0));
        }
    }
    EXPECT_GT(levels.size(), 100u);
    EXPECT_GT(sky, 0);
}

TEST(Tutorial, ShowsTheErrorThatIsPrinted) {
    std::string text = readText(work() / "stages/ssao-vignette.pipeline.json");
    const std::string right = "\"strength\": 0.4";
    ASSERT_NE(text.find(right), std::string::npos);
    text.replace(text.find(right), right.size(), "\"strength\": 4");
    std::filesystem::create_directories(work() / "mistake");
    writeFileAtomically(work() / "mistake/ssao-vignette.pipeline.json", text);
    std::filesystem::copy_file(work() / "stages/vignette.effect", work() / "mistake/vignette.effect",
                               std::filesystem::copy_options::overwrite_existing);
    const Outcome outcome = crevice("mistake", "validate ssao-vignette.pipeline.json");
    EXPECT_EQ(outcome.code, 2);
    for (const char* line : {"ssao-vignette.pipeline.json:8:109: error: property 'strength' is 4, outside its range",
                             "help: give 0 to 1"}) {
        EXPECT_NE(outcome.text.find(line), std::string::npos) << outcome.text;
        EXPECT_NE(readText(std::filesystem::path(CREVICE_TEST_SOURCE_DIR) / "docs/writing-a-stage.md").find(line),
                  std::string::npos)
            << "the tutorial shows: " << line;
    }
}

TEST(ComputeStage, EveryPixelIsTheMeanOfNine) {
    const Image before = picture("compute/before.png"), after = picture("compute/averaged.png");
    ASSERT_EQ(after.width, 333u);
    ASSERT_EQ(after.height, 177u);
    bool changed = false;
    for (int y = 0; y < 177; ++y) {
        for (int x = 0; x < 333; ++x) {
            for (int c = 0; c < 3; ++c) {
                int sum = 0;
                for (int i = 0; i < 9; ++i) {
                    sum += byteAt(before, std::uint32_t(std::clamp(x + i % 3 - 1, 0, 332)),
                                  std::uint32_t(std::clamp(y + i / 3 - 1, 0, 176)), c);
                }
                ASSERT_NEAR(byteAt(after, std::uint32_t(x), std::uint32_t(y), c), sum / 9.0, 0.6) << x << "," << y;
                changed = changed || sum != 9 * byteAt(before, std::uint32_t(x), std::uint32_t(y), c);
            }
        }
    }
    EXPECT_TRUE(changed);
}

TEST(Library, RendersSeveralCamerasAndSizes) {
    const Image first = picture("library/view0.png"), above = picture("library/view1.png");
    EXPECT_EQ(first.width, 320u);
    EXPECT_EQ(first.height, 180u);
    EXPECT_EQ(above.width, 200u);
    EXPECT_EQ(above.height, 240u);
    EXPECT_EQ(first, picture("library/view2.png")) << "a view does not depend on those before it";
    // In both the camera looks at the ball, which is red; the floor is grey.
    for (const Image* image : {&first, &above}) {
        const std::uint32_t x = image->width / 2, y = image->height / 2;
        EXPECT_GT(byteAt(*image, x, y, 0), byteAt(*image, x, y, 1) + 20);
        EXPECT_GT(byteAt(*image, x, y, 0), byteAt(*image, x, y, 2) + 20);
    }
    const std::uint32_t floor = first.height - 5;
    EXPECT_NEAR(byteAt(first, 160, floor, 0), byteAt(first, 160, floor, 2), 3);
    EXPECT_GT(byteAt(first, 160, floor, 0), 30);
}

}  // namespace
}  // namespace crevice::package
