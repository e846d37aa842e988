// The Vulkan 1.3 device: instance, choice of GPU, one queue, memory, and the validation messages it counted.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/Log.h"
#include "gfx/DeviceFaults.h"
#include "gfx/LiveObjects.h"
#include "gfx/Memory.h"
#include "gfx/Vk.h"

namespace crevice {

class Messenger;

struct DeviceOptions {
    const Log& log;         ///< Must outlive the device.
    std::string device{};   ///< Index in listDevices() or part of a name; empty = discrete, else integrated, else CPU.
    bool validate = false;  ///< Needs the package vulkan-validationlayers.
    bool syncValidation = false;  ///< Also look for missing barriers; implies validate.
    DeviceFaults faults{};        ///< For tests.
};

/// A GPU or CPU driver that the Vulkan loader found.
struct DeviceInfo {
    std::string name;     ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string type;     ///< "discrete", "integrated", "virtual", "cpu", "other"
    std::string driver;   ///< "llvmpipe, Mesa 22.3.6"
    std::string api;      ///< "1.3.230"
    std::string problem;  ///< Why Crevice cannot use it; empty = usable.
};

/// Single-threaded; everything made from it must be destroyed before it. Not movable: objects keep its address.
class Device {
public:
    /// Throws Error in words: no driver, no such device, missing feature, missing validation layer.
    explicit Device(const DeviceOptions& options);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// All drivers, usable or not, in the loader's order, not the best first: indices of devices count in it.
    static std::vector<DeviceInfo> listDevices();

    const std::string& deviceName() const { return info_.name; }
    const std::string& driverInfo() const { return info_.driver; }
    const DeviceInfo& info() const { return info_; }
    const VkPhysicalDeviceLimits& limits() const { return limits_; }
    const VkPhysicalDeviceFeatures& features() const { return features_; }  ///< The enabled ones.
    /// Nanoseconds per timestamp tick; 0 = the queue has no timestamps.
    double timestampPeriod() const { return timestampPeriod_; }
    std::uint32_t timestampBits() const { return timestampBits_; }

    std::uint64_t heapBytes() const;       ///< The largest device-local heap.
    std::uint64_t allocatedBytes() const;  ///< In use by images and buffers.
    const LiveObjects& liveObjects() const { return live_; }

    /// Warnings and errors of the validation layer since the device was made.
    std::uint32_t validationMessageCount() const;
    /// The text of those messages, oldest first; at most 50 are kept.
    std::vector<std::string> validationMessages() const;
    bool validates() const { return validates_; }

    void waitIdle();
    /// Tests: from now on these faults, numbers counted anew. A device that was lost so works again.
    void setFaults(const DeviceFaults& faults);

    // Below: for the other classes of gfx/.
    VkDevice handle() const { return device_.get(); }
    VkPhysicalDevice physical() const { return physical_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queueFamily() const { return queueFamily_; }
    VkPipelineCache pipelineCache() const { return pipelineCache_.get(); }
    MemoryAllocator& memory() { return *memory_; }
    /// Called once per submission: VK_SUCCESS, or the fault that is due.
    VkResult nextSubmitFault();
    bool lacksFormat(Format format) const { return faults_.missingFormat == format; }
    const Log& log() const { return log_; }
    LiveObjects& live() { return live_; }
    /// Names an object in validation messages and captures.
    template <class Handle>
    void setName(VkObjectType type, Handle handle, const std::string& name) {
        setObjectName(type, (std::uint64_t)(handle), name);
    }
    void beginLabel(VkCommandBuffer commands, const char* name) const;
    void endLabel(VkCommandBuffer commands) const;

private:
    void createInstance(const DeviceOptions& options);
    void pickPhysicalDevice(const std::string& wanted);
    void createDevice();
    void setObjectName(VkObjectType type, std::uint64_t handle, const std::string& name);

    const Log& log_;
    DeviceFaults faults_;
    int submissions_ = 0;
    bool validates_ = false;
    bool hasDebugUtils_ = false;
    double timestampPeriod_ = 0;
    std::uint32_t timestampBits_ = 0;
    DeviceInfo info_;
    VkPhysicalDeviceLimits limits_{};
    VkPhysicalDeviceFeatures features_{};
    LiveObjects live_;
    Unique<VkInstance> instance_;
    std::unique_ptr<Messenger> messenger_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    std::uint32_t queueFamily_ = 0;
    VkQueue queue_ = VK_NULL_HANDLE;
    Unique<VkDevice> device_;
    Unique<VkPipelineCache> pipelineCache_;
    std::unique_ptr<MemoryAllocator> memory_;
    PFN_vkSetDebugUtilsObjectNameEXT setName_ = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT beginLabel_ = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT endLabel_ = nullptr;
};

}  // namespace crevice
