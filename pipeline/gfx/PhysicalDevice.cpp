// Reads properties, features and formats of a physical device.
#include "gfx/PhysicalDevice.h"

#include <fmt/format.h>

#include "gfx/DevicePick.h"
#include "gfx/Format.h"

namespace crevice {

namespace {

const char* typeName(VkPhysicalDeviceType type) {
    switch (type) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "cpu";
        default:
            return "other";
    }
}

/// Formats that no frame of ours can do without; others are checked when a texture is made.
std::vector<std::string> findMissingFormats(VkPhysicalDevice device, std::optional<Format> absent) {
    const auto needs = [](Format format, VkFormatFeatureFlags features, const char* words) {
        return std::tuple(format, features, words);
    };
    const VkFormatFeatureFlags color = VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    const VkFormatFeatureFlags depth =
        VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
    std::vector<std::string> missing;
    for (const auto& [format, features, words] :
         {needs(Format::RGBA8, color, "colour attachment"), needs(Format::RGBA16F, color, "colour attachment"),
          needs(Format::R32F, color | VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "colour attachment and storage image"),
          needs(Format::D32F, depth, "sampled depth attachment")}) {
        VkFormatProperties properties{};
        vkGetPhysicalDeviceFormatProperties(device, toVk(format), &properties);
        if (format == absent || (properties.optimalTilingFeatures & features) != features) {
            missing.push_back(fmt::format("'{}' as {}", formatInfo(format).name, words));
        }
    }
    return missing;
}

DeviceFacts gatherFacts(VkPhysicalDevice device, std::uint32_t apiVersion, std::optional<Format> absent) {
    DeviceFacts facts;
    facts.apiVersion = apiVersion;
    facts.graphicsComputeQueue = findQueue(device).has_value();
    if (apiVersion < VK_API_VERSION_1_3) return facts;
    auto vulkan13 = vkStruct<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
    auto core = vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    core.pNext = &vulkan13;
    vkGetPhysicalDeviceFeatures2(device, &core);
    facts.dynamicRendering = vulkan13.dynamicRendering == VK_TRUE;
    facts.synchronization2 = vulkan13.synchronization2 == VK_TRUE;
    facts.maintenance4 = vulkan13.maintenance4 == VK_TRUE;
    facts.robustBufferAccess = core.features.robustBufferAccess == VK_TRUE;
    facts.storageImageExtendedFormats = core.features.shaderStorageImageExtendedFormats == VK_TRUE;
    facts.missingFormats = findMissingFormats(device, absent);
    return facts;
}

}  // namespace

std::vector<VkPhysicalDevice> enumeratePhysicalDevices(VkInstance instance) {
    std::uint32_t count = 0;
    // Loaders say "initialization failed" when no driver came up: for us that is an empty list.
    if (vkEnumeratePhysicalDevices(instance, &count, nullptr) != VK_SUCCESS) return {};
    std::vector<VkPhysicalDevice> devices(count);
    VK_CALL(vkEnumeratePhysicalDevices(instance, &count, devices.data()));
    devices.resize(count);
    return devices;
}

DeviceInfo describePhysicalDevice(VkPhysicalDevice device, std::optional<Format> missing) {
    VkPhysicalDeviceProperties basic{};
    vkGetPhysicalDeviceProperties(device, &basic);
    DeviceInfo info;
    info.name = basic.deviceName;
    info.type = typeName(basic.deviceType);
    info.api = fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(basic.apiVersion), VK_API_VERSION_MINOR(basic.apiVersion),
                           VK_API_VERSION_PATCH(basic.apiVersion));
    if (basic.apiVersion >= VK_API_VERSION_1_2) {
        auto driver = vkStruct<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
        auto properties = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
        properties.pNext = &driver;
        vkGetPhysicalDeviceProperties2(device, &properties);
        info.driver = fmt::format("{}, {}", driver.driverName, driver.driverInfo);
    }
    info.problem = describeProblem(gatherFacts(device, basic.apiVersion, missing));
    return info;
}

std::optional<QueueChoice> findQueue(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags kBoth = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & kBoth) == kBoth) return QueueChoice{i, families[i].timestampValidBits};
    }
    return std::nullopt;
}

EnabledFeatures::EnabledFeatures(VkPhysicalDevice device)
    : core(vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2)),
      vulkan13(vkStruct<VkPhysicalDeviceVulkan13Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES)) {
    auto has13 = vulkan13;
    auto has = core;
    has.pNext = &has13;
    vkGetPhysicalDeviceFeatures2(device, &has);

    core.pNext = &vulkan13;
    core.features.robustBufferAccess = VK_TRUE;
    core.features.shaderStorageImageExtendedFormats = VK_TRUE;
    vulkan13.dynamicRendering = VK_TRUE;
    vulkan13.synchronization2 = VK_TRUE;
    vulkan13.maintenance4 = VK_TRUE;
    // Optional ones: shaders and states that need them are refused by the driver's limits, not here.
    core.features.independentBlend = has.features.independentBlend;
    core.features.fillModeNonSolid = has.features.fillModeNonSolid;
    core.features.samplerAnisotropy = has.features.samplerAnisotropy;
    core.features.fragmentStoresAndAtomics = has.features.fragmentStoresAndAtomics;
    core.features.vertexPipelineStoresAndAtomics = has.features.vertexPipelineStoresAndAtomics;
    core.features.shaderStorageImageWriteWithoutFormat = has.features.shaderStorageImageWriteWithoutFormat;
    vulkan13.robustImageAccess = has13.robustImageAccess;
    vulkan13.shaderDemoteToHelperInvocation = has13.shaderDemoteToHelperInvocation;
    vulkan13.shaderTerminateInvocation = has13.shaderTerminateInvocation;
}

}  // namespace crevice
