// Metrics that need to know which pixels are neighbours: structure, noise, edges, borders, contacts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/Camera.h"
#include "truth/Metrics.h"

namespace crevice {

/// All spans have size.x · size.y values, row by row from the top.
struct PictureInput {
    glm::uvec2 size{0};
    std::span<const float> map, truth;
    std::span<const std::uint8_t> isCounted;  ///< 0: takes no part; empty = all.
    std::span<const float> viewDepth;         ///< Linear, sky = kSkyViewDepth. Empty: no edges, no borders.
    Camera camera;                            ///< That of the depth.
    float radius = 0;                         ///< Of the occlusion, world units; 0: no borders.
};

/// RMSE over some of the counted pixels.
struct RegionError {
    std::size_t count = 0;
    double rmse = 0;  ///< 0 where count is.
};

struct PictureMetrics {
    MapMetrics all;
    double ssim = 1;   ///< See structuralSimilarity().
    double noise = 0;  ///< Standard deviation of a - its 5x5 median, over the flat pixels.
    std::size_t flatCount =
        0;                ///< Pixels whose 5x5 all count, without a depth edge, the truth within .1 of each other.
    RegionError edge;     ///< Within 4 pixels of a depth edge.
    RegionError border;   ///< Nearer to the picture's border than the radius appears there.
    RegionError contact;  ///< Where the truth is below 1/2.
};
PictureMetrics measurePicture(const PictureInput& input);

/// Which pixels belong to the regions above: 1 = yes. Empty: there is no such region. They do not depend on the map, so
/// that many maps of one view can share them.
struct PictureRegions {
    std::vector<std::uint8_t> edge, border, contact, flat;
};
PictureRegions findRegions(const PictureInput& input);
PictureMetrics measurePicture(const PictureInput& input, const PictureRegions& regions);

/// Mean SSIM (Wang, Bovik, Sheikh, Simoncelli 2004) over the counted pixels: Gaussian window of 11x11, sigma 1.5, K1
/// .01, K2 .03, range 1. Windows know only counted pixels inside the picture, their weights made to sum to 1.
double structuralSimilarity(const glm::uvec2& size, std::span<const float> a, std::span<const float> b,
                            std::span<const std::uint8_t> isCounted = {});

/// 1 where the depth jumps to a pixel beside or below, on both sides of the jump: neither of the two surfaces continued
/// straight meets the other within 2 % of its depth (orthographic: of the view's height). Planes have none, however
/// steep.
std::vector<std::uint8_t> findDepthEdges(const glm::uvec2& size, std::span<const float> viewDepth,
                                         const Camera& camera);

/// How large a length appears at a depth, in pixels.
float projectedPixels(const Camera& camera, const glm::uvec2& size, float length, float viewDepth);

}  // namespace crevice
