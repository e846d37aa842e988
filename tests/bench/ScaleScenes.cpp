// Everything follows from the counts alone: our own generator, no seed to choose.
#include "ScaleScenes.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "core/Error.h"
#include "core/Files.h"
#include "scene/Primitives.h"

namespace crevice::bench {
namespace {

/// Numbers from 0 to 1: multiplicative congruential, 2^-32 steps (P. L'Ecuyer, 1999, table 4).
class Sequence {
public:
    float next() {
        state_ = state_ * 2891336453u + 1u;
        return static_cast<float>(state_ >> 8) / 16777216.0f;
    }
    glm::vec3 point(const Aabb& box) {
        const float x = next(), y = next(), z = next();
        return glm::mix(box.min, box.max, glm::vec3(x, y, z));
    }

private:
    std::uint32_t state_ = 1;
};

template <class T>
void append(std::vector<char>& bytes, const T& value) {
    const auto* begin = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof value);
}

/// Along x, of a square among others.
float offsetOf(std::uint32_t square) { return 1.1f * float(square); }

// One wavy square: positions, normals, texture coordinates, indices, one after the other.
std::vector<char> wavySquare(std::uint32_t side, float offset) {
    std::vector<char> bytes;
    const std::uint32_t row = side + 1;
    const auto height = [&](float x, float z) { return 0.05f * std::sin(9 * x + offset) * std::cos(7 * z); };
    const auto forAll = [&](auto visit) {
        for (std::uint32_t j = 0; j < row; ++j)
            for (std::uint32_t i = 0; i < row; ++i) visit(float(i) / float(side), float(j) / float(side));
    };
    forAll([&](float x, float z) { append(bytes, glm::vec3(x + offset, height(x, z), z)); });
    forAll([&](float x, float z) {
        const float dx = 0.45f * std::cos(9 * x + offset) * std::cos(7 * z);
        const float dz = -0.35f * std::sin(9 * x + offset) * std::sin(7 * z);
        append(bytes, glm::normalize(glm::vec3(-dx, 1, -dz)));
    });
    forAll([&](float x, float z) { append(bytes, glm::vec2(x, z)); });
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * row + i, b = a + row;
            for (const std::uint32_t index : {a, b, a + 1, a + 1, b, b + 1}) append(bytes, index);
        }
    return bytes;
}

// 'min' and 'max' of a square's positions.
std::string boundsOf(const std::vector<char>& square, std::uint64_t vertices) {
    Aabb box;
    for (std::uint64_t i = 0; i < vertices; ++i) {
        glm::vec3 place;
        std::memcpy(&place, square.data() + i * sizeof place, sizeof place);
        box.add(place);
    }
    return fmt::format(R"(,"min":[{},{},{}],"max":[{},{},{}])", box.min.x, box.min.y, box.min.z, box.max.x, box.max.y,
                       box.max.z);
}

std::string jsonFor(std::uint32_t meshes, std::uint32_t side, std::uint64_t meshBytes) {
    const std::uint64_t vertices = std::uint64_t(side + 1) * (side + 1), indices = std::uint64_t(side) * side * 6;
    std::string views, accessors, primitives, nodes, roots;
    for (std::uint32_t m = 0; m < meshes; ++m) {
        const char* comma = m == 0 ? "" : ",";
        std::uint64_t at = m * meshBytes;
        const std::uint64_t sizes[4] = {vertices * 12, vertices * 12, vertices * 8, indices * 4};
        for (int i = 0; i < 4; ++i) {
            views +=
                fmt::format(R"({}{{"buffer":0,"byteOffset":{},"byteLength":{}}})", i == 0 ? comma : ",", at, sizes[i]);
            at += sizes[i];
        }
        const auto accessor = [&](int i, std::uint64_t count, const char* type, int component, const char* more) {
            return fmt::format(R"({{"bufferView":{},"componentType":{},"count":{},"type":"{}"{}}})", 4 * m + i,
                               component, count, type, more);
        };
        accessors += comma +
                     accessor(0, vertices, "VEC3", 5126, boundsOf(wavySquare(side, offsetOf(m)), vertices).c_str()) +
                     "," + accessor(1, vertices, "VEC3", 5126, "") + "," + accessor(2, vertices, "VEC2", 5126, "") +
                     "," + accessor(3, indices, "SCALAR", 5125, "");
        primitives += fmt::format(
            R"({}{{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{}}},"indices":{}}}]}})",
            comma, 4 * m, 4 * m + 1, 4 * m + 2, 4 * m + 3);
        nodes += fmt::format(R"({}{{"mesh":{}}})", comma, m);
        roots += fmt::format("{}{}", comma, m);
    }
    return fmt::format(R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}}}],"bufferViews":[{}],)"
                       R"("accessors":[{}],"meshes":[{}],"nodes":[{}],"scenes":[{{"nodes":[{}]}}],"scene":0}})",
                       meshes * meshBytes, views, accessors, primitives, nodes, roots);
}

}  // namespace

