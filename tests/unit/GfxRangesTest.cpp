// The arithmetic under device memory: ranges, alignment, holes that merge.
#include <gtest/gtest.h>

#include <random>

#include "gfx/RangeAllocator.h"

namespace crevice {
namespace {

TEST(GfxRanges, FirstFitWithAlignment) {
    RangeAllocator ranges(1000);
    EXPECT_EQ(ranges.allocate(10, 1), 0u);
    EXPECT_EQ(ranges.allocate(10, 256), 256u);
    EXPECT_EQ(ranges.allocate(10, 4), 12u) << "the gap before an aligned range is used";
    EXPECT_EQ(ranges.used(), 30u);
}

TEST(GfxRanges, FullAndTooLargeGiveNothing) {
    RangeAllocator ranges(64);
    EXPECT_FALSE(ranges.allocate(65, 1).has_value());
    EXPECT_EQ(ranges.allocate(64, 64), 0u);
    EXPECT_FALSE(ranges.allocate(1, 1).has_value());
    EXPECT_EQ(ranges.holeCount(), 0u);
    EXPECT_FALSE(RangeAllocator(0).allocate(1, 1).has_value());
}

TEST(GfxRanges, FreedNeighboursMergeInEveryOrder) {
    const int orders[][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : orders) {
        RangeAllocator ranges(30);
        for (int i = 0; i < 3; ++i) ranges.allocate(10, 1);
        for (const int index : order) ranges.free(static_cast<std::uint64_t>(index) * 10, 10);
        EXPECT_TRUE(ranges.isEmpty());
        EXPECT_EQ(ranges.holeCount(), 1u);
        EXPECT_EQ(ranges.allocate(30, 1), 0u);
    }
}

TEST(GfxRanges, RandomUseNeverOverlapsAndEndsWhole) {
    constexpr std::uint64_t kSize = 4096;
    RangeAllocator ranges(kSize);
    std::vector<bool> taken(kSize, false);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> live;
    std::mt19937 random(1);
    for (int step = 0; step < 20000; ++step) {
        if (random() % 2 == 0) {
            const std::uint64_t size = 1 + random() % 200, alignment = std::uint64_t(1) << random() % 9;
            const auto offset = ranges.allocate(size, alignment);
            if (!offset) continue;
            ASSERT_EQ(*offset % alignment, 0u);
            ASSERT_LE(*offset + size, kSize);
            for (std::uint64_t i = *offset; i < *offset + size; ++i) {
                ASSERT_FALSE(taken[i]) << "step " << step;
                taken[i] = true;
            }
            live.emplace_back(*offset, size);
        } else if (!live.empty()) {
            std::swap(live[random() % live.size()], live.back());
            const auto [offset, size] = live.back();
            live.pop_back();
            ranges.free(offset, size);
            for (std::uint64_t i = offset; i < offset + size; ++i) taken[i] = false;
        }
    }
    for (const auto& [offset, size] : live) ranges.free(offset, size);
    EXPECT_TRUE(ranges.isEmpty());
    EXPECT_EQ(ranges.holeCount(), 1u);
}

}  // namespace
}  // namespace crevice
