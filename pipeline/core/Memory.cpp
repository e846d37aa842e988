// Linux: madvise(2), MADV_DONTNEED on private anonymous pages, which is what vectors lie in.
#include "core/Memory.h"

#include <cstdint>

#include <sys/mman.h>
#include <unistd.h>

namespace crevice {

void releasePages(std::span<std::byte> bytes) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto address = reinterpret_cast<std::uintptr_t>(bytes.data());
    const std::uintptr_t begin = (address + page - 1) / page * page;
    const std::uintptr_t end = (address + bytes.size()) / page * page;
    if (begin >= end) return;
    // A failure leaves the pages as they are, which is no worse.
    [[maybe_unused]] const int result =
        ::madvise(bytes.data() + (begin - address), std::size_t(end - begin), MADV_DONTNEED);
}

}  // namespace crevice
