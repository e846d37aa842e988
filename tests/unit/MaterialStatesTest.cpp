// States that a material or a document sets over those of a pass.
#include "flow/MaterialStates.h"

#include <gtest/gtest.h>

#include "core/Document.h"

namespace crevice {
namespace {

RenderState read(const std::string& json) {
    Problems problems;
    const RenderState state = withStates({}, parseJson(json, "states.json"), problems);
    EXPECT_TRUE(problems.all().empty());
    return state;
}

TEST(MaterialStates, AStencilKeyWithoutASideIsForBoth) {
    const RenderState state = read(
        R"({ "depthStencilState": { "stencilTest": true, "stencilFunc": "equal", "stencilRef": 5, "stencilRefBack": 3 } })");
    for (const StencilFace& face : {state.stencilFront, state.stencilBack}) {
        EXPECT_TRUE(face.test);
        EXPECT_EQ(face.func, CompareOp::Equal);
    }
    EXPECT_EQ(state.stencilFront.ref, 5u);
    EXPECT_EQ(state.stencilBack.ref, 3u);
}

TEST(MaterialStates, AMaskKeepsItsFourBits) {
    const RenderState state = read(R"({ "blendState": { "targets": [ { "blendColorMask": 22 } ] } })");
    ASSERT_EQ(state.blendTargets.size(), 1u);
    EXPECT_EQ(state.blendTargets[0].colorMask, 6);
}

}  // namespace
}  // namespace crevice
