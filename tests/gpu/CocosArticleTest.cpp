// The article's project runs unmodified in both G-buffer profiles and gives the pictures of our own form of it.
#include "CocosFixture.h"

#include <cmath>

namespace crevice {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

// Sizes are powers of two: texture coordinates of the quad's two triangles and of our one are then exact and equal, and
// with them the article's hash of their lowest bits.
constexpr std::uint32_t kWidth = 256, kHeight = 128;

struct Difference {
    double mean = 0;
    float most = 0;
    int beyond = 0;  ///< Pixels that differ by more than 1/255.
};

Difference differenceOf(const Image& a, const Image& b, int channels) {
    Difference result;
    for (std::uint32_t y = 0; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) {
            float most = 0;
            for (int c = 0; c < channels; ++c) most = std::max(most, std::abs(a.at(x, y)[c] - b.at(x, y)[c]));
            result.mean += double(most) / (double(a.width) * a.height);
            result.most = std::max(result.most, most);
            result.beyond += most > 1.001f / 255.0f ? 1 : 0;
        }
    }
    return result;
}

double meanOf(const Image& image) {
    double sum = 0;
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) sum += double(image.at(x, y).x);
    return sum / (double(image.width) * image.height);
}

struct Pictures {
    Image picture, occlusion;
};

class CocosArticle : public CocosTest {
protected:
    Pictures render() {
        View view = sized(kWidth, kHeight);
        view.keep = {"cc_ssaoMap"};
        Image picture = renderer_->render(view);
        return {std::move(picture), renderer_->target("cc_ssaoMap")};
    }
    /// Our own form of it, without the shadows and the smoothing that the project does not have.
    Pictures ours(const Scene& scene) {
        load("ssao-deferred", {{"form", "article"}, {"shadows", "false"}, {"fxaa", "false"}},
             {{"SsaoStage.material.radius", "1"}});
        renderer_->setScene(scene);
        return render();
    }
    Pictures cocos(const std::string& article, const Scene& scene) {
        loadArticle(article);
        renderer_->setScene(withEffects(scene));
        return render();
    }
    void save(const char* name, const Image& image) const {
        if (const char* folder = std::getenv("CREVICE_PICTURES"))
            writeImage(std::filesystem::path(folder) / name, image);
    }
};

TEST_F(CocosArticle, OfVersion33IsOurArticleForm) {
    const Pictures reference = ours(cloister());
    const Pictures here = cocos("article-v33", cloister());
    save("v33.png", here.picture);
    save("v33-ao.png", here.occlusion);
    save("ours.png", reference.picture);
    EXPECT_LT(meanOf(here.occlusion), 0.95);  // there is occlusion to compare
    EXPECT_GT(meanOf(here.picture), 0.1);
    EXPECT_EQ(differenceOf(here.occlusion, reference.occlusion, 1).beyond, 0);
    const Difference picture = differenceOf(here.picture, reference.picture, 3);
    EXPECT_EQ(picture.beyond, 0) << picture.most * 255;
}

TEST_F(CocosArticle, OfVersion36IsThatFromDepth) {
    const Pictures reference = ours(cloister());
    const Pictures here = cocos("article-v36", cloister());
    save("v36.png", here.picture);
    save("v36-ao.png", here.occlusion);
    // Positions come from depth instead of half floats and normals are folded: single points of a kernel of 64 change
    // sides, so that it is the average and the blurred picture that agree.
    EXPECT_NEAR(meanOf(here.occlusion), meanOf(reference.occlusion), 0.01);
    EXPECT_LT(differenceOf(here.picture, reference.picture, 3).mean, 1.5 / 255);
    // D16: the lighting's sampler is the material's, and nobody gives it one.
    EXPECT_THAT(takeWarnings(),
                Contains(HasSubstr("'cc_ssaoMap' of effect 'pipeline/ssao-lighting' belongs to the material")));
    // D14: the queue behind the lighting has the phase "".
    EXPECT_THAT(importWarnings_, Contains(HasSubstr("draws nothing: its phases are ['']")));
}

TEST_F(CocosArticle, OcclusionReachesTheLightingOnlyByTheFallbackInVersion36) {
    Scene scene = cloister();
    const Pictures with = cocos("article-v36", scene);
    takeWarnings();
    renderer_ = makeRenderer();
    loadArticle("article-v36", {}, "\"profile\": \"cocos-3.6\"",
                "\"profile\": \"cocos-3.6\", \"fallbacks\": { \"globalSamplers\": false }");
    renderer_->setScene(withEffects(scene));
    const Pictures without = render();
    takeWarnings();
    // Without it the lighting takes the checker of 221 and 85 for the map, as Cocos does: another picture.
    EXPECT_EQ(differenceOf(with.occlusion, without.occlusion, 1).beyond, 0);
    EXPECT_GT(differenceOf(with.picture, without.picture, 3).beyond, 1000);
}

TEST_F(CocosArticle, FollowsTheFramesSizeAndEachCameraHasItsOwnOcclusion) {
    // D20, and the article's "editor preview is wrong": one target for all cameras, never made anew.
    for (const char* article : kBoth) {
        renderer_ = makeRenderer();
        loadArticle(article);
        renderer_->setScene(withEffects(cloister()));
        View large = sized(128, 64), small = sized(64, 64);
        small.camera = Camera::lookAt({0, 2, -2}, {2, 1, -9});
        large.keep = small.keep = {"cc_ssaoMap"};
        const Image first = renderer_->render(large);
        renderer_->render(small);
        EXPECT_EQ(renderer_->target("cc_ssaoMap").width, 64u);
        EXPECT_EQ(renderer_->render(large), first) << article;
        EXPECT_EQ(renderer_->target("cc_ssaoMap").width, 128u);
        takeWarnings();
    }
}

}  // namespace
}  // namespace crevice
