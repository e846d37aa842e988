// Who feeds a sampler of set 1: "reads", then the target of its name, then a texture property; and what cannot be.
#include "flow/Wiring.h"

#include <gmock/gmock.h>

#include "FrameTools.h"

namespace crevice {
namespace {

using testing::HasSubstr;

class Wiring : public testing::Test {
protected:
    /// A document with targets a, b and out, all written before the stage under test.
    static std::string document(const std::string& stage) {
        return R"({ "name": "t", "output": "out", "targets": { "out": { "format": "RGBA8" }, "a": { "format": "RGBA8" },
          "b": { "format": "RGBA8", "mips": 3 }, "image": { "format": "RGBA8" } },
          "flows": [ { "flow": "F", "stages": [
            { "stage": "FullscreenStage", "name": "FillA", "effect": "white", "writes": ["a"] },
            { "stage": "FullscreenStage", "name": "FillB", "effect": "white", "writes": ["b"] },
            { "stage": "FullscreenStage", "name": "FillB1", "effect": "white", "writes": ["b@1"] },
            { "stage": "FullscreenStage", "name": "FillB2", "effect": "white", "writes": ["b@2"] }, )" +
               stage + " ] } ] }";
    }
    void SetUp() override { bench_.fragment("white", "", "result = vec4(1.0);"); }
    /// The one wire of stage S.
    Wire wire(const std::string& stage) {
        program_ = bench_.parse(document(stage));
        program_->prepare(nullptr);
        const std::vector<Wire>& wires = stageOf(*program_, "S").draws[0].wires;
        EXPECT_EQ(wires.size(), 1u);
        return wires.at(0);
    }
    Problem problem(const std::string& stage) {
        const std::vector<Problem> problems = bench_.problemsOf(document(stage));
        for (const Problem& p : problems)
            if (p.severity == Severity::Error) return p;
        ADD_FAILURE() << "no error";
        return {};
    }
    ProgramBench bench_;
    std::unique_ptr<FrameProgram> program_;
};

TEST_F(Wiring, ASamplerNamedLikeATargetIsWiredToIt) {
    bench_.fragment("show", "uniform sampler2D a;", "result = texture(a, v_uv);");
    const Wire found = wire(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show", "writes": ["out"] })");
    EXPECT_EQ(found.target, "a");
    EXPECT_EQ(found.slot.set, 1u);
    EXPECT_FALSE(found.oneMip);
    EXPECT_EQ(readsOf(*program_, "S"), std::vector<std::string>{"a"});
}

TEST_F(Wiring, ReadsWinOverTheNameAndNameALevel) {
    bench_.fragment("show", "uniform sampler2D a;", "result = texture(a, v_uv);");
    const Wire found = wire(
        R"({ "stage": "FullscreenStage", "name": "S", "effect": "show", "reads": { "a": "b@2" }, "writes": ["out"] })");
    EXPECT_EQ(found.target, "b");
    EXPECT_EQ(found.mip, 2u);
    EXPECT_TRUE(found.oneMip);
    EXPECT_EQ(splitTarget("b@2"), (std::pair<std::string, int>("b", 2)));
    EXPECT_EQ(splitTarget("b"), (std::pair<std::string, int>("b", -1)));
}

TEST_F(Wiring, APropertyGivesATextureByKeyword) {
    bench_.fragment("show", "uniform sampler2D pattern;", "result = texture(pattern, v_uv);",
                    "      properties:\n        pattern: { value: black }\n");
    const Wire found = wire(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show", "writes": ["out"] })");
    EXPECT_TRUE(found.target.empty());
    EXPECT_EQ(found.texture, "black");
    EXPECT_TRUE(readsOf(*program_, "S").empty());
}

TEST_F(Wiring, AnUnusedSamplerHoldsWhite) {
    bench_.fragment("show", "uniform sampler2D nobody;", "result = vec4(1.0);");
    EXPECT_EQ(wire(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show", "writes": ["out"] })").texture,
              "white");
}

TEST_F(Wiring, ASamplerBoundToNothingIsAnErrorInTheEffect) {
    bench_.fragment("show", "uniform sampler2D nobody;", "result = texture(nobody, v_uv);");
    const Problem found =
        problem(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show", "writes": ["out"] })");
    EXPECT_THAT(found.message, HasSubstr("'nobody' in effect 'show' is bound to nothing in stage 'S'"));
    EXPECT_THAT(found.where.file, HasSubstr("show.effect"));
    EXPECT_THAT(found.help, HasSubstr("\"reads\": { \"nobody\": \"TARGET\" }"));
    ASSERT_EQ(found.remarks.size(), 1u);
    EXPECT_EQ(found.remarks[0].where.file, "test.json");
}

TEST_F(Wiring, AReadOfASamplerThatIsNotThereNamesTheNearest) {
    bench_.fragment("show", "uniform sampler2D inputMap;", "result = texture(inputMap, v_uv);");
    const Problem found = problem(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show",
        "reads": { "inputMap": "a", "inputMop": "b" }, "writes": ["out"] })");
    EXPECT_THAT(found.message, HasSubstr("of stage 'S' names 'inputMop', and effect 'show' has no such sampler"));
    EXPECT_THAT(found.help, HasSubstr("did you mean 'inputMap'"));
}

TEST_F(Wiring, AReadOfATargetThatIsNotThereIsAnError) {
    bench_.fragment("show", "uniform sampler2D inputMap;", "result = texture(inputMap, v_uv);");
    const Problem found = problem(R"({ "stage": "FullscreenStage", "name": "S", "effect": "show",
        "reads": { "inputMap": "aa" }, "writes": ["out"] })");
    EXPECT_THAT(found.message, HasSubstr("'aa'"));
    EXPECT_THAT(found.help, HasSubstr("did you mean 'a'"));
}

class WiringCompute : public Wiring {
protected:
    void compute(const std::string& declarations, const std::string& body) const {
        bench_.folder.write("effects/fill.effect",
                            "CCEffect %{\n  techniques:\n  - passes:\n    - compute: fill-cs\n}%\n"
                            "CCProgram fill-cs %{\n  layout(local_size_x = 8, local_size_y = 8) in;\n" +
                                declarations + "\n  void main() { " + body + " }\n}%\n");
    }
};

TEST_F(WiringCompute, AnImageTakesTheTargetOfItsNameElseTheWritesInOrder) {
    compute("layout(rgba8) uniform writeonly image2D image;", "imageStore(image, ivec2(0), vec4(1.0));");
    const char* byName = R"({ "stage": "ComputeStage", "name": "S", "effect": "fill", "writes": ["image"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "image" }, "writes": ["out"] })";
    Wire found = wire(byName);
    EXPECT_TRUE(found.storage);
    EXPECT_EQ(found.target, "image");

    ProgramBench fresh;
    fresh.fragment("white", "", "result = vec4(1.0);");
    fresh.folder.write("effects/fill.effect",
                       "CCEffect %{\n  techniques:\n  - passes:\n    - compute: fill-cs\n}%\nCCProgram fill-cs %{\n"
                       "  layout(local_size_x = 8, local_size_y = 8) in;\n"
                       "  layout(rgba8) uniform writeonly image2D target;\n"
                       "  void main() { imageStore(target, ivec2(0), vec4(1.0)); }\n}%\n");
    auto program = fresh.parse(document(
        R"({ "stage": "ComputeStage", "name": "S", "effect": "fill", "writes": ["b@1"] },
           { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "b" }, "writes": ["out"] })"));
    program->prepare(nullptr);
    found = stageOf(*program, "S").draws[0].wires.at(0);
    EXPECT_EQ(found.target, "b");
    EXPECT_EQ(found.mip, 1u);
    EXPECT_TRUE(readsOf(*program, "S").empty());  // what is only written is no read
}

TEST_F(WiringCompute, AnImageThatIsReadIsARead) {
    compute("layout(rgba8) uniform writeonly image2D image;\n  layout(rgba8) uniform readonly image2D a;",
            "imageStore(image, ivec2(0), imageLoad(a, ivec2(0)));");
    program_ = bench_.parse(document(R"({ "stage": "ComputeStage", "name": "S", "effect": "fill", "writes": ["image"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "image" }, "writes": ["out"] })"));
    program_->prepare(nullptr);
    EXPECT_EQ(readsOf(*program_, "S"), std::vector<std::string>{"a"});
}

TEST_F(WiringCompute, AnImageMoreThanTheWritesIsBoundToNothing) {
    compute("layout(rgba8) uniform writeonly image2D one;\n  layout(rgba8) uniform writeonly image2D two;",
            "imageStore(one, ivec2(0), vec4(1.0)); imageStore(two, ivec2(0), vec4(1.0));");
    const Problem found = problem(R"({ "stage": "ComputeStage", "name": "S", "effect": "fill", "writes": ["image"] },
        { "stage": "FullscreenStage", "name": "Show", "effect": "copy", "reads": { "inputMap": "image" }, "writes": ["out"] })");
    EXPECT_THAT(found.message, HasSubstr("'two' in effect 'fill' is bound to nothing in stage 'S'"));
}

}  // namespace
}  // namespace crevice
