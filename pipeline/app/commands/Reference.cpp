// `crevice reference`: ambient occlusion by ray tracing, and how far the maps of other techniques are from it.
#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/ReferenceRequest.h"
#include "app/commands/ReferenceTables.h"
#include "app/commands/SceneFiles.h"
#include "flow/FrameData.h"
#include "truth/ErrorHeat.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice reference crease -o truth.exr --size 160x90 --samples 64\n"
    "  crevice reference default -o truth.png --size 160x90 --samples 64 --radius 0.5 --falloff linear\n"
    "  crevice reference crease -o truth-{radius}-{falloff}.exr --size 64x36 --samples 64 --radius 0.2 --radius 0.5 "
    "--falloff hard --falloff matched:cocos\n";

/// What one run yields.
struct Traced {
    Camera camera;
    AmbientMap map{};
    std::vector<std::vector<float>> heightfields{};  ///< As ReferenceRequest::radii; empty when not asked for.
};

void noteLayers(const Log& log, const ReferenceRequest& request, const AmbientMap& map) {
    const double sky = 100 - 100 * static_cast<double>(map.countedCount()) / (double(map.size.x) * map.size.y);
    for (std::size_t i = 0; i < map.layers.size(); ++i) {
        const AmbientLayer& layer = map.layers[i];
        log.note(fmt::format("radius {:.4g}{}, {}{} rays a pixel, standard error {:.2g}, {:.1f} % sky{}",
                             layer.term.radius, request.wanted[i].radiusText == "auto" ? " (auto)" : "",
                             layer.term.falloff == &hardFalloff() ? "" : fmt::format("{}, ", layer.term.falloff->name),
                             request.settings.samples, layer.noise, sky, map.fromCache ? ", from the cache" : ""));
    }
}

Traced trace(const ReferenceOptions& options, ReferenceRequest& request) {
    Progress progress(options.console.quiet);
    const Log log = makeLog(options.console, progress);
    const AssetRoots roots = AssetRoots::standard();
    progress.show("loading …");
    SceneOptions loading = options.loading;
    loading.aspect = static_cast<float>(request.view.size.x) / static_cast<float>(request.view.size.y);
    const Scene scene = loadSceneFile(findScene(roots, options.scene), roots, log, loading);
    Traced traced{.camera = resolveCamera(request.view, scene)};
    const float automatic = automaticLength(scene.bounds());
    for (std::vector<WantedMap>* list : {&request.wanted, &request.radii}) {
        for (WantedMap& one : *list) {
            if (one.term.radius <= 0) one.term.radius = automatic;
        }
    }
    AmbientSettings& settings = request.settings;
    settings.terms.clear();
    for (const WantedMap& one : request.wanted) settings.terms.push_back(one.term);
    settings.progress = [&](float share) { progress.show(fmt::format("tracing: {:.0f} %", 100 * share)); };
    traced.map = traceAmbient(scene, traced.camera, request.view.size, settings);
    noteLayers(log, request, traced.map);
    if (request.heightfieldNames.empty()) return traced;
    HeightfieldSettings& heightfield = request.heightfield;
    heightfield.seed = settings.seed;
    heightfield.cache = settings.cache;
    heightfield.progress = [&](float share) { progress.show(fmt::format("heightfield: {:.0f} %", 100 * share)); };
    for (const WantedMap& one : request.radii) {
        heightfield.radius = one.term.radius;
        traced.heightfields.push_back(
            traceHeightfield({request.view.size, traced.camera, traced.map.viewDepth, traced.map.normal}, heightfield));
    }
    return traced;
}

/// The heightfield of a layer's radius; empty when there is none or the falloff is another.
std::span<const float> heightfieldOf(const ReferenceRequest& request, const Traced& traced, std::size_t layer) {
    if (traced.heightfields.empty() || !request.wanted[layer].term.falloff->isHard()) return {};
    for (std::size_t i = 0; i < request.radii.size(); ++i) {
        if (request.radii[i].radiusText == request.wanted[layer].radiusText) return traced.heightfields[i];
    }
    return {};
}

void printTables(const ReferenceOptions& options, const ReferenceRequest& request, const Traced& traced) {
    for (std::size_t i = 0; i < traced.map.layers.size(); ++i) {
        const AmbientTerm& term = request.wanted[i].term;
        if (request.wanted.size() > 1)
            print(fmt::format("against radius {:.4g}, {}:\n", term.radius, term.falloff->name));
        std::vector<MeasuredMap> maps;
        for (std::size_t k = 0; k < request.measured.size(); ++k)
            maps.push_back({options.measure[k], request.measured[k]});
        print(measureTables(traced.map, i, traced.camera, maps, heightfieldOf(request, traced, i)));
    }
}

