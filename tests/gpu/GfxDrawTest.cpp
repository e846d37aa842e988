// Drawing and computing with shaders compiled on the spot: bindings, blending, depth, instances, storage, time.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>

#include "GfxFixture.h"
#include "effect/ShaderCompiler.h"

namespace crevice {
namespace {

constexpr std::uint32_t kAllStages = kVertexBit | kFragmentBit | kComputeBit;

StageSource source(ShaderStageBits stage, const std::string& text) {
    StageSource result;
    result.stage = stage;
    result.head = "#version 450\n";
    result.text = text;
    result.flat.text = text;
    result.flat.files = {"test"};
    const auto lineCount = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    for (std::size_t line = 0; line <= lineCount; ++line) {
        result.flat.lines.push_back({0, static_cast<int>(line) + 1});
    }
    return result;
}

/// A full-screen triangle, as chunk fullscreen-vs draws it.
const char* const kFullscreen = R"(
void main() {
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.5, 1.0);
}
)";

class GfxDrawTest : public GfxTest {
protected:
    void SetUp() override {
        GfxTest::SetUp();
        layouts_ = std::make_unique<PipelineLayoutCache>(*device_);
        pipelines_ = std::make_unique<PipelineCache>(*device_);
        pool_ = std::make_unique<DescriptorPool>(*device_, 2);
    }
    void TearDown() override {
        pool_.reset();
        pipelines_.reset();
        layouts_.reset();
        GfxTest::TearDown();
    }

    std::vector<std::vector<std::uint32_t>> compile(const std::vector<StageSource>& stages,
                                                    const BindingMap& bindings) {
        Problems problems;
        std::vector<std::vector<std::uint32_t>> words;
        for (StageCode& code : compiler_.compile(stages, bindings, problems)) words.push_back(std::move(code.words));
        problems.throwIfErrors();
        return words;
    }

    /// State of a full-screen pass: no culling, no depth.
    static RenderState fullscreenState() {
        RenderState state;
        state.cullMode = CullMode::None;
        state.depthTest = state.depthWrite = false;
        return state;
    }

    GpuTexture makeTarget(Format format, const std::string& name, std::uint32_t width = 8, std::uint32_t height = 4) {
        return GpuTexture(*device_,
                          {.format = format,
                           .width = width,
                           .height = height,
                           .usage = TextureUsage::Color | TextureUsage::Sampled | TextureUsage::TransferSource,
                           .name = name});
    }

    ShaderCompiler compiler_;
    std::unique_ptr<PipelineLayoutCache> layouts_;
    std::unique_ptr<PipelineCache> pipelines_;
    std::unique_ptr<DescriptorPool> pool_;
};

