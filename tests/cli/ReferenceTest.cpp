// `crevice reference`: maps, measurements, and what it refuses.
#include "CliTools.h"
#include "core/Image.h"

namespace crevice::cli {
namespace {

class ReferenceTest : public CliTest {};

TEST_F(ReferenceTest, WritesTheSameFloatsEveryTime) {
    const std::string command = "reference crease --size 40x24 --samples 16 -o ";
    const Outcome first = run(command + "a.exr");
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(first.out, "a.exr\n");
    EXPECT_NE(first.err.find("(auto), 16 rays a pixel, standard error 0.0"), std::string::npos) << first.err;
    EXPECT_EQ(run(command + "b.exr -q").err, "");
    const Image map = readImage(path("a.exr"));
    EXPECT_EQ(map.width, 40u);
    EXPECT_EQ(map, readImage(path("b.exr")));
    EXPECT_EQ(run(command + "c.exr --seed 2").code, 0);
    EXPECT_FALSE(map == readImage(path("c.exr")));
    EXPECT_EQ(run(command + "d.png --falloff quadratic --radius 0.5").code, 0);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "b.exr", "c.exr", "d.png"}));
}

// Rays and render choose the same camera from the same options, near, far and shape included.
TEST_F(ReferenceTest, SeesWhatRenderSees) {
    for (const std::string view : {"", " --eye 3,2,4 --target 0,0.5,0 --fov 70", " --ortho 4", " --near 0.5 --far 9"}) {
        const std::string size = " --size 96x64";
        ASSERT_EQ(run("render default -q -o p.png --dump viewDepth=d.exr" + size + view).code, 0);
        const Outcome outcome = run("reference default -q -o t.exr --samples 2 --depth d.exr" + size + view);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_LT(std::stoi(outcome.out), 13) << view << ": " << outcome.out;  // .2 % of 6144 pixels
    }
}

TEST_F(ReferenceTest, MeasuresMaps) {
    ASSERT_EQ(run("reference crease -q --size 32x32 --samples 64 -o a.exr").code, 0);
    ASSERT_EQ(run("reference crease -q --size 32x32 --samples 64 --seed 2 -o b.exr").code, 0);
    const Outcome outcome =
        run("reference crease -q --size 32x32 --samples 64 -o c.exr --measure a.exr --measure b.exr");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> lines = splitWords(outcome.out, '\n');
    ASSERT_GE(lines.size(), 4u);
    EXPECT_NE(lines[0].find("rmse"), std::string::npos);
    EXPECT_NE(lines[1].find("  0.0000   0.0000  +0.0000   0.0000   1.0000   1.0000   0.0000  a.exr"), std::string::npos)
        << lines[1];
    EXPECT_TRUE(lines[2].ends_with("  b.exr")) << lines[2];
    EXPECT_EQ(lines[2].find("  0.0000   0.0000"), std::string::npos) << lines[2];
    EXPECT_EQ(lines[3], "c.exr");
}

TEST_F(ReferenceTest, MistakesAreNamed) {
    expectRefused("reference -o a.exr", "no scene given", "crevice reference crease");
    expectRefused("reference crease", "no output given", "-o truth.exr");
    expectRefused("reference crese -o a.exr", "no scene named 'crese'", "did you mean 'crease'?");
    expectRefused("reference crease -o a.exr --radius 0", "--radius: '0' is out of range", "or auto");
    expectRefused("reference crease -o a.exr --radius wide", "--radius: 'wide' is not a number", "a number");
    expectRefused("reference crease -o a.exr --falloff lineer", "--falloff: 'lineer' is not a falloff",
                  "did you mean 'linear'?");
    expectRefused("reference crease -o a.exr --samples 1", "--samples: '1' is out of range", "from 2");
    expectRefused("reference crease -o a.exr --background red", "unknown option '--background'", "--help");
}

TEST_F(ReferenceTest, MapsOfAnotherSizeAreRefused) {
    ASSERT_EQ(run("reference crease -q --size 8x8 --samples 2 -o small.exr").code, 0);
    expectRefused("reference crease -o a.exr --size 9x8 --measure small.exr",
                  "--measure: 'small.exr' is 8x8 and the reference 9x8", "same --size");
    expectRefused("reference crease -o a.exr --size 9x8 --depth small.exr", "--depth: 'small.exr' is 8x8",
                  "same --size");
}

}  // namespace
}  // namespace crevice::cli
