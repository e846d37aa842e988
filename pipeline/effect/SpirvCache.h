// SPIR-V on disk by content hash, so that glslang is not even started for a shader that was compiled before.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "effect/ShaderCompiler.h"

namespace crevice {

/// Damaged files count as absent; a folder that cannot be written is no error.
class SpirvCache {
public:
    /// Without a folder nothing is found and nothing is kept.
    explicit SpirvCache(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

    /// `key` is a contentHash().
    std::vector<StageCode> load(const std::string& key) const;
    void store(const std::string& key, const std::vector<StageCode>& code) const;

private:
    std::optional<std::filesystem::path> folder_;
};

}  // namespace crevice
