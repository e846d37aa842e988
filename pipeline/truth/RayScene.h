// A scene as rays meet it: every triangle of every instance in an Embree acceleration structure, in world space.
#pragma once

#include <memory>
#include <optional>

#include <glm/glm.hpp>

#include "scene/Scene.h"

namespace crevice {

/// Distances count in lengths of `direction`, which need not be 1.
struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0, 0, -1};
    float near = 0, far = 1e30f;
};

struct SurfaceHit {
    float distance = 0;            ///< As Ray counts.
    glm::vec3 position{0};         ///< From the triangle's corners, not from the distance: more exact.
    glm::vec3 geometricNormal{0};  ///< Of the triangle, unit length, towards the viewer.
    glm::vec3 normal{0};           ///< Interpolated, unit length, reversed on the back of two-sided materials.
    float positionError = 0;       ///< How far rounding may have moved `position`.
    int instance = -1;             ///< Index into Scene::instances.
};

/// What is solid: all instances of triangle meshes whose material does not blend (TransparentStage draws those after
/// the G-buffer, so the techniques that are measured do not see them either). Alpha-masked materials have holes where
/// base colour, texture (bilinear, without mipmaps) and vertex colour together are below the cutoff. Instances are
/// flattened: a triangle costs about 100 bytes per instance. The scene must outlive this. Safe to use from many
/// threads.
class RayScene {
public:
    /// Throws RenderError when Embree fails (out of memory).
    explicit RayScene(const Scene& scene);
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// What the rasteriser would draw along a ray: back faces of one-sided materials are passed through.
    std::optional<SurfaceHit> findVisible(const Ray& ray) const;
    /// Anything on the ray, seen from either side.
    bool isBlocked(const Ray& ray) const;
    /// Distance of the first surface, seen from either side; infinity when there is none.
    float findDistance(const Ray& ray) const;
    /// Of the scene's bounding box.
    float diagonal() const;
    const Scene& source() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace crevice
