// Files that a command writes: all of them, or none when anything fails.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/Image.h"

namespace crevice {

/// ".png" and ".exr"; `option` stands in messages. Throws Error for another ending, a missing or closed folder, or a
/// folder where a file should go.
void checkPicturePath(std::string_view option, const std::filesystem::path& path);
/// The same for a file of any kind.
void checkOutputPath(std::string_view option, const std::filesystem::path& path);

/// Writes aside; commit() gives the files their names. Without it, they are gone.
class OutputFiles {
public:
    OutputFiles() = default;
    ~OutputFiles();
    OutputFiles(const OutputFiles&) = delete;
    OutputFiles& operator=(const OutputFiles&) = delete;

    void add(const std::filesystem::path& path, const Image& image, PngMapping mapping = PngMapping::Clamp,
             float far = 1.0f);
    void add(const std::filesystem::path& path, std::string_view text);
    /// Paths in the order they were added. Throws RenderError when a file cannot get its name.
    std::vector<std::filesystem::path> commit();

private:
    struct File {
        std::filesystem::path aside, path;
    };
    std::filesystem::path asideFor(const std::filesystem::path& path);
    template <class Write>
    void writeAside(const std::filesystem::path& path, Write write);

    std::vector<File> files_;
};

}  // namespace crevice
