// Enums of the camera are places in lists of stops; lights of spheres are turned into points of the same strength.
#include "cocos/scene/SceneComponents.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "cocos/assets/TypedValue.h"

namespace crevice::cocos {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// CameraAperture, CameraShutter (seconds) and CameraISO of the engine.
constexpr double kApertures[] = {1.8, 2.0, 2.2, 2.5,  2.8,  3.2,  3.5,  4.0,  4.5,  5.0,  5.6, 6.3,
                                 7.1, 8.0, 9.0, 10.0, 11.0, 13.0, 14.0, 16.0, 18.0, 20.0, 22.0};
constexpr double kShutters[] = {1,         1 / 2.0,   1 / 4.0,   1 / 8.0,    1 / 15.0,   1 / 30.0,  1 / 60.0,
                                1 / 125.0, 1 / 250.0, 1 / 500.0, 1 / 1000.0, 1 / 2000.0, 1 / 4000.0};
constexpr double kIsos[] = {100, 200, 400, 800};

template <std::size_t N>
double stopOf(const FieldReader& fields, std::string_view key, std::int64_t otherwise, const double (&stops)[N],
              Problems& problems) {
    const std::int64_t index = fields.integer(key, otherwise);
    if (index >= 0 && index < std::int64_t(N)) return stops[index];
    problems.warning(fields.find(key)->where(), fmt::format("'{}' {} is unknown", key, index),
                     fmt::format("0 to {}; {} is taken", N - 1, otherwise));
    return stops[otherwise];
}

double degrees(double angle) { return angle * kPi / 180; }

/// Where a light or camera looks: -z of its node, without scale.
glm::vec3 forwardOf(const glm::mat4& world) {
    const glm::vec3 z(world[2]);
    const float length = glm::length(z);
    return length > 0 ? -z / length : glm::vec3(0, 0, -1);
}

/// Lights have numbers of their own from 3.4 on.
std::optional<LightShadow> readShadow(const FieldReader& fields) {
    if (!fields.find("_shadowBias") && !fields.find("_shadowPcf")) return std::nullopt;
    const LightShadow usual;
    return LightShadow{.bias = float(fields.number("_shadowBias", double(usual.bias))),
                       .normalBias = float(fields.number("_shadowNormalBias", 0)),
                       .pcf = int(std::clamp<std::int64_t>(fields.integer("_shadowPcf", 0), 0, 3)),
                       .saturation = float(std::clamp(fields.number("_shadowSaturation", 1), 0.0, 1.0))};
}

/// Luminous flux of a sphere of 1 candela per m²: 4 pi² r².
double fluxPerLuminance(double size) { return 4 * kPi * kPi * size * size; }

}  // namespace

std::string componentType(const Value& component) {
    std::string type = typeOf(component);
    if (type == "cc.ModelComponent") return "cc.MeshRenderer";
    if (type == "cc.SkinningModelComponent") return "cc.SkinnedMeshRenderer";
    constexpr std::string_view kOldEnding = "Component";
    if (type.starts_with("cc.") && type.ends_with(kOldEnding)) type.resize(type.size() - kOldEnding.size());
    return type;
}

bool isMeshRenderer(std::string_view type) { return type == "cc.MeshRenderer" || isSkinnedRenderer(type); }

bool isSkinnedRenderer(std::string_view type) { return type == "cc.SkinnedMeshRenderer"; }

double exposureOf(double ev) { return 1 / (1.2 * std::exp2(ev)); }

glm::vec4 readVector(const Value& object, std::string_view key, const glm::vec4& otherwise, Problems& problems) {
    const Value* written = FieldReader(object, problems).find(key);
    if (!written) return otherwise;
    const TypedValue typed = readTyped(*written, problems);
    if (typed.kind != TypedValue::Kind::Numbers) {
        problems.error(written->where(), fmt::format("'{}' must be a vector or a colour", key),
                       R"(write { "__type__": "cc.Vec3", "x": …, "y": …, "z": … })");
        return otherwise;
    }
    glm::vec4 result = otherwise;
    const std::vector<Value>& items = typed.plain.items();
    for (std::size_t i = 0; i < items.size() && i < 4; ++i) result[int(i)] = float(items[i].number());
    return result;
}

