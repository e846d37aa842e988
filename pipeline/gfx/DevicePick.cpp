// Best usable device, or an error that lists what there is.
#include "gfx/DevicePick.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Text.h"

namespace crevice {

namespace {

int rankOf(const std::string& type) {
    if (type == "discrete") return 0;
    if (type == "integrated") return 1;
    if (type == "virtual") return 2;
    if (type == "cpu") return 3;
    return 4;
}

std::string listOf(const std::vector<DeviceInfo>& devices) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        lines.push_back(fmt::format("{}: '{}' ({}{})", i, device.name, device.type,
                                    device.problem.empty() ? "" : ", unusable: " + device.problem));
    }
    return join(lines, "; ");
}

bool isNumber(const std::string& text) {
    return !text.empty() && text.size() < 6 &&
           std::all_of(text.begin(), text.end(), [](unsigned char letter) { return std::isdigit(letter) != 0; });
}

/// True when `wanted` is the device's index, or a part of its name or driver in any case.
bool matches(const DeviceInfo& device, std::size_t index, const std::string& wanted) {
    if (isNumber(wanted)) return std::stoul(wanted) == index;
    const std::string part = lowerCase(wanted);
    return lowerCase(device.name).find(part) != std::string::npos ||
           lowerCase(device.driver).find(part) != std::string::npos;
}

}  // namespace

std::string describeProblem(const DeviceFacts& facts) {
    if (facts.apiVersion < VK_API_VERSION_1_3) {
        return fmt::format("it has Vulkan {}.{}, 1.3 is needed", VK_API_VERSION_MAJOR(facts.apiVersion),
                           VK_API_VERSION_MINOR(facts.apiVersion));
    }
    std::vector<std::string> missing;
    if (!facts.graphicsComputeQueue) missing.emplace_back("a queue for graphics and compute");
    if (!facts.dynamicRendering) missing.emplace_back("feature 'dynamicRendering'");
    if (!facts.synchronization2) missing.emplace_back("feature 'synchronization2'");
    if (!facts.maintenance4) missing.emplace_back("feature 'maintenance4'");
    if (!facts.robustBufferAccess) missing.emplace_back("feature 'robustBufferAccess'");
    if (!facts.storageImageExtendedFormats) missing.emplace_back("feature 'shaderStorageImageExtendedFormats'");
    for (const std::string& format : facts.missingFormats) missing.push_back("format " + format);
    return missing.empty() ? "" : "it lacks " + join(missing);
}

std::size_t chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& wanted) {
    if (devices.empty()) {
        throw Error(
            "no Vulkan driver was found",
            "install your GPU's driver, or mesa-vulkan-drivers for rendering on the CPU; see docs/troubleshooting.md");
    }
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (wanted.empty() || matches(devices[i], i, wanted)) candidates.push_back(i);
    }
    if (candidates.empty()) throw Error(fmt::format("no Vulkan device '{}'", wanted), "devices: " + listOf(devices));

    std::stable_sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
        const bool usableA = devices[a].problem.empty(), usableB = devices[b].problem.empty();
        return usableA != usableB ? usableA : rankOf(devices[a].type) < rankOf(devices[b].type);
    });
    const DeviceInfo& best = devices[candidates.front()];
    if (!best.problem.empty()) {
        throw Error(fmt::format("device '{}' cannot be used: {}", best.name, best.problem),
                    "update its driver, or choose another with --device; devices: " + listOf(devices));
    }
    return candidates.front();
}

}  // namespace crevice
