// The fuzz targets: each hands one hostile input to one reader. An Error is an answer; anything else is a finding.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/Error.h"
#include "scene/GltfLoader.h"

namespace crevice::fuzz {

void pipeline(std::string_view input);
void effect(std::string_view input);
void material(std::string_view input);
void scene(std::string_view input);
void gltf(std::string_view input);
void image(std::string_view input);
void cocosEffect(std::string_view input);
void cocosAsset(std::string_view input);

/// Runs `read`; an Error is printed as the program would, so that its places are tried as well.
template <class Read>
void expectAnswer(Read read) {
    try {
        read();
    } catch (const Error& error) {
        if (formatError(error).empty()) throw std::logic_error("an Error without words");
    }
}

/// Limits at which a fuzzer stays quick: what is beyond them is refused as a large file is by the real ones.
LoadLimits smallLimits();

/// A folder of its own in memory for readers that take a path; removed when the process ends.
class ScratchFolder {
public:
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();
    std::filesystem::path write(const std::string& name, std::string_view content) const;
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

}  // namespace crevice::fuzz
