// Aside means: a hidden file in the same folder, so that the final rename cannot cross file systems.
#include "app/commands/OutputFiles.h"

#include <system_error>

#include <unistd.h>

#include <fmt/format.h>

#include "core/Error.h"
#include "core/Files.h"

namespace crevice {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// A device or a pipe: it is written into, never replaced.
bool isSpecial(const fs::path& path) {
    std::error_code failed;
    const fs::file_status status = fs::status(path, failed);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

void checkOutputPath(std::string_view option, const fs::path& path) {
    std::error_code failed;
    if (path.empty() || !path.has_filename()) {
        throw Error(fmt::format("{}: '{}' names no file", option, path.string()), "write a file name");
    }
    if (fs::is_directory(path, failed)) {
        throw Error(fmt::format("{}: '{}' is a folder", option, path.string()), "name a file in it");
    }
    if (isSpecial(path)) return;
    const fs::path folder = folderOf(path);
    if (!fs::is_directory(folder, failed)) {
        throw Error(fmt::format("{}: folder '{}' does not exist", option, folder.string()),
                    fmt::format("make it first: mkdir -p {}", folder.string()));
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw Error(fmt::format("{}: folder '{}' is not writable", option, folder.string()), "choose another folder");
    }
}

void checkPicturePath(std::string_view option, const fs::path& path) {
    checkOutputPath(option, path);
    const std::string ending = path.extension().string();
    if (ending == ".png" || ending == ".exr") return;
    throw Error(ending.empty() ? fmt::format("{}: '{}' has no extension", option, path.string())
                               : fmt::format("{}: '{}' is not a kind of picture that can be written", option, ending),
                "end the name in .png (8 bits) or .exr (floats)");
}

OutputFiles::~OutputFiles() {
    std::error_code ignored;
    for (const File& file : files_) fs::remove(file.aside, ignored);
}

fs::path OutputFiles::asideFor(const fs::path& path) {
    const std::string name =
        fmt::format(".{}.{}-{}{}", path.stem().string(), getpid(), files_.size(), path.extension().string());
    files_.push_back({(isSpecial(path) ? fs::temp_directory_path() : folderOf(path)) / name, path});
    return files_.back().aside;
}

/// A failure names the file that was asked for.
template <class Write>
void OutputFiles::writeAside(const fs::path& path, Write write) {
    const fs::path aside = asideFor(path);
    try {
        write(aside);
    } catch (const RenderError& error) {
        std::vector<Problem> problems = error.problems();
        for (Problem& problem : problems) {
            const std::size_t at = problem.message.find(aside.string());
            if (at != std::string::npos) problem.message.replace(at, aside.string().size(), path.string());
        }
        throw RenderError(std::move(problems));
    }
}

void OutputFiles::add(const fs::path& path, const Image& image, PngMapping mapping, float far) {
    writeAside(path, [&](const fs::path& aside) { writeImage(aside, image, mapping, far); });
}

void OutputFiles::add(const fs::path& path, std::string_view text) {
    writeAside(path, [&](const fs::path& aside) { writeFileAtomically(aside, text); });
}

std::vector<fs::path> OutputFiles::commit() {
    // What cannot be undone or often fails comes first: while it may fail, no file has a new content.
    for (const File& file : files_)
        if (isSpecial(file.path)) writeFileAtomically(file.path, readBytes(file.aside));
    std::vector<fs::path> written;
    for (const File& file : files_) {
        written.push_back(file.path);
        if (isSpecial(file.path)) continue;
        std::error_code failed;
        fs::rename(file.aside, file.path, failed);
        if (failed) throw RenderError(fmt::format("'{}' cannot be written: {}", file.path.string(), failed.message()));
    }
    std::error_code ignored;
    for (const File& file : files_)
        if (isSpecial(file.path)) fs::remove(file.aside, ignored);
    files_.clear();
    return written;
}

}  // namespace crevice
