// One Embree geometry per instance, numbered like Scene::instances, so that a hit leads back to mesh and material.
#include "truth/RayScene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "core/Error.h"
#include "truth/AlphaTest.h"

namespace crevice {
namespace {

constexpr float kRoundingSteps = 8;  // of the largest coordinate: transform, interpolation, camera

/// What the filters and findVisible() need to know of an instance.
struct Solid {
    const Scene* scene = nullptr;
    const Mesh* mesh = nullptr;
    const SceneMaterial* material = nullptr;
    const glm::vec3* positions = nullptr;  ///< World space; Embree owns them.
    bool flipped = false;

    glm::vec3 corner(std::uint32_t primitive, int i) const {
        return positions[mesh->indices[std::size_t(3) * primitive + std::size_t(i)]];
    }
    /// Towards the front, not normalised.
    glm::vec3 frontNormal(std::uint32_t primitive) const {
        const glm::vec3 a = corner(primitive, 0);
        const glm::vec3 n = glm::cross(corner(primitive, 1) - a, corner(primitive, 2) - a);
        return flipped ? -n : n;
    }
};

glm::vec3 directionOf(const RTCFilterFunctionNArguments* args) {
    return {RTCRayN_dir_x(args->ray, args->N, 0), RTCRayN_dir_y(args->ray, args->N, 0),
            RTCRayN_dir_z(args->ray, args->N, 0)};
}

void passThroughHoles(const RTCFilterFunctionNArguments* args) {
    const Solid& solid = *static_cast<const Solid*>(args->geometryUserPtr);
    const glm::vec2 place(RTCHitN_u(args->hit, args->N, 0), RTCHitN_v(args->hit, args->N, 0));
    const std::uint32_t primitive = RTCHitN_primID(args->hit, args->N, 0);
    if (!passesAlphaTest(*solid.scene, *solid.mesh, *solid.material, primitive, place)) args->valid[0] = 0;
}

void passThroughBacks(const RTCFilterFunctionNArguments* args) {
    const Solid& solid = *static_cast<const Solid*>(args->geometryUserPtr);
    if (solid.material->doubleSided) return;
    const glm::vec3 front = solid.frontNormal(RTCHitN_primID(args->hit, args->N, 0));
    if (glm::dot(front, directionOf(args)) >= 0) args->valid[0] = 0;
}

RTCRay toEmbree(const Ray& ray) {
    RTCRay r{};
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.near, r.tfar = ray.far;
    r.mask = ~0u;
    return r;
}

glm::vec3 normalizeOr(const glm::vec3& v, const glm::vec3& fallback) {
    const float length = glm::length(v);
    return length > 0 && std::isfinite(length) ? v / length : fallback;
}

}  // namespace

struct RayScene::Impl {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<Solid> solids;  ///< One per instance, never resized: Embree keeps pointers.
    const Scene* source = nullptr;
    float diagonal = 0;

    ~Impl() {
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void check() const {
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_NONE) return;
        throw RenderError(error == RTC_ERROR_OUT_OF_MEMORY
                              ? "out of memory for the ray tracing structure of the scene"
                              : fmt::format("Embree reports error {}", static_cast<int>(error)));
    }
    void addInstance(std::size_t index);
    SurfaceHit describe(const RTCRayHit& found, const glm::vec3& direction) const;
};

void RayScene::Impl::addInstance(std::size_t index) {
    const Instance& instance = source->instances[index];
    const Mesh& mesh = source->meshes[static_cast<std::size_t>(instance.mesh)];
    const SceneMaterial& material = source->materials[static_cast<std::size_t>(instance.material)];
    if (material.alphaMode == AlphaMode::Blend || mesh.indices.size() < 3) return;
    if (mesh.topology != MeshTopology::Triangles) return;

    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), mesh.vertices.size()));
    if (positions) {
        for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
            positions[i] = glm::vec3(instance.world * glm::vec4(mesh.vertices[i].position, 1));
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                                   3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
        Solid& solid = solids[index];
        solid = {source, &mesh, &material, positions, instance.flipped};
        rtcSetGeometryUserData(geometry, &solid);
        if (material.alphaMode == AlphaMode::Mask) {
            rtcSetGeometryIntersectFilterFunction(geometry, passThroughHoles);
            rtcSetGeometryOccludedFilterFunction(geometry, passThroughHoles);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(index));
    }
    rtcReleaseGeometry(geometry);
    check();
}

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>()) {
    // One thread builds: the structure, and with it every tie between coincident triangles, is then always the same.
    impl_->device = rtcNewDevice("threads=1,set_affinity=0");
    if (!impl_->device) throw RenderError("Embree cannot be started");
    impl_->scene = rtcNewScene(impl_->device);
    impl_->source = &scene;
    impl_->diagonal = scene.bounds().diagonal();
    impl_->solids.resize(scene.instances.size());
    rtcSetSceneFlags(impl_->scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    for (std::size_t i = 0; i < scene.instances.size(); ++i) impl_->addInstance(i);
    rtcCommitScene(impl_->scene);
    impl_->check();
}

RayScene::~RayScene() = default;

float RayScene::diagonal() const { return impl_->diagonal; }

const Scene& RayScene::source() const { return *impl_->source; }

SurfaceHit RayScene::Impl::describe(const RTCRayHit& found, const glm::vec3& direction) const {
    const Solid& solid = solids[found.hit.geomID];
    const std::uint32_t primitive = found.hit.primID;
    const float weight[] = {1 - found.hit.u - found.hit.v, found.hit.u, found.hit.v};
    SurfaceHit hit;
    hit.distance = found.ray.tfar;
    hit.instance = static_cast<int>(found.hit.geomID);
    // Normals turn with the inverse transpose: a factor that the normalisation takes out may stay in.
    const glm::mat3 linear(source->instances[found.hit.geomID].world);
    const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                              glm::cross(linear[0], linear[1]));
    float largest = 0;
    for (int i = 0; i < 3; ++i) {
        const glm::vec3 corner = solid.corner(primitive, i);
        const Vertex& vertex = solid.mesh->vertices[solid.mesh->indices[std::size_t(3) * primitive + std::size_t(i)]];
        hit.position += weight[i] * corner;
        hit.normal += weight[i] * normalizeOr(cofactors * vertex.normal, glm::vec3(0));
        const glm::vec3 size = glm::abs(corner);
        largest = std::max({largest, size.x, size.y, size.z});
    }
    hit.positionError = kRoundingSteps * std::numeric_limits<float>::epsilon() * largest;
    const glm::vec3 front = normalizeOr(solid.frontNormal(primitive), -direction);
    const bool fromBehind = glm::dot(front, direction) > 0;
    hit.geometricNormal = fromBehind ? -front : front;
    // The cofactor matrix of a mirrored instance turns normals inside out.
    if (solid.flipped) hit.normal = -hit.normal;
    hit.normal = normalizeOr(fromBehind ? -hit.normal : hit.normal, hit.geometricNormal);
    return hit;
}

std::optional<SurfaceHit> RayScene::findVisible(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.filter = passThroughBacks;
    RTCRayHit found{};
    found.ray = toEmbree(ray);
    found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene, &context, &found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return impl_->describe(found, ray.direction);
}

bool RayScene::isBlocked(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay r = toEmbree(ray);
    rtcOccluded1(impl_->scene, &context, &r);
    return r.tfar < 0;  // Embree's sign of a hit: minus infinity
}

float RayScene::findDistance(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit found{};
    found.ray = toEmbree(ray);
    found.hit.geomID = found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(impl_->scene, &context, &found);
    return found.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity() : found.ray.tfar;
}

}  // namespace crevice
