// What targets share: small limits, and a scratch folder in shared memory where there is any, so that a fuzzer does not
// wear out a disk.
#include <cstdlib>
#include <fstream>

#include "FuzzTargets.h"

namespace crevice::fuzz {

namespace fs = std::filesystem;

LoadLimits smallLimits() {
    LoadLimits limits;
    limits.maxFileBytes = 1u << 20;
    limits.maxVertices = 50'000;
    limits.maxInstances = 2'000;
    limits.maxNodeDepth = 64;
    limits.maxImageSide = 1024;
    limits.maxImageBytes = 8u << 20;
    return limits;
}

ScratchFolder::ScratchFolder() {
    const fs::path memory = "/dev/shm";
    std::string name =
        ((fs::is_directory(memory) ? memory : fs::temp_directory_path()) / "crevice-fuzz-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("no scratch folder");
    path_ = name;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path ScratchFolder::write(const std::string& name, std::string_view content) const {
    const fs::path file = path_ / name;
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
}

}  // namespace crevice::fuzz
