// A recorded frame is the planned one: barriers, kept targets, times; and the validation layer sees what is not.
#include <chrono>
#include <map>
#include <optional>

#include "FrameFixture.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

using testing::HasSubstr;

class PipelineFrame : public FrameTest {
protected:
    /// Sun, lamp, fog and a blended pane, so that no stage stands idle.
    Scene busyScene() {
        Scene scene = shippedScene("crease");
        SceneMaterial glass;
        glass.alphaMode = AlphaMode::Blend;
        glass.baseColor.a = 0.5f;
        scene.materials.push_back(glass);
        addWall(scene, 1, {0, 1, 0.5f}, static_cast<int>(scene.materials.size()) - 1);
        scene.lights.push_back(spotLight({0, 4, 2}, {0, 0, -1}, 20, 0.3f, 0.6f));
        scene.lights.back().castsShadow = true;
        return scene;
    }
    void expectPlannedBarriers(const std::string& what) {
        const FramePlan& plan = renderer_->pipeline().program().plan();
        std::vector<RecordedBarrier> planned;
        const auto add = [&](const Transition& t) {
            planned.push_back({t.target, static_cast<TextureState>(t.from), static_cast<TextureState>(t.to)});
        };
        for (const PlannedStage& stage : plan.stages)
            for (const Transition& transition : stage.before) add(transition);
        for (const Transition& transition : plan.atEnd) add(transition);
        EXPECT_EQ(renderer_->pipeline().recordedBarriers(), planned) << what;
        EXPECT_FALSE(planned.empty()) << what;
    }
};

TEST_F(PipelineFrame, RecordsExactlyThePlannedBarriers) {
    const std::pair<const char*, Options> cases[] = {
        {"deferred", {}},
        {"deferred", {{"fxaa", "false"}, {"shadows", "false"}}},
        {"forward", {}},
        {"forward", {{"shadows", "false"}}},
        {"ssao-deferred", {}},
        {"ssao-deferred", {{"form", "article"}}},
        {"ssao-deferred", {{"ssao", "false"}}},
        {"ao-only", {{"view", "raw"}}},
        {"ao-only", {{"view", "depth"}}},
        {"ao-only", {{"view", "normal"}}},
    };
    renderer_->setScene(busyScene());
    View view = sized(32, 18);
    for (const auto& [pipeline, options] : cases) {
        load(pipeline, options);
        for (const bool keeping : {false, true, false}) {  // reading a target back leaves the next frame alone
            view.keep.clear();
            if (keeping) view.keep = {"depth"};
            renderer_->render(view);
            expectPlannedBarriers(pipeline);
        }
    }
}

TEST_F(PipelineFrame, EveryTargetCanBeKept) {
    renderer_->setScene(busyScene());
    for (const char* ssao : {"true", "false"}) {
        load("ssao-deferred", {{"ssao", ssao}});
        View view = sized(48, 27);
        const Image alone = renderer_->render(view);
        const FrameProgram& program = renderer_->pipeline().program();
        for (const TargetDesc& target : program.desc().targets) view.keep.push_back(target.name);
        std::map<std::string, Image> first;
        EXPECT_EQ(renderer_->render(view), alone) << ssao;
        for (const std::string& name : view.keep) first[name] = renderer_->target(name);
        EXPECT_EQ(renderer_->render(view), alone) << ssao;
        for (const std::string& name : view.keep) EXPECT_EQ(renderer_->target(name), first[name]) << ssao << name;

        for (const TargetDesc& target : program.desc().targets) {
            EXPECT_EQ(first[target.name].format, target.format) << target.name;
            EXPECT_EQ(first[target.name].width, target.size ? target.size->x : 48u) << target.name;
        }
        EXPECT_EQ(first["finalColor"], renderer_->target("finalColor"));
        // What nobody writes holds its clear value.
        const bool on = std::string(ssao) == "true";
        float lowest = 1;
        for (std::uint32_t y = 0; y < 27; ++y)
            for (std::uint32_t x = 0; x < 48; ++x) lowest = std::min(lowest, first["cc_ssaoMap"].at(x, y).x);
        EXPECT_EQ(lowest < 1, on);
    }
    // One that was kept once and is not asked for again must not answer with old contents.
    renderer_->render(sized(48, 27));
    EXPECT_THROW(renderer_->target("depth"), Error);
    View view = sized(48, 27);
    view.keep = {"cc_ssaoMop"};
    try {
        renderer_->render(view);
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.problems().front().message, "pipeline 'ssao-deferred' has no target 'cc_ssaoMop'");
        EXPECT_THAT(error.problems().front().help, HasSubstr("cc_ssaoMap"));
    }
    // An error of that kind leaves the pipeline as it was.
    view.keep = {"depth"};
    renderer_->render(view);
    EXPECT_EQ(renderer_->target("depth").width, 48u);
}

