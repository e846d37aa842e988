// The only door to <vulkan/vulkan.h>: owning handles, and calls whose failure is an Error with the call's text.
#pragma once

#include <utility>

#include <vulkan/vulkan.h>

namespace crevice {

/// "VK_ERROR_DEVICE_LOST".
const char* vkResultName(VkResult result);

/// Throws RenderError: what failed in words, the call and the result's name.
[[noreturn]] void throwVkError(VkResult result, const char* call);

/// Runs a Vulkan call; anything but VK_SUCCESS throws RenderError with the text of the call.
#define VK_CALL(expr)                                                                   \
    do {                                                                                \
        const VkResult vkCallResult_ = (expr);                                          \
        if (vkCallResult_ != VK_SUCCESS) ::crevice::throwVkError(vkCallResult_, #expr); \
    } while (false)

/// A zeroed Vulkan struct of the given type.
template <class Struct>
Struct vkStruct(VkStructureType type) {
    Struct result{};
    result.sType = type;
    return result;
}

/// Sole owner of a Vulkan handle; `destroy(owner, handle)` runs once. Move-only.
template <class Handle>
class Unique {
public:
    using Destroy = void (*)(void* owner, Handle handle);

    Unique() = default;
    Unique(Handle handle, void* owner, Destroy destroy) : handle_(handle), owner_(owner), destroy_(destroy) {}
    Unique(Unique&& other) noexcept
        : handle_(std::exchange(other.handle_, Handle{})), owner_(other.owner_), destroy_(other.destroy_) {}
    Unique& operator=(Unique&& other) noexcept {
        if (this != &other) {
            reset();
            handle_ = std::exchange(other.handle_, Handle{});
            owner_ = other.owner_;
            destroy_ = other.destroy_;
        }
        return *this;
    }
    ~Unique() { reset(); }

    Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != Handle{}; }
    void reset() {
        if (handle_ != Handle{}) destroy_(owner_, std::exchange(handle_, Handle{}));
    }

private:
    Handle handle_{};
    void* owner_ = nullptr;
    Destroy destroy_ = nullptr;
};

}  // namespace crevice
