// Fuzzes glTF files, text and binary, whole: container, JSON, buffers in data URIs, accessors, nodes, images; posed by
// an animation and read strictly, too.
#include "FuzzTargets.h"

namespace crevice::fuzz {

void gltf(std::string_view input) {
    static const ScratchFolder kFolder;
    static const Log kLog(LogLevel::Note, [](LogLevel, std::string_view) {});
    const std::filesystem::path file = kFolder.write("fuzz.gltf", input);
    expectAnswer([&] { (void)loadGltf(file, {.log = kLog, .limits = smallLimits()}); });
    if (input.find("animations") != std::string_view::npos)
        expectAnswer([&] { (void)loadGltf(file, {.log = kLog, .limits = smallLimits(), .time = 0.4f}); });
    expectAnswer([&] { (void)loadGltf(file, {.log = kLog, .limits = smallLimits(), .scene = "0", .strict = true}); });
}

}  // namespace crevice::fuzz
