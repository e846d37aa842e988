// Rows of independent work shared by threads: which thread takes a row never changes what the row becomes.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace crevice {

/// Calls work(row) once for every row below `rows`, in no order, and returns when all are done. `threads` 0 = one per
/// processor. `work` must not throw and may write only what belongs to its row.
template <class Work>
void forEachRow(std::uint32_t rows, unsigned threads, Work&& work) {
    std::atomic<std::uint32_t> next{0};
    const auto take = [&] {
        for (std::uint32_t row = next++; row < rows; row = next++) work(row);
    };
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < std::min(threads, rows); ++i) helpers.emplace_back(take);
    take();
}

}  // namespace crevice
