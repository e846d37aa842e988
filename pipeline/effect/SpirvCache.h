// Compiled passes on disk: by content, so that glslang is not even started for what was compiled before, and by
// request, so that not even a text is put together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "effect/ShaderBytes.h"

namespace crevice {

/// Damaged files count as absent; a folder that cannot be written is no error. Keys are contentHash()es.
class SpirvCache {
public:
    /// Without a folder nothing is found and nothing is kept.
    explicit SpirvCache(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

    bool keeps() const { return folder_.has_value(); }
    std::optional<CompiledPass> load(const std::string& key) const;
    void store(const std::string& key, const CompiledPass& pass) const;

    /// What a request came to: the key of its content, and what was said of it on the way.
    struct Answer {
        std::string content;
        std::vector<Problem> problems;
    };
    std::optional<Answer> loadAnswer(const std::string& request) const;
    void storeAnswer(const std::string& request, const Answer& answer) const;

private:
    std::optional<std::string> read(const std::string& file) const;
    void write(const std::string& file, const std::string& body) const;

    std::optional<std::filesystem::path> folder_;
};

}  // namespace crevice
