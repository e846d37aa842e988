// Runs a shell in the folder and reads what it says.
#include "PackageTools.h"

#include <array>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/wait.h>

namespace crevice::package {

namespace fs = std::filesystem;

fs::path work() { return CREVICE_PACKAGE_WORK; }

Outcome crevice(const std::string& folder, const std::string& arguments) {
    const std::string command = "cd '" + (work() / folder).string() + "' && '" +
                                (work() / "crevice/bin/crevice").string() + "' " + arguments + " 2>&1 </dev/null";
    Outcome outcome;
    std::FILE* pipe = popen(command.c_str(), "r");
    if (!pipe) return outcome;
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        outcome.text.append(buffer.data(), count);
    const int status = pclose(pipe);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

Image picture(const std::string& path) { return readImage(work() / path); }

int byteAt(const Image& image, std::uint32_t x, std::uint32_t y, int channel) {
    return std::to_integer<int>(image.pixel(x, y)[channel]);
}

std::vector<std::string> linesOf(const fs::path& path) {
    std::ifstream in(path);
    EXPECT_TRUE(in) << path;
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> includesOf(const fs::path& path) {
    std::vector<std::string> includes;
    for (const std::string& line : linesOf(path)) {
        if (!line.starts_with("#include ")) continue;
        const std::string rest = line.substr(9);
        includes.push_back(rest.substr(0, rest.find_first_of("\">", 1) + 1));
    }
    return includes;
}

}  // namespace crevice::package
