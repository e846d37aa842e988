// Tests of articles that have two forms: loading either, and a plate in front of a wall.
#pragma once

#include "AoFixture.h"

namespace crevice {

inline constexpr std::uint32_t kWidth = 96, kHeight = 72;
inline constexpr float kDistance = 5;  // of planes along the axis; the radius is 1 where no test says otherwise

class AoTwoFormsTest : public AoTest {
protected:
    AoTwoFormsTest(std::string technique, std::vector<std::string> targets)
        : technique_(std::move(technique)), targets_(std::move(targets)) {}

    /// Either form as full floats. `sets` name AoMain or AoArticle: those of the other form change nothing.
    void loadForm(const std::string& quality, Sets sets = {}, Options options = {}) {
        for (const std::string& target : targets_)
            sets.insert(sets.begin(), {.path = target + ".format", .value = "R32F"});
        options.insert({{"ao", technique_}, {"quality", quality}, {"radius", "1"}});
        load("ao-deferred", options, std::move(sets));
    }
    FloatMap mapOf(const std::string& quality, const Scene& scene, const View& view, Sets sets = {},
                   Options options = {}) {
        loadForm(quality, std::move(sets), std::move(options));
        renderer_->setScene(scene);
        return map(view);
    }

private:
    std::string technique_;
    std::vector<std::string> targets_;
};

/// A plane that leans back around the x axis; a camera that looks along -z sees nothing else.
inline Scene leaningPlane(float degrees, float scale = 1) {
    Scene scene = emptyScene();
    const float tilt = glm::radians(degrees);
    addSquare(scene, {0, 0, -kDistance * scale}, {0, std::sin(tilt), std::cos(tilt)}, 400 * kDistance * scale);
    return scene;
}

/// A plate `gap` in front of a wall that is kDistance away.
inline Scene plateScene(float gap) {
    Scene scene = leaningPlane(0);
    addSquare(scene, {0, 0, -kDistance + gap}, {0, 0, 1}, 1);
    return scene;
}

/// Smallest openness of the wall behind the plate.
inline float darkestOfWall(const FloatMap& ao, const FloatMap& depth) {
    float darkest = 1;
    for (std::size_t i = 0; i < ao.values.size(); ++i)
        if (depth.values[i] > kDistance - 0.01f) darkest = std::min(darkest, ao.values[i]);
    return darkest;
}

/// Smallest openness of the plate itself, where it stands 0.25 or more before the wall.
inline float darkestOfPlate(const FloatMap& ao, const FloatMap& depth) {
    float darkest = 1;
    for (std::size_t i = 0; i < ao.values.size(); ++i)
        if (depth.values[i] <= kDistance - 0.25f) darkest = std::min(darkest, ao.values[i]);
    return darkest;
}

}  // namespace crevice
