// Which driver to use and why another cannot be: pure decisions over what the loader reported.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gfx/Device.h"

namespace crevice {

/// What a physical device has of that which Crevice needs.
struct DeviceFacts {
    std::uint32_t apiVersion = 0;
    bool graphicsComputeQueue = false;
    bool dynamicRendering = false;
    bool synchronization2 = false;
    bool maintenance4 = false;
    bool robustBufferAccess = false;
    bool storageImageExtendedFormats = false;
    std::vector<std::string> missingFormats{};  ///< "RGBA16F as colour attachment"
};

/// Empty when usable, else everything missing in words.
std::string describeProblem(const DeviceFacts& facts);

/// Index of the device to use. Throws Error: none at all, none named so (lists them), none usable, the named one
/// unusable.
std::size_t chooseDevice(const std::vector<DeviceInfo>& devices, const std::string& wanted);

}  // namespace crevice
