// A scene as plain structs: meshes, materials, textures, instances, lights, cameras. Owns no GPU object.
// World space: right-handed, y up, units are the scene's (glTF: metres). Colours are linear unless said otherwise.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/Document.h"
#include "core/Image.h"
#include "scene/Camera.h"
#include "scene/Environment.h"

namespace crevice {

struct Aabb {
    glm::vec3 min{0}, max{0};
    bool empty = true;
    void add(const glm::vec3& point);
    void add(const Aabb& box);
    Aabb transformed(const glm::mat4& matrix) const;
    glm::vec3 centre() const { return 0.5f * (min + max); }
    float diagonal() const;
};

/// One vertex as it is uploaded: 64 bytes, interleaved.
struct Vertex {
    glm::vec3 position{0};
    glm::vec3 normal{0, 0, 1};
    glm::vec4 tangent{1, 0, 0, 1};  ///< w = handedness of the bitangent; or sets 2 and 3 of coordinates: TextureRef
    glm::vec2 uv0{0};
    glm::vec2 uv1{0};
    glm::vec4 color{1};
};
static_assert(sizeof(Vertex) == 18 * sizeof(float));

/// What `indices` join: single vertices, pairs, or triples. Strips, loops and fans are unrolled when they are read.
enum class MeshTopology : std::uint8_t { Points, Lines, Triangles };

/// Indexed vertices of one topology.
struct Mesh {
    std::string name;
    MeshTopology topology = MeshTopology::Triangles;
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;
    bool hasTangents = false;  ///< False: shaders derive the tangent frame from derivatives.
    Aabb bounds;               ///< Object space.
};

enum class TextureWrap : std::uint8_t { Repeat, Mirror, Clamp };
struct SamplerDesc {
    TextureWrap wrapU = TextureWrap::Repeat, wrapV = TextureWrap::Repeat;
    bool linearMag = true, linearMin = true;
    bool mipmaps = true, linearMip = true;
    bool operator==(const SamplerDesc&) const = default;
};

/// A decoded picture. RGBA8; `srgb` when colours (base colour, emissive) are stored in it.
struct SceneTexture {
    std::string name;
    Image image;
    bool srgb = false;
    SamplerDesc sampler;
};

/// How texture coordinates move before a texture is read (KHR_texture_transform): scaled, turned, shifted.
struct UvTransform {
    glm::vec2 offset{0}, scale{1};
    float rotation = 0;  ///< Radians, the picture turns counter-clockwise.
    bool isIdentity() const { return offset == glm::vec2(0) && scale == glm::vec2(1) && rotation == 0; }
    /// Row 0 or 1 of the matrix: the new u (v) is the dot product with (u, v, 1).
    glm::vec3 row(int index) const;
    glm::vec2 apply(const glm::vec2& uv) const;
};

struct TextureRef {
    int texture = -1;  ///< Index into Scene::textures, -1 = none.
    int texcoord = 0;  ///< 0 or 1; 2 and 3: xy and zw of the tangent, which then is none
    UvTransform transform{};
    explicit operator bool() const { return texture >= 0; }
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

/// One pass of a material that names its effect; each is an object or null. Indices are those of the technique, so a
/// pass that its `switch` drops keeps its place.
struct MaterialPass {
    Value defines;     ///< Macro → bool, integer or word.
    Value states;      ///< Over the pass' own: the keys of an effect's pass, enums by name or by Cocos' integer.
    Value properties;  ///< Name → number, list of numbers, name of a built-in texture, or index of a scene texture.
};

/// A material that is drawn by an effect of its own instead of the stage's.
struct MaterialEffect {
    std::string effect;  ///< As EffectLibrary finds it.
    std::size_t technique = 0;
    std::vector<MaterialPass> passes;  ///< May be shorter than the technique.
};

/// Metallic-roughness material of glTF 2.0, or values for an effect that the material names.
struct SceneMaterial {
    std::string name;
    glm::vec4 baseColor{1};
    float metallic = 1, roughness = 1;
    glm::vec3 emissive{0};  ///< Includes emissive strength.
    float normalScale = 1, occlusionStrength = 1;
    TextureRef baseColorMap, metallicRoughnessMap, normalMap, occlusionMap, emissiveMap;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;  ///< Gives off baseColor + emissive whatever light there is (KHR_materials_unlit).
    std::optional<MaterialEffect> effect;  ///< Nothing: the stage's effect.
};

struct Instance {
    int mesh = 0;
    int material = 0;  ///< Always valid: a default material is added for primitives without one.
    glm::mat4 world{1};
    std::string name;
    bool flipped = false;  ///< The matrix mirrors (negative determinant): front faces are clockwise in world space.
    int sourceMesh = -1;   ///< Number of the glTF mesh it is a part of; -1 = none.
    bool castsShadow = true;
};

enum class LightType : std::uint8_t { Directional, Point, Spot };

/// How a light's shadow map is looked up, in Cocos' numbers. Only its profiles use it.
struct LightShadow {
    float bias = 1e-5f;    ///< Towards the light, world units.
    float normalBias = 0;  ///< World units.
    int pcf = 0;           ///< 0 hard, 1 soft, 2 and 3 softer: PCFType.
    float saturation = 1;  ///< 1 = black.
};

/// KHR_lights_punctual: intensity in lux (directional) or candela; range 0 = unlimited; angles in radians.
struct Light {
    LightType type = LightType::Directional;
    glm::vec3 color{1};
    float intensity = 1;
    float range = 0;
    float size = 0;  ///< Radius of the source, world units; 0 = a point. Only Cocos' effects use it.
    float innerAngle = 0, outerAngle = 0.785398f;
    glm::vec3 position{0};
    glm::vec3 direction{0, 0, -1};  ///< The way the light travels, unit length.
    bool castsShadow = true;
    std::optional<LightShadow> shadow{};  ///< Nothing: what the stage that draws the map says.
    std::string name;
};

/// Hemispheric ambient light: irradiance / pi from above and below, linear.
struct Ambient {
    glm::vec3 sky{0};
    glm::vec3 ground{0};
};

enum class FogType : std::uint8_t { None, Linear, Exp, Exp2, Layered };  ///< Layered: Cocos' effects only.
struct Fog {
    FogType type = FogType::None;
    glm::vec3 color{0.5f};
    float start = 0,
          end = 100;        ///< World units along the view ray: of linear fog; Cocos' other ones begin at `start`, too.
    float density = 0.01f;  ///< Exp and exp²: per world unit.
    float top = 1.5f, range = 1.2f, attenuation = 4;  ///< Layered: heights in world units, and what divides distances.
};

/// What SkyboxStage shows behind everything: a vertical gradient, or nothing (the background colour).
struct Sky {
    bool enabled = false;
    glm::vec3 zenith{0.2f, 0.4f, 0.8f}, horizon{0.8f, 0.85f, 0.9f}, nadir{0.3f, 0.28f, 0.25f};
};

struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<SceneTexture> textures;
    std::vector<SceneMaterial> materials;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::optional<Ambient> ambient;          ///< Nothing: addDefaultLight() decides.
    std::optional<Environment> environment;  ///< Replaces `ambient` wherever an effect can look it up.
    Fog fog;
    Sky sky;
    std::optional<float> exposureEv;  ///< Nothing = automatic.

    Aabb bounds() const;  ///< World space, all instances.
};

/// Whether it has an environment that lights, and not only one that is shown.
bool litByEnvironment(const Scene& scene);

/// A key light, ambient and environment for a scene without any light: documented in docs/scenes.md. Returns true when
/// it added them. `environment` false: only the first two.
bool addDefaultLight(Scene& scene, bool environment = true);

}  // namespace crevice
