// A walk over the roots; file times instead of contents, because a thousand passes should load in a second.
#include "cocos/files/Fingerprint.h"

#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cocos/files/FolderWalk.h"
#include "core/Files.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxChunkBytes = 16u << 20;
/// Two writes may share a file system's time stamp when they follow one another closer than this.
constexpr std::chrono::seconds kStampsMayRepeat{2};

std::string describe(const fs::path& path, std::error_code& error) {
    const auto size = fs::file_size(path, error);
    const auto written = fs::last_write_time(path, error);
    std::string text = fmt::format("{} {} {}\n", path.string(), size, written.time_since_epoch().count());
    if (!error && fs::file_time_type::clock::now() - written < kStampsMayRepeat)
        text += contentHash(readText(path, kMaxChunkBytes));
    return text;
}

/// The file that this code was loaded from.
std::string ownFile() {
    Dl_info info{};
    std::error_code error;
    if (dladdr(reinterpret_cast<const void*>(&fingerprintOf), &info) == 0 || info.dli_fname == nullptr) return {};
    const fs::path path = info.dli_fname;
    const auto size = fs::file_size(path, error);
    const auto written = fs::last_write_time(path, error);
    return error ? std::string() : fmt::format("{} {}\n", size, written.time_since_epoch().count());
}

}  // namespace

std::string fingerprintOf(const Roots& roots) {
    std::vector<fs::path> folders = roots.chunks;
    for (const fs::path& folder : roots.assetFolders()) folders.push_back(folder);
    std::vector<std::string> files;
    std::size_t entries = 0;
    try {
        for (const fs::path& folder : folders) {
            std::error_code failed;
            const auto add = [&](const fs::directory_entry& file) {
                std::error_code dangling;
                const std::string_view path = file.path().native();
                if ((!path.ends_with(".effect") && !path.ends_with(".chunk")) || !file.is_regular_file(dangling))
                    return;
                std::error_code error;
                files.push_back(describe(file.path(), error));
                if (error) failed = error;
            };
            if (walkFiles(folder, entries, add) != WalkEnd::Complete || failed) return {};
            files.push_back("folder " + folder.string() + "\n");
        }
    } catch (const Error&) {
        return {};
    }
    std::string all = ownFile();
    if (all.empty()) return {};
    std::sort(files.begin(), files.end());
    for (const fs::path& folder : folders) all += folder.string() + "\n";
    for (const std::string& file : files) all += file;
    return contentHash(all);
}

}  // namespace crevice::cocos
