// The JSON that --timings writes: GPU time of each stage, wall time of each step of the program.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "flow/RenderPipeline.h"

namespace crevice {

/// Wall time since it was made or last asked, in milliseconds.
class Stopwatch {
public:
    double lap();

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct SceneTimings {
    std::string scene;
    double frameMs = 0;             ///< The last frame, on the device.
    std::vector<StageTime> stages;  ///< Of the last frame, read-back included.
    std::vector<double> framesMs;   ///< Every frame, on the device.
};

struct Timings {
    std::uint64_t pixels = 0;  ///< Per frame.
    std::vector<SceneTimings> scenes;
    /// The program, by the clock on the wall: start of the device, scene files, shaders, upload, frames, pictures.
    double deviceMs = 0, loadMs = 0, compileMs = 0, prepareMs = 0, renderMs = 0, writeMs = 0;
};

/// One scene: its numbers on top. Several: under "scenes".
std::string timingsJson(const Timings& timings);

}  // namespace crevice
