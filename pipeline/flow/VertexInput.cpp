// The tables of attribute names.
#include "flow/VertexInput.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>

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
    {"a_position", kMeshStream, VertexFormat::Float3, offsetof(Vertex, position)},
    {"a_normal", kMeshStream, VertexFormat::Float3, offsetof(Vertex, normal)},
    {"a_tangent", kMeshStream, VertexFormat::Float4, offsetof(Vertex, tangent)},
    {"a_texCoord", kMeshStream, VertexFormat::Float2, offsetof(Vertex, uv0)},
    {"a_texCoord1", kMeshStream, VertexFormat::Float2, offsetof(Vertex, uv1)},
    {"a_color", kMeshStream, VertexFormat::Float4, offsetof(Vertex, color)},
    {"a_matWorld0", kInstanceStream, VertexFormat::Float4, 0},
    {"a_matWorld1", kInstanceStream, VertexFormat::Float4, kRowBytes},
    {"a_matWorld2", kInstanceStream, VertexFormat::Float4, 2 * kRowBytes},
};

// The quad: position and texture coordinates, two floats each.
constexpr AttributeRow kQuadAttributes[] = {
    {"a_position", kMeshStream, VertexFormat::Float2, 0},
    {"a_texCoord", kMeshStream, VertexFormat::Float2, 2 * sizeof(float)},
};

std::span<const AttributeRow> attributesOf(VertexSource source) {
    if (source == VertexSource::Quad) return kQuadAttributes;
    return kAttributes;
}

std::uint32_t strideOf(std::uint32_t stream, VertexSource source, const VertexLayout& layout) {
    if (stream == kInstanceStream) return 3 * kRowBytes;
    if (stream == kSameStream) return 0;
    return source == VertexSource::Quad ? 4 * sizeof(float) : layout.stride();
}

/// Where the part of a vertex lies in a scene that may have left it out.
AttributeRow placed(AttributeRow row, const VertexLayout& layout) {
    if (const auto place = layout.placeOf(row.offset)) {
        row.offset = *place;
    } else {
        row.binding = kSameStream;
        row.offset += kZeroBytes;
    }
    return row;
}

/// Zeroes in the type that the shader declares.
AttributeRow zeroRow(const ShaderVariable& input) {
    const bool integer = input.type.starts_with('u') || input.type.starts_with('i');
    return {input.name.c_str(), kSameStream, integer ? VertexFormat::UInt4 : VertexFormat::Float4, 0};
}

AttributeRow findAttribute(const ShaderVariable& input, const EffectVariant& variant, VertexSource source,
                           MissingAttributes missing) {
    std::vector<std::string> names;
    for (const AttributeRow& row : attributesOf(source)) {
        if (input.name == row.name) return row;
        names.emplace_back(row.name);
    }
    if (missing == MissingAttributes::Zero) return zeroRow(input);
    throw Error(variant.pass->where,
                fmt::format("effect '{}' reads vertex attribute '{}', which {}", variant.effect, input.name,
                            source == VertexSource::Quad ? "the full-screen quad does not have" : "meshes do not have"),
                didYouMean(input.name, names, "attributes"));
}

}  // namespace

bool VertexInput::uses(std::uint32_t stream) const {
    return std::any_of(bindings.begin(), bindings.end(), [&](const VertexBinding& b) { return b.binding == stream; });
}

VertexInput vertexInput(const EffectVariant& variant, VertexSource source, MissingAttributes missing,
                        const VertexLayout& layout) {
    VertexInput result;
    for (const ShaderVariable& input : variant.info.inputs) {
        // Front ends keep declarations that no code reads in the shader's interface: Vulkan wants them fed.
        if (!input.active && missing == MissingAttributes::Refused) continue;
        AttributeRow row = findAttribute(input, variant, source, missing);
        if (source == VertexSource::Mesh && row.binding == kMeshStream) row = placed(row, layout);
        result.attributes.push_back(
            {.location = input.location, .binding = row.binding, .format = row.format, .offset = row.offset});
    }
    for (const std::uint32_t stream : {kMeshStream, kInstanceStream, kSameStream}) {
        const bool used = std::any_of(result.attributes.begin(), result.attributes.end(),
                                      [&](const VertexAttribute& a) { return a.binding == stream; });
        if (used)
            result.bindings.push_back({.binding = stream,
                                       .stride = strideOf(stream, source, layout),
                                       .perInstance = stream == kInstanceStream});
    }
    return result;
}

}  // namespace crevice
