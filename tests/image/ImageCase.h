// A golden image's case: what is rendered, how far it may be off on another driver, and which test proves the fact.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace crevice::image {

struct ImageCase {
    std::string name;  ///< Of the file, without ".case.json".
    std::string help;
    std::string pipeline;
    std::filesystem::path scene;
    std::uint32_t width = 320, height = 180;
    std::map<std::string, std::string> options;
    std::map<std::string, std::string> sets;
    /// On another driver than the recorded one: largest difference of any channel (0 … 255) that may pass, the share of
    /// pixels that may be off further, and the cause of both.
    double tolerance = 0, outliers = 0;
    std::string reason;
    std::string fact;  ///< "Suite.Name" of the test that asserts what the picture only shows.
};

/// For messages of GoogleTest.
inline void PrintTo(const ImageCase& c, std::ostream* out) { *out << c.name; }

std::filesystem::path goldenPath(const std::string& name);
/// Every case, sorted by name. Throws std::exception for a file that is no case or has an unknown key.
std::vector<ImageCase> readCases();

}  // namespace crevice::image
