// The glTF that has everything: what the faults and the mutations begin with.
#include <initializer_list>

#include "GltfFaultCases.h"
#include "GltfTestTools.h"

namespace crevice::test {

namespace {

std::vector<unsigned char> decode(std::string_view base64) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : base64) {
        if (c == '=') break;
        group = group << 6 | std::uint32_t(kDigits.find(c));
        bits += 6;
        if (bits >= 8) bytes.push_back(static_cast<unsigned char>(group >> (bits -= 8)));
    }
    return bytes;
}

constexpr const char* kJson = R"({
"asset": {"version": "2.0", "generator": "a test", "copyright": "none", "minVersion": "2.0"},
"extensionsUsed": ["KHR_lights_punctual", "KHR_texture_transform"], "scene": 0,
"scenes": [{"name": "all", "nodes": [0, 3, 4]}],
"nodes": [{"name": "root", "children": [1, 2]}, {"name": "joint", "translation": [0, 0, 0]},
 {"name": "second joint", "rotation": [0, 0, 0, 1]}, {"name": "square", "mesh": 0, "skin": 0, "weights": [0.5]},
 {"name": "eye", "camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1],
  "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"meshes": [{"name": "square", "weights": [0.25], "primitives": [{"mode": 4, "indices": 6, "material": 0,
  "attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3, "JOINTS_0": 4, "WEIGHTS_0": 5, "COLOR_0": 13},
  "targets": [{"POSITION": 12}]}]}],
"skins": [{"name": "skin", "inverseBindMatrices": 11, "skeleton": 0, "joints": [1, 2]}],
"animations": [{"name": "move",
  "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}},
   {"sampler": 1, "target": {"node": 2, "path": "rotation"}}, {"sampler": 2, "target": {"node": 3, "path": "weights"}}],
  "samplers": [{"input": 7, "output": 8, "interpolation": "LINEAR"}, {"input": 7, "output": 9}, {"input": 7, "output": 10}]}],
"materials": [{"name": "paint", "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true, "emissiveFactor": [0, 0, 0.1],
  "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "roughnessFactor": 0.5,
   "baseColorTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform": {"offset": [0, 0]}}}},
  "normalTexture": {"index": 0, "scale": 1}, "occlusionTexture": {"index": 0, "strength": 0.5}}],
"textures": [{"source": 0, "sampler": 0}], "samplers": [{"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 33071}],
"images": [{"name": "picture", "bufferView": 16, "mimeType": "image/png"}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100, "aspectRatio": 1}},
 {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}}],
"extensions": {"KHR_lights_punctual": {"lights": [
  {"type": "spot", "color": [1, 1, 1], "intensity": 3, "range": 10, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}}]}},
"accessors": [
 {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
 {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
 {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC4"},
 {"bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC2"},
 {"bufferView": 4, "componentType": 5121, "count": 4, "type": "VEC4"},
 {"bufferView": 5, "componentType": 5126, "count": 4, "type": "VEC4"},
 {"bufferView": 6, "componentType": 5123, "count": 6, "type": "SCALAR", "min": [0], "max": [3]},
 {"bufferView": 7, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
 {"bufferView": 8, "componentType": 5126, "count": 2, "type": "VEC3"},
 {"bufferView": 9, "componentType": 5126, "count": 2, "type": "VEC4"},
 {"bufferView": 10, "componentType": 5126, "count": 2, "type": "SCALAR"},
 {"bufferView": 11, "componentType": 5126, "count": 2, "type": "MAT4"},
 {"bufferView": 12, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 1],
  "sparse": {"count": 1, "indices": {"bufferView": 14, "componentType": 5123}, "values": {"bufferView": 15}}},
 {"bufferView": 13, "componentType": 5126, "count": 4, "type": "VEC4"}],
"bufferViews": [
 {"buffer": 0, "byteLength": 48, "target": 34962, "byteStride": 12},
 {"buffer": 0, "byteOffset": 48, "byteLength": 48, "target": 34962},
 {"buffer": 0, "byteOffset": 96, "byteLength": 64, "target": 34962},
 {"buffer": 0, "byteOffset": 160, "byteLength": 32, "target": 34962},
 {"buffer": 0, "byteOffset": 192, "byteLength": 16, "target": 34962},
 {"buffer": 0, "byteOffset": 208, "byteLength": 64, "target": 34962},
 {"buffer": 0, "byteOffset": 272, "byteLength": 12, "target": 34963},
 {"buffer": 0, "byteOffset": 284, "byteLength": 8}, {"buffer": 0, "byteOffset": 292, "byteLength": 24},
 {"buffer": 0, "byteOffset": 316, "byteLength": 32}, {"buffer": 0, "byteOffset": 348, "byteLength": 8},
 {"buffer": 0, "byteOffset": 356, "byteLength": 128}, {"buffer": 0, "byteOffset": 484, "byteLength": 48},
 {"buffer": 0, "byteOffset": 532, "byteLength": 64}, {"buffer": 0, "byteOffset": 596, "byteLength": 2},
 {"buffer": 0, "byteOffset": 600, "byteLength": 12}, {"buffer": 0, "byteOffset": 612, "byteLength": @picture}],
"buffers": [{"byteLength": @size, "uri": "@bytes"}]})";

void replace(std::string& text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
}

}  // namespace

Everything::Everything() : json(kJson) {
    append<float>(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
    append<float>(bytes, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    append<float>(bytes, {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1});
    append<float>(bytes, {0, 0, 1, 0, 1, 1, 0, 1});
    append<unsigned char>(bytes, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0});
    append<float>(bytes, {1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0.25f, 0.75f, 0, 0, 0, 1, 0, 0});
    append<std::uint16_t>(bytes, {0, 1, 2, 0, 2, 3});
    append<float>(bytes, {0, 1});
    append<float>(bytes, {0, 0, 0, 0, 1, 0});
    append<float>(bytes, {0, 0, 0, 1, 0, 0, 1, 0});
    append<float>(bytes, {0, 1});
    for (int matrix = 0; matrix < 2; ++matrix) append<float>(bytes, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    append<float>(bytes, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    append<float>(bytes, {1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 1, 0.5f, 0.5f, 0.5f, 1});
    append<std::uint16_t>(bytes, {1, 0});
    append<float>(bytes, {0, 0, 1});
    const std::vector<unsigned char> picture = decode(kPng);
    bytes.insert(bytes.end(), picture.begin(), picture.end());
    replace(json, "@picture", std::to_string(picture.size()));
    replace(json, "@size", std::to_string(bytes.size()));
}

}  // namespace crevice::test
