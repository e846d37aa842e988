// `crevice info`: the devices and what they can do; or what a scene holds.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/SceneFiles.h"
#include "app/commands/TextTable.h"
#include "flow/FrameData.h"
#include "gfx/Device.h"
#include "gfx/Format.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice info\n"
    "  crevice info default\n";

struct InfoOptions {
    std::string scene, device;
    SceneOptions loading;
    ConsoleOptions console;
};

void printDevices(const std::vector<DeviceInfo>& devices) {
    TextTable table;
    table.add({"device", "name", "type", "driver", "Vulkan", "usable"});
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        table.add({std::to_string(i), device.name, device.type, device.driver, device.api,
                   device.problem.empty() ? "yes" : "no: " + device.problem});
    }
    print(table.text());
}

void printFormats(const Device& device) {
    const auto yes = [](bool supported) { return std::string(supported ? "yes" : "–"); };
    TextTable table;
    table.add({"format", "bytes", "colour", "blend", "depth", "sampled", "linear", "storage"});
    for (const FormatInfo& info : allFormats()) {
        const Format format = info.format;
        table.add({info.name, std::to_string(info.bytesPerPixel), yes(supports(device, format, TextureUsage::Color)),
                   yes(supportsBlend(device, format)), yes(supports(device, format, TextureUsage::Depth)),
                   yes(supports(device, format, TextureUsage::Sampled)), yes(supportsLinearFilter(device, format)),
                   yes(supports(device, format, TextureUsage::Storage))});
    }
    print(table.text());
}

int printDeviceInfo(const InfoOptions& options, const Log& log) {
    const std::vector<DeviceInfo> devices = Device::listDevices();
    if (!devices.empty()) printDevices(devices);
    const Device device({.log = log, .device = options.device});
    constexpr double kMiB = 1 << 20;
    print(fmt::format("\nin use: {} ({}), {:.0f} MiB of device memory\n", device.deviceName(), device.driverInfo(),
                      static_cast<double>(device.heapBytes()) / kMiB));
    printFormats(device);
    return 0;
}

std::size_t countLights(const Scene& scene, LightType type) {
    std::size_t count = 0;
    for (const Light& light : scene.lights) count += light.type == type ? 1 : 0;
    return count;
}

std::string camerasText(const Scene& scene) {
    if (scene.cameras.empty()) return "none: a view that frames the scene is used";
    std::string text;
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        const Camera& camera = scene.cameras[i];
        text += fmt::format("{}{}{}{}", i ? ", " : "", i, camera.name.empty() ? "" : " '" + camera.name + "'",
                            camera.orthographic ? " (orthographic)" : "");
    }
    return text;
}

/// Triangles are counted as drawn: a mesh once for each instance.
std::size_t countTriangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        if (mesh.topology == MeshTopology::Triangles) count += mesh.indices.size() / 3;
    }
    return count;
}

int printSceneInfo(const InfoOptions& options, const Log& log) {
    const AssetRoots roots = AssetRoots::standard();
    const SceneFile file = findScene(roots, options.scene);
    Scene scene = loadSceneFile(file, roots, log, options.loading);
    const Aabb box = scene.bounds();
    const auto number = [](auto value) { return fmt::format("{}", value); };
    TextTable table;
    table.add({"scene", file.path.string()});
    table.add({"meshes", number(scene.meshes.size())});
    table.add({"instances", number(scene.instances.size())});
    table.add({"triangles", number(countTriangles(scene))});
    table.add({"materials", number(scene.materials.size())});
    table.add({"textures", number(scene.textures.size())});
    table.add({"lights", fmt::format("{} directional, {} point, {} spot{}", countLights(scene, LightType::Directional),
                                     countLights(scene, LightType::Point), countLights(scene, LightType::Spot),
                                     scene.ambient ? ", ambient" : "")});
    table.add({"cameras", camerasText(scene)});
    table.add({"bounds", box.empty ? "empty"
                                   : fmt::format("{:.6g},{:.6g},{:.6g} to {:.6g},{:.6g},{:.6g}", box.min.x, box.min.y,
                                                 box.min.z, box.max.x, box.max.y, box.max.z)});
    table.add(
        {"auto radius", fmt::format("{:.4g} (1/40 of the diagonal {:.4g})", automaticLength(box), box.diagonal())});
    const bool lit = addDefaultLight(scene);
    table.add({"exposure", fmt::format("{:.3g} EV{}", scene.exposureEv ? *scene.exposureEv : autoExposureEv(scene),
                                       scene.exposureEv ? ""
                                       : lit            ? " (automatic, default light)"
                                                        : " (automatic)")});
    print(table.text());
    return 0;
}

}  // namespace

void addInfoCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("info", "Show devices and formats, or what a scene holds");
    const auto options = std::make_shared<InfoOptions>();
    command->add_option("scene", options->scene, "Scene to describe")->type_name("SCENE");
    command->add_option("--device", options->device, "Device whose formats are shown")->type_name("NAME|INDEX");
    addSceneOptions(*command, options->loading);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] {
        action = [options] {
            const Log log = makeLog(options->console);
            return options->scene.empty() ? printDeviceInfo(*options, log) : printSceneInfo(*options, log);
        };
    });
}

}  // namespace crevice
