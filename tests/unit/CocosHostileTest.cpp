// What hostile projects hold: every one of them ends in errors, in bounded time and memory. Bounds are counted, not
// timed.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "CocosFrontTools.h"
#include "SceneTestTools.h"
#include "cocos/assets/Mtl.h"
#include "cocos/assets/Rpp.h"
#include "cocos/files/MetaIndex.h"
#include "cocos/scene/SceneImport.h"

namespace crevice::cocos {
namespace {

namespace fs = std::filesystem;
using test::contains;
using testing::HasSubstr;

std::string textOf(const Problems& problems) {
    std::string text;
    for (const Problem& problem : problems.all()) text += formatProblem(problem) + "\n";
    return text;
}

/// Errors of anything that collects or throws.
template <class Read>
std::string errorsOf(Read read) {
    Problems problems;
    try {
        read(problems);
    } catch (const Error& error) {
        problems.add(error);
    }
    EXPECT_TRUE(problems.hasErrors());
    return textOf(problems);
}

std::string rppErrors(const std::string& text) {
    return errorsOf([&](Problems& problems) { parseRpp(text, "x.rpp", problems); });
}

std::string mtlErrors(const std::string& text) {
    return errorsOf([&](Problems& problems) { parseMtl(text, "x.mtl", problems); });
}

TEST(CocosHostile, ChainsOfReferencesEnd) {
    std::string chain = R"([ { "__type__": "P", "_flows": [ { "__id__": 1 } ] })";
    for (int i = 1; i < 100'000; ++i) chain += ",{\"__id__\":" + std::to_string(i + 1) + "}";
    EXPECT_THAT(rppErrors(chain + ",{\"__type__\":\"F\"}]"), HasSubstr("its '__id__' never ends at an object"));
}

TEST(CocosHostile, ObjectsInsideOfObjectsEnd) {
    std::string deep = R"({ "__type__": "P", "_flows": [)";
    for (int i = 0; i < 5000; ++i) deep += R"({"__type__":"F","_stages":[)";
    EXPECT_THAT(rppErrors(deep), HasSubstr("nests deeper than"));
    EXPECT_THAT(mtlErrors(R"({ "__type__": "cc.Material", "_props": [ { "a": )" + std::string(5000, '[')),
                HasSubstr("nests deeper than"));
}

TEST(CocosHostile, MillionsOfValuesAreRefused) {
    std::string many = R"({ "__type__": "cc.Material", "_props": [ { "a": [0)";
    for (int i = 0; i < 300'000; ++i) many += ",0";
    EXPECT_THAT(mtlErrors(many + "] } ] }"), HasSubstr("more than"));
    EXPECT_THAT(rppErrors(std::string(17u << 20, ' ')), HasSubstr("x.rpp"));
    std::string passes = R"({ "__type__": "cc.Material", "_props": [ {})";
    for (int i = 0; i < 300; ++i) passes += ",{}";
    EXPECT_THAT(mtlErrors(passes + "] }"), HasSubstr("'_props' has 301 passes"));
}

TEST(CocosHostile, HugeNumbersAreErrors) {
    for (const char* number : {"1e400", "-1e999999999"})
        EXPECT_THAT(mtlErrors(std::string(R"({ "__type__": "cc.Material", "_techIdx": )") + number + "}"),
                    HasSubstr("x.mtl:1:"))
            << number;
    for (const char* number : {"1e300", "99999999999999999999", "256", "-1", "0.5"})
        EXPECT_THAT(mtlErrors(std::string(R"({ "__type__": "cc.Material", "_techIdx": )") + number + "}"),
                    HasSubstr("_techIdx"))
            << number;
    EXPECT_THAT(
        mtlErrors(R"({ "__type__": "cc.Material", "_props": [ { "a": { "__type__": "cc.Vec2", "x": 1e300 } } ] })"),
        HasSubstr("'x' of a cc.Vec2 is 1e+300, more than a float holds"));
    for (const char* id : {"18446744073709551616", "1e300", "-9223372036854775809", "2147483648"})
        EXPECT_THAT(rppErrors(std::string(R"([ { "__type__": "P", "_flows": [ { "__id__": )") + id + "} ] } ]"),
                    HasSubstr("but this file has 1"))
            << id;
    EXPECT_THAT(rppErrors(R"({ "__type__": "P", "_flows": [], "_tag": 1e300 })"),
                HasSubstr("'_tag' must be a whole number"));
}

TEST(CocosHostile, BytesThatAreNoTextAreErrors) {
    EXPECT_THAT(mtlErrors("{ \"__type__\": \"cc.Material\", \"_name\": \"a\xff\" }"), HasSubstr("x.mtl:1:"));
    EXPECT_THAT(rppErrors(std::string("[ { \0 } ]", 9)), HasSubstr("x.rpp:1:"));
    EXPECT_THAT(mtlErrors(std::string("\0\0\0\0", 4)), HasSubstr("x.mtl:1:"));
    CocosBench bench;
    bench.fragment(std::string("layout(location = 0) out vec4 color;\nvoid main() { color = \0 vec4(1.0); }\n", 75));
    EXPECT_THAT(bench.compileError(), HasSubstr("the byte 0x00 is no part of GLSL"));
    bench.fragment(
        "layout(location = 0) out vec4 color;\n// \xc0\xae \xe4\xb8\xad\nvoid main() { color = vec4(1.0); }\n");
    EXPECT_EQ(bench.compileError(), "");  // comments may hold what they like
}

TEST(CocosHostile, UuidLoopsEnd) {
    // A material that is its own effect, and a prefab that is an instance of itself.
    const test::TempFolder folder;
    const std::string uuid = "10ff50d1-0000-4000-8000-000000f1736b";
    const auto ref = [&](const std::string& key) { return "\"" + key + R"(": { "__uuid__": ")" + uuid + "\" }"; };
    const std::string inside = R"([ { "__type__": "cc.Prefab", "data": { "__id__": 1 } },
      { "__type__": "cc.Node", "_children": [ { "__id__": 2 }, { "__id__": 2 } ] },
      { "__type__": "cc.Node", "_prefab": { "__type__": "cc.PrefabInfo", )" +
                               ref("asset") + R"(, "instance": { "__type__": "cc.PrefabInstance" } } } ])";
    folder.write("a/p.prefab", inside);
    folder.write("a/p.prefab.meta", R"({ "importer": "prefab", "uuid": ")" + uuid + "\" }");
    Problems problems;
    Project project(
        {.chunks = {}, .project = folder.path() / "a", .engine = {}},
        [](const fs::path&, const std::string&, Problems&) { return EffectAsset{}; }, problems);
    const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
    const ImportedScene scene =
        importScene(folder.path() / "a/p.prefab", project, MaterialForm::Plain, {.log = quiet}, problems);
    EXPECT_TRUE(scene.scene.instances.empty());
    EXPECT_THAT(textOf(problems), HasSubstr("p.prefab' is a part of itself"));
    Mtl mtl;
    mtl.name = "m";
    mtl.effect.uuid = uuid;
    EXPECT_EQ(project.effectFile(mtl, problems), nullptr);
    EXPECT_THAT(textOf(problems), HasSubstr("which is none"));
}

TEST(CocosHostile, AMetaOfManyPartsAndLevelsEnds) {
    const test::TempFolder folder;
    const std::string uuid = "1baf0fc9-befa-459c-8bdd-af1a450a0319";
    std::string parts, nested = uuid;
    for (int i = 0; i < 20'000; ++i) {
        const std::string id = std::to_string(i);
        parts += (i ? ",\"" : "\"") + id + R"(": { "uuid": ")" + uuid + "@" + id + "\" }";
    }
    folder.write("wide.png", "");
    folder.write("wide.png.meta", R"({ "uuid": ")" + uuid + R"(", "subMetas": {)" + parts + "} }");
    std::string deep, ends;
    for (int i = 0; i < 30; ++i) {
        deep += R"({ "uuid": ")" + nested + R"(x", "subMetas": { "x": )";
        nested += "@x";
        ends += " } }";
    }
    folder.write("deep.png", "");
    folder.write("deep.png.meta", deep + "{}" + ends);
    folder.write("cut.png", "");
    folder.write("cut.png.meta", R"({ "uuid": ")");
    Problems problems;
    const fs::path roots[] = {folder.path()};
    const MetaIndex index = MetaIndex::build(roots, problems);
    EXPECT_EQ(index.size(), 20'001u);
    EXPECT_FALSE(problems.hasErrors());
    EXPECT_LE(problems.all().size(), 21u);
}

TEST(CocosHostile, LinksToDevicesAndFoldersAreNoFiles) {
    const test::TempFolder folder;
    fs::create_directories(folder.path() / "p/assets/chunks/folder.chunk");
    fs::create_symlink("/dev/zero", folder.path() / "p/assets/chunks/endless.chunk");
    fs::create_symlink("/dev/zero", folder.path() / "p/assets/endless.mtl");
    folder.write("p/assets/endless.mtl.meta", R"({ "uuid": "1baf0fc9-befa-459c-8bdd-af1a450a0319" })");
    folder.write("p/assets/effects/t.effect",
                 "CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n}%\nCCProgram vs %{ }%\n"
                 "CCProgram fs %{\n#include <endless>\n#include <folder>\n}%\n");
    CocosEffects effects({{}, folder.path() / "p", {}});
    const auto errors = errorsOf([&](Problems& problems) {
        const EffectAsset asset = effects.parse(*effects.find("t"), "t", problems);
        effects.flatten(asset, asset.techniques.at(0).passes.at(0), problems);
    });
    EXPECT_THAT(errors, HasSubstr("no chunk or program 'endless'"));
    EXPECT_THAT(errors, HasSubstr("no chunk or program 'folder'"));
    EXPECT_THAT(errorsOf([&](Problems& problems) { readMtl(folder.path() / "p/assets/endless.mtl", problems); }),
                HasSubstr("endless.mtl"));
}

TEST(CocosHostile, NamesOfNamesOfMacrosAreFollowedOnce) {
    // Each name stands in front of what it names: reading all of them again and again would find one at a time.
    CocosBench bench;
    const auto chain = [](int count) {
        std::string text;
        for (int i = 0; i < count; ++i) text += "#define A" + std::to_string(i) + " A" + std::to_string(i + 1) + "\n";
        return text + "#define A" + std::to_string(count) + " out\nlayout(location = 0) A0 vec4 color;\n" +
               "void main() { color = vec4(1.0); }\n";
    };
    bench.fragment(chain(60'000));
    EXPECT_THAT(bench.problem().message, HasSubstr("nests macros deeper than 64"));
    bench.fragment(chain(30));
    EXPECT_EQ(bench.compileError(), "");
}

TEST(CocosHostile, ConditionsFollowEachMacroOnce) {
    // Followed level by level, twelve names each, these would be 12 to the power of their depth.
    std::string twelve;
    for (int i = 0; i < 6; ++i) twelve += " COUNT OTHER";
    CocosBench bench;
    bench.fragment("#define COUNT" + twelve + "\n#define OTHER" + twelve + " USE_X\n#if COUNT\n#endif\n" +
                   "void main() {}\n");
    EXPECT_EQ(macroNames(bench.fragmentText()), std::vector<std::string>{"USE_X"});
    std::string many = "#define LIST";
    for (int i = 0; i < 20'000; ++i) many += " M" + std::to_string(i);
    many += "\n";
    for (int i = 0; i < 200; ++i) many += "#if LIST\n#endif\n";
    bench.fragment(many + "void main() {}\n");
    EXPECT_THAT(bench.problem().message, HasSubstr("the conditions lead to more than 1000000 macros"));
}

TEST(CocosHostile, ManyPassesAndPropertiesAreReadOnce) {
    std::string header = "  techniques:\n  - passes:\n";
    for (int i = 0; i < 2000; ++i) header += "    - { vert: vs, frag: fs, propertyIndex: 0 }\n";
    CocosBench bench;
    bench.folder.write("p/assets/effects/t.effect", "CCEffect %{\n" + header + "}%\nCCProgram vs %{ }%\n");
    Problems problems;
    const EffectAsset asset = bench.parse(problems);
    EXPECT_FALSE(problems.hasErrors());
    EXPECT_EQ(asset.techniques.at(0).passes.size(), 2000u);
    bench.folder.write("p/assets/effects/t.effect",
                       "CCEffect %{\n  techniques:\n  - passes:\n    - vert: vs\n      frag: fs\n"
                       "      priority: " +
                           std::string(100'000, '(') + "\n}%\n");
    EXPECT_THAT(errorsOf([&](Problems& found) { bench.parse(found); }), HasSubstr("t.effect:"));
}

TEST(CocosHostile, SceneNumbersThatNoFloatHoldsAreErrors) {
    const test::TempFolder folder;
    Problems none;
    Project project(
        {.chunks = {}, .project = folder.path(), .engine = {}},
        [](const fs::path&, const std::string&, Problems&) { return EffectAsset{}; }, none);
    const Log quiet(LogLevel::Error, [](LogLevel, std::string_view) {});
    for (const std::string node : {R"("_lpos": { "__type__": "cc.Vec3", "x": 1e39, "y": 0, "z": 0 })",
                                   R"("_components": [ { "__type__": "cc.Camera", "_far": 1e300 } ])",
                                   R"("_components": [ { "__type__": "cc.SphereLight", "_luminance": 1e200 } ])"}) {
        folder.write("x.scene", R"([ { "__type__": "cc.SceneAsset", "scene": { "__type__": "cc.Scene", "_children": [
            { "__type__": "cc.Node", )" +
                                    node + " } ] } } ]");
        EXPECT_THAT(errorsOf([&](Problems& problems) {
                        importScene(folder.path() / "x.scene", project, MaterialForm::Plain, {.log = quiet}, problems);
                    }),
                    HasSubstr("more than a float holds"))
            << node;
    }
}

}  // namespace
}  // namespace crevice::cocos
