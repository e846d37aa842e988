// Cameras, and the lights of KHR_lights_punctual, as they stand in the world.
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "scene/GltfParts.h"

namespace crevice::gltf {

namespace {

double innerAngle(const Value& spot) { return numberOr(spot, "innerConeAngle", 0); }
double outerAngle(const Value& spot) { return numberOr(spot, "outerConeAngle", glm::quarter_pi<double>()); }

}  // namespace

void checkLights(const File& file) {
    const Value* extension = extensionOf(file.json, "KHR_lights_punctual");
    if (!extension) return;
    const auto& lights = listIn(*extension, "lights");
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const Value* spot = objectIn(&lights[i], "spot");
        if (spot && !(innerAngle(*spot) < outerAngle(*spot)))
            file.fail("lights", i, "'innerConeAngle' is not below 'outerConeAngle'");
        if (!spot && textOr(lights[i], "type") == "spot") file.fault("lights", i, "'spot' is missing");
    }
}

namespace {

// The specification, 3.10.3: a camera of another aspect ratio than the picture's is neither cropped nor stretched. What
// it frames is all in the picture, which shows more at the sides or, taller by this, above and below.
double heightFactor(const File& file, double ownAspect) {
    const double aspect = file.options.aspect;
    return aspect > 0 && ownAspect > aspect ? ownAspect / aspect : 1;
}

}  // namespace

std::optional<Camera> readCamera(const File& file, int index, const glm::mat4& world, const std::string& otherName) {
    const std::size_t camera = std::size_t(index);
    const Value& from = file.item("cameras", camera);
    const std::string type = textOr(from, "type");
    const Value* lens = objectIn(&from, type);
    const glm::vec3 eye(world[3]), backward(world[2]), up(world[1]);
    if (!(glm::length(backward) > 0) || !(glm::length(glm::cross(up, backward)) > 0)) {
        file.fault("cameras", camera, "its node is scaled to nothing: it is left out");
        return std::nullopt;
    }
    Camera to = Camera::lookAt(eye, eye - backward, up);
    to.name = nameIn(from);
    if (to.name.empty()) to.name = otherName;
    if (type != "orthographic" && type != "perspective") return std::nullopt;  // told by checkSchema()
    if (!lens) file.fail("cameras", camera, fmt::format("'{}' is missing", type));
    to.near = float(numberOr(*lens, "znear", 0));
    to.far = float(numberOr(*lens, "zfar", 0));
    if (type == "orthographic") {
        to.orthographic = true;
        const double width = std::abs(numberOr(*lens, "xmag", 0)), height = std::abs(numberOr(*lens, "ymag", 0));
        to.orthoHeight = float(2 * height * (height > 0 ? heightFactor(file, width / height) : 1));
        if (!(to.orthoHeight > 0 && std::isfinite(to.orthoHeight))) {
            file.fault("cameras", camera, fmt::format("'ymag' is {}: it is left out", height));
            return std::nullopt;
        }
    } else {
        to.fovY = float(numberOr(*lens, "yfov", 0));
        if (!(to.fovY < glm::pi<float>())) {
            file.fault("cameras", camera, "'yfov' is not below pi: it is left out");
            return std::nullopt;
        }
        const double factor = heightFactor(file, numberOr(*lens, "aspectRatio", 0));
        if (factor > 1) to.fovY = 2 * std::atan(std::tan(0.5f * to.fovY) * float(factor));
    }
    return to;
}

Light readLight(const File& file, int index, const glm::mat4& world, const std::string& otherName) {
    const std::size_t light = std::size_t(index);
    const Value& from = listIn(*extensionOf(file.json, "KHR_lights_punctual"), "lights")[light];
    Light to;
    const std::string type = textOr(from, "type");
    if (type == "point")
        to.type = LightType::Point;
    else if (type == "spot")
        to.type = LightType::Spot;
    else if (type != "directional")
        file.fail("lights", light, fmt::format("'type' is '{}'; it may be directional, point or spot", type));
    if (const auto c = floatsIn(from, "color"); c.size() == 3) to.color = {c[0], c[1], c[2]};
    to.intensity = float(numberOr(from, "intensity", 1));
    to.range = float(numberOr(from, "range", 0));
    const Value* spot = objectIn(&from, "spot");
    if (to.type == LightType::Spot) {
        to.innerAngle = spot ? float(innerAngle(*spot)) : 0;
        to.outerAngle = spot ? float(outerAngle(*spot)) : to.outerAngle;
    }
    to.position = glm::vec3(world[3]);
    const glm::vec3 direction = -glm::vec3(world[2]);
    to.direction = glm::length(direction) > 0 ? glm::normalize(direction) : glm::vec3(0, 0, -1);
    to.name = nameIn(from);
    if (to.name.empty()) to.name = otherName;
    return to;
}

}  // namespace crevice::gltf
