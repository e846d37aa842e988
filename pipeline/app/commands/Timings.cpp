// Milliseconds everywhere.
#include "app/commands/Timings.h"

#include <nlohmann/json.hpp>

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

Json sceneJson(const SceneTimings& scene) {
    Json stages = Json::array();
    for (const StageTime& stage : scene.stages) {
        stages.push_back({{"flow", stage.flow}, {"stage", stage.stage}, {"ms", stage.milliseconds}});
    }
    return {{"scene", scene.scene}, {"frame_ms", scene.frameMs}, {"stages", stages}, {"frames_ms", scene.framesMs}};
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
    json["process"] = {{"device_ms", timings.deviceMs},   {"load_ms", timings.loadMs},
                       {"compile_ms", timings.compileMs}, {"prepare_ms", timings.prepareMs},
                       {"render_ms", timings.renderMs},   {"write_ms", timings.writeMs}};
    return json.dump(2) + "\n";
}

}  // namespace crevice
