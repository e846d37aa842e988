// Handles that belong to a Device: destroyed by it and counted in its live objects.
#pragma once

#include "gfx/Device.h"
#include "gfx/Vk.h"

namespace crevice {

/// own<vkDestroyImage, ObjectKind::Image>(device, image)
template <auto kDestroy, ObjectKind kKind, class Handle>
Unique<Handle> own(Device& device, Handle handle) {
    ++device.live()[kKind];
    return Unique<Handle>(handle, &device, [](void* owner, Handle dead) {
        Device& owning = *static_cast<Device*>(owner);
        kDestroy(owning.handle(), dead, nullptr);
        --owning.live()[kKind];
    });
}

}  // namespace crevice
