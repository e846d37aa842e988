// Makes the instance and the device, and says in words what is missing when it cannot.
#include "gfx/Device.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "core/Error.h"
#include "gfx/DevicePick.h"
#include "gfx/Messenger.h"
#include "gfx/PhysicalDevice.h"

namespace crevice {

namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool hasInstanceLayer(const char* name) {
    std::uint32_t count = 0;
    VK_CALL(vkEnumerateInstanceLayerProperties(&count, nullptr));
    std::vector<VkLayerProperties> layers(count);
    VK_CALL(vkEnumerateInstanceLayerProperties(&count, layers.data()));
    return std::any_of(layers.begin(), layers.end(),
                       [&](const VkLayerProperties& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool hasInstanceExtension(const char* name) {
    std::uint32_t count = 0;
    VK_CALL(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr));
    std::vector<VkExtensionProperties> extensions(count);
    VK_CALL(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()));
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& extension) {
        return std::strcmp(extension.extensionName, name) == 0;
    });
}

/// `chain` is what the instance info points at; may be null.
Unique<VkInstance> makeInstance(const std::vector<const char*>& layers, const std::vector<const char*>& extensions,
                                const void* chain) {
    auto application = vkStruct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = "crevice";
    application.apiVersion = VK_API_VERSION_1_3;
    auto info = vkStruct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pNext = chain;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = static_cast<std::uint32_t>(layers.size());
    info.ppEnabledLayerNames = layers.data();
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    VkInstance instance = VK_NULL_HANDLE;
    const VkResult result = vkCreateInstance(&info, nullptr, &instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) chooseDevice({}, {});  // throws "no Vulkan driver was found"
    VK_CALL(result);
    return {instance, nullptr, [](void*, VkInstance dead) { vkDestroyInstance(dead, nullptr); }};
}

