// A walk of our own: the standard one either skips linked folders or follows links in circles.
#include "cocos/files/FolderWalk.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 60;
constexpr std::size_t kMaxBehindLinks = 100'000;  ///< Somebody's link leads to the root of the disk.
constexpr int kMaxWays = 4;

class Walk {
public:
    using Visit = std::function<void(const fs::directory_entry&)>;
    Walk(std::size_t& seen, const Visit& visit) : seen_(seen), visit_(visit) {}

    WalkEnd end() const { return end_; }

    /// `linked`: a link stands somewhere in the path below the first folder.
    void enter(const fs::path& folder, bool linked) {
        struct stat info {};
        if (stat(folder.c_str(), &info) != 0) {
            end_ = WalkEnd::Unreadable;
            return;
        }
        const Identity self{info.st_dev, info.st_ino};
        if (std::find(around_.begin(), around_.end(), self) != around_.end()) return;
        if (linked && (behindLinks_ > kMaxBehindLinks || ++ways_[self] > kMaxWays)) return;
        around_.push_back(self);
        std::vector<Inner> inner;
        read(folder, linked, inner);
        // Ways and entries behind links are counted: the order must not be the disk's.
        std::sort(inner.begin(), inner.end());
        for (const auto& [behindLink, path] : inner)
            if (end_ != WalkEnd::TooMany) enter(path, behindLink);
        around_.pop_back();
    }

private:
    using Identity = std::pair<dev_t, ino_t>;
    using Inner = std::pair<bool, fs::path>;  ///< Real folders before linked ones.

    void read(const fs::path& folder, bool linked, std::vector<Inner>& inner) {
        std::error_code failed;
        for (fs::directory_iterator it(folder, failed), last; !failed && it != last; it.increment(failed)) {
            if (++seen_ > kMaxWalkedEntries) {
                end_ = WalkEnd::TooMany;
                return;
            }
            behindLinks_ += linked ? 1 : 0;
            std::error_code unreadable;  // a link to nothing
            if (!it->is_directory(unreadable))
                visit_(*it);
            else if (mayEnter(it->path()))
                inner.emplace_back(linked || it->is_symlink(unreadable), it->path());
        }
        if (failed) end_ = WalkEnd::Unreadable;
    }

    bool mayEnter(const fs::path& folder) const {
        const std::string_view path = folder.native();
        const std::string_view name = path.substr(path.rfind('/') + 1);
        return name != "node_modules" && name != ".git" && around_.size() <= kMaxDepth;
    }

    std::size_t& seen_;
    const Visit& visit_;
    WalkEnd end_ = WalkEnd::Complete;
    std::vector<Identity> around_;  ///< The folders that the walk stands within.
    std::map<Identity, int> ways_;  ///< How often links led to a folder.
    std::size_t behindLinks_ = 0;
};

}  // namespace

WalkEnd walkFiles(const fs::path& folder, std::size_t& seen,
                  const std::function<void(const fs::directory_entry&)>& visit) {
    Walk walk(seen, visit);
    walk.enter(folder, false);
    return walk.end();
}

}  // namespace crevice::cocos
