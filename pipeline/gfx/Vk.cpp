// Names of Vulkan results, and failures in words.
#include "gfx/Vk.h"

#include <fmt/format.h>

#include "core/Error.h"

namespace crevice {

const char* vkResultName(VkResult result) {
    switch (result) {
        case VK_SUCCESS:
            return "VK_SUCCESS";
        case VK_NOT_READY:
            return "VK_NOT_READY";
        case VK_TIMEOUT:
            return "VK_TIMEOUT";
        case VK_INCOMPLETE:
            return "VK_INCOMPLETE";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return "VK_ERROR_OUT_OF_HOST_MEMORY";
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
        case VK_ERROR_INITIALIZATION_FAILED:
            return "VK_ERROR_INITIALIZATION_FAILED";
        case VK_ERROR_DEVICE_LOST:
            return "VK_ERROR_DEVICE_LOST";
        case VK_ERROR_MEMORY_MAP_FAILED:
            return "VK_ERROR_MEMORY_MAP_FAILED";
        case VK_ERROR_LAYER_NOT_PRESENT:
            return "VK_ERROR_LAYER_NOT_PRESENT";
        case VK_ERROR_EXTENSION_NOT_PRESENT:
            return "VK_ERROR_EXTENSION_NOT_PRESENT";
        case VK_ERROR_FEATURE_NOT_PRESENT:
            return "VK_ERROR_FEATURE_NOT_PRESENT";
        case VK_ERROR_INCOMPATIBLE_DRIVER:
            return "VK_ERROR_INCOMPATIBLE_DRIVER";
        case VK_ERROR_TOO_MANY_OBJECTS:
            return "VK_ERROR_TOO_MANY_OBJECTS";
        case VK_ERROR_FORMAT_NOT_SUPPORTED:
            return "VK_ERROR_FORMAT_NOT_SUPPORTED";
        case VK_ERROR_FRAGMENTED_POOL:
            return "VK_ERROR_FRAGMENTED_POOL";
        case VK_ERROR_OUT_OF_POOL_MEMORY:
            return "VK_ERROR_OUT_OF_POOL_MEMORY";
        case VK_ERROR_INVALID_SHADER_NV:
            return "VK_ERROR_INVALID_SHADER_NV";
        default:
            return "an unknown VkResult";
    }
}

void throwVkError(VkResult result, const char* call) {
    const std::string what = fmt::format("{} ({}) from {}", vkResultName(result), static_cast<int>(result), call);
    switch (result) {
        case VK_ERROR_DEVICE_LOST:
            throw RenderError("the GPU was lost while it worked: " + what,
                              "the driver reset it; run again with --validate, or on another device with --device");
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            throw RenderError("the GPU is out of memory: " + what,
                              "render fewer pixels with --size, or a smaller scene");
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            throw RenderError("the driver is out of host memory: " + what);
        default:
            throw RenderError("a Vulkan call failed: " + what, "run again with --validate to see why");
    }
}

}  // namespace crevice
