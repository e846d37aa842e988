// The library: variants in memory, SPIR-V on disk, generated chunks, and questions about things that are not there.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

const char* const kFragment =
    "in vec2 v_uv;\nlayout(location = 0) out vec4 color;\nuniform sampler2D map;\nvoid main() { color = texture(map, "
    "v_uv);\n#if BRIGHT\n"
    "color += 1.0;\n#endif\n}\n";

TEST(EffectLibrary, VariantsAreMadeOnce) {
    EffectBench bench;
    bench.fullscreen(kFragment);
    const EffectVariant& first = bench.get();
    EXPECT_EQ(&bench.get(), &first);
    EXPECT_EQ(&bench.get({{"BRIGHT", "0"}}), &first);  // The same text by another request.
    const EffectVariant& bright = bench.get({{"BRIGHT", "1"}});
    EXPECT_NE(&bright, &first);
    EXPECT_NE(bright.id, first.id);
    BindingMap other = contractBindings();
    other["cc_unrelated"] = {0, 20};
    EXPECT_EQ(&bench.get({}, other), &first);  // Numbers of names that the shader does not have.
    other["map"] = {0, 21};
    EXPECT_EQ(bench.get({}, other).info.find("map")->slot, (BindingSlot{0, 21}));
    EXPECT_EQ(bench.effects.counters().compiled, 3u);
    EXPECT_EQ(bench.effects.counters().fromMemory, 3u);
    EXPECT_EQ(bench.effects.counters().fromDisk, 0u);
}

TEST(EffectLibrary, GeneratedChunks) {
    EffectBench bench;
    bench.chunk("value", "const float kValue = 1.0;\n");
    bench.fullscreen("#include <value>\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(kValue); }\n");
    const auto fromFile = bench.get().fragment;
    bench.effects.setChunk("value", "const float kValue = 2.0;\n");
    const auto generated = bench.get().fragment;
    EXPECT_NE(fromFile, generated);
    bench.effects.setChunk("value", "const float kValue = 2.0;\n");
    bench.get();
    EXPECT_EQ(bench.effects.counters().compiled, 2u);
    EXPECT_EQ(bench.effects.counters().fromMemory, 1u);
    bench.effects.setChunk("value", "const float kValue = ;\n");
    EXPECT_EQ(bench.problem().where.file, "<generated value>");
}

TEST(EffectLibrary, TextIsWhatTheCompilerGets) {
    EffectBench bench;
    bench.fullscreen(kFragment);
    VariantRequest request;
    request.effect = "e";
    request.defines = {{"BRIGHT", "1"}};
    const std::string text = bench.effects.text(request, kFragmentBit);
    EXPECT_TRUE(text.starts_with("#version 450\n#define BRIGHT 1\n")) << text;
    EXPECT_NE(text.find("texture(map, v_uv)"), std::string::npos);
    EXPECT_EQ(bench.effects.text(request, kComputeBit), "");
}

TEST(EffectLibrary, UnknownEffectTechniqueAndPass) {
    EffectBench bench;
    bench.fullscreen(kFragment);
    bench.folder.write("effects/post/bloom.effect", "CCEffect %{ }%");
    const auto messageOf = [&](const char* effect, std::size_t technique, std::size_t pass) {
        VariantRequest request;
        request.effect = effect;
        request.technique = technique;
        request.pass = pass;
        request.where = {"ask.json", 4, 2, 1};
        try {
            bench.effects.get(request, {});
        } catch (const Error& error) {
            const Problem& problem = error.problems().front();
            return problem.where.file + ": " + problem.message + "; " + problem.help;
        }
        return std::string();
    };
    EXPECT_EQ(messageOf("post/blom", 0, 0).substr(0, 62),
              "ask.json: no effect 'post/blom'; did you mean 'post/bloom'? ef");
    EXPECT_EQ(messageOf("e", 1, 0), "ask.json: effect 'e' has no technique 1; it has 1, counted from 0");
    EXPECT_EQ(messageOf("e", 0, 2), "ask.json: technique 0 of effect 'e' has no pass 2; it has 1, counted from 0");
    EXPECT_NE(messageOf("../e", 0, 0).find("no effect '../e'"), std::string::npos);
    EXPECT_NE(messageOf("post/bloom", 0, 0), "");
}

TEST(EffectLibrary, EffectsByPath) {
    EffectBench bench;
    bench.fullscreen(kFragment);
    EffectFolder outside;
    std::filesystem::copy(bench.file(), outside.path() / "o.effect");
    EXPECT_EQ(bench.effects.asset((outside.path() / "o.effect").string()).name, "o");
    // A document may only name files inside the asset folders.
    bench.folder.write("effects/doc.json", "{}");
    const SourceLoc document{(bench.folder.path() / "effects/doc.json").string(), 1, 1, 1};
    EXPECT_EQ(bench.effects.asset("e.effect", document).name, "e");
    EXPECT_THROW(bench.effects.asset((outside.path() / "./o.effect").string(), document), Error);
}

