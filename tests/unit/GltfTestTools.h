// A glTF small enough to read in a test, with parts that can be replaced; shared by the glTF tests.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "SceneTestTools.h"

namespace crevice::test {

template <class T>
inline void append(std::vector<unsigned char>& bytes, std::initializer_list<T> values) {
    for (const T value : values) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(T));
        std::memcpy(&bytes[at], &value, sizeof(T));
    }
}

/// A glTF with one buffer of four corners of a square (bytes 0 … 47), indices 0 1 2 3 (u16, 48 … 55); parts can be
/// replaced.
struct GltfText {
    std::vector<unsigned char> bytes;
    std::string attributes = R"("POSITION": 0)", primitive = R"(, "indices": 1)";
    std::string views = R"({"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8})";
    std::string accessors = R"({"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                               {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"})";
    std::string nodes = R"({"mesh": 0})", roots = "0", rest, uri, scenes, moreBuffers;
    std::string version = "2.0";

    GltfText() {
        append<float>(bytes, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
        append<std::uint16_t>(bytes, {0, 1, 2, 3});
    }
    std::string json(bool binary = false) const {
        const std::string data =
            uri.empty() ? "data:application/octet-stream;base64," + test::encodeBase64(bytes) : uri;
        return R"({"asset": {"version": ")" + version + R"("}, "scene": 0, "scenes": [{"nodes": [)" + roots + "]}" +
               scenes + R"(],
"nodes": [)" + nodes +
               R"(],
"meshes": [{"name": "square", "primitives": [{"attributes": {)" +
               attributes + "}" + primitive + R"(}]}],
"accessors": [)" +
               accessors + R"(],
"bufferViews": [)" +
               views + R"(],
"buffers": [{"byteLength": )" +
               std::to_string(bytes.size()) + (binary ? "" : R"(, "uri": ")" + data + "\"") + "}" + moreBuffers + "]" +
               rest + "}";
    }
    std::string glb() const {
        std::string text = json(true);
        while (text.size() % 4) text += ' ';
        std::vector<unsigned char> head;
        append<std::uint32_t>(head, {0x46546c67, 2, std::uint32_t(12 + 8 + text.size() + 8 + bytes.size())});
        append<std::uint32_t>(head, {std::uint32_t(text.size()), 0x4e4f534a});
        std::string file(head.begin(), head.end());
        file += text;
        std::vector<unsigned char> chunk;
        append<std::uint32_t>(chunk, {std::uint32_t(bytes.size()), 0x004e4942});
        file.append(chunk.begin(), chunk.end());
        return file.append(bytes.begin(), bytes.end());
    }
    Scene load(Listener* listener = nullptr) const {
        const TempFolder folder;
        Listener own;
        return loadGltf(folder.write("test.gltf", json()), {.log = (listener ? *listener : own).log});
    }
    std::string error() const {
        return errorOf([&] { load(); });
    }
};

// A white-and-red picture of 2 × 1 pixels, 8-bit RGB.
inline constexpr const char* kPng =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAADUlEQVR42mP4DwQMDAAR9QP9hjw3TQAAAABJRU5ErkJggg==";

}  // namespace crevice::test
