// What the tests of the package share: its folder, its program, pictures as numbers, files as lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/Image.h"

namespace crevice::package {

/// Where package.sh left everything.
std::filesystem::path work();

struct Outcome {
    int code = -1;
    std::string text;  ///< Both streams.
};
/// Runs the installed `crevice` with arguments of a shell, in a folder below work().
Outcome crevice(const std::string& folder, const std::string& arguments);

Image picture(const std::string& path);
/// Byte of a channel of an RGBA8 picture.
int byteAt(const Image& image, std::uint32_t x, std::uint32_t y, int channel);

std::vector<std::string> linesOf(const std::filesystem::path& path);
/// The words between #include and the end of the line, quotes and brackets included.
std::vector<std::string> includesOf(const std::filesystem::path& path);

}  // namespace crevice::package
