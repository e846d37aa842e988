// The field lists of scene documents, and what becomes of the values.
#include "scene/SceneFields.h"

#include <glm/gtc/matrix_transform.hpp>

#include "scene/Primitives.h"
#include "scene/SceneAsset.h"

namespace crevice {

const char* const kPrimitiveNames[kPrimitiveKindCount] = {"box",   "plane", "sphere", "cylinder",
                                                          "torus", "wedge", "arch",   "lathe"};

namespace {

constexpr double kHuge = 1e7;  // world units
constexpr double kTiny = 1e-5;
constexpr double kBright = 1e9;  // lux, candela
constexpr const char* kLightNames[] = {"directional", "point", "spot"};
constexpr const char* kAlphaNames[] = {"opaque", "mask", "blend"};
constexpr const char* kFogNames[] = {"none", "linear", "exp", "exp2"};

FieldInfo length(const char* help) { return {.min = kTiny, .max = kHuge, .help = help}; }
FieldInfo place(const char* help) { return {.min = -kHuge, .max = kHuge, .help = help}; }
FieldInfo color(const char* help) { return {.min = 0, .max = kBright, .help = help}; }
FieldInfo between(double min, double max, const char* unit, const char* help) {
    return {.min = min, .max = max, .unit = unit, .help = help};
}
FieldInfo around(const char* help) { return between(3, 1024, "", help); }

}  // namespace

void visitFields(ParamVisitor& v, PrimitiveFields& f) {
    switch (f.kind) {
        case kBox:
        case kWedge:
            v.field("size", f.size, length("Full extent along x, y and z"));
            break;
        case kPlane:
            v.field("size", f.planeSize, length("Extent along x and z"));
            v.field("segments", f.planeSegments, between(1, 1024, "", "Cells along each side"));
            break;
        case kSphere:
            v.field("radius", f.radius, length("Radius"));
            v.field("segments", f.segments, around("Facets around the equator"));
            break;
        case kCylinder:
            v.field("radius", f.radius, length("Radius at the bottom"));
            v.field("topRadius", f.topRadius,
                    between(-1, kHuge, "", "Radius at the top; -1 = as at the bottom, 0 = a cone"));
            v.field("height", f.height, length("Height along y"));
            v.field("segments", f.segments, around("Facets around the axis"));
            break;
        case kTorus:
            v.field("radius", f.radius, length("From the centre to the middle of the tube"));
            v.field("tubeRadius", f.tubeRadius, length("Radius of the tube"));
            v.field("segments", f.segments, around("Facets around the ring"));
            v.field("tubeSegments", f.tubeSegments, around("Facets around the tube"));
            break;
        case kArch:
            v.field("radius", f.radius, length("Inner radius"));
            v.field("thickness", f.thickness, length("Outer minus inner radius"));
            v.field("depth", f.depth, length("Extent along z"));
            v.field("segments", f.segments, around("Facets along the half circle"));
            break;
        case kLathe:
            v.field("segments", f.segments, around("Facets around the axis"));
            break;
        default:
            break;
    }
}

void visitFields(ParamVisitor& v, PlacementFields& f) {
    v.field("position", f.position, place("Moved by this, last"));
    v.field("rotation", f.rotation, between(-3600, 3600, "degrees", "Turned about x, then y, then z"));
}

void visitFields(ParamVisitor& v, ArrayFields& f) {
    v.field("count", f.count, between(1, 10000, "", "Copies along x, y and z"));
    v.field("step", f.step, place("Distance of neighbours along x, y and z"));
}

void visitFields(ParamVisitor& v, GltfFields& f) {
    v.field("file", f.file, {.help = "The .gltf or .glb, below the document's folder or an asset root"});
    v.field("scene", f.scene, {.help = "Name or index of the scene in it; empty = its default one"});
    v.field("animation", f.animation, {.help = "Name or index of the animation that poses it; empty = none"});
    v.field("time", f.time, between(-1, 1e6, "seconds", "Moment of the animation; -1 = the rest pose"));
}

void visitFields(ParamVisitor& v, CameraFields& f) {
    v.field("name", f.name, {.help = "For --camera"});
    v.field("eye", f.eye, place("Where it stands"));
    v.field("target", f.target, place("What it looks at"));
    v.field("up", f.up, place("What is up in the picture"));
    v.field("fov", f.fov, between(1, 179, "degrees", "Vertical field of view"));
    v.field("orthoHeight", f.orthoHeight,
            between(0, kHuge, "", "Height of the picture in world units; 0 = perspective"));
    v.field("near", f.near, between(0, kHuge, "", "Near plane; 0 = from the scene"));
    v.field("far", f.far, between(0, kHuge, "", "Far plane; 0 = from the scene"));
    v.field("lensShift", f.lensShift, between(-10, 10, "NDC", "Off-centre shift of the picture"));
}

void visitFields(ParamVisitor& v, LightFields& f) {
    Light& light = f.light;
    v.field("name", light.name, {.help = "For messages"});
    v.choice("type", f.type, kLightNames, {.help = "Kind of light"});
    v.field("color", light.color, color("Linear colour"));
    v.field("intensity", light.intensity,
            between(0, kBright, "lux or candela", "Lux (directional) or candela (point, spot)"));
    v.field("range", light.range, between(0, kHuge, "", "Distance at which a point or spot light ends; 0 = never"));
    v.field("position", light.position, place("Of a point or spot light"));
    v.field("direction", light.direction, place("The way a directional or spot light travels"));
    v.field("innerAngle", light.innerAngle,
            between(0, 90, "degrees", "Spot: full brightness within this angle from the axis"));
    v.field("outerAngle", light.outerAngle, between(0.01, 90, "degrees", "Spot: dark beyond this angle from the axis"));
    v.field("castsShadow", light.castsShadow, {.help = "Whether shadow stages consider it"});
}

void visitFields(ParamVisitor& v, MaterialFields& f) {
    v.field("baseColor", f.baseColor, between(0, 1, "", "Linear colour"));
    v.field("alpha", f.alpha, between(0, 1, "", "Opacity, for the modes mask and blend"));
    v.field("metallic", f.material.metallic, between(0, 1, "", "0 = stone, wood; 1 = metal"));
    v.field("roughness", f.material.roughness, between(0, 1, "", "0 = mirror, 1 = chalk"));
    v.field("emissive", f.material.emissive, color("Linear radiance given off"));
    v.choice("alphaMode", f.alphaMode, kAlphaNames, {.help = "How alpha is used"});
    v.field("alphaCutoff", f.material.alphaCutoff, between(0, 1, "", "Mask: parts below are cut out"));
    v.field("doubleSided", f.material.doubleSided, {.help = "Whether back faces are drawn"});
}

void visitFields(ParamVisitor& v, FogFields& f) {
    v.choice("type", f.type, kFogNames, {.help = "How fog grows with distance"});
    v.field("color", f.fog.color, color("Linear colour"));
    v.field("start", f.fog.start, between(0, kHuge, "", "Linear: no fog before this distance"));
    v.field("end", f.fog.end, between(0, kHuge, "", "Linear: nothing but fog from this distance"));
    v.field("density", f.fog.density, between(0, 1e6, "per unit", "Exp and exp2: growth"));
}

void visitFields(ParamVisitor& v, Ambient& f) {
    v.field("sky", f.sky, color("Radiance of a white surface that faces up"));
    v.field("ground", f.ground, color("Radiance of a white surface that faces down"));
}

void visitFields(ParamVisitor& v, Sky& f) {
    v.field("zenith", f.zenith, color("Straight up"));
    v.field("horizon", f.horizon, color("At eye level"));
    v.field("nadir", f.nadir, color("Straight down"));
}

void visitFields(ParamVisitor& v, EnvironmentFields& f) {
    v.field("file", f.file, {.help = "A panorama (.hdr, .exr), or sky: the gradient of the scene's sky"});
    v.field("rotation", f.rotation, between(-3600, 3600, "degrees", "Turned about +y, counterclockwise from above"));
    v.field("intensity", f.intensity, between(0, kBright, "", "Factor of its radiance"));
    v.field("visible", f.visible, {.help = "Whether it is the background"});
    v.field("blur", f.blur, between(0, 1, "", "Of the background: 0 = sharp, 1 = as a dull surface mirrors it"));
}

void EnvironmentFields::apply(Environment& environment) const {
    environment.rotation = glm::radians(rotation);
    environment.intensity = intensity;
    environment.visible = visible;
    environment.blur = blur;
}

glm::mat4 PlacementFields::matrix() const {
    glm::mat4 m = glm::translate(glm::mat4(1), position);
    m = glm::rotate(m, glm::radians(rotation.z), {0, 0, 1});
    m = glm::rotate(m, glm::radians(rotation.y), {0, 1, 0});
    m = glm::rotate(m, glm::radians(rotation.x), {1, 0, 0});
    return glm::scale(m, scale);
}

Camera CameraFields::make() const {
    Camera camera = Camera::lookAt(eye, target, up);
    camera.name = name;
    camera.fovY = glm::radians(fov);
    camera.orthographic = orthoHeight > 0;
    if (camera.orthographic) camera.orthoHeight = orthoHeight;
    camera.near = near;
    camera.far = far;
    camera.lensShift = lensShift;
    return camera;
}

Light LightFields::make() const {
    Light made = light;
    made.type = LightType(type);
    made.innerAngle = glm::radians(light.innerAngle);
    made.outerAngle = glm::radians(light.outerAngle);
    if (glm::length(light.direction) > 0) made.direction = glm::normalize(light.direction);
    return made;
}

MaterialFields::MaterialFields() {
    material.metallic = 0;
    material.roughness = 0.9f;
}

SceneMaterial MaterialFields::make(const std::string& name) const {
    SceneMaterial made = material;
    made.name = name;
    made.baseColor = glm::vec4(baseColor, alpha);
    made.alphaMode = AlphaMode(alphaMode);
    return made;
}

Fog FogFields::make() const {
    Fog made = fog;
    made.type = FogType(type);
    return made;
}

Mesh makePrimitive(const PrimitiveFields& f) {
    switch (f.kind) {
        case kBox:
            return makeBox(f.size);
        case kPlane:
            return makePlane(f.planeSize, f.planeSegments);
        case kSphere:
            return makeSphere(f.radius, f.segments);
        case kCylinder:
            return makeCylinder(f.radius, f.topRadius < 0 ? f.radius : f.topRadius, f.height, f.segments);
        case kTorus:
            return makeTorus(f.radius, f.tubeRadius, f.segments, f.tubeSegments);
        case kWedge:
            return makeWedge(f.size);
        case kArch:
            return makeArch(f.radius, f.thickness, f.depth, f.segments);
        default:
            return makeLathe(f.profile, f.segments);
    }
}

std::vector<SceneFieldTable> sceneFieldTables() {
    std::vector<SceneFieldTable> tables;
    const auto add = [&](std::string name, auto fields) {
        ParamTable table;
        visitFields(table, fields);
        tables.push_back({std::move(name), table.rows(), table.schema()});
    };
    for (int kind = 0; kind < kPrimitiveKindCount; ++kind)
        add(std::string("primitive ") + kPrimitiveNames[kind], PrimitiveFields{.kind = kind});
    add("gltf", GltfFields{});
    add("placement", PlacementFields{});
    add("array", ArrayFields{});
    add("material", MaterialFields{});
    add("camera", CameraFields{});
    add("light", LightFields{});
    add("ambient", Ambient{});
    add("fog", FogFields{});
    add("sky", Sky{});
    add("environment", EnvironmentFields{});
    return tables;
}

}  // namespace crevice
