// Samplers by what they do; equal keys share one object.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>

#include "core/RenderState.h"
#include "gfx/Vk.h"

namespace crevice {

class Device;

enum class Filter : std::uint8_t { Nearest, Linear };
enum class SamplerWrap : std::uint8_t { Clamp, Repeat, Mirror, Border };
enum class BorderColor : std::uint8_t { TransparentBlack, OpaqueBlack, OpaqueWhite };
enum class MipFilter : std::uint8_t { None, Nearest, Linear };  ///< None samples mip 0 only.

/// Default: "point-clamp".
struct SamplerKey {
    Filter minFilter = Filter::Nearest;
    Filter magFilter = Filter::Nearest;
    MipFilter mipFilter = MipFilter::None;
    SamplerWrap wrapU = SamplerWrap::Clamp;
    SamplerWrap wrapV = SamplerWrap::Clamp;
    BorderColor border = BorderColor::TransparentBlack;
    std::optional<CompareOp> compare{};  ///< Set: a shadow sampler.
    auto operator<=>(const SamplerKey&) const = default;
};

class SamplerCache {
public:
    explicit SamplerCache(Device& device) : device_(device) {}
    /// Lives as long as the cache.
    VkSampler get(const SamplerKey& key);

private:
    Device& device_;
    std::map<SamplerKey, Unique<VkSampler>> samplers_;
};

}  // namespace crevice
