// GPU times: a pool of timestamps that commands write and the host reads in nanoseconds.
#pragma once

#include <cstdint>
#include <vector>

#include "gfx/Vk.h"

namespace crevice {

class Device;

class Timestamps {
public:
    Timestamps(Device& device, std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    bool isSupported() const { return period_ > 0; }
    /// Times of slots 0 … count-1 in ns since slot 0; all must have been written and waited for. Zeros when
    /// unsupported.
    std::vector<double> read(std::uint32_t count) const;
    VkQueryPool handle() const { return pool_.get(); }

private:
    Device* device_;
    std::uint32_t capacity_;
    double period_;       ///< ns per tick
    std::uint64_t mask_;  ///< Valid bits.
    Unique<VkQueryPool> pool_;
};

}  // namespace crevice
