// Sums run in double, row by row, so that the result is the same everywhere.
#include "app/commands/ImageDifference.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crevice {
namespace {

double differenceOf(float a, float b) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    if (a == b) return 0;  // equal infinities as well
    const double difference = std::abs(static_cast<double>(a) - static_cast<double>(b));
    return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

template <class Visit>
void visitPixels(const Image& a, const Image& b, Visit&& visit) {
    for (std::uint32_t y = 0; y < a.height; ++y) {
        for (std::uint32_t x = 0; x < a.width; ++x) visit(x, y, a.at(x, y), b.at(x, y));
    }
}

}  // namespace

double ImageDifference::psnr() const {
    return rmse > 0 ? -20.0 * std::log10(rmse) : std::numeric_limits<double>::infinity();
}

ImageDifference compareImages(const Image& a, const Image& b, int colours) {
    ImageDifference result;
    result.colours = colours;
    std::array<double, 4> squares{};
    visitPixels(a, b, [&](std::uint32_t, std::uint32_t, const glm::vec4& left, const glm::vec4& right) {
        for (int c = 0; c < 4; ++c) {
            if (c >= colours && c < 3) continue;
            const auto i = static_cast<std::size_t>(c);
            const double difference = differenceOf(left[c], right[c]);
            squares[i] += difference * difference;
            result.meanAbs[i] += difference;
            result.max = std::max(result.max, difference);
        }
        result.alphaCounts = result.alphaCounts || left.a != 1.0f || right.a != 1.0f;
    });
    const double pixels = static_cast<double>(a.width) * a.height;
    const double sum = squares[0] + squares[1] + squares[2] + (result.alphaCounts ? squares[3] : 0);
    result.rmse = std::sqrt(sum / (pixels * (colours + (result.alphaCounts ? 1 : 0))));
    for (double& mean : result.meanAbs) mean /= pixels;
    return result;
}

Image makeHeatImage(const Image& a, const Image& b, double max) {
    Image heat(a.width, a.height, Format::RGBA8);
    visitPixels(a, b, [&](std::uint32_t x, std::uint32_t y, const glm::vec4& left, const glm::vec4& right) {
        double largest = 0;
        for (int c = 0; c < 4; ++c) largest = std::max(largest, differenceOf(left[c], right[c]));
        const double part = std::isinf(largest) ? 1 : max > 0 ? std::min(largest / max, 1.0) : 0;
        std::byte* pixel = heat.pixel(x, y);
        for (int c = 0; c < 3; ++c) {  // red fills up first, then green, then blue
            pixel[c] = static_cast<std::byte>(std::clamp(part * 3 - c, 0.0, 1.0) * 255 + 0.5);
        }
        pixel[3] = std::byte{255};
    });
    return heat;
}

}  // namespace crevice
