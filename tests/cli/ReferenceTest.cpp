// `crevice reference`: maps, measurements, and what it refuses.
#include <random>

#include "CliTools.h"
#include "core/Image.h"

namespace crevice::cli {
namespace {

class ReferenceTest : public CliTest {};

TEST_F(ReferenceTest, WritesTheSameFloatsEveryTime) {
    const std::string command = "reference crease --no-cache --size 40x24 --samples 16 -o ";
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
    ASSERT_GE(lines.size(), 7u) << outcome.out;
    EXPECT_NE(lines[0].find("rmse"), std::string::npos);
    EXPECT_NE(lines[1].find("  0.0000   0.0000  +0.0000   0.0000   1.0000   1.0000   0.0000  a.exr"), std::string::npos)
        << lines[1];
    EXPECT_TRUE(lines[2].ends_with("  b.exr")) << lines[2];
    EXPECT_EQ(lines[2].find("  0.0000   0.0000"), std::string::npos) << lines[2];
    EXPECT_NE(lines[3].find("corrected     ssim    slope   offset"), std::string::npos) << lines[3];
    EXPECT_NE(lines[4].find("   0.0000   1.0000   1.0000  +0.0000   0.0000"), std::string::npos) << lines[4];
    EXPECT_EQ(lines[6], "c.exr");
}

// The seed is one that no other test has, so that the first run finds nothing.
TEST_F(ReferenceTest, TheSecondRunComesFromTheCache) {
    const std::string seed = std::to_string(std::random_device()());
    const std::string command = "reference crease --size 24x16 --samples 16 --seed " + seed + " -o ";
    const Outcome first = run(command + "a.exr");
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(first.err.find("from the cache"), std::string::npos) << first.err;
    const Outcome second = run(command + "b.exr");
    EXPECT_NE(second.err.find(", from the cache"), std::string::npos) << second.err;
    EXPECT_EQ(readImage(path("a.exr")), readImage(path("b.exr")));
    const Outcome third = run(command + "c.exr --no-cache");
    EXPECT_EQ(third.err.find("from the cache"), std::string::npos) << third.err;
    EXPECT_EQ(readImage(path("a.exr")), readImage(path("c.exr")));
}

TEST_F(ReferenceTest, OneRunWritesSeveralMaps) {
    const std::string rest = " -q --no-cache --size 24x16 --samples 16";
    const Outcome outcome =
        run("reference crease -o t-{radius}-{falloff}.exr --radius 0.2 --radius 0.6 --falloff hard "
            "--falloff matched:hbao" +
            rest);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> names = {"t-0.2-hard.exr", "t-0.2-matched-hbao.exr", "t-0.6-hard.exr",
                                            "t-0.6-matched-hbao.exr"};
    EXPECT_EQ(files(), names);
    for (std::size_t i = 1; i < names.size(); ++i)
        EXPECT_FALSE(readImage(path(names[0])) == readImage(path(names[i]))) << names[i];
    ASSERT_EQ(run("reference crease -o one.exr --radius 0.6 --falloff matched:hbao" + rest).code, 0);
    EXPECT_EQ(readImage(path("one.exr")), readImage(path(names[3])));
}

// The depth buffer tells all of what a picture of an open crease needs: the floor is near the truth.
TEST_F(ReferenceTest, Heightfields) {
    const std::string rest = " -q --no-cache --size 48x32 --samples 256 --slices 16 --heightfield h.exr";
    const Outcome outcome = run("reference crease -o t.exr" + rest);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(files(), (std::vector<std::string>{"h.exr", "t.exr"}));
    EXPECT_NE(outcome.out.find("  (heightfield)\n"), std::string::npos) << outcome.out;
    const Outcome measured = run("reference crease -o t.exr --measure h.exr" + rest);
    EXPECT_NE(measured.out.find("estimator  map\n   0.0000  h.exr\n"), std::string::npos) << measured.out;
    const std::string other = " -q --no-cache --size 48x32 --samples 2 --slices 16 --heightfield i.exr";
    ASSERT_EQ(run("reference crease -o t.exr --thickness infinite" + other).code, 0);
    EXPECT_FALSE(readImage(path("h.exr")) == readImage(path("i.exr")));
}

TEST_F(ReferenceTest, MistakesAreNamed) {
    expectRefused("reference -o a.exr", "no scene given", "crevice reference crease");
    expectRefused("reference crease", "no output given", "-o truth.exr");
    expectRefused("reference crese -o a.exr", "no scene named 'crese'", "did you mean 'crease'?");
    expectRefused("reference crease -o a.exr --radius 0", "--radius: '0' is out of range", "or auto");
    expectRefused("reference crease -o a.exr --radius wide", "--radius: 'wide' is not a number", "a number");
    expectRefused("reference crease -o a.exr --falloff lineer", "--falloff: 'lineer' is not a falloff",
                  "did you mean 'linear'?");
    expectRefused("reference crease -o a.exr --falloff matched:gtoa", "--falloff: 'matched:gtoa' is not a falloff",
                  "did you mean 'matched:gtao'");
    expectRefused("reference crease -o a.exr --radius 1 --radius 2", "-o: two maps would both be written to 'a.exr'",
                  "{radius}");
    expectRefused("reference crease -o a.exr --thickness -1", "--thickness: '-1' is out of range", "infinite");
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