Scene manyObjects(std::uint32_t count) {
    Scene scene;
    scene.name = fmt::format("{} objects", count);
    scene.materials.resize(1);
    for (int i = 0; i < 10; ++i) {
        const float size = 0.3f + 0.04f * float(i);
        scene.meshes.push_back(i % 2 == 0 ? makeBox({size, 0.5f, size}) : makeCylinder(size, 0, 0.6f, 5));
    }
    const auto side = std::uint32_t(std::ceil(std::sqrt(double(count))));
    for (std::uint32_t i = 0; i < count; ++i) {
        Instance instance;
        instance.mesh = int(i % 10);
        const glm::vec2 place = glm::vec2(i % side, i / side) - 0.5f * float(side);
        instance.world = glm::translate(glm::mat4(1), {place.x, 0, place.y});
        scene.instances.push_back(instance);
    }
    Light sun;
    sun.direction = glm::normalize(glm::vec3(1, -2, 1));
    scene.lights.push_back(sun);
    return scene;
}

void addSmallLights(Scene& scene, std::uint32_t count) {
    Sequence sequence;
    const Aabb bounds = scene.bounds();
    const float range = bounds.diagonal() / 40;
    for (std::uint32_t i = 0; i < count; ++i) {
        Light light;
        light.type = LightType::Point;
        light.position = sequence.point(bounds);
        const float r = sequence.next(), g = sequence.next(), b = sequence.next();
        light.color = {0.3f + 0.7f * r, 0.3f + 0.7f * g, 0.3f + 0.7f * b};
        light.range = range;
        light.intensity = 2 * range * range;
        light.castsShadow = false;
        scene.lights.push_back(light);
    }
}

std::uint64_t writeManyTriangles(const std::filesystem::path& path, std::uint32_t meshes, std::uint32_t side) {
    const std::uint64_t meshBytes = wavySquare(side, 0).size();
    std::string json = jsonFor(meshes, side, meshBytes);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t binaryBytes = meshes * meshBytes;
    std::ofstream out(path, std::ios::binary);
    const auto word = [&](std::uint64_t value) {
        const auto bits = std::uint32_t(value);
        out.write(reinterpret_cast<const char*>(&bits), sizeof bits);
    };
    word(0x46546c67), word(2), word(28 + json.size() + binaryBytes);
    word(json.size()), word(0x4e4f534a);
    out.write(json.data(), std::streamsize(json.size()));
    word(binaryBytes), word(0x004e4942);
    for (std::uint32_t m = 0; m < meshes; ++m) {
        const std::vector<char> bytes = wavySquare(side, offsetOf(m));
        out.write(bytes.data(), std::streamsize(bytes.size()));
    }
    if (!out.flush()) throw Error(fmt::format("cannot write '{}'", path.string()), "is the disk full?");
    return binaryBytes;
}

std::filesystem::path writeManyPictures(const std::filesystem::path& folder, std::uint32_t count, std::uint32_t side) {
    std::filesystem::create_directories(folder);
    std::string images, textures, materials, meshes, nodes, roots;
    for (std::uint32_t i = 0; i < count; ++i) {
        Image image(side, side, Format::RGBA8);
        for (std::size_t p = 0; p < image.pixels.size(); ++p)
            image.pixels[p] =
                std::byte(p % 4 == 3 ? 255 : (p / 4 % side + (p / 4 / side) * (i + 1) + 20 * (p % 4)) / 16);
        writeImage(folder / fmt::format("{}.png", i), image);
        const char* comma = i == 0 ? "" : ",";
        images += fmt::format(R"({}{{"uri":"{}.png"}})", comma, i);
        textures += fmt::format(R"({}{{"source":{}}})", comma, i);
        materials += fmt::format(R"({}{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":{}}}}}}})", comma, i);
        meshes += fmt::format(
            R"({}{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"material":{}}}]}})", comma,
            i);
        nodes += fmt::format(R"({}{{"mesh":{},"translation":[{},0,0]}})", comma, i, i);
        roots += fmt::format("{}{}", comma, i);
    }
    // One square: three floats and two per corner, then six bytes of indices.
    std::vector<char> bytes;
    for (const glm::vec3& p : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 1, 0)})
        append(bytes, p);
    for (const glm::vec2& uv : {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(0, 0), glm::vec2(1, 0)}) append(bytes, uv);
    for (const int index : {0, 1, 2, 2, 1, 3}) append(bytes, static_cast<std::uint16_t>(index));
    writeFileAtomically(folder / "squares.bin", std::string_view(bytes.data(), bytes.size()));
    const std::filesystem::path path = folder / "pictures.gltf";
    writeFileAtomically(
        path,
        fmt::format(
            R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":92,"uri":"squares.bin"}}],"bufferViews":[)"
            R"({{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":32}},)"
            R"({{"buffer":0,"byteOffset":80,"byteLength":12}}],"accessors":[)"
            R"({{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},)"
            R"({{"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"}},)"
            R"({{"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}}],)"
            R"("images":[{}],"textures":[{}],"materials":[{}],"meshes":[{}],"nodes":[{}],"scenes":[{{"nodes":[{}]}}],"scene":0}})",
            images, textures, materials, meshes, nodes, roots));
    return path;
}

}  // namespace crevice::bench
