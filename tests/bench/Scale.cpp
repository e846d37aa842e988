// One function per curve. Each prints its table as it goes, then its bars.
#include "Scale.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "Children.h"
#include "ProcessClock.h"
#include "Report.h"
#include "ScaleScenes.h"
#include "app/Renderer.h"
#include "scene/SceneAsset.h"

namespace crevice::bench {
namespace {

namespace fs = std::filesystem;

constexpr double kMega = 1e6, kMebi = 1 << 20;

void print(const std::vector<Bar>& bars) {
    for (const Bar& bar : bars)
        fmt::print("{:<70} {:>9.3f} {:<5} {}\n", bar.name, bar.value, bar.unit,
                   bar.isMet() ? "met" : fmt::format("MISSED: {} to {}", bar.least, bar.most));
    fmt::print("\n");
}

/// Processor time of the calling thread: what Crevice does itself. The software GPU works in threads of its own.
double threadMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e3 + double(now.tv_nsec) * 1e-6;
}

std::unique_ptr<Renderer> makeRenderer(const std::string& pipeline, std::vector<StageSet> sets = {}) {
    auto renderer = std::make_unique<Renderer>(RendererOptions{.log = Log(LogLevel::Warning)});
    renderer->load({.nameOrPath = pipeline, .options = {}, .sets = std::move(sets)},
                   {.width = 1280, .height = 720, .frames = 100});
    return renderer;
}

Scene benchAtrium() {
    const Log log(LogLevel::Warning);
    return loadScene(benchScene({}, log), {.log = log, .allowOutside = true});
}

/// Least time of each stage, and of the frame, over some frames.
std::map<std::string, double> stageCosts(Renderer& renderer, const View& view, int repeats) {
    std::map<std::string, double> least;
    renderer.render(view);
    for (int i = 0; i < repeats; ++i) {
        std::map<std::string, double> costs;
        ProcessStopwatch watch;
        renderer.pipeline().observeStages([&](std::string_view stage) {
            const double ms = watch.lap();
            costs[std::string(stage)] += ms;
            if (stage != "readback") costs["frame"] += ms;
        });
        renderer.render(view);
        renderer.pipeline().observeStages({});
        for (const auto& [stage, ms] : costs) least[stage] = i == 0 ? ms : std::min(least[stage], ms);
    }
    return least;
}

struct ObjectCost {
    double still = 0, moving = 0, process = 0;  ///< ms a frame
    std::uint64_t draws = 0;
};

ObjectCost objectCost(Renderer& renderer, int repeats) {
    ObjectCost cost{1e9, 1e9, 1e9};
    View view{.width = 160, .height = 90};
    const auto cameraAt = [&](float angle) {
        Camera camera = Camera::lookAt({0, 3, 0}, {std::cos(angle), 2.5f, std::sin(angle)});
        camera.fovY = 1;
        return camera;
    };
    const auto frame = [&] {
        const double before = threadMilliseconds();
        renderer.render(view);
        return threadMilliseconds() - before;
    };
    for (int i = 0; i < 2 * repeats; ++i) {
        view.camera = cameraAt(0.3f * float(i));
        const double moving = frame();
        if (i > 0) cost.moving = std::min(cost.moving, moving);
        ProcessStopwatch watch;
        cost.still = std::min(cost.still, frame());
        cost.process = std::min(cost.process, watch.lap());
    }
    cost.draws = renderer.pipeline().drawCount();
    return cost;
}

void objects(const ScaleOptions& options) {
    fmt::print("Objects: instances of 10 meshes, forward with a shadow map, 160x90; thread ms of a frame\n");
    fmt::print("{:>9} {:>12} {:>12} {:>14} {:>7} {:>16} {:>16}\n", "objects", "still view", "moving view", "process ms",
               "draws", "µs/object still", "µs/object moving");
    std::vector<Bar> bars;
    for (const std::uint32_t count : {1000u, 10000u, 100000u}) {
        const auto renderer = makeRenderer("forward");
        renderer->setScene(manyObjects(count));
        const ObjectCost cost = objectCost(*renderer, options.repeats);
        const double still = 1e3 * cost.still / count, moving = 1e3 * cost.moving / count;
        fmt::print("{:>9} {:>12.2f} {:>12.2f} {:>14.1f} {:>7} {:>16.3f} {:>16.3f}\n", count, cost.still, cost.moving,
                   cost.process, cost.draws, still, moving);
        if (count < 100000) continue;
        bars.push_back({.name = "100k objects, still view: µs an object", .value = still, .most = 0.5});
        bars.push_back({.name = "100k objects, moving view: µs an object", .value = moving, .most = 0.5});
        bars.push_back({.name = "100k objects of 10 meshes: draw calls", .value = double(cost.draws), .most = 50});
    }
    print(bars);
}

double largestDifference(const Image& a, const Image& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(std::to_integer<int>(a.pixels[i]) - std::to_integer<int>(b.pixels[i])));
    return most;
}

