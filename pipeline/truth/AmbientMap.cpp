// What a traced map says of itself, and which of its pixels count.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "truth/AmbientReference.h"

namespace crevice {
namespace {

constexpr float kDepthTolerance = 1e-3f;

}  // namespace

std::size_t AmbientMap::countedCount() const {
    return static_cast<std::size_t>(std::count(isCounted.begin(), isCounted.end(), std::uint8_t{1}));
}

double AmbientMap::countedNoise(std::size_t layer) const {
    const std::vector<float>&first = layers[layer].first, &second = layers[layer].second;
    double squares = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < isCounted.size(); ++i) {
        if (!isCounted[i]) continue;
        const double difference = double(first[i]) - double(second[i]);
        squares += difference * difference;
        ++count;
    }
    // The mean of two halves has a quarter of the variance of their difference.
    return count > 0 ? std::sqrt(squares / (4.0 * static_cast<double>(count))) : 0;
}

Image AmbientMap::toImage(std::size_t layer) const {
    const std::vector<float>& openness = layers[layer].openness;
    Image image(size.x, size.y, Format::R32F);
    std::memcpy(image.pixels.data(), openness.data(), openness.size() * sizeof(float));
    return image;
}

std::size_t excludeOtherSurfaces(AmbientMap& map, const Image& viewDepth) {
    assert(viewDepth.width == map.size.x && viewDepth.height == map.size.y);
    std::size_t excluded = 0;
    for (std::uint32_t y = 0; y < map.size.y; ++y) {
        for (std::uint32_t x = 0; x < map.size.x; ++x) {
            const std::size_t pixel = std::size_t(y) * map.size.x + x;
            const float traced = map.viewDepth[pixel];
            if (std::abs(viewDepth.at(x, y).x - traced) <= kDepthTolerance * traced) continue;
            map.isCounted[pixel] = 0;
            ++excluded;
        }
    }
    return excluded;
}

}  // namespace crevice
