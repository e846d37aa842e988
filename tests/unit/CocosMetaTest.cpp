// The uuid index: forms of uuids, sub-assets, stray, broken and duplicate metas, links that go in circles, speed.

#include <gtest/gtest.h>

#include "SceneTestTools.h"
#include "cocos/files/MetaFiles.h"
#include "cocos/files/MetaIndex.h"
#include "cocos/files/Uuid.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;
using test::contains;
using test::TempFolder;

constexpr const char* kUuidA = "1baf0fc9-befa-459c-8bdd-af1a450a0319";
constexpr const char* kUuidB = "7acaaaaa-1111-4222-8333-444455556666";

std::string meta(const std::string& uuid, const std::string& rest = "") {
    return R"({"ver":"1.0.0","importer":"effect","imported":true,"uuid":")" + uuid + "\"" + rest + "}";
}

MetaIndex indexOf(const std::vector<fs::path>& roots, Problems& problems) { return MetaIndex::build(roots, problems); }

std::string textOf(const Problems& problems) {
    std::string text;
    for (const Problem& problem : problems.all()) text += formatProblem(problem) + "\n";
    return text;
}

// 7c 70 6b ce … : 2 hex digits stay, each pair of base64 digits holds the next 12 bits, by hand:
// "fc" "99" "1d" … of fc991dd7-0033-4b80-9d41-c8a86a702e59 is fc|991|dd7|003|34b|809|d41|c8a|86a|702|e59.
// 991 = 100110 010001 = 38 17 = m R; dd7 = 110111 010111 = 55 23 = 3 X; 003 = 0 3 = A D; 34b = 001101 001011 = 13 11 =
// N L; 809 = 100000 001001 = 32 9 = g J; d41 = 110101 000001 = 53 1 = 1 B; c8a = 110010 001010 = 50 10 = y K; 86a =
// 100001 101010 = 33 42 = h q; 702 = 011100 000010 = 28 2 = c C; e59 = 111001 011001 = 57 25 = 5 Z.
constexpr const char* kCompressed22 = "fcmR3XADNLgJ1ByKhqcC5Z";
constexpr const char* kWhole = "fc991dd7-0033-4b80-9d41-c8a86a702e59";
// 5 digits stay: fc991|dd7|003|…
constexpr const char* kCompressed23 = "fc9913XADNLgJ1ByKhqcC5Z";

TEST(CocosUuid, EveryFormBecomesTheSameText) {
    EXPECT_EQ(normalizeUuid(kWhole), kWhole);
    EXPECT_EQ(normalizeUuid("FC991DD7-0033-4B80-9D41-C8A86A702E59"), kWhole);
    EXPECT_EQ(normalizeUuid(kCompressed22), kWhole);
    EXPECT_EQ(normalizeUuid(kCompressed23), kWhole);
}

TEST(CocosUuid, SubIdsStayAndKeepTheirCase) {
    EXPECT_EQ(normalizeUuid(std::string(kCompressed22) + "@6c48a"), std::string(kWhole) + "@6c48a");
    EXPECT_EQ(normalizeUuid(std::string(kWhole) + "@b47c0@40c10"), std::string(kWhole) + "@b47c0@40c10");
    EXPECT_EQ(normalizeUuid(std::string(kWhole) + "@Cube.mesh"), std::string(kWhole) + "@Cube.mesh");
    EXPECT_EQ(parentUuid("a@b@c"), "a");
    EXPECT_EQ(parentUuid("a"), "a");
}

TEST(CocosUuid, OtherTextIsNone) {
    for (const std::string text :
         {"", "x", "1baf0fc9-befa-459c-8bdd-af1a450a031", "1baf0fc9-befa-459c-8bdd-af1a450a031g",
          "1baf0fc9xbefa-459c-8bdd-af1a450a0319", "zzmR3XADNLgJ1ByKhqcC5Z", "fcmR3XADNLgJ1ByKhqc*5Z",
          "1baf0fc9-befa-459c-8bdd-af1a450a0319@", "1baf0fc9-befa-459c-8bdd-af1a450a0319@a@@b"})
        EXPECT_FALSE(normalizeUuid(text)) << text;
}