glm::mat4 readTransform(const Value& node, Problems& problems) {
    const glm::vec4 position = readVector(node, "_lpos", glm::vec4(0), problems);
    const glm::vec4 turn = readVector(node, "_lrot", {0, 0, 0, 1}, problems);
    const glm::vec4 scale = readVector(node, "_lscale", glm::vec4(1), problems);
    const float length = glm::length(turn);
    const glm::quat rotation = length > 0
                                   ? glm::quat(turn.w / length, turn.x / length, turn.y / length, turn.z / length)
                                   : glm::quat(1, 0, 0, 0);
    return glm::translate(glm::mat4(1), glm::vec3(position)) * glm::mat4_cast(rotation) *
           glm::scale(glm::mat4(1), glm::vec3(scale));
}

ImportedCamera readCamera(const Value& component, const glm::mat4& world, Problems& problems) {
    const FieldReader fields(component, problems);
    ImportedCamera out;
    const glm::vec3 eye(world[3]), forward = forwardOf(world);
    const glm::vec3 up = glm::normalize(glm::vec3(world[1]));
    out.camera = Camera::lookAt(eye, eye + forward, up);
    out.camera.orthographic = fields.integer("_projection", 1) == 0;
    out.camera.orthoHeight = float(2 * fields.number("_orthoHeight", 10));  // Cocos' is half of the height
    out.camera.near = float(fields.number("_near", 1));
    out.camera.far = float(fields.number("_far", 1000));
    if (!out.camera.orthographic && (out.camera.near <= 0 || out.camera.far <= out.camera.near))
        out.camera.near = out.camera.far = 0;
    double fov = degrees(std::clamp(fields.number("_fov", 45), 1.0, 179.0));
    if (fields.integer("_fovAxis", 0) == 1) {
        fov = 2 * std::atan(std::tan(fov / 2) * 9 / 16);
        problems.note(component.where(), "a horizontal field of view is taken at 16:9");
    }
    out.camera.fovY = float(fov);
    out.priority = fields.integer("_priority", 0);
    out.visibility = std::uint32_t(fields.integer("_visibility", 0));
    const double aperture = stopOf(fields, "_aperture", 19, kApertures, problems);
    const double shutter = stopOf(fields, "_shutter", 7, kShutters, problems);
    const double iso = stopOf(fields, "_iso", 0, kIsos, problems);
    out.ev = std::log2(aperture * aperture / shutter * 100 / iso);
    constexpr std::int64_t kClearColor = 1, kClearSky = 8;
    const std::int64_t flags = fields.integer("_clearFlags", 7);
    out.showsSky = (flags & kClearSky) != 0;
    if ((flags & kClearColor) != 0) out.clearColor = readVector(component, "_color", {0.2f, 0.2f, 0.2f, 1}, problems);
    return out;
}

std::optional<Light> readLight(const Value& component, const glm::mat4& world, bool hdr, double exposure,
                               Problems& problems) {
    const FieldReader fields(component, problems);
    const std::string type = componentType(component);
    Light light;
    light.color = glm::vec3(readVector(component, "_color", glm::vec4(1), problems));
    light.position = glm::vec3(world[3]);
    light.direction = forwardOf(world);
    if (type == "cc.DirectionalLight") {
        const double lux =
            hdr ? fields.number(fields.firstOf({"_illuminanceHDR", "_illuminance"}), 65000)
                : fields.number("_illuminanceLDR", 65000 * exposureOf(std::log2(16.0 * 16 * 125))) / exposure;
        light.intensity = float(lux);
        light.castsShadow = fields.boolean("_shadowEnabled", true);
        light.shadow = readShadow(fields);
        return light;
    }
    const bool spot = type == "cc.SpotLight";
    if (!spot && type != "cc.SphereLight" && type != "cc.PointLight") return std::nullopt;
    light.type = spot ? LightType::Spot : LightType::Point;
    const double size = type == "cc.PointLight" ? 1 : std::max(0.0, fields.number("_size", 0.15));
    constexpr double kMeterScale = 10000;  // the engine counts luminance in ten thousands where there is no HDR
    const double usual = 1700 / fluxPerLuminance(0.15);
    const double luminance =
        hdr ? fields.number(fields.firstOf({"_luminanceHDR", "_luminance"}), usual)
            : fields.number("_luminanceLDR", usual * exposureOf(std::log2(16.0 * 16 * 125)) * kMeterScale) /
                  (exposure * kMeterScale);
    light.intensity = float(luminance * kPi * size * size);
    light.size = float(size);
    light.range = float(std::max(0.0, fields.number("_range", 1)));
    light.outerAngle = float(degrees(std::clamp(fields.number("_spotAngle", 60), 2.0, 180.0)) / 2);
    light.castsShadow = fields.boolean("_shadowEnabled", false);
    if (spot) light.shadow = readShadow(fields);
    return light;
}

}  // namespace crevice::cocos