TEST_F(PipelineFrame, StageTimesAreThoseOfTheStages) {
    writeFragment("cheap", "", "result = vec4(v_uv, 0.0, 1.0);");
    writeFragment(
        "costly", "",
        "float sum = v_uv.x;\n for (int i = 0; i < 1000; ++i) sum = sin(sum + v_uv.y);\n result = vec4(sum);");
    renderer_->setScene(busyScene());
    const char* orders[][2] = {{"costly", "cheap"}, {"cheap", "costly"}};
    for (const auto& [first, second] : orders) {
        const auto stage = [](const std::string& effect, const std::string& target) {
            return R"({ "stage": "FullscreenStage", "name": ")" + effect + R"(", "effect": ")" + effect +
                   R"(", "writes": [")" + target + "\"] }";
        };
        const std::string blend = R"({ "stage": "FullscreenStage", "name": "Blend", "effect": "both",
                                       "reads": { "a": "a", "b": "b" }, "writes": ["out"] })";
        writeFragment("both", "uniform sampler2D a;\n  uniform sampler2D b;",
                      "result = texture(a, v_uv) + texture(b, v_uv);");
        loadDocument(R"({ "name": "t", "output": "out", "targets": { "a": { "format": "RGBA8" },
                          "b": { "like": "a" }, "out": { "like": "a" } }, "flows": [ { "flow": "Main", "stages": [)" +
                     stage(first, "a") + "," + stage(second, "b") + "," + blend + "] } ] }");
        std::map<std::string, double> least;
        for (int frame = 0; frame < 3; ++frame) {
            const auto start = std::chrono::steady_clock::now();
            renderer_->render(sized(128, 128));
            const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
            EXPECT_LE(renderer_->pipeline().frameMilliseconds(), wall.count()) << "the unit is the millisecond";
            const std::vector<StageTime> times = renderer_->pipeline().stageTimes();
            ASSERT_EQ(times.size(), 4u);
            EXPECT_EQ(times[0].stage, first);
            EXPECT_EQ(times[0].flow, "Main");
            EXPECT_EQ(times[1].stage, second);
            EXPECT_EQ(times[2].stage, "Blend");
            EXPECT_EQ(times[3].stage, "readback");
            for (const StageTime& time : times) {
                const auto [entry, isNew] = least.emplace(time.stage, time.milliseconds);
                entry->second = std::min(entry->second, time.milliseconds);
            }
        }
        // 16 million sines against 16 thousand texels; the least of three frames, as the machine may be busy.
        EXPECT_GT(least["costly"], 10 * least["cheap"]) << first << " first";
        EXPECT_GT(least["costly"], 10 * least["Blend"]) << first << " first";
    }
}

