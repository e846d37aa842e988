// Asset names that cannot leave their root, whole reads, atomic writes, the cache folder and content hashes.
#include "core/Files.h"

#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace crevice {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class Files : public testing::Test {
protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        root_ = fs::path(testing::TempDir()) / ("crevice-files-" + std::to_string(::getpid()) + "-" + info->name());
        fs::create_directories(root_);
    }
    void TearDown() override { fs::remove_all(root_); }

    fs::path make(const std::string& name, const std::string& content = "x") const {
        const fs::path path = root_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << content;
        return path;
    }
    std::set<std::string> entries() const {
        std::set<std::string> names;
        for (const auto& entry : fs::directory_iterator(root_)) names.insert(entry.path().filename().string());
        return names;
    }

    fs::path root_;
};

/// Sets an environment variable for one test.
class Environment {
public:
    Environment(const char* name, const std::string& value) : name_(name) {
        if (const char* old = std::getenv(name)) old_ = old;
        ::setenv(name, value.c_str(), 1);
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() {
        if (old_) {
            ::setenv(name_, old_->c_str(), 1);
        } else {
            ::unsetenv(name_);
        }
    }

private:
    const char* name_;
    std::optional<std::string> old_;
};

TEST_F(Files, EveryKindHasItsFolderAndEnding) {
    const AssetRoots roots({root_});
    const std::pair<AssetKind, const char*> places[] = {{AssetKind::Pipeline, "assets/pipelines/n.pipeline.json"},
                                                        {AssetKind::Flow, "assets/pipelines/flows/n.flow.json"},
                                                        {AssetKind::Effect, "effects/n.effect"},
                                                        {AssetKind::Chunk, "effects/chunks/n.chunk"},
                                                        {AssetKind::Scene, "assets/scenes/n.scene.json"},
                                                        {AssetKind::Material, "assets/materials/n.mtl.json"}};
    for (const auto& [kind, path] : places) {
        EXPECT_FALSE(roots.find(kind, "n"));
        make(path);
        EXPECT_EQ(roots.find(kind, "n"), root_ / path);
        EXPECT_EQ(roots.list(kind), std::vector<std::string>{"n"});
    }
}

TEST_F(Files, EffectsBesideADocumentGoBeforeAllOthers) {
    const AssetRoots ours({root_ / "ours"});
    make("ours/effects/e.effect");
    make("ours/effects/chunks/c.chunk");
    const std::string document = make("mine/my.pipeline.json").string();
    const AssetRoots roots = ours.forDocument(document);
    EXPECT_EQ(roots.find(AssetKind::Effect, "e"), root_ / "ours/effects/e.effect");
    make("mine/effects/e.effect");
    EXPECT_EQ(roots.find(AssetKind::Effect, "e"), root_ / "mine/effects/e.effect");
    make("mine/e.effect");
    make("mine/c.chunk");
    EXPECT_EQ(roots.find(AssetKind::Effect, "e"), root_ / "mine/e.effect");
    EXPECT_EQ(roots.find(AssetKind::Chunk, "c"), root_ / "mine/c.chunk");
    make("mine/deeper/below.effect");
    EXPECT_EQ(roots.find(AssetKind::Effect, "deeper/below"), root_ / "mine/deeper/below.effect");
    EXPECT_EQ(roots.list(AssetKind::Effect), std::vector<std::string>{"e"});
    EXPECT_EQ(ours.find(AssetKind::Effect, "e"), root_ / "ours/effects/e.effect") << "the original is unchanged";
    EXPECT_EQ(roots.forDocument(document).roots(), roots.roots()) << "twice is once";
    EXPECT_EQ(ours.forDocument("my").roots(), ours.roots()) << "a name has no folder";
}

TEST_F(Files, OnlyEffectsAndChunksMayLieBesideADocument) {
    const AssetRoots roots = AssetRoots({root_ / "ours"}).forDocument(make("mine/my.pipeline.json").string());
    make("mine/s.scene.json");
    make("mine/m.mtl.json");
    EXPECT_FALSE(roots.find(AssetKind::Scene, "s"));
    EXPECT_FALSE(roots.find(AssetKind::Material, "m"));
    EXPECT_FALSE(roots.find(AssetKind::Pipeline, "my"));
}

TEST_F(Files, ADocumentsEffectsStayInItsFolder) {
    const AssetRoots roots = AssetRoots({root_ / "ours"}).forDocument(make("mine/my.pipeline.json").string());
    const fs::path secret = make("secret.effect");
    fs::create_symlink(secret, root_ / "mine/link.effect");
    EXPECT_FALSE(roots.find(AssetKind::Effect, "link"));
    EXPECT_FALSE(roots.find(AssetKind::Effect, "../secret"));
    EXPECT_FALSE(roots.find(AssetKind::Effect, (root_ / "secret").string()));
}

TEST_F(Files, ADocumentInATreeLikeOursBringsTheTree) {
    make("tree/effects/e.effect");
    const std::string document = make("tree/assets/pipelines/my.pipeline.json").string();
    const AssetRoots roots = AssetRoots({root_ / "ours"}).forDocument(document);
    const auto found = roots.find(AssetKind::Effect, "e");
    ASSERT_TRUE(found);
    EXPECT_TRUE(fs::equivalent(*found, root_ / "tree/effects/e.effect"));
}

TEST_F(Files, NamesCannotLeaveTheRoot) {
    make("effects/ok.effect");
    make("secret.effect");
    const AssetRoots roots({root_});
    for (const char* name : {"../secret", "a/../ok", "./ok", "", "/ok", "ok/", "a//ok", "..", "a\\ok"}) {
        EXPECT_FALSE(roots.find(AssetKind::Effect, name)) << name;
    }
    EXPECT_FALSE(roots.find(AssetKind::Effect, (root_ / "secret").string()));
    EXPECT_FALSE(roots.find(AssetKind::Effect, std::string_view("ok\0", 3)));
    EXPECT_TRUE(roots.find(AssetKind::Effect, "ok"));
}

TEST_F(Files, LinksCannotLeaveTheRoot) {
    const fs::path outside = make("outside.effect");
    make("inner/effects/real.effect");
    fs::create_symlink(outside, root_ / "inner/effects/link.effect");
    fs::create_symlink("real.effect", root_ / "inner/effects/alias.effect");
    const AssetRoots roots({root_ / "inner"});
    EXPECT_FALSE(roots.find(AssetKind::Effect, "link"));
    EXPECT_TRUE(roots.find(AssetKind::Effect, "alias"));
    EXPECT_FALSE(roots.contains(root_ / "inner/effects/link.effect"));
    EXPECT_FALSE(roots.contains(root_ / "inner/../outside.effect"));
    EXPECT_TRUE(roots.contains(root_ / "inner/not/there/yet"));
    EXPECT_FALSE(roots.contains(root_ / "innermost"));
}

TEST_F(Files, TheFirstRootWinsAndListsAreMerged) {
    make("one/effects/a.effect");
    make("one/effects/sub/b.effect");
    make("two/effects/a.effect");
    make("two/effects/c.effect");
    make("two/effects/notes.txt");
    AssetRoots roots({root_ / "one"});
    roots.prepend(root_ / "two");
    EXPECT_EQ(roots.find(AssetKind::Effect, "a"), root_ / "two/effects/a.effect");
    EXPECT_EQ(roots.find(AssetKind::Effect, "sub/b"), root_ / "one/effects/sub/b.effect");
    EXPECT_EQ(roots.list(AssetKind::Effect), (std::vector<std::string>{"a", "c", "sub/b"}));
    EXPECT_TRUE(AssetRoots({root_ / "none"}).list(AssetKind::Effect).empty());
}

TEST_F(Files, StandardRootFollowsTheEnvironment) {
    const Environment set("CREVICE_DATA_DIR", root_.string());
    EXPECT_EQ(AssetRoots::standard().roots(), std::vector<fs::path>{root_});
    const Environment wrong("CREVICE_DATA_DIR", (root_ / "none").string());
    EXPECT_THROW(AssetRoots::standard(), Error);
}

TEST_F(Files, ReadsWholeFiles) {
    std::string content(200'000, 'a');
    content += std::string("\0\r\n\xff", 4);
    const fs::path path = make("f", content);
    EXPECT_EQ(readText(path), content);
    EXPECT_EQ(readText(path, content.size()), content);
    EXPECT_EQ(readBytes(path).size(), content.size());
    EXPECT_EQ(readText(make("empty", "")), "");
}

TEST_F(Files, ReadErrorsNameThePathAndTheReason) {
    const auto messageOf = [](const fs::path& path, std::size_t limit) {
        try {
            readText(path, limit);
        } catch (const Error& error) {
            EXPECT_FALSE(error.problems().front().help.empty());
            return error.problems().front().message;
        }
        return std::string("nothing was thrown");
    };
    const std::string none = (root_ / "none").string();
    EXPECT_EQ(messageOf(none, 10), "cannot read '" + none + "': No such file or directory");
    EXPECT_EQ(messageOf(root_, 10), "cannot read '" + root_.string() + "': it is a folder");
    const fs::path large = make("large", "12345678901");
    EXPECT_EQ(messageOf(large, 10),
              "cannot read '" + large.string() + "': it is larger than the 10 bytes that are read");
    EXPECT_NE(messageOf("/dev/zero", 10).find("larger than the 10 bytes"), std::string::npos);
}

TEST_F(Files, WritesReplaceAndLeaveNothingBehind) {
    const fs::path path = root_ / "out.txt";
    writeFileAtomically(path, std::string_view("one"));
    writeFileAtomically(path, std::string_view("two"));
    EXPECT_EQ(readText(path), "two");
    EXPECT_EQ(entries(), std::set<std::string>{"out.txt"});
    struct stat info {};
    ASSERT_EQ(::stat(path.c_str(), &info), 0);
    const mode_t mask = ::umask(0);
    ::umask(mask);
    EXPECT_EQ(info.st_mode & 0777, 0666 & ~mask);
}

TEST_F(Files, FailedWritesLeaveNothingBehind) {
    fs::create_directories(root_ / "folder");
    EXPECT_THROW(writeFileAtomically(root_ / "folder", std::string_view("x")), RenderError);
    EXPECT_THROW(writeFileAtomically(root_ / "none/out.txt", std::string_view("x")), RenderError);
    EXPECT_THROW(writeFileAtomically(root_ / std::string(250, 'n'), std::string_view("x")), RenderError);
    EXPECT_THROW(writeFileAtomically("", std::string_view("x")), RenderError);
    EXPECT_EQ(entries(), std::set<std::string>{"folder"});
}

TEST_F(Files, LinksAndDevicesStayWhatTheyAre) {
    const fs::path target = make("target.txt", "old");
    fs::create_symlink("target.txt", root_ / "link.txt");
    writeFileAtomically(root_ / "link.txt", std::string_view("new"));
    EXPECT_TRUE(fs::is_symlink(root_ / "link.txt"));
    EXPECT_EQ(readText(target), "new");
    fs::create_symlink("/dev/null", root_ / "null");
    writeFileAtomically(root_ / "null", std::string_view("gone"));
    EXPECT_TRUE(fs::is_character_file(root_ / "null"));
    EXPECT_THROW(writeFileAtomically("/dev/full", std::string_view("x")), RenderError);
}

TEST_F(Files, ThreadsThatWriteOneFileDoNotMixTheirTexts) {
    const fs::path path = root_ / "shared.txt";
    std::vector<std::thread> threads;
    for (char c = 'a'; c < 'e'; ++c) {
        threads.emplace_back([&, c] {
            for (int i = 0; i < 50; ++i) writeFileAtomically(path, std::string_view(std::string(5000, c)));
        });
    }
    for (std::thread& thread : threads) thread.join();
    const std::string text = readText(path);
    EXPECT_EQ(text, std::string(5000, text.front()));
    EXPECT_EQ(entries(), std::set<std::string>{"shared.txt"});
}

TEST_F(Files, CacheFolderIsMadeOrAbsent) {
    {
        const Environment cache("XDG_CACHE_HOME", (root_ / "cache").string());
        EXPECT_EQ(cacheFolder("spirv"), root_ / "cache/crevice/spirv");
        EXPECT_TRUE(fs::is_directory(root_ / "cache/crevice/spirv"));
    }
    make("file");
    const Environment blocked("XDG_CACHE_HOME", (root_ / "file").string());
    EXPECT_FALSE(cacheFolder("spirv"));
    const Environment relative("XDG_CACHE_HOME", "relative");
    const Environment home("HOME", root_.string());
    EXPECT_EQ(cacheFolder("spirv"), root_ / ".cache/crevice/spirv");
    const Environment homeless("HOME", "");
    EXPECT_FALSE(cacheFolder("spirv"));
}

TEST(ContentHash, IsStableAndHasItsForm) {
    EXPECT_EQ(contentHash("crevice"), contentHash(std::string("crevice")));
    EXPECT_EQ(contentHash("").size(), 32u);
    EXPECT_EQ(contentHash("a").find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(ContentHash, TellsApartZerosLengthsAndOrder) {
    std::set<std::string> seen;
    for (std::size_t length = 0; length < 200; ++length) seen.insert(contentHash(std::string(length, '\0')));
    EXPECT_EQ(seen.size(), 200u);
    EXPECT_NE(contentHash("aaaaaaaabbbbbbbb"), contentHash("bbbbbbbbaaaaaaaa"));
}

TEST(ContentHash, EveryBitMovesAboutHalfOfEveryHalf) {
    const std::string base(40, 'x');
    const std::string before = contentHash(base);
    const auto bitsOf = [](const std::string& hex, int half) {
        return std::stoull(hex.substr(static_cast<std::size_t>(half) * 16, 16), nullptr, 16);
    };
    for (std::size_t bit = 0; bit < base.size() * 8; ++bit) {
        std::string changed = base;
        changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << (bit % 8)));
        const std::string after = contentHash(changed);
        for (int half = 0; half < 2; ++half) {
            const int moved = __builtin_popcountll(bitsOf(before, half) ^ bitsOf(after, half));
            EXPECT_GT(moved, 10) << "bit " << bit;  // 32 expected, deviation 4: below 10 is no accident
            EXPECT_LT(moved, 54) << "bit " << bit;
        }
    }
}

}  // namespace
}  // namespace crevice
