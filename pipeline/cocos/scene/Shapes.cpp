// Our own primitives, turned and with their texture coordinates stretched to one repeat.
#include "cocos/scene/Shapes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/Primitives.h"

namespace crevice::cocos {
namespace {

constexpr std::uint32_t kSegments = 32;
constexpr float kPi = 3.14159265f;

void stretchCoordinates(Mesh& mesh) {
    glm::vec2 low(1e30f), high(-1e30f);
    for (const Vertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.uv0);
        high = glm::max(high, vertex.uv0);
    }
    const glm::vec2 size = glm::max(high - low, glm::vec2(1e-6f));
    for (Vertex& vertex : mesh.vertices) vertex.uv0 = (vertex.uv0 - low) / size;
}

/// +y becomes +z.
void tiltForward(Mesh& mesh) {
    const auto turn = [](const glm::vec3& v) { return glm::vec3(v.x, -v.z, v.y); };
    for (Vertex& vertex : mesh.vertices) {
        vertex.position = turn(vertex.position);
        vertex.normal = turn(vertex.normal);
        vertex.tangent = glm::vec4(turn(glm::vec3(vertex.tangent)), vertex.tangent.w);
    }
    updateBounds(mesh);
}

Mesh makeCapsule(float radius, float height) {
    constexpr int kSteps = 8;
    const float straight = height / 2 - radius;
    std::vector<glm::vec2> profile;
    for (int side = 0; side < 2; ++side) {
        const float centre = side == 0 ? -straight : straight;
        for (int i = 0; i <= kSteps; ++i) {
            const float angle = (side == 0 ? -kPi / 2 : 0) + kPi / 2 * float(i) / kSteps;
            profile.push_back({std::max(0.0f, radius * std::cos(angle)), centre + radius * std::sin(angle)});
        }
    }
    profile.front().x = profile.back().x = 0;
    return makeLathe(profile, kSegments);
}

}  // namespace

std::optional<Mesh> makeShape(std::string_view name) {
    Mesh mesh;
    if (name == "box") mesh = makeBox({1, 1, 1});
    if (name == "sphere") mesh = makeSphere(0.5f, kSegments);
    if (name == "capsule") mesh = makeCapsule(0.5f, 2);
    if (name == "cylinder") mesh = makeCylinder(0.5f, 0.5f, 2, kSegments);
    if (name == "cone") mesh = makeCylinder(0.5f, 0, 1, kSegments);
    if (name == "torus") mesh = makeTorus(0.4f, 0.1f, kSegments, 32);
    if (name == "plane") mesh = makePlane({10, 10}, 10);
    if (name == "quad") {
        mesh = makePlane({1, 1});
        tiltForward(mesh);
    }
    if (mesh.vertices.empty()) return std::nullopt;
    mesh.name = name;
    stretchCoordinates(mesh);
    return mesh;
}

std::string_view shapeName(std::string_view subId) {
    struct Id {
        std::string_view id, name;
    };
    static constexpr Id kIds[] = {{"17020", "sphere"}, {"801ec", "capsule"}, {"2e76e", "plane"},    {"38fd2", "cone"},
                                  {"40ece", "torus"},  {"fc873", "quad"},    {"8abdc", "cylinder"}, {"a804a", "box"}};
    for (const Id& known : kIds) {
        if (known.id == subId) return known.name;
        // Parts had names before they had numbers: "box.mesh".
        if (subId.ends_with(".mesh") && subId.substr(0, subId.size() - 5) == known.name) return known.name;
    }
    return {};
}

}  // namespace crevice::cocos
