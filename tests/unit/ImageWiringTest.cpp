// Names in a shader and the targets that feed them, where the order of writes decides.
#include "flow/Wiring.h"

#include <gtest/gtest.h>

#include "EffectTestTools.h"

namespace crevice {
namespace {

/// The target of each storage image of a compute effect, for a stage that writes `a` and `b`.
std::map<std::string, std::string> wired(const std::string& images) {
    EffectBench bench;
    bench.effect(
        "CCEffect %{\n  techniques:\n  - passes:\n    - compute: cs\n}%\nCCProgram cs %{\n"
        "  layout(local_size_x = 1) in;\n" +
        images + "}%\n");
    const EffectVariant& variant = bench.get();
    PipelineDesc pipeline;
    std::vector<TargetWrite> writes;
    for (const char* target : {"a", "b"}) {
        pipeline.targets.emplace_back().name = target;
        writes.emplace_back().target = target;
        writes.back().kind = WriteKind::Storage;
    }
    const StageDesc stage;
    const Material material(variant);
    Problems problems;
    std::map<std::string, std::string> result;
    for (const Wire& wire : wireShader({pipeline, stage, variant, material, writes}, problems))
        result[wire.name] = wire.target;
    EXPECT_FALSE(problems.hasErrors());
    return result;
}

using Wires = std::map<std::string, std::string>;

TEST(ImageWiring, ImagesWithoutATargetsNameTakeTheWritesInOrder) {
    EXPECT_EQ(wired("  layout(rgba8) uniform writeonly image2D one;\n  layout(rgba8) uniform writeonly image2D two;\n"
                    "  void main() { imageStore(one, ivec2(0), vec4(0)); imageStore(two, ivec2(0), vec4(0)); }\n"),
              (Wires{{"one", "a"}, {"two", "b"}}));
}

TEST(ImageWiring, AnImageOfATargetsNameLeavesTheOthersTheRest) {
    for (const char* images :
         {"  layout(rgba8) uniform writeonly image2D a;\n  layout(rgba8) uniform writeonly image2D x;\n",
          "  layout(rgba8) uniform writeonly image2D x;\n  layout(rgba8) uniform writeonly image2D a;\n"}) {
        EXPECT_EQ(wired(std::string(images) +
                        "  void main() { imageStore(a, ivec2(0), vec4(0)); imageStore(x, ivec2(0), vec4(0)); }\n"),
                  (Wires{{"a", "a"}, {"x", "b"}}));
    }
}

}  // namespace
}  // namespace crevice
