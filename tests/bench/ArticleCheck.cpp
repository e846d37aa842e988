// The kernel is made again from the seed that ssao-deferred gives the stage.
#include "ArticleCheck.h"

#include <cstdlib>

#include "ProcessClock.h"
#include "stages/SsaoKernel.h"

namespace crevice::bench {
namespace {

constexpr std::uint32_t kSeed = 7;      // "seed" of SsaoStage in assets/pipelines/ssao-deferred.pipeline.json
constexpr float kArticleRadius = 1.0f;  // world units

std::vector<glm::vec4> decoded(const Image& image) {
    std::vector<glm::vec4> result;
    result.reserve(std::size_t(image.width) * image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) result.push_back(image.at(x, y));
    }
    return result;
}

}  // namespace

ArticleCheck::ArticleCheck(BenchCase& article) : kernel_(kSsaoMaxSamples) {
    article.run({"cc_gbuffer_positionMap", "cc_gbuffer_normalMap", "cc_ssaoMap"});
    positions_ = decoded(article.target("cc_gbuffer_positionMap"));
    normals_ = decoded(article.target("cc_gbuffer_normalMap"));
    shaderMap_ = article.target("cc_ssaoMap");
    makeSsaoKernel(SsaoKernelKind::Article, kSeed, kernel_);
    const Camera camera = article.camera();
    const float aspect = static_cast<float>(shaderMap_.width) / static_cast<float>(shaderMap_.height);
    input_ = {.width = shaderMap_.width,
              .height = shaderMap_.height,
              .positions = positions_,
              .normals = normals_,
              .kernel = kernel_,
              .view = camera.view,
              .projection = camera.projection(aspect),
              .far = camera.far,
              .radius = kArticleRadius};
}

double ArticleCheck::run() {
    ProcessStopwatch watch;
    picture_ = articleLoop(input_);
    return watch.lap();
}

double ArticleCheck::difference() const {
    double sum = 0;
    for (std::size_t i = 0; i < picture_.size(); ++i)
        sum += std::abs(int(picture_[i]) - std::to_integer<int>(shaderMap_.pixels[i]));
    return sum / static_cast<double>(picture_.size());
}

}  // namespace crevice::bench