TEST_F(GfxDrawTest, DynamicBlocksTexturesAndPushConstantsReachTheShader) {
    const auto code = compile({source(kVertexBit, kFullscreen), source(kFragmentBit, R"(
        layout(push_constant) uniform Push { float scale; };
        uniform Tint { vec4 tint; };
        uniform sampler2D picture;
        layout(location = 0) out vec4 color;
        void main() { color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0) * tint * scale; }
    )")},
                              {{"Tint", {0, 0}}, {"picture", {0, 1}}});
    const SetLayout setLayout(*device_, {{1, DescriptorType::CombinedImageSampler, 1, kFragmentBit},
                                         {0, DescriptorType::UniformBufferDynamic, 1, kFragmentBit}});
    EXPECT_EQ(setLayout.bindings().front().binding, 0u) << "sorted";
    EXPECT_EQ(setLayout.dynamicCount(), 1u);
    const SetLayout* const sets[] = {&setLayout};
    const PipelineLayout& layout = layouts_->get(sets, {.stages = kFragmentBit, .size = 4});

    const Image image = pattern(8, 4, Format::RGBA32F);
    const GpuTexture picture = makeTexture(*device_, image, false, "picture");
    Buffer blocks(*device_, {.size = 512, .usage = BufferUsage::Uniform, .name = "blocks"});
    const glm::vec4 tints[] = {{1, 1, 1, 1}, {2, 0, 1, 4}};
    for (std::size_t i = 0; i < 2; ++i) blocks.write(std::as_bytes(std::span(&tints[i], 1)), i * 256);
    SamplerCache samplers(*device_);
    DescriptorSet set = pool_->allocate(setLayout, "set");
    EXPECT_FALSE(set.isComplete());
    set.writeUniformBuffer(0, blocks, 0, 16);
    set.writeTexture(1, picture, samplers.get({}));
    EXPECT_TRUE(set.hasPendingWrites());
    set.update();
    EXPECT_TRUE(set.isComplete());

    const Pipeline& pipeline = pipelines_->get(GraphicsPipelineDesc{.vertex = code[0],
                                                                    .fragment = code[1],
                                                                    .state = fullscreenState(),
                                                                    .vertexBindings = {},
                                                                    .vertexAttributes = {},
                                                                    .colorFormats = {Format::RGBA32F},
                                                                    .depthFormat = {},
                                                                    .layout = &layout,
                                                                    .name = "tint"});
    const GpuTexture target = makeTarget(Format::RGBA32F, "target");
    for (std::uint32_t slice = 0; slice < 2; ++slice) {
        Commands commands(*device_);
        commands.begin();
        commands.barrier(target, TextureState::Undefined, TextureState::Color);
        commands.beginRendering({.colors = {{.texture = &target}}});
        commands.bindPipeline(pipeline);
        const std::uint32_t offset = slice * 256;
        commands.bindSet(0, set, {&offset, 1});
        const float scale = 0.5f;
        commands.pushConstants(std::as_bytes(std::span(&scale, 1)));
        commands.draw(3);
        commands.endRendering();
        commands.submitAndWait();
        const Image result = readTexture(*device_, target, TextureState::Color);
        for (std::uint32_t x = 0; x < 8; ++x) EXPECT_EQ(result.at(x, 3), image.at(x, 3) * tints[slice] * 0.5f);
    }
}