Image toImage(const glm::uvec2& size, const std::vector<float>& values) {
    Image image(size.x, size.y, Format::R32F);
    const auto bytes = std::as_bytes(std::span(values));
    std::copy(bytes.begin(), bytes.end(), image.pixels.begin());
    return image;
}

int runReference(const ReferenceOptions& options) {
    ReferenceRequest request = readRequest(options);
    Traced traced = trace(options, request);
    if (!options.depth.empty()) {
        const std::size_t excluded = excludeOtherSurfaces(traced.map, request.depth);
        print(fmt::format("{} of {} pixels show another surface in '{}' and do not count\n", excluded,
                          std::size_t(request.view.size.x) * request.view.size.y, options.depth));
    }
    if (!request.measured.empty() || !traced.heightfields.empty()) printTables(options, request, traced);
    OutputFiles files;
    for (std::size_t i = 0; i < request.names.size(); ++i) files.add(request.names[i], traced.map.toImage(i));
    for (std::size_t i = 0; i < request.heightfieldNames.size(); ++i)
        files.add(request.heightfieldNames[i], toImage(request.view.size, traced.heightfields[i]));
    for (std::size_t i = 0; i < options.heat.size(); ++i) {
        files.add(options.heat[i], errorHeat(request.view.size, request.measured[i], traced.map.layers[0].openness,
                                             traced.map.isCounted));
    }
    for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
    return 0;
}

void addOcclusionOptions(CLI::App& command, ReferenceOptions& options) {
    const auto several = [&](const char* name, std::vector<std::string>& values, const char* type, const char* help) {
        command.add_option(name, values, help)->type_name(type)->group("Occlusion")->allow_extra_args(false);
    };
    several("--radius", options.radius, "LENGTH",
            "How far occluders reach (repeatable); auto = 1/40 of the scene's diagonal, the default");
    several("--falloff", options.falloff, "NAME",
            "What an occluder at a share x of the radius weighs (repeatable): hard 1, the default, linear 1-x, "
            "quadratic 1-x², or matched:TECHNIQUE, see docs/reference.md");
    const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
        command.add_option(name, value, help)->type_name(type)->group("Occlusion")->capture_default_str();
    };
    add("--samples", options.samples, "N", "Rays per pixel; powers of two are spread best");
    add("--seed", options.seed, "N", "Chooses the directions");
    command.add_flag("--no-cache", options.noCache, "Trace even when the answer is known, and do not keep it")
        ->group("Occlusion");
    command.add_option("--heightfield", options.heightfield, "Map of what the depth buffer alone tells, .exr or .png")
        ->type_name("OUT")
        ->group("Heightfield");
    const auto addHeightfield = [&](const char* name, std::string& value, const char* type, const char* help) {
        command.add_option(name, value, help)->type_name(type)->group("Heightfield")->capture_default_str();
    };
    addHeightfield("--thickness", options.thickness, "SHARE", "Of what is behind a texel, in radii; or infinite");
    addHeightfield("--slices", options.slices, "N", "Half-planes around each pixel");
}

}  // namespace

void addReferenceCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("reference", "Trace the true ambient occlusion; measure maps by it");
    const auto options = std::make_shared<ReferenceOptions>();
    command->add_option("scene", options->scene, "File (.gltf, .glb, .scene.json) or name of a shipped scene")
        ->type_name("SCENE");
    command
        ->add_option("-o,--out", options->out,
                     "Map to write, .exr (floats) or .png; {radius} and {falloff} in it name several")
        ->type_name("OUT");
    addOcclusionOptions(*command, *options);
    command->add_option("--measure", options->measure, "Map of the same view to compare with it (repeatable)")
        ->type_name("MAP")
        ->allow_extra_args(false);
    command
        ->add_option("--heat", options->heat,
                     "Picture of the error of the map at the same place among --measure, by the first radius and "
                     "falloff (repeatable): red too bright, blue too dark, full from 0.5, grey does not count")
        ->type_name("OUT")
        ->allow_extra_args(false);
    command->add_option("--depth", options->depth, "Dump of viewDepth: pixels with another surface do not count")
        ->type_name("DEPTH.exr");
    addSceneOptions(*command, options->loading);
    addViewOptions(*command, options->view, false);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runReference(*options); }; });
}

}  // namespace crevice
