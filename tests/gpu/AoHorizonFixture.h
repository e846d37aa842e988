// Tests of the techniques on slices: a document that ends with the occlusion, and maps beside the points that they
// show.
#pragma once

#include "AoFixture.h"

namespace crevice {

class AoHorizonTest : public AoTest {
protected:
    /// A technique without light and picture; its raw map and the positions as full floats.
    void loadSlices(const std::string& ao, float radius, Options more = {}, Sets sets = {}) {
        Options options{{"ao", ao}, {"radius", std::to_string(radius)}};
        options.merge(more);
        sets.insert(sets.begin(), {{.path = "cc_ssaoMap.format", .value = "R32F"},
                                   {.path = "cc_gbuffer_positionMap.format", .value = "RGBA32F"}});
        loadDocument(R"({ "extends": "ao-deferred", "output": "cc_ssaoBlurMap", "edits": [
            { "remove": "ShadowFlow" }, { "remove": "LightingStage" }, { "remove": "SkyboxStage" },
            { "remove": "TransparentStage" }, { "remove": "PostProcessStage" }, { "remove": "Fxaa" } ] })",
                     std::move(sets), std::move(options));
    }

    /// Targets of one frame.
    std::vector<Image> targets(const View& view, const std::vector<std::string>& names) {
        View keeping = view;
        keeping.keep = names;
        renderer_->render(keeping);
        std::vector<Image> images;
        for (const std::string& name : names) images.push_back(renderer_->target(name));
        return images;
    }
};

/// A camera that shows `height` world units of what is at `target`, from a distance of 10.
inline Camera cameraTowards(const glm::vec3& from, const glm::vec3& target, float height, bool orthographic,
                            const glm::vec3& up = {0, 1, 0}) {
    constexpr float kDistance = 10;
    Camera camera = Camera::lookAt(target + kDistance * glm::normalize(from), target, up);
    camera.orthographic = orthographic;
    camera.orthoHeight = height;
    camera.fovY = 2 * std::atan(height / (2 * kDistance));
    camera.near = 0.1f;
    camera.far = 60;
    return camera;
}

}  // namespace crevice
