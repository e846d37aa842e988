// What the objects of a scene document may say: one list of fields per kind, for reading, checks, docs and schema
// alike.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/Params.h"
#include "scene/Scene.h"

namespace crevice {

/// A shape and its numbers. Only the fields of its kind are read.
struct PrimitiveFields {
    int kind = 0;  ///< Index into kPrimitiveNames.
    glm::vec3 size{1};
    glm::vec2 planeSize{10};
    float radius = 0.5f, topRadius = -1, tubeRadius = 0.15f, height = 1, thickness = 0.2f, depth = 0.5f;
    std::uint32_t segments = 32, tubeSegments = 16, planeSegments = 1;
    std::vector<glm::vec2> profile{};  ///< Lathe only; read apart, for no field type holds it.
};

enum PrimitiveKind { kBox, kPlane, kSphere, kCylinder, kTorus, kWedge, kArch, kLathe, kPrimitiveKindCount };
extern const char* const kPrimitiveNames[kPrimitiveKindCount];

/// Where an object or one of its instances stands: scaled, then turned about x, y and z in this order, then moved.
struct PlacementFields {
    glm::vec3 position{0}, rotation{0}, scale{1};
    glm::mat4 matrix() const;
};

/// Repetition along three axes: cell (i, j, k) is moved by step * (i, j, k).
struct ArrayFields {
    glm::vec3 count{1}, step{1};
};

/// A glTF and the part of it that is shown.
struct GltfFields {
    std::string file, scene, animation;
    float time = -1;
};

struct CameraFields {
    std::string name;
    glm::vec3 eye{0, 1, 5}, target{0}, up{0, 1, 0};
    float fov = 45, orthoHeight = 0, near = 0, far = 0;
    glm::vec2 lensShift{0};
    Camera make() const;
};

struct LightFields {
    int type = 0;
    Light light{.outerAngle = 45.0f, .name = {}};  ///< Angles in degrees here.
    Light make() const;
};

struct MaterialFields {
    SceneMaterial material;
    glm::vec3 baseColor{0.8f};
    float alpha = 1;
    int alphaMode = 0;
    MaterialFields();
    SceneMaterial make(const std::string& name) const;
};

struct FogFields {
    int type = 1;
    Fog fog;
    Fog make() const;
};

/// `file` "sky": the gradient of the scene's sky, computed.
struct EnvironmentFields {
    std::string file = "sky";
    float rotation = 0, intensity = 1, blur = 0;  ///< Degrees here.
    bool visible = true;
    bool isSky() const { return file == "sky"; }
    /// Turns, scales and shows an environment as the fields say.
    void apply(Environment& environment) const;
};

void visitFields(ParamVisitor& visitor, PrimitiveFields& fields);
void visitFields(ParamVisitor& visitor, PlacementFields& fields);
void visitFields(ParamVisitor& visitor, ArrayFields& fields);
void visitFields(ParamVisitor& visitor, GltfFields& fields);
void visitFields(ParamVisitor& visitor, CameraFields& fields);
void visitFields(ParamVisitor& visitor, LightFields& fields);
void visitFields(ParamVisitor& visitor, MaterialFields& fields);
void visitFields(ParamVisitor& visitor, FogFields& fields);
void visitFields(ParamVisitor& visitor, Ambient& fields);
void visitFields(ParamVisitor& visitor, Sky& fields);
void visitFields(ParamVisitor& visitor, EnvironmentFields& fields);

/// The mesh of a primitive.
Mesh makePrimitive(const PrimitiveFields& fields);

}  // namespace crevice
