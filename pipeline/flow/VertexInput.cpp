// The one table of attribute names.
#include "flow/VertexInput.h"

#include <fmt/format.h>

#include <cstddef>

#include "core/Text.h"
#include "scene/Scene.h"

namespace crevice {
namespace {

constexpr std::uint32_t kRowBytes = sizeof(glm::vec4);

struct AttributeRow {
    const char* name;
    std::uint32_t binding;
    VertexFormat format;
    std::uint32_t offset;
};
constexpr AttributeRow kAttributes[] = {
    {"a_position", 0, VertexFormat::Float3, offsetof(Vertex, position)},
    {"a_normal", 0, VertexFormat::Float3, offsetof(Vertex, normal)},
    {"a_tangent", 0, VertexFormat::Float4, offsetof(Vertex, tangent)},
    {"a_texCoord", 0, VertexFormat::Float2, offsetof(Vertex, uv0)},
    {"a_texCoord1", 0, VertexFormat::Float2, offsetof(Vertex, uv1)},
    {"a_color", 0, VertexFormat::Float4, offsetof(Vertex, color)},
    {"a_matWorld0", 1, VertexFormat::Float4, 0},
    {"a_matWorld1", 1, VertexFormat::Float4, kRowBytes},
    {"a_matWorld2", 1, VertexFormat::Float4, 2 * kRowBytes},
};

const AttributeRow& findAttribute(const ShaderVariable& input, const EffectVariant& variant) {
    std::vector<std::string> names;
    for (const AttributeRow& row : kAttributes) {
        if (input.name == row.name) return row;
        names.emplace_back(row.name);
    }
    throw Error(
        variant.pass->where,
        fmt::format("effect '{}' reads vertex attribute '{}', which meshes do not have", variant.effect, input.name),
        didYouMean(input.name, names, "attributes"));
}

}  // namespace

VertexInput vertexInput(const EffectVariant& variant) {
    VertexInput result;
    bool used[2] = {false, false};
    for (const ShaderVariable& input : variant.info.inputs) {
        if (!input.active) continue;
        const AttributeRow& row = findAttribute(input, variant);
        result.attributes.push_back(
            {.location = input.location, .binding = row.binding, .format = row.format, .offset = row.offset});
        used[row.binding] = true;
    }
    if (used[0]) result.bindings.push_back({.binding = 0, .stride = sizeof(Vertex), .perInstance = false});
    if (used[1]) result.bindings.push_back({.binding = 1, .stride = 3 * kRowBytes, .perInstance = true});
    return result;
}

}  // namespace crevice
