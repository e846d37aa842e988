// Which files a run will write is settled here, before anything is rendered.
#include "app/commands/RenderOptions.h"

#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/OutputFiles.h"
#include "core/Text.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMaxFrames = 1'000'000;

/// Where "%04d", "%d" and the like stand in a name.
struct FramePlace {
    std::size_t begin = 0, length = 0;
    int digits = 1;
};

std::optional<FramePlace> findFramePlace(const std::string& name) {
    for (std::size_t begin = name.find('%'); begin != std::string::npos; begin = name.find('%', begin + 1)) {
        if (name.compare(begin, 2, "%d") == 0) return FramePlace{begin, 2, 1};
        const bool padded = name.size() > begin + 3 && name[begin + 1] == '0' && name[begin + 2] >= '1' &&
                            name[begin + 2] <= '9' && name[begin + 3] == 'd';
        if (padded) return FramePlace{begin, 4, name[begin + 2] - '0'};
    }
    return std::nullopt;
}

std::vector<RenderItem> planItems(const RenderOptions& options, const AssetRoots& roots) {
    if (options.scenes.empty()) {
        throw Error("no scene given",
                    "name a file (.gltf, .glb, .scene.json) or a shipped scene: " + join(roots.list(AssetKind::Scene)));
    }
    if (options.out.empty()) throw Error("no output given", "say where the picture goes: -o OUT.png");
    std::error_code failed;
    const fs::path out = options.out;
    const bool isFolder = options.out.ends_with('/') || fs::is_directory(out, failed);
    if (options.scenes.size() > 1 && !isFolder) {
        throw Error(fmt::format("-o: {} scenes cannot go into the one file '{}'", options.scenes.size(), options.out),
                    fmt::format("name an existing folder: -o {}/", out.stem().string()));
    }
    std::vector<RenderItem> items;
    std::set<fs::path> taken;
    for (const std::string& argument : options.scenes) {
        RenderItem item{.scene = findScene(roots, argument), .out = out};
        if (isFolder) item.out = out / (item.scene.name + ".png");
        checkPicturePath("-o", item.out);
        if (!taken.insert(item.out.lexically_normal()).second) {
            throw Error(fmt::format("two scenes would be written to '{}'", item.out.string()),
                        "render them into different folders");
        }
        items.push_back(std::move(item));
    }
    return items;
}

std::vector<Dump> planDumps(const RenderOptions& options, const PipelineDesc& desc, std::size_t sceneCount) {
    std::vector<std::string> targets;
    for (const TargetDesc& target : desc.targets) targets.push_back(target.name);
    std::vector<Dump> dumps;
    for (const std::string& text : options.dumps) {
        const auto [target, path] = parseAssignment("--dump", text, "TARGET=FILE.png");
        if (!desc.findTarget(target)) {
            throw Error(fmt::format("--dump: pipeline '{}' has no target '{}'", desc.name, target),
                        didYouMean(target, targets, "targets"));
        }
        checkPicturePath("--dump", path);
        dumps.push_back({target, path});
    }
    if (!dumps.empty() && sceneCount > 1) {
        throw Error(fmt::format("--dump writes one file, and there are {} scenes", sceneCount),
                    "render the scenes one at a time");
    }
    return dumps;
}

void checkNoFileTwice(const RenderJob& job, const std::string& timings) {
    std::set<fs::path> taken;
    const auto take = [&](const fs::path& path) {
        if (!taken.insert(path.lexically_normal()).second) {
            throw Error(fmt::format("'{}' would be written twice", path.string()), "give every output its own name");
        }
    };
    for (const RenderItem& item : job.items) take(item.out);
    for (const Dump& dump : job.dumps) take(dump.path);
    if (!timings.empty()) take(timings);
}

}  // namespace

void addRenderOptions(CLI::App& command, RenderOptions& options) {
    command.add_option("scene", options.scenes, "Files (.gltf, .glb, .scene.json) or names of shipped scenes")
        ->type_name("SCENE");
    command.add_option("-p,--pipeline", options.pipeline, "Name of a pipeline or path of a .json file")
        ->type_name("PIPELINE")
        ->capture_default_str();
    command.add_option("-o,--out", options.out, "Picture to write, .png or .exr; for several scenes a folder")
        ->type_name("OUT");
    command.add_option("--frames", options.frames, "Render N frames, write the last; %04d in OUT writes each")
        ->type_name("N");
    command.add_option("--dump", options.dumps, "Write a target as well: .png clamped, .exr in full (repeatable)")
        ->type_name("TARGET=FILE")
        ->allow_extra_args(false);
    command.add_option("--timings", options.timings, "Write times of stages and of the program as JSON")
        ->type_name("FILE.json");
    command.add_option("--device", options.device, "Device to use: see `crevice info`")->type_name("NAME|INDEX");
    command.add_flag("--validate", options.validate, "Vulkan validation; any message is a failure");
    command.add_flag("--no-cache", options.noCache, "Compile shaders and blur environments anew");
    command.add_flag("--no-default-light", options.noDefaultLight, "Leave a scene without lights dark");
    addSceneOptions(command, options.loading);
    addPipelineOptions(command, options.pipelineOptions);
    addViewOptions(command, options.view);
    addEnvironmentOptions(command, options.environment);
    addConsoleOptions(command, options.console);
}

RenderJob planRender(const RenderOptions& options, const PipelineChoice& pipeline) {
    RenderJob job;
    job.view = readView(options.view);
    job.environment = EnvironmentChoice(options.environment);
    if (!options.frames.empty()) job.frames = parseCount("--frames", options.frames, 1, kMaxFrames);
    job.items = planItems(options, pipeline.roots());
    job.eachFrame = findFramePlace(job.items.front().out.filename().string()).has_value();
    job.dumps = planDumps(options, pipeline.desc(), job.items.size());
    if (!options.timings.empty()) checkOutputPath("--timings", options.timings);
    checkNoFileTwice(job, options.timings);
    return job;
}

fs::path frameName(const fs::path& pattern, std::uint32_t frame) {
    std::string name = pattern.filename().string();
    const auto place = findFramePlace(name);
    if (!place) return pattern;
    name.replace(place->begin, place->length, fmt::format("{:0{}}", frame, place->digits));
    return pattern.parent_path() / name;
}

}  // namespace crevice