TEST_F(GfxDrawTest, BlendingLoadsAndScissorLimits) {
    const auto code = compile({source(kVertexBit, kFullscreen), source(kFragmentBit, R"(
        layout(location = 0) out vec4 color;
        void main() { color = vec4(0.25, 0.5, 1.0, 0.5); }
    )")},
                              {});
    RenderState state = fullscreenState();
    state.blendTargets = {{.blend = true, .src = BlendFactor::SrcAlpha, .dst = BlendFactor::OneMinusSrcAlpha}};
    const Pipeline& pipeline = pipelines_->get(GraphicsPipelineDesc{.vertex = code[0],
                                                                    .fragment = code[1],
                                                                    .state = state,
                                                                    .vertexBindings = {},
                                                                    .vertexAttributes = {},
                                                                    .colorFormats = {Format::RGBA32F},
                                                                    .depthFormat = {},
                                                                    .layout = &layouts_->get({}),
                                                                    .name = "blend"});
    const GpuTexture target = makeTarget(Format::RGBA32F, "target");
    Commands commands(*device_);
    commands.begin();
    commands.barrier(target, TextureState::Undefined, TextureState::Color);
    commands.beginRendering({.colors = {{.texture = &target, .load = LoadOp::Clear, .clear = {1, 1, 0, 1}}}});
    commands.endRendering();
    commands.barrier(target, TextureState::Color, TextureState::Color);
    commands.beginRendering({.colors = {{.texture = &target, .load = LoadOp::Load}}});
    commands.setScissor(0, 0, 4, 4);
    commands.bindPipeline(pipeline);
    commands.draw(3);
    commands.endRendering();
    commands.submitAndWait();
    const Image result = readTexture(*device_, target, TextureState::Color);
    EXPECT_EQ(result.at(3, 0), glm::vec4(0.625f, 0.75f, 0.5f, 0.5f));
    EXPECT_EQ(result.at(4, 0), glm::vec4(1, 1, 0, 1)) << "outside the scissor";
}

TEST_F(GfxDrawTest, InstancesTakeTheirAttributesAndDepthDecides) {
    const auto code = compile({source(kVertexBit, R"(
        layout(location = 0) in vec2 a_corner;
        layout(location = 1) in vec4 a_instance;  // color, depth
        layout(location = 0) out vec3 v_color;
        void main() { gl_Position = vec4(a_corner, a_instance.w, 1.0); v_color = a_instance.xyz; }
    )"),
                               source(kFragmentBit, R"(
        layout(location = 0) in vec3 v_color;
        layout(location = 0) out vec4 color;
        void main() { color = vec4(v_color, 1.0); }
    )")},
                              {});
    // Counter-clockwise as seen on screen, v down: bottom left, bottom right, top left; doubled to cover the target.
    const glm::vec2 corners[] = {{-1, 1}, {3, 1}, {-1, -3}};
    const glm::vec4 instances[] = {{9, 9, 9, 0}, {1, 0, 0, 0.25f}, {0, 1, 0, 0.75f}};  // the first is skipped
    const std::uint16_t indices[] = {9, 0, 1, 2};
    const Buffer vertices(*device_, {.size = sizeof corners, .usage = BufferUsage::Vertex},
                          std::as_bytes(std::span(corners)));
    const Buffer perInstance(*device_, {.size = sizeof instances, .usage = BufferUsage::Vertex},
                             std::as_bytes(std::span(instances)));
    const Buffer indexBuffer(*device_, {.size = sizeof indices, .usage = BufferUsage::Index},
                             std::as_bytes(std::span(indices)));
    GraphicsPipelineDesc desc;  // member by member: gcc 12 takes `state` of an initialiser list for uninitialized
    desc.vertex = code[0];
    desc.fragment = code[1];
    desc.vertexBindings = {{0, sizeof(glm::vec2), false}, {1, sizeof(glm::vec4), true}};
    desc.vertexAttributes = {{0, 0, VertexFormat::Float2, 0}, {1, 1, VertexFormat::Float4, 0}};
    desc.colorFormats = {Format::RGBA8};
    desc.depthFormat = Format::D32F;
    desc.layout = &layouts_->get({});
    desc.name = "instances";
    const GpuTexture target = makeTarget(Format::RGBA8, "target");
    const GpuTexture depth(*device_, {.format = Format::D32F,
                                      .width = 8,
                                      .height = 4,
                                      .usage = TextureUsage::Depth | TextureUsage::TransferSource,
                                      .name = "depth"});
    const auto render = [&](const Pipeline& pipeline) {
        Commands commands(*device_);
        commands.begin();
        commands.barrier(target, TextureState::Undefined, TextureState::Color);
        commands.barrier(depth, TextureState::Undefined, TextureState::Depth);
        commands.beginRendering({.colors = {{.texture = &target}}, .depth = {.texture = &depth}});
        commands.bindPipeline(pipeline);
        commands.bindVertexBuffer(0, vertices);
        commands.bindVertexBuffer(1, perInstance);
        commands.bindIndexBuffer(indexBuffer, 0, true);
        commands.drawIndexed(3, 2, 1, 0, 1);
        commands.endRendering();
        commands.submitAndWait();
        return readTexture(*device_, target, TextureState::Color).at(5, 2);
    };
    EXPECT_EQ(render(pipelines_->get(desc)), glm::vec4(1, 0, 0, 1)) << "the nearer, though drawn first";
    EXPECT_EQ(readTexture(*device_, depth, TextureState::Depth).at(5, 2).x, 0.25f);
    desc.state.depthFunc = CompareOp::Always;
    EXPECT_EQ(render(pipelines_->get(desc)), glm::vec4(0, 1, 0, 1)) << "the later";
    desc.state.frontFaceCcw = false;
    EXPECT_EQ(render(pipelines_->get(desc)), glm::vec4(0)) << "culled: front faces are counter-clockwise on screen";
    EXPECT_EQ(pipelines_->createdCount(), 3u);
    pipelines_->get(desc);
    EXPECT_EQ(pipelines_->createdCount(), 3u) << "an equal description is the same pipeline";
}

TEST_F(GfxDrawTest, ComputeWritesImageAndBufferAndTimeAdvances) {
    const auto code = compile({source(kComputeBit, R"(
        layout(local_size_x = 4, local_size_y = 4) in;
        layout(r32f) uniform image2D result;
        layout(std430) buffer Sum { uint sum; };
        void main() {
            ivec2 at = ivec2(gl_GlobalInvocationID.xy);
            imageStore(result, at, vec4(float(at.x + 100 * at.y)));
            atomicAdd(sum, 1u);
        }
    )")},
                              {{"result", {0, 3}}, {"Sum", {0, 5}}});
    const SetLayout setLayout(*device_, {{3, DescriptorType::StorageImage, 1, kAllStages},
                                         {5, DescriptorType::StorageBuffer, 1, kAllStages}});
    const SetLayout* const sets[] = {&setLayout};
    const PipelineLayout& layout = layouts_->get(sets);
    const GpuTexture result(*device_,
                            {.format = Format::R32F,
                             .width = 8,
                             .height = 8,
                             .mips = 2,
                             .usage = TextureUsage::Storage | TextureUsage::Sampled | TextureUsage::TransferSource,
                             .name = "result"});
    const std::uint32_t zero = 0;
    const Buffer sum(*device_, {.size = 4, .usage = BufferUsage::Storage, .access = BufferAccess::HostRead},
                     std::as_bytes(std::span(&zero, 1)));
    const Pipeline& pipeline = pipelines_->get({.compute = code[0], .layout = &layout, .name = "count"});
    DescriptorSet set = pool_->allocate(setLayout);
    set.writeStorageImage(3, result, 1);
    set.writeStorageBuffer(5, sum);
    set.update();

    const Timestamps times(*device_, 2);
    Commands commands(*device_);
    commands.begin();
    commands.resetTimestamps(times);
    commands.writeTimestamp(times, 0);
    commands.barrier(result, TextureState::Undefined, TextureState::StorageWrite);
    commands.bindPipeline(pipeline);
    commands.bindSet(0, set);
    commands.dispatch(1);
    commands.memoryBarrier();
    commands.writeTimestamp(times, 1);
    commands.submitAndWait();

    EXPECT_EQ(readTexture(*device_, result, TextureState::StorageWrite, 1).at(3, 2).x, 203.0f) << "mip 1 was bound";
    std::uint32_t counted = 0;
    std::memcpy(&counted, sum.data().data(), 4);
    EXPECT_EQ(counted, 16u);
    ASSERT_TRUE(times.isSupported());
    const std::vector<double> nanoseconds = times.read(2);
    EXPECT_EQ(nanoseconds[0], 0.0);
    EXPECT_GT(nanoseconds[1], 0.0);
    EXPECT_LT(nanoseconds[1], 60e9);
}

TEST_F(GfxDrawTest, PoolGrowsAndSetsGiveThemselvesBack) {
    const SetLayout layout(*device_, {{0, DescriptorType::CombinedImageSampler, 20, kFragmentBit}});
    std::vector<DescriptorSet> sets;
    for (int i = 0; i < 5; ++i) sets.push_back(pool_->allocate(layout));
    EXPECT_EQ(device_->liveObjects()[ObjectKind::DescriptorPool], 3) << "two sets a pool";
    EXPECT_EQ(device_->liveObjects()[ObjectKind::DescriptorSet], 5);
    sets.clear();
    for (int i = 0; i < 6; ++i) sets.push_back(pool_->allocate(layout));
    EXPECT_EQ(device_->liveObjects()[ObjectKind::DescriptorPool], 3) << "the room was used again";
}

TEST_F(GfxDrawTest, EqualLayoutContentsAreOnePipelineLayout) {
    const SetLayout a(*device_, {{0, DescriptorType::UniformBuffer, 1, kAllStages}});
    const SetLayout b(*device_, {{0, DescriptorType::UniformBuffer, 1, kAllStages}});
    const SetLayout c(*device_, {{0, DescriptorType::StorageBuffer, 1, kAllStages}});
    const SetLayout* const setsA[] = {&a};
    const SetLayout* const setsB[] = {&b};
    const SetLayout* const setsC[] = {&c};
    EXPECT_EQ(&layouts_->get(setsA), &layouts_->get(setsB));
    EXPECT_NE(&layouts_->get(setsA), &layouts_->get(setsC));
    EXPECT_NE(&layouts_->get(setsA), &layouts_->get(setsA, {.stages = kVertexBit, .size = 16}));
    EXPECT_EQ(layouts_->size(), 3u);
}

}  // namespace
}  // namespace crevice
