// Faults on demand: what a test asks a device to suffer, at the places where a real one would.
#pragma once

#include <optional>

#include "core/Format.h"

namespace crevice {

/// None by default. Numbers count from 0 since the device was made or the faults were set.
struct DeviceFaults {
    int failAllocation = -1;                ///< This allocation of device memory fails; -1 = none.
    int loseDevice = -1;                    ///< With this submission the device is lost, for good; -1 = never.
    std::optional<Format> missingFormat{};  ///< The driver can do nothing with images of this format.
};

}  // namespace crevice
