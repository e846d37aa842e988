// A walk of our own: the standard one either skips linked folders or follows links in circles.
#include "cocos/files/MetaFiles.h"

#include <algorithm>
#include <set>
#include <string>
#include <system_error>

#include <fmt/format.h>

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

class Walk {
public:
    Walk(Problems& problems, const WalkLimits& limits) : problems_(problems), limits_(limits) {}

    std::vector<fs::path> take() { return std::move(found_); }

    void enter(const fs::path& folder, int depth) {
        if (stopped_) return;
        if (depth > limits_.maxDepth) {
            problems_.warning({.file = folder.string()},
                              fmt::format("folders deeper than {} levels are not searched", limits_.maxDepth),
                              "flatten the folder");
            return;
        }
        std::error_code failed;
        const fs::path real = fs::canonical(folder, failed);
        if (failed || !entered_.insert(real).second) return;
        std::vector<fs::path> folders;
        readFolder(folder, folders);
        for (const fs::path& inner : folders) enter(inner, depth + 1);
    }

private:
    void readFolder(const fs::path& folder, std::vector<fs::path>& folders) {
        std::error_code failed;
        std::vector<fs::path> metas;
        std::set<std::string> names;
        for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
            if (++entries_ > limits_.maxEntries) return stop(folder);
            const std::string name = it->path().filename().string();
            if (name.starts_with('.')) continue;
            std::error_code unreadable;
            if (it->is_directory(unreadable)) folders.push_back(it->path());
            if (name.ends_with(".meta") && !name.ends_with(".meta.meta")) metas.push_back(it->path());
            names.insert(name);
        }
        if (failed) {
            problems_.warning({.file = folder.string()}, fmt::format("the folder cannot be read: {}", failed.message()),
                              "check its permissions");
        }
        std::sort(folders.begin(), folders.end());
        std::sort(metas.begin(), metas.end());
        for (fs::path& meta : metas) {
            if (names.contains(meta.stem().string())) found_.push_back(std::move(meta));
        }
    }

    void stop(const fs::path& folder) {
        stopped_ = true;
        problems_.warning({.file = folder.string()},
                          fmt::format("the search for assets stops here, after {} files", limits_.maxEntries),
                          "give a smaller project folder");
    }

    Problems& problems_;
    WalkLimits limits_;
    std::vector<fs::path> found_;
    std::set<fs::path> entered_;
    std::size_t entries_ = 0;
    bool stopped_ = false;
};

}  // namespace

std::vector<fs::path> findMetaFiles(std::span<const fs::path> roots, Problems& problems, const WalkLimits& limits) {
    Walk walk(problems, limits);
    for (const fs::path& root : roots) walk.enter(root, 0);
    return walk.take();
}

}  // namespace crevice::cocos