template <class Function>
Function instanceFunction(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

Device::Device(const DeviceOptions& options) : log_(options.log), faults_(options.faults) {
    createInstance(options);
    pickPhysicalDevice(options.device);
    createDevice();
    memory_ = std::make_unique<MemoryAllocator>(physical_, device_.get(), live_, faults_.failAllocation);
}

Device::~Device() {
    if (device_) vkDeviceWaitIdle(device_.get());
    const bool leaks = std::any_of(live_.counts.begin(), live_.counts.end(), [](std::int64_t n) { return n != 0; });
    if (leaks) log_.error("Vulkan objects outlived their device: " + live_.text());
}

void Device::createInstance(const DeviceOptions& options) {
    std::vector<const char*> layers, extensions;
    validates_ = options.validate || options.syncValidation;
    if (validates_) {
        if (!hasInstanceLayer(kValidationLayer)) {
            throw Error("the Vulkan validation layer is not installed",
                        "install the package vulkan-validationlayers, or run without --validate");
        }
        layers.push_back(kValidationLayer);
    }
    hasDebugUtils_ = hasInstanceExtension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (hasDebugUtils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    messenger_ = std::make_unique<Messenger>(log_);
    const auto messengerInfo = messenger_->createInfo();
    const VkValidationFeatureEnableEXT sync = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    auto features = vkStruct<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
    features.pNext = hasDebugUtils_ ? &messengerInfo : nullptr;
    features.enabledValidationFeatureCount = options.syncValidation ? 1 : 0;
    features.pEnabledValidationFeatures = &sync;
    instance_ = makeInstance(layers, extensions, validates_ ? &features : nullptr);

    if (validates_ && hasDebugUtils_) messenger_->attach(instance_.get());
    if (!hasDebugUtils_) return;
    VkInstance instance = instance_.get();
    setName_ = instanceFunction<PFN_vkSetDebugUtilsObjectNameEXT>(instance, "vkSetDebugUtilsObjectNameEXT");
    beginLabel_ = instanceFunction<PFN_vkCmdBeginDebugUtilsLabelEXT>(instance, "vkCmdBeginDebugUtilsLabelEXT");
    endLabel_ = instanceFunction<PFN_vkCmdEndDebugUtilsLabelEXT>(instance, "vkCmdEndDebugUtilsLabelEXT");
}

void Device::pickPhysicalDevice(const std::string& wanted) {
    const std::vector<VkPhysicalDevice> all = enumeratePhysicalDevices(instance_.get());
    std::vector<DeviceInfo> infos;
    for (VkPhysicalDevice candidate : all) infos.push_back(describePhysicalDevice(candidate, faults_.missingFormat));
    const std::size_t chosen = chooseDevice(infos, wanted);
    physical_ = all[chosen];
    info_ = infos[chosen];
    log_.verbose(fmt::format("device {}: {} ({})", chosen, info_.name, info_.driver));
}

void Device::createDevice() {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    limits_ = properties.limits;
    const QueueChoice queue = *findQueue(physical_);  // chooseDevice() made sure of it
    queueFamily_ = queue.family;
    timestampPeriod_ = queue.timestampBits > 0 ? static_cast<double>(limits_.timestampPeriod) : 0;
    timestampBits_ = queue.timestampBits;

    const EnabledFeatures enabled(physical_);
    features_ = enabled.core.features;

    const float priority = 1;
    auto queueInfo = vkStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = queueFamily_;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    auto info = vkStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &enabled.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    VkDevice device = VK_NULL_HANDLE;
    VK_CALL(vkCreateDevice(physical_, &info, nullptr, &device));
    device_ = {device, nullptr, [](void*, VkDevice dead) { vkDestroyDevice(dead, nullptr); }};
    vkGetDeviceQueue(device, queueFamily_, 0, &queue_);

    const auto cacheInfo = vkStruct<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    VkPipelineCache cache = VK_NULL_HANDLE;
    VK_CALL(vkCreatePipelineCache(device, &cacheInfo, nullptr, &cache));
    pipelineCache_ = {cache, device, [](void* owner, VkPipelineCache dead) {
                          vkDestroyPipelineCache(static_cast<VkDevice>(owner), dead, nullptr);
                      }};
}

std::vector<DeviceInfo> Device::listDevices() {
    std::vector<DeviceInfo> infos;
    try {
        const Unique<VkInstance> instance = makeInstance({}, {}, nullptr);
        for (VkPhysicalDevice device : enumeratePhysicalDevices(instance.get())) {
            infos.push_back(describePhysicalDevice(device, std::nullopt));
        }
    } catch (const RenderError&) {
        throw;
    } catch (const Error&) {
        // No driver at all: an empty list says so.
    }
    return infos;
}

std::uint64_t Device::heapBytes() const { return memory_->heapBytes(); }
std::uint64_t Device::allocatedBytes() const { return memory_->usedBytes(); }
std::uint32_t Device::validationMessageCount() const { return messenger_->count(); }
std::vector<std::string> Device::validationMessages() const { return messenger_->messages(); }
void Device::setFaults(const DeviceFaults& faults) {
    faults_ = faults;
    submissions_ = 0;
    memory_->failAt(faults.failAllocation);
}

VkResult Device::nextSubmitFault() {
    const bool lost = faults_.loseDevice >= 0 && submissions_ >= faults_.loseDevice;
    ++submissions_;
    return lost ? VK_ERROR_DEVICE_LOST : VK_SUCCESS;
}

void Device::waitIdle() { VK_CALL(vkDeviceWaitIdle(device_.get())); }

void Device::setObjectName(VkObjectType type, std::uint64_t handle, const std::string& name) {
    if (!setName_ || name.empty()) return;
    auto info = vkStruct<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    VK_CALL(setName_(device_.get(), &info));
}

void Device::beginLabel(VkCommandBuffer commands, const char* name) const {
    if (!beginLabel_) return;
    auto label = vkStruct<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
    label.pLabelName = name;
    beginLabel_(commands, &label);
}

void Device::endLabel(VkCommandBuffer commands) const {
    if (endLabel_) endLabel_(commands);
}

}  // namespace crevice
