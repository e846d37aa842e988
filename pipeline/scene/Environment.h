// Light from all around a scene: an equirectangular picture of radiance, how it is turned and shown, and what a diffuse
// surface receives of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <glm/glm.hpp>

#include "core/Image.h"
#include "core/Limits.h"
#include "core/Log.h"
#include "scene/SphericalHarmonics.h"

namespace crevice {

struct EnvironmentCube;
struct Sky;

/// The middle of the picture is +X, three quarters from its left edge +Z, its upper edge +Y: seen from within, the
/// picture is not mirrored. three.js and the Khronos sample viewer read panoramas in the same way.
/// Turned by `rotation` about +Y (right-handed: a quarter turn brings the middle to -Z).
struct Environment {
    std::string name;  ///< Of the file, or "sky": for messages.
    Image radiance;    ///< RGBA32F, twice as wide as high; finite, not negative, in the units of the scene's lights.
    ShCoefficients harmonics{};  ///< Of `radiance`: neither turned nor scaled.
    float intensity = 1;         ///< Factor of the radiance.
    float rotation = 0;          ///< Radians.
    bool visible = true;         ///< SkyboxStage shows it.
    bool lights = true;          ///< Surfaces receive it; without, it is only shown.
    float blur = 0;              ///< Of what is shown: the roughness of a mirror in which it is seen, 0 to 1.
    /// Made of `radiance`; null: the pipeline makes it when the scene is uploaded. See scene/EnvironmentCube.h.
    std::shared_ptr<const EnvironmentCube> cube{};

    /// Irradiance / pi of a surface with that unit normal, turned and scaled.
    glm::vec3 diffuse(const glm::vec3& normalWorld) const;
};

/// Brightest radiance that is kept; brighter texels and infinite ones are clamped to it.
inline constexpr float kMaxRadiance = 1e9f;

/// Radiance at a unit direction, not turned: bilinear, around the wrap and across the poles. `equirect` is RGBA32F.
glm::vec3 sampleEquirect(const Image& equirect, const glm::vec3& direction);
/// Centre of a texel as a unit direction; fractions are allowed.
glm::dvec3 equirectDirection(double x, double y, std::uint32_t width, std::uint32_t height);

/// Throws Error when the picture is not twice as wide as high.
void checkPanoramaShape(std::uint64_t width, std::uint64_t height, const std::string& name);

/// An environment from a picture: RGBA32F, twice as wide as high. Texels that are not a number or negative become 0,
/// too bright ones kMaxRadiance, with a note. Throws Error for another shape.
Environment makeEnvironment(Image radiance, const std::string& name, const Log& log);

/// Reads .hdr (Radiance) or .exr by content. Decoded (16 bytes a pixel) it may take an eighth of `maxImageBytes`: 8192
/// x 4096 pixels by default. Its size is judged by its header, before anything is decoded. Throws Error.
Environment loadEnvironment(const std::filesystem::path& path, const Log& log, const Limits& limits = {});

/// The gradient of a sky as light: what SkyboxStage shows of it. No file, no sun.
Environment skyEnvironment(const Sky& sky);
/// The light that a scene without any gets: a dim studio with three soft boxes, so that metals and varnish have
/// something to mirror. White level surfaces that face up and down have radiances 0.5 and 0.18.
Environment defaultEnvironment();

}  // namespace crevice
