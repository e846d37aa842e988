// A target's raw values as a picture that shows them: what --dump writes.
#pragma once

#include <filesystem>

#include "app/commands/OutputFiles.h"
#include "plan/PipelineDesc.h"
#include "scene/Camera.h"

namespace crevice {

/// .exr: the values. .png: clamped to [0, 1]; float targets that hold negative values as x/2 + 1/2; distances and the
/// camera's depth as distance / far. Never tone-mapped.
void addDump(OutputFiles& files, const std::filesystem::path& path, const Image& image, const TargetDesc& target,
             const Camera& camera);

}  // namespace crevice
