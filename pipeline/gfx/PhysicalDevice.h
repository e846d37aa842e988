// Questions to a physical device: what it is called, what it can do, which features to switch on.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gfx/Device.h"
#include "gfx/Vk.h"

namespace crevice {

/// In the loader's order; empty when there is none.
std::vector<VkPhysicalDevice> enumeratePhysicalDevices(VkInstance instance);

/// `missing`: a format to report as missing, for tests.
DeviceInfo describePhysicalDevice(VkPhysicalDevice device, std::optional<Format> missing);

struct QueueChoice {
    std::uint32_t family = 0;
    std::uint32_t timestampBits = 0;  ///< 0 = no timestamps.
};
/// The first family with graphics and compute.
std::optional<QueueChoice> findQueue(VkPhysicalDevice device);

/// Needed features, and the optional ones that the device has; `core` is the head of the chain.
struct EnabledFeatures {
    explicit EnabledFeatures(VkPhysicalDevice device);
    EnabledFeatures(const EnabledFeatures&) = delete;
    EnabledFeatures& operator=(const EnabledFeatures&) = delete;
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan13Features vulkan13;
};

}  // namespace crevice
