// What the tests of crytek, cocos and learnopengl in ao-deferred share: raw maps of a form, the exact wall, small
// scenes.
#pragma once

#include "AoFaultFixture.h"

namespace crevice {

class AoKernelTest : public AoFault {
protected:
    /// The raw map of a technique as full floats, radius 1.
    FloatMap rawMap(const std::string& ao, const std::string& quality, const Scene& scene, const View& view,
                    Sets sets = {}, Options more = {}) {
        loadTechnique(ao, quality, std::move(sets), std::move(more));
        renderer_->setScene(scene);
        return map(view);
    }
    void loadTechnique(const std::string& ao, const std::string& quality, Sets sets = {}, Options more = {}) {
        sets.insert(sets.begin(), {"cc_ssaoMap.format", "R32F"});
        more.insert({{"ao", ao}, {"quality", quality}, {"radius", "1"}, {"fxaa", "false"}, {"shadows", "false"}});
        load("ao-deferred", more, std::move(sets));
    }
    /// Mean of the rows nearest to some distances from the wall of wallScene(), over kernels and noise tiles.
    std::vector<double> besideWall(const std::string& ao, const std::string& quality,
                                   const std::vector<float>& distances, const Sets& sets = {}, int seeds = 8) {
        constexpr std::uint32_t kColumns = 48, kRows = 160;
        std::vector<double> means(distances.size());
        for (int seed = 0; seed < seeds; ++seed) {
            Sets all = sets;
            all.push_back({"AoArticle.params.seed", std::to_string(seed)});
            all.push_back({"AoMain.params.seed", std::to_string(seed)});
            const FloatMap ao1 = rawMap(ao, quality, wallScene(), viewOf(wallCamera(kWallHeight), kColumns, kRows), all,
                                        {{"seed", std::to_string(seed)}});
            for (std::size_t i = 0; i < distances.size(); ++i) {
                const float row = (distances[i] / 1.41421356f / kWallHeight + 0.5f) * kRows - 0.5f;
                const auto above = static_cast<std::uint32_t>(row);
                const float share = row - static_cast<float>(above);
                means[i] += ((1 - share) * ao1.rowMean(above, 12, 36) + share * ao1.rowMean(above + 1, 12, 36)) / seeds;
            }
        }
        return means;
    }
    bool stageReads(const std::string& stageName, const std::string& target) const { return reads(stageName, target); }
};

/// Seen straight on and in parallel: a wall 10 units away, and a plate `gap` in front of it that covers the left half.
inline Scene halfPlate(float gap) {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 0, 1}, 40);
    addSquare(scene, {-10, 0, gap}, {0, 0, 1}, 20);
    return scene;
}

inline Camera parallelAlongZ(float height) {
    Camera camera = Camera::lookAt({0, 0, 10}, {0, 0, 0});
    camera.orthographic = true;
    camera.orthoHeight = height;
    camera.near = 0.1f;
    camera.far = 30;
    return camera;
}

/// A plane through the origin whose normal leans towards the viewer's up and right.
inline Scene leaningPlane(float degrees) {
    const float tilt = glm::radians(degrees);
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0.3f * std::sin(tilt), 0.95394f * std::sin(tilt), std::cos(tilt)}, 200);
    return scene;
}

}  // namespace crevice
