// Listens to the validation layer: counts what it says, keeps the text, passes it to the log.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "core/Log.h"
#include "gfx/Vk.h"

namespace crevice {

class Messenger {
public:
    static constexpr std::size_t kMaxKept = 50;

    explicit Messenger(const Log& log) : log_(log) {}
    Messenger(const Messenger&) = delete;
    Messenger& operator=(const Messenger&) = delete;

    /// What to chain into VkInstanceCreateInfo, so that instance creation is heard too.
    VkDebugUtilsMessengerCreateInfoEXT createInfo();
    /// Starts to listen until destroyed; the instance must live longer.
    void attach(VkInstance instance);

    std::uint32_t count() const;
    std::vector<std::string> messages() const;

private:
    static VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                  VkDebugUtilsMessageTypeFlagsEXT type,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* self);
    void add(bool isError, std::string text);

    const Log& log_;
    mutable std::mutex mutex_;  // layers may call from any thread
    std::uint32_t count_ = 0;
    std::vector<std::string> messages_;
    Unique<VkDebugUtilsMessengerEXT> messenger_;
};

}  // namespace crevice
