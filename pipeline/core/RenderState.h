// Fixed-function state as pure data: what an effect's pass asks for, before any Vulkan.
#pragma once

#include <cstdint>
#include <vector>

namespace crevice {

enum class CompareOp : std::uint8_t { Never, Less, Equal, LessEqual, Greater, NotEqual, GreaterEqual, Always };
enum class StencilOp : std::uint8_t { Zero, Keep, Replace, Incr, Decr, Invert, IncrWrap, DecrWrap };
enum class CullMode : std::uint8_t { None, Front, Back };
enum class PolygonMode : std::uint8_t { Fill, Line, Point };
enum class BlendFactor : std::uint8_t {
    Zero,
    One,
    SrcAlpha,
    DstAlpha,
    OneMinusSrcAlpha,
    OneMinusDstAlpha,
    SrcColor,
    DstColor,
    OneMinusSrcColor,
    OneMinusDstColor,
    SrcAlphaSaturate,
    ConstantColor,
    OneMinusConstantColor,
    ConstantAlpha,
    OneMinusConstantAlpha
};
enum class BlendOp : std::uint8_t { Add, Sub, RevSub, Min, Max };
enum class Topology : std::uint8_t { PointList, LineList, LineStrip, TriangleList, TriangleStrip, TriangleFan };

/// Defaults are Cocos': depth test and write on with `less`, back faces culled, counter-clockwise front, no blending.
struct BlendTarget {
    bool blend = false;
    BlendFactor src = BlendFactor::One, dst = BlendFactor::Zero;
    BlendOp op = BlendOp::Add;
    BlendFactor srcAlpha = BlendFactor::One, dstAlpha = BlendFactor::Zero;
    BlendOp alphaOp = BlendOp::Add;
    std::uint8_t colorMask = 0xf;
    bool operator==(const BlendTarget&) const = default;
};

/// What Cocos' files say of the stencil test of one side. A depth target that a pass with such a test draws into has
/// eight bits of stencil; Crevice's own dialect has no words for it.
struct StencilFace {
    bool test = false;
    CompareOp func = CompareOp::Always;
    std::uint32_t readMask = 0xffff, writeMask = 0xffff, ref = 1;
    StencilOp failOp = StencilOp::Keep, zFailOp = StencilOp::Keep, passOp = StencilOp::Keep;
    bool operator==(const StencilFace&) const = default;
};

struct RenderState {
    Topology topology = Topology::TriangleList;
    PolygonMode polygonMode = PolygonMode::Fill;
    CullMode cullMode = CullMode::Back;
    bool frontFaceCcw = true;
    float depthBias = 0, depthBiasSlope = 0;
    bool depthTest = true;
    bool depthWrite = true;
    CompareOp depthFunc = CompareOp::Less;
    StencilFace stencilFront{}, stencilBack{};
    std::vector<BlendTarget> blendTargets{};  ///< Per colour attachment; missing ones do not blend.
    bool operator==(const RenderState&) const = default;
};

}  // namespace crevice
