// Keeps the yardsticks still, and frames from growing: the texts that ratios refer to, memory from frame to frame,
// stage times.
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "Cases.h"
#include "core/Files.h"

namespace crevice::bench {
namespace {

/// What the process holds in memory, in bytes.
double residentBytes() {
    std::ifstream statm("/proc/self/statm");
    double total = 0, resident = 0;
    statm >> total >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

BenchView smallView() {
    return {.width = 160, .height = 90, .scene = CREVICE_BENCH_DIR "/../../assets/scenes/default.scene.json"};
}

// A change to either text changes what every ratio in docs/performance.md means: measure anew, then put the new hash
// here.
TEST(Bench, YardsticksAreFrozen) {
    EXPECT_EQ(contentHash(readText(CREVICE_BENCH_EFFECTS "/ssao-article.effect")), "e5e839142f2d92973f090d3decbb3087");
    EXPECT_EQ(contentHash(readText(CREVICE_BENCH_DIR "/ArticleLoop.cpp")), "f907f97c09cd482f225e8f637d27685c");
}

TEST(Bench, FramesThreeAndHundredHoldTheSame) {
    BenchCase everything(benchCases().front(), smallView());
    for (int frame = 1; frame <= 3; ++frame) everything.run();
    const LiveObjects before = everything.renderer().device().liveObjects();
    const double residentBefore = residentBytes();
    for (int frame = 4; frame <= 100; ++frame) everything.run();
    EXPECT_EQ(before, everything.renderer().device().liveObjects())
        << before.text() << "\n"
        << everything.renderer().device().liveObjects().text();
    EXPECT_LT(residentBytes() - residentBefore, 2.0 * (1 << 20));
}

TEST(Bench, StageTimesSumToTheFrame) {
    BenchCase everything(benchCases().front(), smallView());
    View view{.width = 160, .height = 90};
    everything.renderer().render(view);
    everything.renderer().render(view);
    double sum = 0;
    for (const StageTime& stage : everything.renderer().pipeline().stageTimes()) {
        EXPECT_GE(stage.milliseconds, 0) << stage.stage;
        sum += stage.milliseconds;
    }
    const double frame = everything.renderer().pipeline().frameMilliseconds();
    EXPECT_GT(frame, 0);
    EXPECT_NEAR(sum, frame, 0.05 * frame);
}

}  // namespace
}  // namespace crevice::bench
