// Fuzzes glTF files, text and binary, whole: container, JSON, buffers in data URIs, accessors, nodes, images.
#include "FuzzTargets.h"

namespace crevice::fuzz {

void gltf(std::string_view input) {
    static const ScratchFolder kFolder;
    static const Log kLog(LogLevel::Note, [](LogLevel, std::string_view) {});
    const std::filesystem::path file = kFolder.write("fuzz.gltf", input);
    expectAnswer([&] { (void)loadGltf(file, {.log = kLog, .limits = smallLimits()}); });
}

}  // namespace crevice::fuzz
