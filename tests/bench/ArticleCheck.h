// The yardstick applied to a rendered frame: the loop runs on the targets that the article's shader read.
#pragma once

#include "ArticleLoop.h"
#include "Cases.h"

namespace crevice::bench {

class ArticleCheck {
public:
    /// Renders one frame of the article's case and keeps its targets.
    explicit ArticleCheck(BenchCase& article);

    /// Runs the loop once; returns its milliseconds.
    double run();
    /// Mean difference of the last run's picture from the shader's, in 1/255.
    double difference() const;

private:
    std::vector<glm::vec4> positions_, normals_, kernel_;
    Image shaderMap_;
    ArticleInput input_;
    std::vector<std::uint8_t> picture_;
};

}  // namespace crevice::bench
