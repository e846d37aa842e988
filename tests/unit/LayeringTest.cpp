// The house rules that a compiler does not check: includes point one way, Vulkan has one door, files stay short.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxLines = 400;
const fs::path kRoot = CREVICE_TEST_SOURCE_DIR;

/// What each layer may include besides itself: what stands to its left.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"core", {}},
    {"gfx", {"core"}},
    {"effect", {"core"}},
    {"scene", {"core"}},
    {"plan", {"core", "effect", "scene"}},
    {"cocos", {"core", "effect", "scene", "plan"}},
    {"truth", {"core", "scene"}},
    {"flow", {"core", "effect", "scene", "plan", "gfx"}},
    {"stages", {"core", "effect", "scene", "plan", "gfx", "flow"}},
    {"app", {"core", "effect", "scene", "plan", "cocos", "truth", "gfx", "flow", "stages"}},
};

/// The same for the rooms of pipeline/cocos; "" is its front door, which Crevice's effect library calls.
const std::map<std::string, std::set<std::string>> kCocosRooms = {
    {"files", {}},
    {"text", {"files"}},
    {"interface", {"files", "text"}},
    {"flatten", {"files", "text"}},
    {"analysis", {"files", "text", "flatten"}},
    {"", {"files", "text", "interface", "flatten", "analysis"}},
    {"reflection", {"", "files", "text", "interface", "flatten", "analysis"}},
    {"assets", {"files"}},
    {"import", {"files", "assets"}},
    {"scene", {"files", "assets"}},
};

struct SourceFile {
    std::string name;   // relative to the repository
    std::string layer;  // "core", …, "stages"; empty for tests
    std::vector<std::string> lines;
};

bool isSource(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

std::vector<SourceFile> readSources(const std::string& folder) {
    std::vector<SourceFile> files;
    if (!fs::is_directory(kRoot / folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
        if (!entry.is_regular_file() || !isSource(entry.path())) continue;
        SourceFile file;
        const fs::path relative = entry.path().lexically_relative(kRoot);
        file.name = relative.generic_string();
        const auto part = relative.begin();
        if (*part == "stages") file.layer = "stages";
        if (*part == "pipeline") file.layer = std::next(part)->string();
        std::ifstream in(entry.path());
        for (std::string line; std::getline(in, line);) file.lines.push_back(line);
        files.push_back(std::move(file));
    }
    std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return files;
}

std::vector<SourceFile> readLayers() {
    std::vector<SourceFile> files = readSources("pipeline");
    for (SourceFile& file : readSources("stages")) files.push_back(std::move(file));
    return files;
}

/// The layer that an include names, or nothing for system headers and files of the same folder.
std::string includedLayer(const std::string& line) {
    static const std::regex kInclude(R"re(^\s*#\s*include\s*"([a-z]+)/.*)re");
    std::smatch match;
    if (!std::regex_match(line, match, kInclude)) return {};
    return kMayInclude.contains(match[1]) ? match[1].str() : std::string();
}

TEST(Layering, EveryLayerIsKnownAndSeen) {
    std::set<std::string> seen;
    for (const SourceFile& file : readLayers()) {
        EXPECT_TRUE(kMayInclude.contains(file.layer)) << file.name << " lies in an unknown layer";
        seen.insert(file.layer);
    }
    EXPECT_TRUE(seen.contains("core")) << "the sources were not found below " << kRoot;
}

TEST(Layering, IncludesPointOneWay) {
    for (const SourceFile& file : readLayers()) {
        if (!kMayInclude.contains(file.layer)) continue;
        for (std::size_t i = 0; i < file.lines.size(); ++i) {
            const std::string layer = includedLayer(file.lines[i]);
            if (layer.empty() || layer == file.layer) continue;
            EXPECT_TRUE(kMayInclude.at(file.layer).contains(layer))
                << file.name << ":" << i + 1 << ": '" << file.layer << "' may not include '" << layer << "'";
        }
    }
}

TEST(Layering, TheRoomsOfCocosPointOneWay) {
    const std::regex include(R"re(^\s*#\s*include\s*"cocos/(?:([a-z]+)/)?.*)re");
    const fs::path top = kRoot / "pipeline/cocos";
    std::size_t seen = 0;
    for (const SourceFile& file : readSources("pipeline/cocos")) {
        const fs::path below = (kRoot / file.name).lexically_relative(top);
        const std::string room = below.has_parent_path() ? below.begin()->string() : "";
        ASSERT_TRUE(kCocosRooms.contains(room)) << file.name << " lies in an unknown room";
        std::smatch match;
        for (const std::string& line : file.lines) {
            if (!std::regex_match(line, match, include) || match[1] == room) continue;
            EXPECT_TRUE(kCocosRooms.at(room).contains(match[1])) << file.name << ": " << line;
            ++seen;
        }
    }
    EXPECT_GT(seen, 50u);
}

TEST(Layering, NoIncludeClimbsOutOfItsFolder) {
    const std::regex climbs(R"re(^\s*#\s*include\s*"\.\./.*)re");
    for (const SourceFile& file : readLayers()) {
        for (const std::string& line : file.lines)
            EXPECT_FALSE(std::regex_match(line, climbs)) << file.name << ": " << line;
    }
}

TEST(Layering, VulkanHasOneDoor) {
    const std::regex vulkan(R"re(^\s*#\s*include\s*[<"]vulkan.*)re");
    for (const SourceFile& file : readLayers()) {
        if (file.name == "pipeline/gfx/Vk.h") continue;
        for (const std::string& line : file.lines)
            EXPECT_FALSE(std::regex_match(line, vulkan)) << file.name << ": " << line;
    }
}

TEST(Layering, FilesStayShortAndSayWhatTheyAreFor) {
    std::vector<SourceFile> files = readLayers();
    for (SourceFile& file : readSources("tests")) files.push_back(std::move(file));
    for (const SourceFile& file : files) {
        EXPECT_LE(file.lines.size(), kMaxLines) << file.name;
        ASSERT_FALSE(file.lines.empty()) << file.name;
        EXPECT_TRUE(file.lines.front().starts_with("// ")) << file.name << " does not begin with its purpose";
    }
}

TEST(Layering, HeadersGuardThemselves) {
    for (const SourceFile& file : readLayers()) {
        if (!file.name.ends_with(".h")) continue;
        EXPECT_NE(std::find(file.lines.begin(), file.lines.end(), "#pragma once"), file.lines.end()) << file.name;
    }
}

// The checks above can fail: each rule is shown a line that breaks it.
TEST(Layering, RecognisesIncludes) {
    EXPECT_EQ(includedLayer("#include \"gfx/Device.h\""), "gfx");
    EXPECT_EQ(includedLayer("#  include \"flow/RenderStage.h\"  // why"), "flow");
    EXPECT_EQ(includedLayer("#include <spdlog/spdlog.h>"), "");
    EXPECT_EQ(includedLayer("#include \"Other.h\""), "");
}

}  // namespace
