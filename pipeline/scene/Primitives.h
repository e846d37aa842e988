// Closed meshes made from a few numbers: boxes, planes, spheres and their kin, so that scenes need no downloads.
// Every one is wound counter-clockwise seen from outside, with unit normals, tangents and texture coordinates in
// world-size units of about one repeat per unit of length, y up, and centred on the origin unless said otherwise.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/Scene.h"

namespace crevice {

Mesh makeBox(const glm::vec3& size);
/// One-sided rectangle in the xz plane that faces +y; the only open primitive.
Mesh makePlane(const glm::vec2& size, std::uint32_t segments = 1);
/// `segments` around the equator, half as many from pole to pole.
Mesh makeSphere(float radius, std::uint32_t segments);
/// Cylinder, or cone when the radii differ; a radius of 0 closes that end to a point.
Mesh makeCylinder(float bottomRadius, float topRadius, float height, std::uint32_t segments);
/// Ring around the y axis: `radius` to the middle of the tube, which is `tubeRadius` thick.
Mesh makeTorus(float radius, float tubeRadius, std::uint32_t segments, std::uint32_t tubeSegments);
/// A ramp: box whose top falls from full height at -z to nothing at +z.
Mesh makeWedge(const glm::vec3& size);
/// Half ring of rectangular section, standing on the xz plane and opening along z: an arch, or with a large depth a
/// vault.
Mesh makeArch(float innerRadius, float thickness, float depth, std::uint32_t segments);
/// Revolves a profile of (radius, height) points around the y axis. Listed from bottom to top along the outside (and
/// down again inside, for a bowl); ends that are off the axis are closed by flat discs. Kinks above 35° stay sharp.
Mesh makeLathe(std::span<const glm::vec2> profile, std::uint32_t segments);

/// Recomputes `bounds` from the vertices.
void updateBounds(Mesh& mesh);

}  // namespace crevice
