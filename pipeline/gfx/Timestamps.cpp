// Query pool of timestamps.
#include "gfx/Timestamps.h"

#include <cassert>

#include "gfx/Device.h"
#include "gfx/Owned.h"

namespace crevice {

Timestamps::Timestamps(Device& device, std::uint32_t capacity)
    : device_(&device),
      capacity_(capacity),
      period_(device.timestampPeriod()),
      mask_(device.timestampBits() >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << device.timestampBits()) - 1) {
    assert(capacity > 0);
    auto info = vkStruct<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = capacity;
    VkQueryPool pool = VK_NULL_HANDLE;
    VK_CALL(vkCreateQueryPool(device.handle(), &info, nullptr, &pool));
    pool_ = own<vkDestroyQueryPool, ObjectKind::QueryPool>(device, pool);
}

std::vector<double> Timestamps::read(std::uint32_t count) const {
    assert(count <= capacity_);
    std::vector<double> nanoseconds(count, 0.0);
    if (count == 0 || !isSupported()) return nanoseconds;
    std::vector<std::uint64_t> ticks(count);
    VK_CALL(vkGetQueryPoolResults(device_->handle(), pool_.get(), 0, count, count * sizeof(std::uint64_t), ticks.data(),
                                  sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    // From the first slot, so that a double keeps single ticks.
    for (std::uint32_t i = 0; i < count; ++i) {
        nanoseconds[i] = static_cast<double>((ticks[i] - ticks[0]) & mask_) * period_;
    }
    return nanoseconds;
}

}  // namespace crevice
