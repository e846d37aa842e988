// Every link of every document leads to a file and a heading that are there; every document can be reached.
#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "Markdown.h"

namespace crevice::docs {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxPictureBytes = 700'000;

bool isElsewhere(const std::string& target) { return target.starts_with("https://") || target.starts_with("mailto:"); }

TEST(DocsLinks, LeadSomewhere) {
    std::size_t count = 0;
    for (const fs::path& document : allDocuments()) {
        for (const Link& link : linksOf(readText(document))) {
            if (isElsewhere(link.target)) continue;
            ++count;
            const fs::path target = link.target.empty() ? document : document.parent_path() / link.target;
            ASSERT_TRUE(fs::exists(target)) << document << ":" << link.line << ": " << link.target;
            if (link.anchor.empty()) continue;
            const std::vector<std::string> anchors = anchorsOf(readText(target));
            EXPECT_TRUE(std::find(anchors.begin(), anchors.end(), link.anchor) != anchors.end())
                << document << ":" << link.line << ": '" << link.target << "' has no heading #" << link.anchor;
        }
    }
    EXPECT_GE(count, 30u);
}

TEST(DocsLinks, ReachEveryDocumentAndPicture) {
    const fs::path root = CREVICE_TEST_SOURCE_DIR;
    std::set<fs::path> reached;
    std::vector<fs::path> open{root / "README.md"};
    while (!open.empty()) {
        const fs::path document = open.back().lexically_normal();
        open.pop_back();
        if (!reached.insert(document).second || document.extension() != ".md") continue;
        for (const Link& link : linksOf(readText(document))) {
            if (!isElsewhere(link.target) && !link.target.empty()) open.push_back(document.parent_path() / link.target);
        }
    }
    for (const fs::path& document : allDocuments()) EXPECT_TRUE(reached.contains(document)) << document;
    for (const auto& entry : fs::directory_iterator(root / "docs" / "images")) {
        EXPECT_TRUE(reached.contains(entry.path())) << entry.path() << " is shown nowhere";
        EXPECT_LE(entry.file_size(), kMaxPictureBytes) << entry.path();
    }
}

}  // namespace
}  // namespace crevice::docs
