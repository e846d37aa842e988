// The options of `crevice render`, checked as far as they can be without a device: names, paths, numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/Console.h"
#include "app/commands/EnvironmentOptions.h"
#include "app/commands/PipelineOptions.h"
#include "app/commands/SceneFiles.h"
#include "app/commands/ViewOptions.h"

namespace crevice {

struct RenderOptions {
    std::vector<std::string> scenes;
    std::string pipeline = kDefaultPipeline;
    std::string out, frames, timings, device;
    std::vector<std::string> dumps;
    PipelineOptions pipelineOptions;
    ViewOptions view;
    EnvironmentOptions environment;
    ConsoleOptions console;
    bool validate = false, noCache = false, noDefaultLight = false;
    SceneOptions loading;
};
void addRenderOptions(CLI::App& command, RenderOptions& options);

struct Dump {
    std::string target;
    std::filesystem::path path;
};

/// A scene and the picture made of it.
struct RenderItem {
    SceneFile scene;
    std::filesystem::path out;  ///< May hold the number of the frame as "%04d".
};

struct RenderJob {
    std::vector<RenderItem> items;
    ViewChoice view;
    EnvironmentChoice environment;
    std::vector<Dump> dumps;
    std::uint32_t frames = 1;
    bool eachFrame = false;  ///< Every frame is written, not the last one only.
};

/// Checks everything that needs neither device nor scene. Throws Error.
RenderJob planRender(const RenderOptions& options, const PipelineChoice& pipeline);

/// "a-%04d.png" with the number of a frame; other paths as they are.
std::filesystem::path frameName(const std::filesystem::path& pattern, std::uint32_t frame);

}  // namespace crevice