TEST(EffectLibrary, OtherRootsGiveOtherEffectsOfTheSameName) {
    EffectBench bench;
    bench.fullscreen(kFragment);
    const EffectVariant& first = bench.get();
    EffectFolder other;
    std::filesystem::create_directories(other.path() / "effects");
    // The same programs: only the header differs.
    std::string text = readText(bench.file());
    text.replace(text.find("frag:"), 0, "blendState: { targets: [ { blend: true } ] }\n      ");
    other.write("effects/e.effect", text);
    AssetRoots roots = bench.effects.roots();
    roots.prepend(other.path());
    bench.effects.setRoots(roots);
    const EffectVariant& second = bench.get();
    EXPECT_NE(first.id, second.id);
    EXPECT_TRUE(first.pass->state.blendTargets.empty() || !first.pass->state.blendTargets[0].blend);
    ASSERT_FALSE(second.pass->state.blendTargets.empty());
    EXPECT_TRUE(second.pass->state.blendTargets[0].blend);
}

TEST(EffectLibrary, PropertyThatFeedsNothing) {
    EffectBench bench;
    bench.fullscreen(kFragment, "      properties: { brightnes: { value: 1 }, map: { value: white } }\n");
    const Problem problem = bench.problem();
    EXPECT_EQ(problem.message, "property 'brightnes' of effect 'e' feeds no uniform: no program mentions 'brightnes'");
    EXPECT_EQ(problem.where.line, 6);
}

class EffectDiskCache : public testing::Test {
protected:
    EffectDiskCache() {
        keepCompilerWarm();
        if (const char* home = std::getenv("XDG_CACHE_HOME")) before_ = home;
        setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
        bench_.fullscreen(kFragment);
    }
    ~EffectDiskCache() override {
        if (before_.empty())
            unsetenv("XDG_CACHE_HOME");
        else
            setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }
    /// A fresh library's counters after one request, and its words.
    EffectLibrary::Counters ask(std::vector<std::uint32_t>* words = nullptr, const Defines& defines = {}) {
        EffectLibrary library(AssetRoots({bench_.folder.path()}), Log(LogLevel::Error));
        VariantRequest request;
        request.effect = "e";
        request.defines = defines;
        const EffectVariant& variant = library.get(request, contractBindings());
        if (words != nullptr) *words = variant.fragment;
        EXPECT_NE(variant.info.find("map"), nullptr);
        EXPECT_TRUE(variant.info.find("map")->active);
        return library.counters();
    }
    std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(cache_.path()))
            if (entry.is_regular_file()) found.push_back(entry.path());
        return found;
    }

    EffectFolder cache_;
    EffectBench bench_;
    std::string before_;
};

TEST_F(EffectDiskCache, SecondLibraryCompilesNothing) {
    std::vector<std::uint32_t> compiled, loaded;
    EXPECT_EQ(ask(&compiled).compiled, 1u);
    ASSERT_EQ(files().size(), 1u);
    const auto counters = ask(&loaded);
    EXPECT_EQ(counters.compiled, 0u);
    EXPECT_EQ(counters.fromDisk, 1u);
    EXPECT_EQ(compiled, loaded);
}

TEST_F(EffectDiskCache, OtherTextOtherEntry) {
    ask();
    EXPECT_EQ(ask(nullptr, {{"BRIGHT", "1"}}).compiled, 1u);
    bench_.fullscreen(std::string(kFragment) + "float unused() { return 3.0; }\n");
    EXPECT_EQ(ask().compiled, 1u);
    EXPECT_EQ(files().size(), 3u);
}

TEST_F(EffectDiskCache, DamagedFilesAreIgnoredAndRewritten) {
    std::vector<std::uint32_t> good, again;
    ask(&good);
    const auto file = files().at(0);
    const std::string whole = readText(file);
    std::string flipped = whole;
    flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
    for (const std::string& damaged :
         {std::string(), std::string("CREVICE"), whole.substr(0, whole.size() - 5), flipped, whole + "x"}) {
        std::ofstream(file, std::ios::binary | std::ios::trunc) << damaged;
        EXPECT_EQ(ask(&again).compiled, 1u);
        EXPECT_EQ(again, good);
        EXPECT_EQ(readText(file), whole);
    }
}

TEST_F(EffectDiskCache, NoPlaceToWriteIsNoError) {
    std::ofstream(cache_.path() / "crevice") << "a file where the folder should be";
    EXPECT_EQ(ask().compiled, 1u);
    EXPECT_EQ(ask().compiled, 1u);
}

TEST_F(EffectDiskCache, ReadOnlyFolderIsNoError) {
    ask();
    const auto folder = files().at(0).parent_path();
    std::filesystem::permissions(folder, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_EQ(ask(nullptr, {{"BRIGHT", "1"}}).compiled, 1u);
    EXPECT_EQ(ask().fromDisk, 1u);
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace crevice