void lightsOf(const std::string& pipeline, const std::string& stage, const ScaleOptions& options) {
    fmt::print("Lights: {} in '{}', 640x360, process ms\n", stage, pipeline);
    fmt::print("{:>7} {:>10} {:>10} {:>12} {:>12}\n", "lights", "stage", "frame", "brute stage", "max diff/255");
    std::map<std::uint32_t, double> costs;
    double worst = 0;
    const View view{.width = 640, .height = 360};
    for (const std::uint32_t count : {1u, 10u, 100u, 1000u}) {
        Scene scene = benchAtrium();
        addSmallLights(scene, count);
        const auto culled = makeRenderer(pipeline);
        culled->setScene(scene);
        const auto cost = stageCosts(*culled, view, options.repeats);
        costs[count] = cost.at(stage);
        const auto brute = makeRenderer(pipeline, {{stage + ".defines.BRUTE_FORCE_LIGHTS", "true"}});
        brute->setScene(std::move(scene));
        const double bruteMs = stageCosts(*brute, view, 1).at(stage);
        const double difference = largestDifference(culled->render(view), brute->render(view));
        worst = std::max(worst, difference);
        fmt::print("{:>7} {:>10.1f} {:>10.1f} {:>12.1f} {:>12.0f}\n", count, cost.at(stage), cost.at("frame"), bruteMs,
                   difference);
    }
    print({{.name = stage + ": 1000 small lights / 10", .value = costs[1000] / costs[10], .most = 6},
           {.name = stage + ": difference from brute force, 1/255", .value = worst, .most = 1}});
}

void lights(const ScaleOptions& options) {
    lightsOf("deferred", "LightingStage", options);
    lightsOf("forward", "ForwardStage", options);
}

void pixels(const ScaleOptions& options) {
    fmt::print("Pixels: 'ssao-deferred', process ms\n");
    fmt::print("{:>12} {:>8} {:>10} {:>12} {:>14}\n", "size", "Mpixel", "frame", "ms/Mpixel", "without draws");
    const auto renderer = makeRenderer("ssao-deferred");
    renderer->setScene(benchAtrium());
    std::vector<double> x, y, screen;
    for (const double megapixels : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
        const auto height = std::uint32_t(std::lround(std::sqrt(megapixels * 1e6 * 9 / 16)));
        const View view{.width = height * 16 / 9, .height = height};
        const auto cost = stageCosts(*renderer, view, options.repeats);
        const double actual = double(view.width) * view.height * 1e-6;
        double drawn = 0;
        for (const auto& [stage, ms] : cost)
            if (stage == "GbufferStage" || stage == "ShadowStage" || stage == "TransparentStage") drawn += ms;
        x.push_back(actual);
        y.push_back(cost.at("frame"));
        screen.push_back((cost.at("frame") - drawn) / actual);
        fmt::print("{:>12} {:>8.2f} {:>10.1f} {:>12.1f} {:>14.1f}\n", fmt::format("{}x{}", view.width, view.height),
                   actual, y.back(), y.back() / actual, screen.back());
    }
    // The straight line that the frame's cost follows; its height at 0 is the scene's geometry. Weighted by 1/y, so
    // that what is least is the share by which a size leaves the line.
    double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double weight = 1 / (y[i] * y[i]);
        w += weight, wx += weight * x[i], wy += weight * y[i];
        wxx += weight * x[i] * x[i], wxy += weight * x[i] * y[i];
    }
    const double slope = (w * wxy - wx * wy) / (w * wxx - wx * wx), base = (wy - slope * wx) / w;
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(y[i] / (base + slope * x[i]) - 1));
    const auto [least, most] = std::minmax_element(screen.begin(), screen.end());
    fmt::print("the line: {:.1f} ms + {:.1f} ms a Mpixel\n", base, slope);
    print({{.name = "largest share by which a frame leaves the line", .value = worst, .most = 0.15},
           {.name = "full-screen stages, ms a Mpixel: from the mean",
            .value = (*most - *least) / (*most + *least),
            .most = 0.15}});
}

std::uint64_t geometryBytes(const Scene& scene) {
    std::uint64_t bytes = 0;
    for (const Mesh& mesh : scene.meshes)
        bytes += mesh.vertices.size() * sizeof(Vertex) + mesh.indices.size() * sizeof(std::uint32_t);
    return bytes;
}

std::uint64_t textureBytes(const Scene& scene) {
    std::uint64_t bytes = 0;
    for (const SceneTexture& texture : scene.textures) bytes += texture.image.pixels.size();
    return bytes;
}

/// `crevice render` of a scene, small: its time, and its peak memory.
ChildCost renderCost(const std::string& scene) {
    const fs::path out = fs::temp_directory_path() / "crevice-scale.png";
    const ChildCost cost = runChild({CREVICE_PROGRAM, "render", scene, "-p", "forward", "--allow-outside", "--quiet",
                                     "--size", "160x90", "-o", out.string()});
    fs::remove(out);
    return cost;
}