TEST(CocosMeta, FindsAssetsAndNestedPartsInBothRoots) {
    const TempFolder folder;
    folder.write("project/a/x.effect", "");
    folder.write("project/a/x.effect.meta", meta(kUuidA));
    folder.write("engine/pic.png", "");
    const std::string sub = std::string(kUuidB) + "@b47c0";
    folder.write(
        "engine/pic.png.meta",
        meta(kUuidB, R"(,"subMetas":{"b47c0":{"importer":"erp-texture-cube","uuid":")" + sub +
                         R"(","name":"cube","userData":{"wrapModeS":"repeat"},"subMetas":{"40c10":{"importer":)"
                         R"("texture-cube-face","uuid":")" +
                         sub + R"(@40c10","name":"back"}}}})"));
    Problems problems;
    const MetaIndex index = indexOf({folder.path() / "project", folder.path() / "engine"}, problems);
    EXPECT_EQ(textOf(problems), "");
    EXPECT_EQ(index.size(), 4u);
    ASSERT_TRUE(index.find(kUuidA));
    EXPECT_EQ(index.find(kUuidA)->path, folder.path() / "project/a/x.effect");
    EXPECT_EQ(index.find(kUuidA)->importer, "effect");
    EXPECT_EQ(index.find(kUuidA)->name, "x.effect");
    ASSERT_TRUE(index.find(sub));
    EXPECT_EQ(index.find(sub)->path, folder.path() / "engine/pic.png");
    EXPECT_EQ(index.find(sub)->name, "cube");
    EXPECT_EQ(index.find(sub)->userData.find("wrapModeS")->string(), "repeat");
    EXPECT_TRUE(index.find(sub)->isSubAsset());
    ASSERT_TRUE(index.find(sub + "@40c10"));
    EXPECT_EQ(index.find(sub + "@40c10")->importer, "texture-cube-face");
    EXPECT_EQ(index.find(sub + "@99999"), nullptr);
    EXPECT_EQ(index.findNearest(sub + "@99999"), index.find(sub));
    EXPECT_EQ(index.findFile(folder.path() / "project/./a/x.effect"), index.find(kUuidA));
    EXPECT_EQ(index.find("nonsense"), nullptr);
}

TEST(CocosMeta, PartsComeInTheOrderOfTheFile) {
    const TempFolder folder;
    folder.write("m.gltf", "");
    const std::string parent = kUuidA;
    const auto part = [&](const char* id, const char* importer, const char* index) {
        return std::string("\"") + id + R"(":{"importer":")" + importer + R"(","uuid":")" + parent + "@" + id +
               R"(","userData":{"gltfIndex":)" + index + "}}";
    };
    folder.write(
        "m.gltf.meta",
        meta(kUuidA, ",\"subMetas\":{" + part("0aaaa", "gltf-mesh", "2") + "," + part("1bbbb", "gltf-material", "0") +
                         "," + part("2cccc", "gltf-mesh", "0") + "," + part("3dddd", "gltf-mesh", "1") + "}"));
    Problems problems;
    const MetaIndex index = indexOf({folder.path()}, problems);
    const auto meshes = index.parts(kUuidA, "gltf-mesh");
    ASSERT_EQ(meshes.size(), 3u);
    EXPECT_EQ(meshes[0]->uuid, parent + "@2cccc");
    EXPECT_EQ(meshes[1]->uuid, parent + "@3dddd");
    EXPECT_EQ(meshes[2]->uuid, parent + "@0aaaa");
}

TEST(CocosMeta, StrayMetasAreIgnored) {
    const TempFolder folder;
    folder.write("gone.chunk.meta", meta(kUuidA));
    folder.write("x.effect", "");
    folder.write("x.effect.meta", meta(kUuidB));
    folder.write("x.effect.meta.meta", meta(kUuidA));
    folder.write(".hidden/y.effect", "");
    folder.write(".hidden/y.effect.meta", meta(kUuidA));
    Problems problems;
    const MetaIndex index = indexOf({folder.path()}, problems);
    EXPECT_EQ(textOf(problems), "");
    EXPECT_EQ(index.size(), 1u);
    EXPECT_TRUE(index.find(kUuidB));
}

TEST(CocosMeta, TheFirstOfTwoEqualUuidsWinsWithAWarning) {
    const TempFolder folder;
    for (const std::string name : {"project/b.effect", "project/a.effect", "engine/c.effect"}) {
        folder.write(name, "");
        folder.write(name + ".meta", meta(kUuidA));
    }
    Problems problems;
    const MetaIndex index = indexOf({folder.path() / "project", folder.path() / "engine"}, problems);
    ASSERT_TRUE(index.find(kUuidA));
    EXPECT_EQ(index.find(kUuidA)->path.filename(), "a.effect");
    EXPECT_FALSE(problems.hasErrors());
    ASSERT_EQ(problems.all().size(), 2u);
    EXPECT_EQ(problems.all()[0].severity, Severity::Warning);
    EXPECT_EQ(problems.all()[0].where.file, (folder.path() / "project/b.effect.meta").string());
    EXPECT_TRUE(contains(problems.all()[0].message, "is the uuid of 'a.effect' already")) << problems.all()[0].message;
    EXPECT_EQ(problems.all()[1].where.file, (folder.path() / "engine/c.effect.meta").string());
}

