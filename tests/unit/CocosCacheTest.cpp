// What a request came to is found on disk without a text being made, until a file that it may read changes.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>

#include "EffectTestTools.h"
#include "cocos/CocosEffects.h"
#include "cocos/files/Fingerprint.h"

namespace crevice::cocos {
namespace {

constexpr const char* kEffect = R"(CCEffect %{
  techniques:
  - passes: [ { vert: vs:vert, frag: fs:frag }, { vert: vs:vert, frag: fs:frag, phase: second } ]
}%
CCProgram vs %{
  #include <place>
  vec4 vert () { return place(); }
}%
CCProgram fs %{
  #include <place>
  #pragma builtin(global)
  layout(set = 0, binding = 3) uniform sampler2D map;
  vec4 frag () { return place() * texture(map, vec2(0.0)); }
}%
)";

class CocosCache : public testing::Test {
protected:
    CocosCache() {
        keepCompilerWarm();
        if (const char* home = std::getenv("XDG_CACHE_HOME")) before_ = home;
        setenv("XDG_CACHE_HOME", cache_.path().c_str(), 1);
        project_.write("assets/e.effect", kEffect);
        writePlace("1.0");
    }
    ~CocosCache() override {
        if (before_.empty())
            unsetenv("XDG_CACHE_HOME");
        else
            setenv("XDG_CACHE_HOME", before_.c_str(), 1);
    }

    void writePlace(const std::string& value) {
        project_.write("assets/place.chunk", "vec4 place() { return vec4(" + value + "); }\n");
        // Old enough that its time alone tells it apart.
        std::filesystem::last_write_time(project_.path() / "assets/place.chunk",
                                         std::filesystem::file_time_type::clock::now() - std::chrono::hours(++hours_));
    }
    Roots roots() const {
        Roots roots;
        roots.project = project_.path();
        return roots;
    }
    /// A fresh library's counters after both passes, and how many notes it wrote.
    EffectLibrary::Counters ask(bool check = false, int* notes = nullptr) {
        const Log log(LogLevel::Note, [&](LogLevel, std::string_view) {
            if (notes != nullptr) ++*notes;
        });
        EffectLibrary library(AssetRoots({}), log);
        library.addFrontEnd(std::make_unique<CocosEffects>(roots()));
        for (const std::size_t pass : {0u, 1u}) {
            const EffectVariant& variant = library.get(
                {.effect = "e", .technique = 0, .pass = pass, .defines = {}, .where = {}, .checkOnly = check},
                {{"map", {0, 4}}});
            EXPECT_EQ(variant.info.find("map")->slot, (BindingSlot{0, 4}));
            EXPECT_TRUE(variant.info.find("map")->active);
            EXPECT_FALSE(variant.vertex.empty());
        }
        return library.counters();
    }

    EffectFolder cache_, project_;
    int hours_ = 0;
    std::string before_;
};

TEST_F(CocosCache, RequestsAreAnsweredWithTheNotesTheyGave) {
    int first = 0, second = 0;
    EXPECT_EQ(ask(false, &first).fromDisk, 1u) << "both passes are one text";
    const auto counters = ask(false, &second);
    EXPECT_EQ(counters.compiled, 0u);
    EXPECT_EQ(counters.fromDisk, 2u);
    EXPECT_GT(first, 0) << "'map' was bound by name";
    EXPECT_EQ(first, second);
}

TEST_F(CocosCache, NotesAreSaidOnceByALibrary) {
    std::vector<std::string> notes;
    const Log log(LogLevel::Note, [&](LogLevel, std::string_view message) { notes.emplace_back(message); });
    EffectLibrary library(AssetRoots({}), log, {.useDiskCache = false});
    library.addFrontEnd(std::make_unique<CocosEffects>(roots()));
    VariantRequest request;
    request.effect = "e";
    library.get(request, {{"map", {0, 4}}});
    ASSERT_EQ(notes.size(), 1u) << "'map' was bound by name";
    library.setRoots(library.roots());  // as a pipeline does that loads for another scene
    request.pass = 1;
    library.get(request, {{"map", {0, 4}}});
    EXPECT_EQ(notes.size(), 1u);
    library.get(request, {{"map", {0, 5}}});
    EXPECT_EQ(notes.size(), 2u) << "that is another note";
}

TEST_F(CocosCache, WhatIsSaidWhenStagesAreJoinedIsSaidEachTime) {
    project_.write("assets/narrow.effect",
                   "CCEffect %{\n  techniques:\n  - passes: [ { vert: vs:vert, frag: fs:frag } ]\n}%\n"
                   "CCProgram vs %{\n  out vec4 v_p;\n  vec4 vert () { v_p = vec4(1.0); return v_p; }\n}%\n"
                   "CCProgram fs %{\n  in vec3 v_p;\n  vec4 frag () { return vec4(v_p, 1.0); }\n}%\n");
    // How often a fresh library says so, and what it counted.
    const auto said = [&](EffectLibrary::Counters& counters) {
        int notes = 0;
        const Log log(LogLevel::Note, [&](LogLevel, std::string_view message) {
            if (message.find("'v_p' is a vec3") != std::string_view::npos) ++notes;
        });
        EffectLibrary library(AssetRoots({}), log);
        library.addFrontEnd(std::make_unique<CocosEffects>(roots()));
        VariantRequest request;
        request.effect = "narrow";
        library.get(request, {});
        counters = library.counters();
        return notes;
    };
    EffectLibrary::Counters counters;
    EXPECT_EQ(said(counters), 1);
    EXPECT_EQ(counters.compiled, 1u);
    EXPECT_EQ(said(counters), 1) << "answered by request";
    EXPECT_EQ(counters.fromDisk, 1u);
    writePlace("2.0");  // which this effect does not include
    EXPECT_EQ(said(counters), 1) << "answered by content";
    EXPECT_EQ(counters.fromDisk, 1u);
    EXPECT_EQ(said(counters), 1) << "answered by request again";
    EXPECT_EQ(counters.compiled, 0u);
}

TEST_F(CocosCache, AChangedChunkIsSeen) {
    ask();
    writePlace("2.0");
    EXPECT_EQ(ask().compiled, 1u);
    writePlace("1.0");
    EXPECT_EQ(ask().compiled, 0u) << "the text is the first one again";
}

TEST_F(CocosCache, WhatWasNotValidatedIsCompiledToBeValidated) {
    ask(false);
    EXPECT_EQ(ask(true).compiled, 1u);
    EXPECT_EQ(ask(true).compiled, 0u);
    EXPECT_EQ(ask(false).compiled, 0u);
}

TEST_F(CocosCache, FingerprintsTellFilesApart) {
    const std::string first = fingerprintOf(roots());
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(fingerprintOf(roots()), first);
    project_.write("assets/unrelated.txt", "x");
    EXPECT_EQ(fingerprintOf(roots()), first);
    project_.write("assets/deep/other.chunk", "a");
    const std::string second = fingerprintOf(roots());
    EXPECT_NE(second, first);
    project_.write("assets/deep/other.chunk", "b");  // the same size, maybe the same time
    EXPECT_NE(fingerprintOf(roots()), second);
}

}  // namespace
}  // namespace crevice::cocos
