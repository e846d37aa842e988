// `crevice reference`: ambient occlusion by ray tracing, and how far the maps of other techniques are from it.
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/SceneFiles.h"
#include "app/commands/ViewOptions.h"
#include "core/Error.h"
#include "core/Text.h"
#include "flow/FrameData.h"
#include "truth/AmbientReference.h"
#include "truth/Metrics.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice reference crease -o truth.exr --size 160x90 --samples 64\n"
    "  crevice reference default -o truth.png --size 160x90 --samples 64 --radius 0.5 --falloff linear\n";

constexpr std::uint32_t kMaxSamples = 1u << 20;

struct ReferenceOptions {
    std::string scene, out, radius = "auto", falloff = "hard", samples = "1024", seed = "1", depth;
    std::vector<std::string> measure;
    ViewOptions view;
    ConsoleOptions console;
    bool allowOutside = false;
};

/// 0 = auto.
float readRadius(const std::string& text) {
    if (text == "auto") return 0;
    const double radius = parseNumber("--radius", text);
    if (radius <= 0 || radius > 1e30) {
        throw Error(fmt::format("--radius: '{}' is out of range", text), "write a length above 0, or auto");
    }
    return static_cast<float>(radius);
}

Falloff readFalloff(const std::string& text) {
    const std::vector<std::string> names = {"hard", "linear", "quadratic"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (text == names[i]) return static_cast<Falloff>(i);
    }
    throw Error(fmt::format("--falloff: '{}' is not a falloff", text), didYouMean(text, names, "falloffs"));
}

Image readMap(const char* option, const std::string& path, const glm::uvec2& size) {
    Image image = readImage(path);
    if (image.width == size.x && image.height == size.y) return image;
    throw Error(fmt::format("{}: '{}' is {}x{} and the reference {}x{}", option, path, image.width, image.height,
                            size.x, size.y),
                "render both with the same --size");
}

/// One row of numbers per map.
std::string measureMaps(const ReferenceOptions& options, const std::vector<Image>& images, const AmbientMap& truth) {
    std::string text = fmt::format("{:>8} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}  map\n", "rmse", "mae", "bias", "p95",
                                   "r", "skill", "of white");
    for (std::size_t i = 0; i < images.size(); ++i) {
        std::vector<float> values;
        for (std::uint32_t y = 0; y < truth.size.y; ++y) {
            for (std::uint32_t x = 0; x < truth.size.x; ++x) values.push_back(images[i].at(x, y).x);
        }
        const MapMetrics m = measureMap(values, truth.openness, truth.isCounted);
        text += fmt::format("{:8.4f} {:8.4f} {:+8.4f} {:8.4f} {:8.4f} {:8.4f} {:8.4f}  {}\n", m.rmse, m.mae, m.bias,
                            m.p95, m.correlation, m.skill, m.ofWhite, options.measure[i]);
    }
    return text;
}

AmbientMap trace(const ReferenceOptions& options, const ViewChoice& view, AmbientSettings settings) {
    Progress progress(options.console.quiet);
    const Log log = makeLog(options.console, progress);
    const AssetRoots roots = AssetRoots::standard();
    progress.show("loading …");
    const Scene scene = loadSceneFile(findScene(roots, options.scene), roots, log, options.allowOutside);
    const Camera camera = resolveCamera(view, scene);
    const RayScene rays(scene);
    const bool isAuto = settings.radius <= 0;
    if (isAuto) settings.radius = std::max(kAutoLength * rays.diagonal(), 1e-6f);
    settings.progress = [&](float share) { progress.show(fmt::format("tracing: {:.0f} %", 100 * share)); };
    AmbientMap map = traceAmbient(rays, camera, view.size, settings);
    log.note(fmt::format("radius {:.4g}{}, {} rays a pixel, standard error {:.2g}, {:.1f} % sky", settings.radius,
                         isAuto ? " (auto)" : "", settings.samples, map.noise,
                         100 - 100 * static_cast<double>(map.countedCount()) / (double(view.size.x) * view.size.y)));
    return map;
}

int runReference(const ReferenceOptions& options) {
    if (options.scene.empty()) throw Error("no scene given", "name one: crevice reference crease -o truth.exr");
    if (options.out.empty()) throw Error("no output given", "say where the map goes: -o truth.exr");
    checkPicturePath("-o", options.out);
    const ViewChoice view = readView(options.view);
    AmbientSettings settings{.radius = readRadius(options.radius), .falloff = readFalloff(options.falloff)};
    settings.samples = parseCount("--samples", options.samples, 2, kMaxSamples);
    settings.seed = parseCount("--seed", options.seed, 0, std::numeric_limits<std::uint32_t>::max());
    std::vector<Image> measured;
    for (const std::string& path : options.measure) measured.push_back(readMap("--measure", path, view.size));
    Image depth;
    if (!options.depth.empty()) depth = readMap("--depth", options.depth, view.size);

    AmbientMap map = trace(options, view, settings);
    if (!options.depth.empty()) {
        const std::size_t excluded = excludeOtherSurfaces(map, depth);
        print(fmt::format("{} of {} pixels show another surface in '{}' and do not count\n", excluded,
                          std::size_t(view.size.x) * view.size.y, options.depth));
    }
    if (!measured.empty()) print(measureMaps(options, measured, map));
    OutputFiles files;
    files.add(options.out, map.toImage());
    for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
    return 0;
}

}  // namespace

void addReferenceCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("reference", "Trace the true ambient occlusion; measure maps by it");
    const auto options = std::make_shared<ReferenceOptions>();
    command->add_option("scene", options->scene, "File (.gltf, .glb, .scene.json) or name of a shipped scene")
        ->type_name("SCENE");
    command->add_option("-o,--out", options->out, "Map to write, .exr (floats) or .png")->type_name("OUT");
    const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
        command->add_option(name, value, help)->type_name(type)->group("Occlusion")->capture_default_str();
    };
    add("--radius", options->radius, "LENGTH", "How far occluders reach; auto = 1/40 of the scene's diagonal");
    add("--falloff", options->falloff, "NAME",
        "What an occluder at a share x of the radius weighs: hard 1, linear "
        "1-x, quadratic 1-x²");
    add("--samples", options->samples, "N", "Rays per pixel; powers of two are spread best");
    add("--seed", options->seed, "N", "Chooses the directions");
    command->add_option("--measure", options->measure, "Map of the same view to compare with it (repeatable)")
        ->type_name("MAP")
        ->allow_extra_args(false);
    command->add_option("--depth", options->depth, "Dump of viewDepth: pixels with another surface do not count")
        ->type_name("DEPTH.exr");
    command->add_flag("--allow-outside", options->allowOutside, "Let the scene name files outside its folder");
    addViewOptions(*command, options->view, false);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runReference(*options); }; });
}

}  // namespace crevice
