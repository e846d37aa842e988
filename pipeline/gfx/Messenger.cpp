// The debug messenger and the text of its messages.
#include "gfx/Messenger.h"

#include <fmt/format.h>

namespace crevice {

namespace {

/// The layer's message, then the labels and names of what was being recorded.
std::string describe(const VkDebugUtilsMessengerCallbackDataEXT& data) {
    std::string text = fmt::format("validation: {}", data.pMessage ? data.pMessage : "(no text)");
    for (std::uint32_t i = 0; i < data.cmdBufLabelCount; ++i) {
        text += fmt::format("\n  recorded in '{}'", data.pCmdBufLabels[i].pLabelName);
    }
    for (std::uint32_t i = 0; i < data.objectCount; ++i) {
        if (data.pObjects[i].pObjectName) text += fmt::format("\n  object '{}'", data.pObjects[i].pObjectName);
    }
    return text;
}

void destroyMessenger(void* instance, VkDebugUtilsMessengerEXT messenger) {
    const auto owner = static_cast<VkInstance>(instance);
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(owner, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(owner, messenger, nullptr);
}

}  // namespace

VkDebugUtilsMessengerCreateInfoEXT Messenger::createInfo() {
    auto info = vkStruct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = receive;
    info.pUserData = this;
    return info;
}

void Messenger::attach(VkInstance instance) {
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance, "vkCreateDebugUtilsMessengerEXT"));
    const auto info = createInfo();
    VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE;
    VK_CALL(create(instance, &info, nullptr, &messenger));
    messenger_ = {messenger, instance, destroyMessenger};
}

std::uint32_t Messenger::count() const {
    const std::lock_guard lock(mutex_);
    return count_;
}

std::vector<std::string> Messenger::messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

VkBool32 Messenger::receive(VkDebugUtilsMessageSeverityFlagBitsEXT severity, VkDebugUtilsMessageTypeFlagsEXT type,
                            const VkDebugUtilsMessengerCallbackDataEXT* data, void* self) {
    auto& messenger = *static_cast<Messenger*>(self);
    if (type == VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT) {
        // The loader's remarks about other drivers of the machine are no fault of ours.
        messenger.log_.verbose(describe(*data));
    } else {
        messenger.add((severity & VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT) != 0, describe(*data));
    }
    return VK_FALSE;
}

void Messenger::add(bool isError, std::string text) {
    log_.write(isError ? LogLevel::Error : LogLevel::Warning, text);
    const std::lock_guard lock(mutex_);
    ++count_;
    if (messages_.size() < kMaxKept) messages_.push_back(std::move(text));
}

}  // namespace crevice
