// Names of tests that documents refer to.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace crevice {

std::string textOf(const std::filesystem::path& path);

/// "Suite.Name" of every TEST, TEST_F and TEST_P below a folder.
std::set<std::string> testsThereAre(const std::filesystem::path& folder);

}  // namespace crevice
