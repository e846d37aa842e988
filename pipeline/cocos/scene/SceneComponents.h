// Internal to the scene importer: components as plain numbers.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "cocos/assets/ObjectGraph.h"
#include "scene/Scene.h"

namespace crevice::cocos {

/// A camera and what comes with it.
struct ImportedCamera {
    Camera camera{};
    std::int64_t priority = 0;
    double ev = 0;  ///< Exposure value at ISO 100: log2(N² / t x 100 / ISO).
    std::optional<glm::vec4> clearColor{};
    bool showsSky = false;         ///< It clears with the sky.
    std::uint32_t visibility = 0;  ///< Bits of the layers that it sees; 0 = the file does not say.
};

/// The type of a component under its name of 3.x: earlier ones were "cc.CameraComponent", "cc.ModelComponent", …
std::string componentType(const Value& component);
bool isMeshRenderer(std::string_view type);
bool isSkinnedRenderer(std::string_view type);

/// `world`: of the node. Fields that are missing have the engine's defaults.
ImportedCamera readCamera(const Value& component, const glm::mat4& world, Problems& problems);
/// cc.DirectionalLight, cc.SphereLight, cc.PointLight, cc.SpotLight; nothing for another type. In a scene without HDR
/// the component's LDR strength is divided by `exposure`, so that the product is the same.
std::optional<Light> readLight(const Value& component, const glm::mat4& world, bool hdr, double exposure,
                               Problems& problems);
/// Position, rotation and scale of a node.
glm::mat4 readTransform(const Value& node, Problems& problems);
glm::vec4 readVector(const Value& object, std::string_view key, const glm::vec4& otherwise, Problems& problems);

/// 0.8333 / 2^ev: what the engine multiplies light with.
double exposureOf(double ev);

}  // namespace crevice::cocos
