// The tables: glTF 2.0 specification, 5 "Properties Reference", and the JSON schemas of the extensions.
#include "scene/GltfSchema.h"

namespace crevice::gltf {

namespace {

using S = Shape;

constexpr Rule kName{.key = "name", .shape = S::Text, .harmless = true};
constexpr double kMaxCount = 9007199254740992.0;  // 2^53: integers beyond are not exact in JSON

constexpr Rule index(const char* key, const char* list, bool required = false) {
    return {.key = key, .shape = S::Index, .required = required, .list = list};
}
constexpr Rule size(const char* key, double min = 0, bool required = false) {
    return {.key = key, .shape = S::Integer, .required = required, .min = min, .max = kMaxCount};
}
constexpr Rule number(const char* key, double min, double max) { return {.key = key, .min = min, .max = max}; }
constexpr Rule number(const char* key) { return {.key = key}; }
constexpr Rule numbers(const char* key, std::size_t count) {
    return {.key = key, .shape = S::Numbers, .least = count, .most = count};
}
constexpr Rule factors(const char* key, std::size_t count) {
    return {.key = key, .shape = S::Numbers, .min = 0, .max = 1, .least = count, .most = count};
}
constexpr Rule object(const char* key, std::span<const Rule> rules, bool required = false) {
    return {.key = key, .shape = S::Object, .required = required, .rules = rules};
}
constexpr Rule objects(const char* key, std::span<const Rule> rules, bool required = false) {
    return {.key = key, .shape = S::Objects, .required = required, .least = 1, .rules = rules};
}
constexpr Rule indices(const char* key, const char* list, bool required = false) {
    return {.key = key, .shape = S::Indices, .required = required, .least = 1, .list = list};
}
constexpr Rule words(const char* key, const char* allowed, bool required = false) {
    return {.key = key, .shape = S::Text, .required = required, .words = allowed};
}
constexpr Rule required(Rule rule) {
    rule.required = true;
    return rule;
}
constexpr Rule above(const char* key, double min, bool needed = false) {
    return {.key = key, .required = needed, .min = min, .aboveMin = true};
}

// Words of OpenGL, of which there are few.
constexpr int kTargets[] = {34962, 34963}, kMagFilters[] = {9728, 9729};
constexpr int kMinFilters[] = {9728, 9729, 9984, 9985, 9986, 9987}, kWraps[] = {10497, 33071, 33648};
constexpr Rule oneOf(const char* key, std::span<const int> values) {
    return {.key = key, .shape = S::Integer, .harmless = true, .oneOf = values};
}
constexpr Rule any(const char* key) { return {.key = key, .shape = S::Any}; }

constexpr Rule kAsset[] = {required({.key = "version", .shape = S::Text}),
                           any("minVersion"),
                           {.key = "generator", .shape = S::Text, .harmless = true},
                           {.key = "copyright", .shape = S::Text, .harmless = true}};

constexpr Rule kSparseIndices[] = {index("bufferView", "bufferViews", true), size("byteOffset"),
                                   size("componentType", 0, true)};
constexpr Rule kSparseValues[] = {index("bufferView", "bufferViews", true), size("byteOffset")};
constexpr Rule kSparse[] = {size("count", 1, true), object("indices", kSparseIndices, true),
                            object("values", kSparseValues, true)};
constexpr Rule kAccessor[] = {index("bufferView", "bufferViews"),
                              size("byteOffset"),
                              size("componentType", 0, true),
                              {.key = "normalized", .shape = S::Flag},
                              size("count", 1, true),
                              words("type", " SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4 ", true),
                              {.key = "min", .shape = S::Numbers, .least = 1, .most = 16, .harmless = true},
                              {.key = "max", .shape = S::Numbers, .least = 1, .most = 16, .harmless = true},
                              object("sparse", kSparse),
                              kName};

constexpr Rule kMeshoptBuffer[] = {{.key = "fallback", .shape = S::Flag}};
constexpr Rule kBufferExtensions[] = {object("EXT_meshopt_compression", kMeshoptBuffer)};
constexpr Rule kBuffer[] = {
    {.key = "uri", .shape = S::Text}, size("byteLength", 1, true), object("extensions", kBufferExtensions), kName};

constexpr Rule kMeshoptView[] = {
    index("buffer", "buffers", true),   size("byteOffset"),     size("byteLength", 1, true),
    size("byteStride", 1, true),        size("count", 1, true), required({.key = "mode", .shape = S::Text}),
    {.key = "filter", .shape = S::Text}};
constexpr Rule kViewExtensions[] = {object("EXT_meshopt_compression", kMeshoptView)};
constexpr Rule kBufferView[] = {index("buffer", "buffers", true),
                                size("byteOffset"),
                                size("byteLength", 1, true),
                                {.key = "byteStride", .shape = S::Integer, .min = 4, .max = 252},
                                oneOf("target", kTargets),
                                object("extensions", kViewExtensions),
                                kName};

constexpr Rule kPerspective[] = {above("aspectRatio", 0), above("yfov", 0, true), above("zfar", 0),
                                 above("znear", 0, true)};
constexpr Rule kOrthographic[] = {required(number("xmag")),
                                  required(number("ymag")),
                                  above("zfar", 0, true),
                                  {.key = "znear", .required = true, .min = 0}};
constexpr Rule kCamera[] = {words("type", " perspective orthographic ", true), object("perspective", kPerspective),
                            object("orthographic", kOrthographic), kName};

constexpr Rule kImage[] = {{.key = "uri", .shape = S::Text},
                           words("mimeType", " image/jpeg image/png image/webp "),
                           index("bufferView", "bufferViews"),
                           kName};
constexpr Rule kSampler[] = {oneOf("magFilter", kMagFilters), oneOf("minFilter", kMinFilters), oneOf("wrapS", kWraps),
                             oneOf("wrapT", kWraps), kName};
constexpr Rule kWebp[] = {index("source", "images", true)};
constexpr Rule kTextureExtensions[] = {object("EXT_texture_webp", kWebp)};
constexpr Rule kTexture[] = {index("sampler", "samplers"), index("source", "images"),
                             object("extensions", kTextureExtensions), kName};

constexpr Rule kTransform[] = {numbers("offset", 2), number("rotation"), numbers("scale", 2), size("texCoord")};
constexpr Rule kTextureInfoExtensions[] = {object("KHR_texture_transform", kTransform)};
constexpr Rule kTextureInfo[] = {index("index", "textures", true), size("texCoord"), number("scale"),
                                 number("strength", 0, 1), object("extensions", kTextureInfoExtensions)};
constexpr Rule kMetallicRoughness[] = {factors("baseColorFactor", 4), object("baseColorTexture", kTextureInfo),
                                       number("metallicFactor", 0, 1), number("roughnessFactor", 0, 1),
                                       object("metallicRoughnessTexture", kTextureInfo)};
constexpr Rule kGlossiness[] = {factors("diffuseFactor", 4), object("diffuseTexture", kTextureInfo),
                                factors("specularFactor", 3), number("glossinessFactor", 0, 1),
                                object("specularGlossinessTexture", kTextureInfo)};
constexpr Rule kEmissiveStrength[] = {{.key = "emissiveStrength", .min = 0}};
constexpr Rule kMaterialExtensions[] = {object("KHR_materials_unlit", {}),
                                        object("KHR_materials_emissive_strength", kEmissiveStrength),
                                        object("KHR_materials_pbrSpecularGlossiness", kGlossiness)};
constexpr Rule kMaterial[] = {object("pbrMetallicRoughness", kMetallicRoughness),
                              object("normalTexture", kTextureInfo),
                              object("occlusionTexture", kTextureInfo),
                              object("emissiveTexture", kTextureInfo),
                              factors("emissiveFactor", 3),
                              words("alphaMode", " OPAQUE MASK BLEND "),
                              {.key = "alphaCutoff", .min = 0},
                              {.key = "doubleSided", .shape = S::Flag},
                              object("extensions", kMaterialExtensions),
                              kName};

constexpr Rule kPrimitive[] = {required({.key = "attributes", .shape = S::IndexMap, .list = "accessors"}),
                               index("indices", "accessors"),
                               index("material", "materials"),
                               {.key = "mode", .shape = S::Integer, .min = 0, .max = 6},
                               {.key = "targets", .shape = S::IndexMaps, .least = 1, .list = "accessors"}};
constexpr Rule kMesh[] = {
    objects("primitives", kPrimitive, true), {.key = "weights", .shape = S::Numbers, .least = 1}, kName};

constexpr Rule kNodeLight[] = {index("light", "lights", true)};
constexpr Rule kInstancing[] = {required({.key = "attributes", .shape = S::IndexMap, .list = "accessors"})};
constexpr Rule kVisibility[] = {{.key = "visible", .shape = S::Flag}};
constexpr Rule kNodeExtensions[] = {object("KHR_lights_punctual", kNodeLight),
                                    object("EXT_mesh_gpu_instancing", kInstancing),
                                    object("KHR_node_visibility", kVisibility)};
constexpr Rule kNode[] = {index("camera", "cameras"),
                          index("mesh", "meshes"),
                          index("skin", "skins"),
                          indices("children", "nodes"),
                          numbers("matrix", 16),
                          numbers("translation", 3),
                          {.key = "rotation", .shape = S::Numbers, .min = -1.001, .max = 1.001, .least = 4, .most = 4},
                          numbers("scale", 3),
                          {.key = "weights", .shape = S::Numbers, .least = 1},
                          object("extensions", kNodeExtensions),
                          kName};
constexpr Rule kScene[] = {indices("nodes", "nodes"), kName};
constexpr Rule kSkin[] = {index("inverseBindMatrices", "accessors"), index("skeleton", "nodes"),
                          indices("joints", "nodes", true), kName};

constexpr Rule kTarget[] = {index("node", "nodes"), required({.key = "path", .shape = S::Text})};
constexpr Rule kChannel[] = {size("sampler", 0, true), object("target", kTarget, true)};
constexpr Rule kAnimationSampler[] = {index("input", "accessors", true), index("output", "accessors", true),
                                      words("interpolation", " LINEAR STEP CUBICSPLINE ")};
constexpr Rule kAnimation[] = {objects("channels", kChannel, true), objects("samplers", kAnimationSampler, true),
                               kName};

constexpr Rule kSpot[] = {number("innerConeAngle", 0, 1.5707964),
                          {.key = "outerConeAngle", .min = 0, .max = 1.5707964, .aboveMin = true}};
constexpr Rule kLight[] = {words("type", " directional point spot ", true),
                           factors("color", 3),
                           {.key = "intensity", .min = 0},
                           above("range", 0),
                           object("spot", kSpot),
                           kName};
constexpr Rule kLights[] = {objects("lights", kLight, true)};
constexpr Rule kDocumentExtensions[] = {object("KHR_lights_punctual", kLights)};

constexpr Rule kDocument[] = {object("asset", kAsset, true),   index("scene", "scenes"),
                              objects("accessors", kAccessor), objects("animations", kAnimation),
                              objects("buffers", kBuffer),     objects("bufferViews", kBufferView),
                              objects("cameras", kCamera),     objects("images", kImage),
                              objects("materials", kMaterial), objects("meshes", kMesh),
                              objects("nodes", kNode),         objects("samplers", kSampler),
                              objects("scenes", kScene),       objects("skins", kSkin),
                              objects("textures", kTexture),   object("extensions", kDocumentExtensions),
                              any("extensionsUsed"),           any("extensionsRequired")};

}  // namespace

std::span<const Rule> documentRules() { return kDocument; }

}  // namespace crevice::gltf
