// One table per enum, in the enum's order.
#include "gfx/StateWords.h"

#include <array>

namespace crevice {

namespace {

template <class Enum, class Table>
auto lookUp(const Table& table, Enum value) {
    return table.at(static_cast<std::size_t>(value));
}

}  // namespace

VkCompareOp toVk(CompareOp op) {
    static constexpr std::array kOps = {VK_COMPARE_OP_NEVER,
                                        VK_COMPARE_OP_LESS,
                                        VK_COMPARE_OP_EQUAL,
                                        VK_COMPARE_OP_LESS_OR_EQUAL,
                                        VK_COMPARE_OP_GREATER,
                                        VK_COMPARE_OP_NOT_EQUAL,
                                        VK_COMPARE_OP_GREATER_OR_EQUAL,
                                        VK_COMPARE_OP_ALWAYS};
    return lookUp(kOps, op);
}

VkStencilOp toVk(StencilOp op) {
    static constexpr std::array kOps = {VK_STENCIL_OP_ZERO,
                                        VK_STENCIL_OP_KEEP,
                                        VK_STENCIL_OP_REPLACE,
                                        VK_STENCIL_OP_INCREMENT_AND_CLAMP,
                                        VK_STENCIL_OP_DECREMENT_AND_CLAMP,
                                        VK_STENCIL_OP_INVERT,
                                        VK_STENCIL_OP_INCREMENT_AND_WRAP,
                                        VK_STENCIL_OP_DECREMENT_AND_WRAP};
    return lookUp(kOps, op);
}

VkCullModeFlags toVk(CullMode mode) {
    static constexpr std::array kModes = {VK_CULL_MODE_NONE, VK_CULL_MODE_FRONT_BIT, VK_CULL_MODE_BACK_BIT};
    return static_cast<VkCullModeFlags>(lookUp(kModes, mode));
}

VkPolygonMode toVk(PolygonMode mode) {
    static constexpr std::array kModes = {VK_POLYGON_MODE_FILL, VK_POLYGON_MODE_LINE, VK_POLYGON_MODE_POINT};
    return lookUp(kModes, mode);
}

VkBlendFactor toVk(BlendFactor factor) {
    static constexpr std::array kFactors = {VK_BLEND_FACTOR_ZERO,
                                            VK_BLEND_FACTOR_ONE,
                                            VK_BLEND_FACTOR_SRC_ALPHA,
                                            VK_BLEND_FACTOR_DST_ALPHA,
                                            VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
                                            VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA,
                                            VK_BLEND_FACTOR_SRC_COLOR,
                                            VK_BLEND_FACTOR_DST_COLOR,
                                            VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR,
                                            VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR,
                                            VK_BLEND_FACTOR_SRC_ALPHA_SATURATE,
                                            VK_BLEND_FACTOR_CONSTANT_COLOR,
                                            VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR,
                                            VK_BLEND_FACTOR_CONSTANT_ALPHA,
                                            VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA};
    return lookUp(kFactors, factor);
}

VkBlendOp toVk(BlendOp op) {
    static constexpr std::array kOps = {VK_BLEND_OP_ADD, VK_BLEND_OP_SUBTRACT, VK_BLEND_OP_REVERSE_SUBTRACT,
                                        VK_BLEND_OP_MIN, VK_BLEND_OP_MAX};
    return lookUp(kOps, op);
}

VkPrimitiveTopology toVk(Topology topology) {
    static constexpr std::array kTopologies = {
        VK_PRIMITIVE_TOPOLOGY_POINT_LIST,    VK_PRIMITIVE_TOPOLOGY_LINE_LIST,      VK_PRIMITIVE_TOPOLOGY_LINE_STRIP,
        VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_FAN};
    return lookUp(kTopologies, topology);
}

VkFilter toVk(Filter filter) { return filter == Filter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST; }

}  // namespace crevice
