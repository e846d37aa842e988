// How a document says the sampling of a picture that it names.
#include "flow/FileTextures.h"

#include <gtest/gtest.h>

#include "SceneTestTools.h"

namespace crevice {
namespace {

TEST(PictureName, IsRepeatedAndLinearWithoutWords) {
    const PictureName plain = readPictureName("folder/noise.png");
    EXPECT_EQ(plain.file, "folder/noise.png");
    EXPECT_EQ(plain.sampler.minFilter, Filter::Linear);
    EXPECT_EQ(plain.sampler.magFilter, Filter::Linear);
    EXPECT_EQ(plain.sampler.wrapU, SamplerWrap::Repeat);
    EXPECT_EQ(plain.sampler.wrapV, SamplerWrap::Repeat);
}

TEST(PictureName, WordsBehindTheMarkCount) {
    const PictureName all = readPictureName("noise.png#nearest,clamp");
    EXPECT_EQ(all.file, "noise.png");
    EXPECT_EQ(all.sampler.minFilter, Filter::Nearest);
    EXPECT_EQ(all.sampler.magFilter, Filter::Nearest);
    EXPECT_EQ(all.sampler.wrapU, SamplerWrap::Clamp);
    EXPECT_EQ(all.sampler.wrapV, SamplerWrap::Clamp);
    const PictureName sides = readPictureName("noise.png#clamp-u,mirror-v,nearest-mag");
    EXPECT_EQ(sides.sampler.wrapU, SamplerWrap::Clamp);
    EXPECT_EQ(sides.sampler.wrapV, SamplerWrap::Mirror);
    EXPECT_EQ(sides.sampler.minFilter, Filter::Linear);
    EXPECT_EQ(sides.sampler.magFilter, Filter::Nearest);
}

TEST(PictureName, AFileMayHaveTheMarkInItsName) {
    const test::TempFolder folder;
    const std::string odd = folder.write("a#b.png", "").string();
    EXPECT_EQ(readPictureName(odd).file, odd);
    EXPECT_EQ(readPictureName(odd + "#nearest").file, odd);
}

TEST(PictureName, AMarkInAFoldersNameIsTheFolders) {
    const PictureName missing = readPictureName("C#/a.png");  // so that it is what "cannot be read" names
    EXPECT_EQ(missing.file, "C#/a.png");
    EXPECT_EQ(missing.sampler.minFilter, Filter::Linear);
    const PictureName sampled = readPictureName("C#/a.png#nearest");
    EXPECT_EQ(sampled.file, "C#/a.png");
    EXPECT_EQ(sampled.sampler.minFilter, Filter::Nearest);
}

TEST(PictureName, AMarkInTheNameOfAMissingFileIsTheFiles) {
    EXPECT_EQ(readPictureName("a#b.png").file, "a#b.png");
    EXPECT_EQ(readPictureName("a#b.png#clamp").file, "a#b.png");
    EXPECT_EQ(readPictureName("a#b.png#clamp").sampler.wrapU, SamplerWrap::Clamp);
}

TEST(PictureName, UnknownWordsAreErrors) {
    for (const char* words : {"blurred", "clamp-w", "nearest-max", "linearly"}) {
        const std::string text = test::errorOf([&] { readPictureName(std::string("noise.png#") + words); });
        EXPECT_TRUE(test::contains(text, "behind picture 'noise.png' says nothing of how it is sampled")) << text;
    }
}

}  // namespace
}  // namespace crevice
