// Milliseconds everywhere.
#include "app/commands/Timings.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

/// To nanoseconds: more is noise.
double tidy(double milliseconds) { return std::round(milliseconds * 1e6) / 1e6; }

Json sceneJson(const SceneTimings& scene) {
    Json stages = Json::array();
    for (const StageTime& stage : scene.stages) {
        stages.push_back({{"flow", stage.flow}, {"stage", stage.stage}, {"ms", tidy(stage.milliseconds)}});
    }
    Json frames = Json::array();
    for (const double frame : scene.framesMs) frames.push_back(tidy(frame));
    return {{"scene", scene.scene}, {"frame_ms", tidy(scene.frameMs)}, {"stages", stages}, {"frames_ms", frames}};
}

}  // namespace

double Stopwatch::lap() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return elapsed;
}

std::string timingsJson(const Timings& timings) {
    Json json;
    if (timings.scenes.size() == 1) {
        json = sceneJson(timings.scenes.front());
    } else {
        for (const SceneTimings& scene : timings.scenes) json["scenes"].push_back(sceneJson(scene));
    }
    json["pixels"] = timings.pixels;
    json["process"] = {{"device_ms", tidy(timings.deviceMs)},   {"load_ms", tidy(timings.loadMs)},
                       {"compile_ms", tidy(timings.compileMs)}, {"prepare_ms", tidy(timings.prepareMs)},
                       {"render_ms", tidy(timings.renderMs)},   {"write_ms", tidy(timings.writeMs)}};
    return json.dump(2) + "\n";
}

}  // namespace crevice
