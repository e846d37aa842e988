// Regions are masks over the picture, made from the depth; every error is one RMSE over such a mask.
#include "truth/PictureMetrics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "truth/DepthContinuity.h"

namespace crevice {
namespace {

constexpr int kEdgeReach = 4;    // pixels
constexpr int kMedianReach = 2;  // 5x5
constexpr float kFlatRange = 0.1f;
constexpr float kContactTruth = 0.5f;

/// Values by place, and the walk over a pixel's surroundings inside the picture.
struct Grid {
    glm::ivec2 size;
    explicit Grid(const glm::uvec2& extent) : size(extent) {}
    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(size.x) + std::size_t(x); }
    bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < size.x && y < size.y; }
    template <class Visit>
    void around(int x, int y, int reach, Visit&& visit) const {
        for (int v = std::max(0, y - reach); v <= std::min(size.y - 1, y + reach); ++v)
            for (int u = std::max(0, x - reach); u <= std::min(size.x - 1, x + reach); ++u) visit(u, v);
    }
    template <class Visit>
    void all(Visit&& visit) const {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) visit(x, y);
    }
};

float finite(float value) { return std::isfinite(value) ? value : 0.0f; }

RegionError errorWhere(const PictureInput& input, const std::vector<std::uint8_t>& region) {
    RegionError result;
    double squares = 0;
    for (std::size_t i = 0; i < region.size(); ++i) {
        if (!region[i] || (!input.isCounted.empty() && !input.isCounted[i])) continue;
        const double e = double(finite(input.map[i])) - double(input.truth[i]);
        squares += e * e;
        ++result.count;
    }
    if (result.count > 0) result.rmse = std::sqrt(squares / static_cast<double>(result.count));
    return result;
}

std::vector<std::uint8_t> grow(const Grid& grid, const std::vector<std::uint8_t>& mask, int reach) {
    std::vector<std::uint8_t> grown(mask.size(), 0);
    grid.all([&](int x, int y) {
        if (!mask[grid.at(x, y)]) return;
        grid.around(x, y, reach, [&](int u, int v) { grown[grid.at(u, v)] = 1; });
    });
    return grown;
}

/// Flat: the whole 5x5 counts and knows no depth edge, and its truth hardly changes.
bool isFlat(const PictureInput& input, const Grid& grid, const std::vector<std::uint8_t>& edges, int x, int y) {
    if (!grid.contains(x - kMedianReach, y - kMedianReach) || !grid.contains(x + kMedianReach, y + kMedianReach))
        return false;
    bool flat = true;
    float low = 1e30f, high = -1e30f;
    grid.around(x, y, kMedianReach, [&](int u, int v) {
        const std::size_t i = grid.at(u, v);
        flat = flat && (input.isCounted.empty() || input.isCounted[i]) && (edges.empty() || !edges[i]);
        low = std::min(low, input.truth[i]);
        high = std::max(high, input.truth[i]);
    });
    return flat && high - low <= kFlatRange;
}

void measureNoise(const PictureInput& input, const Grid& grid, const std::vector<std::uint8_t>& flat,
                  PictureMetrics& result) {
    double sum = 0, squares = 0;
    grid.all([&](int x, int y) {
        if (!flat[grid.at(x, y)]) return;
        std::array<float, 25> values;
        std::size_t count = 0;
        grid.around(x, y, kMedianReach, [&](int u, int v) { values[count++] = finite(input.map[grid.at(u, v)]); });
        std::nth_element(values.begin(), values.begin() + 12, values.end());
        const double off = double(finite(input.map[grid.at(x, y)])) - double(values[12]);
        sum += off;
        squares += off * off;
        ++result.flatCount;
    });
    if (result.flatCount == 0) return;
    const auto n = static_cast<double>(result.flatCount);
    result.noise = std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)));
}

}  // namespace

float projectedPixels(const Camera& camera, const glm::uvec2& size, float length, float viewDepth) {
    const float height = camera.orthographic ? camera.orthoHeight : 2 * std::tan(0.5f * camera.fovY) * viewDepth;
    return length * static_cast<float>(size.y) / height;
}

std::vector<std::uint8_t> findDepthEdges(const glm::uvec2& size, std::span<const float> viewDepth,
                                         const Camera& camera) {
    const Grid grid(size);
    const DepthContinuity continuity(camera);
    std::vector<std::uint8_t> edges(viewDepth.size(), 0);
    const auto value = [&](const glm::ivec2& place) {
        const glm::ivec2 inside = glm::clamp(place, glm::ivec2(0), grid.size - 1);
        return continuity.toLinear(viewDepth[grid.at(inside.x, inside.y)]);
    };
    grid.all([&](int x, int y) {
        for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)}) {
            const glm::ivec2 here(x, y), next = here + step;
            if (!grid.contains(next.x, next.y)) continue;
            if (continuity.breaks(value(here - step), value(here), value(next), value(next + step)))
                edges[grid.at(x, y)] = edges[grid.at(next.x, next.y)] = 1;
        }
    });
    return edges;
}

PictureRegions findRegions(const PictureInput& input) {
    const Grid grid(input.size);
    PictureRegions regions;
    std::vector<std::uint8_t> edges;
    regions.contact.resize(input.truth.size());
    for (std::size_t i = 0; i < input.truth.size(); ++i) regions.contact[i] = input.truth[i] < kContactTruth;
    if (!input.viewDepth.empty()) {
        edges = findDepthEdges(input.size, input.viewDepth, input.camera);
        regions.edge = grow(grid, edges, kEdgeReach - 1);
    }
    if (!input.viewDepth.empty() && input.radius > 0) {
        regions.border.resize(input.truth.size());
        grid.all([&](int x, int y) {
            const glm::ivec2 place(x, y), rest = grid.size - 1 - place;
            const float distance = 0.5f + static_cast<float>(std::min({x, y, rest.x, rest.y}));
            const std::size_t i = grid.at(x, y);
            regions.border[i] = distance < projectedPixels(input.camera, input.size, input.radius, input.viewDepth[i]);
        });
    }
    regions.flat.resize(input.truth.size());
    grid.all([&](int x, int y) { regions.flat[grid.at(x, y)] = isFlat(input, grid, edges, x, y); });
    return regions;
}

PictureMetrics measurePicture(const PictureInput& input) { return measurePicture(input, findRegions(input)); }

PictureMetrics measurePicture(const PictureInput& input, const PictureRegions& regions) {
    const Grid grid(input.size);
    assert(input.map.size() == input.truth.size() && input.map.size() == std::size_t(input.size.x) * input.size.y);
    PictureMetrics result;
    result.all = measureMap(input.map, input.truth, input.isCounted);
    result.ssim = structuralSimilarity(input.size, input.map, input.truth, input.isCounted);
    result.contact = errorWhere(input, regions.contact);
    result.edge = errorWhere(input, regions.edge);
    result.border = errorWhere(input, regions.border);
    measureNoise(input, grid, regions.flat, result);
    return result;
}

}  // namespace crevice