/// The same scene with pictures of one pixel: what the program, its shaders and the geometry take.
fs::path withoutPictures(const fs::path& scene) {
    const fs::path folder = fs::temp_directory_path() / "crevice-scale-small";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const std::vector<std::byte> pixel = encodePng(Image(1, 1, Format::RGBA8));
    for (const fs::directory_entry& entry : fs::directory_iterator(scene.parent_path())) {
        const fs::path to = folder / entry.path().filename();
        if (entry.path().extension() == ".png")
            writeFileAtomically(to, pixel);
        else if (entry.is_regular_file())
            fs::copy_file(entry.path(), to);
    }
    return folder / scene.filename();
}

void triangles(const ScaleOptions& options) {
    const fs::path path = fs::temp_directory_path() / "crevice-scale.glb";
    const auto bytes = double(writeManyTriangles(path, options.triangleMeshes, 500));
    const ChildCost whole = renderCost(path.string());  // before this process grows: see ChildCost
    const double triangleCount = 5e5 * options.triangleMeshes;
    const Log log(LogLevel::Warning);
    double loadMs = 1e9, uploadMs = 1e9, deviceBytes = 0, own = 1;
    for (int i = 0; i < options.repeats; ++i) {
        const auto renderer = makeRenderer("forward");
        ProcessStopwatch watch;
        Scene scene = loadScene(path, {.log = log});
        loadMs = std::min(loadMs, watch.lap());
        own = double(geometryBytes(scene));
        renderer->setScene(std::move(scene));
        uploadMs = std::min(uploadMs, watch.lap());
        deviceBytes = double(renderer->device().liveObjects().memoryBytes);
    }
    fs::remove(path);
    fmt::print("Triangles: {:.1f} million, {:.0f} MB of geometry in one .glb\n", triangleCount / kMega, bytes / kMega);
    fmt::print("load {:.0f} ms, upload {:.0f} ms, `crevice render` {:.0f} ms, all process time\n", loadMs, uploadMs,
               whole.milliseconds);
    print({{.name = "geometry read, MB a second of process time",
            .value = bytes / kMega / (loadMs * 1e-3),
            .least = 300,
            .most = 1e9},
           {.name = "geometry read and uploaded, MB a second",
            .value = bytes / kMega / ((loadMs + uploadMs) * 1e-3),
            .most = 1e9},
           {.name = "peak memory of `crevice render` / the scene's own size",
            .value = double(whole.peakBytes) / own,
            .most = 2.5},
           {.name = "peak memory of `crevice render`",
            .value = double(whole.peakBytes) / kMebi,
            .most = 3072,
            .unit = "MiB"},
           {.name = "Vulkan memory of it", .value = deviceBytes / kMebi, .most = 1.2 * 1024, .unit = "MiB"}});
}

void textures(const ScaleOptions&) {
    fmt::print("Textures: peak memory of `crevice render` above that with pictures of one pixel, MiB\n");
    fmt::print("{:>16} {:>10} {:>10} {:>8} {:>10} {:>12}\n", "scene", "textures", "peak", "ratio", "load ms",
               "wall ms");
    const Log log(LogLevel::Error);
    const fs::path made = writeManyPictures(fs::temp_directory_path() / "crevice-scale-pictures", 16, 2048);
    const fs::path scenes = fs::path(CREVICE_BENCH_DIR) / "../../../shared/scenes";
    std::vector<std::pair<fs::path, double>> peaks;
    for (const fs::path& path : {made, scenes / "FlightHelmet/FlightHelmet.gltf", scenes / "atrium/atrium.gltf"}) {
        if (!fs::exists(path)) {
            fmt::print("{:>16} is not here\n", path.stem().string());
            continue;
        }
        const fs::path small = withoutPictures(path);
        const double peak = double(renderCost(path.string()).peakBytes) - double(renderCost(small.string()).peakBytes);
        fs::remove_all(small.parent_path());
        peaks.emplace_back(path, peak);
    }
    std::vector<Bar> bars;
    for (const auto& [path, peak] : peaks) {
        ProcessStopwatch watch;
        const auto start = std::chrono::steady_clock::now();
        const Scene scene = loadScene(path, {.log = log, .allowOutside = true});
        const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
        const double loadMs = watch.lap(), own = double(textureBytes(scene));
        const std::string name = path.stem().string();
        fmt::print("{:>16} {:>10.1f} {:>10.1f} {:>8.2f} {:>10.0f} {:>12.0f}\n", name, own / kMebi, peak / kMebi,
                   peak / own, loadMs, wall.count());
        bars.push_back({.name = name + ": peak memory / decoded pictures", .value = peak / own, .most = 2.5});
    }
    fs::remove_all(made.parent_path());
    print(bars);
}

}  // namespace

void runScale(const ScaleOptions& options) {
    const std::vector<std::pair<std::string, std::function<void(const ScaleOptions&)>>> curves = {
        {"textures", textures}, {"triangles", triangles}, {"objects", objects}, {"lights", lights}, {"pixels", pixels}};
    for (const auto& [name, run] : curves) {
        const bool wanted = options.curves.empty() ||
                            std::find(options.curves.begin(), options.curves.end(), name) != options.curves.end();
        if (wanted) run(options);
        std::fflush(stdout);
    }
}

}  // namespace crevice::bench