/// Draws as planned, then once more with a texture of its own that is still being an attachment: a missing transition.
class HazardStage final : public RenderStage {
public:
    void declare(StageIo& io) override {
        for (const std::string& target : io.documentWrites()) io.color(target);
        draw_ = io.fullscreen("copy");
    }
    void render(FrameContext& frame) override {
        Commands& commands = frame.commands();
        frame.draw(draw_);
        if (!own_) own_.emplace(commands.device());
        commands.endRendering();
        commands.barrier(own_->texture, TextureState::Undefined, TextureState::Color);
        commands.beginRendering({.colors = {{.texture = &own_->output}}, .depth = {}});
        frame.draw(draw_);
        commands.bindSet(1, own_->set);  // says Sampled; the texture is in Color
        commands.draw(3);
    }

private:
    struct Own {
        explicit Own(Device& device)
            : texture(device, {.usage = TextureUsage::Color | TextureUsage::Sampled, .name = "neverTransitioned"}),
              output(device, {.usage = TextureUsage::Color, .name = "elsewhere"}),
              layout(device, {{.binding = 0, .type = DescriptorType::CombinedImageSampler}}, "hazard"),
              pool(device),
              samplers(device),
              set(pool.allocate(layout, "hazard")) {
            set.writeTexture(0, texture, samplers.get({}));
            set.update();
            Commands commands(device);
            commands.begin();
            commands.barrier(output, TextureState::Undefined, TextureState::Color);
            commands.submitAndWait();
        }
        GpuTexture texture, output;
        SetLayout layout;
        DescriptorPool pool;
        SamplerCache samplers;
        DescriptorSet set;
    };
    DrawId draw_;
    std::optional<Own> own_;
};

TEST_F(PipelineFrame, TheValidationLayerSeesAHazardInsideAFrame) {
    renderer_->stages().add<HazardStage>("HazardStage", {.priority = {}, .help = "A planted mistake."});
    writeFragment("white", "", "result = vec4(1.0);");
    const auto document = [](const char* stage) {
        return std::string(R"({ "name": "hazard", "output": "out",
          "targets": { "a": { "format": "RGBA8" }, "out": { "format": "RGBA8" } },
          "flows": [ { "flow": "F", "stages": [
            { "stage": "FullscreenStage", "name": "Fill", "effect": "white", "writes": ["a"] },
            { "stage": ")") +
               stage +
               R"(", "name": "Copy", "effect": "copy", "reads": { "inputMap": "a" }, "writes": ["out"] } ] } ] })";
    };
    Scene scene = darkScene();
    addWall(scene, 1);
    renderer_->setScene(scene);
    loadDocument(document("FullscreenStage"));
    renderer_->render(sized(1, 1));
    EXPECT_EQ(renderer_->device().validationMessageCount(), 0u);

    loadDocument(document("HazardStage"));
    renderer_->render(sized(1, 1));
    EXPECT_GE(renderer_->device().validationMessageCount(), 1u);
    ASSERT_FALSE(messages_.empty());
    EXPECT_THAT(messages_.front(), HasSubstr("neverTransitioned"));
    EXPECT_THAT(messages_.front(), HasSubstr("F / Copy"));  // the label of the stage that did it
    messages_.clear();
    renderer_.reset();
    EXPECT_TRUE(messages_.empty());  // and the stage's own objects went with it
}

TEST_F(PipelineFrame, ThePlannerRefusesTheHazardThatADocumentCanWrite) {
    writeFragment("white", "", "result = vec4(1.0);");
    Scene scene = darkScene();
    addWall(scene, 1);
    renderer_->setScene(scene);
    try {
        // The same copy, of what it is itself drawing into.
        loadDocument(R"({ "name": "hazard", "output": "out", "targets": { "out": { "format": "RGBA8" } },
          "flows": [ { "flow": "F", "stages": [
            { "stage": "FullscreenStage", "name": "Fill", "effect": "white", "writes": ["out"] },
            { "stage": "FullscreenStage", "name": "Copy", "effect": "copy", "reads": { "inputMap": "out" },
              "writes": ["out"] } ] } ] })");
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.problems().front().message, "'Copy' reads and writes 'out'");
    }
}

}  // namespace
}  // namespace crevice