TEST(CocosMeta, BrokenMetasAreWarningsWithTheirPlace) {
    const TempFolder folder;
    const auto add = [&](const std::string& name, const std::string& content) {
        folder.write(name, "");
        folder.write(name + ".meta", content);
    };
    add("1.effect", "{ \"uuid\": ");
    add("2.effect", "[]");
    add("3.effect", "{}");
    add("4.effect", "{\n  \"uuid\": \"nonsense\"\n}");
    add("5.effect", "{ \"uuid\": 5 }");
    add("6.effect", meta(kUuidA, R"(,"subMetas":{"x":{"uuid":"7acaaaaa-1111-4222-8333-444455556666@x"}})"));
    add("7.effect", std::string(300, '[') + std::string(300, ']'));
    add("8.effect", meta(kUuidB));
    Problems problems;
    const MetaIndex index = indexOf({folder.path()}, problems);
    EXPECT_FALSE(problems.hasErrors());
    ASSERT_EQ(problems.all().size(), 7u) << textOf(problems);
    for (const Problem& problem : problems.all()) {
        EXPECT_EQ(problem.severity, Severity::Warning);
        EXPECT_GT(problem.where.line, 0) << problem.message;
    }
    EXPECT_EQ(problems.all()[3].where.line, 2);
    EXPECT_EQ(problems.all()[3].message, "'nonsense' is no uuid");
    EXPECT_TRUE(contains(problems.all()[5].message, "of a part of this asset"));
    EXPECT_EQ(index.size(), 2u);
    EXPECT_TRUE(index.find(kUuidB));
}

TEST(CocosMeta, ManyBrokenMetasAreCountedNotListed) {
    const TempFolder folder;
    for (int i = 0; i < 50; ++i) {
        folder.write(std::to_string(i) + ".png", "");
        folder.write(std::to_string(i) + ".png.meta", "{}");
    }
    Problems problems;
    indexOf({folder.path()}, problems);
    ASSERT_EQ(problems.all().size(), 21u);
    EXPECT_EQ(problems.all().back().message, "30 more problems with metas are not shown");
}

TEST(CocosMeta, LinksThatGoInCirclesAreEnteredOnce) {
    const TempFolder folder;
    folder.write("assets/a/x.effect", "");
    folder.write("assets/a/x.effect.meta", meta(kUuidA));
    fs::create_directory_symlink(folder.path() / "assets", folder.path() / "assets/a/loop");
    fs::create_directory_symlink(folder.path() / "assets/a", folder.path() / "assets/again");
    folder.write("other/y.effect", "");
    folder.write("other/y.effect.meta", meta(kUuidB));
    fs::create_directory_symlink(folder.path() / "other", folder.path() / "assets/linked");
    Problems problems;
    const MetaIndex index = indexOf({folder.path() / "assets"}, problems);
    EXPECT_EQ(textOf(problems), "");
    EXPECT_EQ(index.fileCount(), 2u);
    EXPECT_TRUE(index.find(kUuidA));
    EXPECT_TRUE(index.find(kUuidB));
}

TEST(CocosMeta, WalksAreBounded) {
    const TempFolder folder;
    std::string deep = "d";
    for (int i = 0; i < 10; ++i) deep += "/d";
    folder.write(deep + "/x.effect", "");
    folder.write(deep + "/x.effect.meta", meta(kUuidA));
    for (int i = 0; i < 20; ++i) folder.write("many/" + std::to_string(i), "");
    Problems problems;
    const fs::path roots[] = {folder.path()};
    EXPECT_TRUE(findMetaFiles(roots, problems, {.maxDepth = 5}).empty());
    EXPECT_TRUE(contains(textOf(problems), "folders deeper than 5 levels are not searched"));
    Problems counted;
    findMetaFiles(roots, counted, {.maxEntries = 10});
    EXPECT_TRUE(contains(textOf(counted), "stops here, after 10 files")) << textOf(counted);
    Problems none;
    EXPECT_EQ(findMetaFiles(roots, none).size(), 1u);
    EXPECT_EQ(textOf(none), "");
}

TEST(CocosMeta, TenThousandMetasAreRead) {
    const TempFolder folder;
    char uuid[37];
    for (int i = 0; i < 10'000; ++i) {
        std::snprintf(uuid, sizeof uuid, "%08x-0000-4000-8000-000000000000", static_cast<unsigned>(i));
        const std::string name = std::to_string(i % 100) + "/" + std::to_string(i) + ".png";
        folder.write(name, "");
        folder.write(
            name + ".meta",
            meta(uuid, R"(,"files":[".json",".png"],"subMetas":{"6c48a":{"importer":"texture","uuid":")" +
                           std::string(uuid) +
                           R"(@6c48a","displayName":"p","id":"6c48a","name":"texture","userData":{"wrapModeS":)"
                           R"("repeat","wrapModeT":"repeat","minfilter":"linear","magfilter":"linear",)"
                           R"("mipfilter":"none","anisotropy":1},"ver":"1.0.21","files":[".json"]}},)"
                           R"("userData":{"type":"texture","redirect":"x"})"));
    }
    Problems problems;
    const MetaIndex index = indexOf({folder.path()}, problems);
    EXPECT_EQ(index.size(), 20'000u);
    EXPECT_EQ(textOf(problems), "");
}

}  // namespace
}  // namespace crevice::cocos
