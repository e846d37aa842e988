// What the tests of the article's faults share: maps of a form, lighting, the SPIR-V of a stage, a few scenes.
#pragma once

#include "AoFixture.h"

namespace crevice {

inline constexpr float kWallHeight = 4;  // world units that the wall camera sees

inline std::vector<StageSet> radiusOne(std::vector<StageSet> more = {}) {
    more.insert(more.begin(), {"SsaoStage.material.radius", "1"});
    return more;
}

class AoFault : public AoTest {
protected:
    FloatMap mapOf(const std::string& form, const Scene& scene, const View& view, std::vector<StageSet> more = {}) {
        loadMap(form, radiusOne(std::move(more)));
        renderer_->setScene(scene);
        return map(view);
    }
    FloatMap lightingOf(const Options& options, const Scene& scene, const View& view, std::vector<StageSet> more = {}) {
        more.push_back({"cc_lighting_resultMap.format", "RGBA32F"});
        load("ssao-deferred", options, radiusOne(std::move(more)));
        renderer_->setScene(scene);
        return map(view, "cc_lighting_resultMap");
    }
    /// The variant that a stage draws with.
    const EffectVariant& variantOf(const std::string& name) const { return *stage(name).draws.at(0).variant; }
    const StageUse& useOf(const std::string& name) const {
        for (const StageUse& use : renderer_->pipeline().program().plan().uses)
            if (use.stage == name) return use;
        throw Error("no stage " + name);
    }
    bool reads(const std::string& stageName, const std::string& target) const {
        const auto& list = useOf(stageName).reads;
        return std::any_of(list.begin(), list.end(), [&](const TargetRead& read) { return read.target == target; });
    }
};

inline Camera alongZ(float z, float degrees) {
    Camera camera = Camera::lookAt({0, 0, z}, {0, 0, 0});
    camera.fovY = glm::radians(degrees);
    camera.near = 0.1f;
    camera.far = 100;
    return camera;
}

/// How often an instruction occurs in SPIR-V, by its number in the specification (section 3.49).
inline int countInstruction(const std::vector<std::uint32_t>& words, std::uint32_t opcode) {
    int count = 0;
    for (std::size_t at = 5; at < words.size(); at += std::max(1u, words[at] >> 16u))
        count += (words[at] & 0xffffu) == opcode;
    return count;
}
inline constexpr std::uint32_t kSampleImplicit = 87, kImageRead = 98, kMatrixTimesVector = 145,
                               kMatrixTimesMatrix = 146;

/// How often a function of GLSL.std.450 is called.
inline int countFunction(const std::vector<std::uint32_t>& words, std::uint32_t number) {
    constexpr std::uint32_t kExtInst = 12;
    int count = 0;
    for (std::size_t at = 5; at < words.size(); at += std::max(1u, words[at] >> 16u))
        count += (words[at] & 0xffffu) == kExtInst && words[at + 4] == number;
    return count;
}
inline constexpr std::uint32_t kSin = 13, kCos = 14;

/// Smallest value among the pixels whose depth lies in a range.
inline float minWhere(const FloatMap& map, const FloatMap& depth, float from, float to) {
    float smallest = 2;
    for (std::size_t i = 0; i < map.values.size(); ++i)
        if (depth.values[i] > from && depth.values[i] < to) smallest = std::min(smallest, map.values[i]);
    return smallest;
}

/// A plate ten radii in front of a wall that faces the camera.
inline Scene plateBeforeWall() {
    Scene scene = emptyScene();
    addSquare(scene, {0, 0, 0}, {0, 0, 1}, 40);
    addSquare(scene, {0.13f, 0.07f, 10}, {0, 0, 1}, 2);
    return scene;
}

}  // namespace crevice
