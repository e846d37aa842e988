// Switches and repetition: what is off costs nothing, and the same request makes the same picture, always.
#include <cstdlib>

#include "FrameFixture.h"
#include "stages/Builtin.h"

namespace crevice {
namespace {

class PipelineSwitch : public FrameTest {
protected:
    Image renderWith(const std::string& pipeline, const Options& options, const View& view) {
        load(pipeline, options);
        return renderer_->render(view);
    }
};

TEST_F(PipelineSwitch, OcclusionOffIsTheParentByteForByte) {
    for (const char* scene : {"crease", "default"}) {
        renderer_->setScene(shippedScene(scene));
        const View view = sized(160, 90);
        const Image parent = renderWith("deferred", {}, view);
        for (const char* form : {"default", "article"}) {
            EXPECT_EQ(renderWith("ssao-deferred", {{"ssao", "false"}, {"form", form}}, view), parent)
                << scene << ' ' << form;
        }
        EXPECT_NE(renderWith("ssao-deferred", {}, view), parent) << scene;
    }
}

TEST_F(PipelineSwitch, ThereAndBackInSizeIsIdentical) {
    renderer_->setScene(shippedScene("crease"));
    load("ssao-deferred");
    const Image first = renderer_->render(sized(640, 360));
    const LiveObjects live = renderer_->device().liveObjects();
    const std::size_t pipelines = renderer_->pipeline().pipelinesMade();
    EXPECT_GT(pipelines, 8u);
    const Image other = renderer_->render(sized(333, 777));
    EXPECT_EQ(other.width, 333u);
    EXPECT_EQ(other.height, 777u);
    EXPECT_EQ(renderer_->render(sized(640, 360)), first);
    EXPECT_EQ(renderer_->device().liveObjects().counts, live.counts);
    EXPECT_EQ(renderer_->pipeline().pipelinesMade(), pipelines);
}

TEST_F(PipelineSwitch, AFrameOfTheSameSizeMakesNothing) {
    renderer_->setScene(shippedScene("crease"));
    load("ssao-deferred");
    const View view = sized(96, 54);
    Image third;
    LiveObjects live;
    for (int frame = 1; frame <= 100; ++frame) {
        const Image image = renderer_->render(view);
        if (frame == 3) {
            third = image;
            live = renderer_->device().liveObjects();
        }
        if (frame == 100) {
            EXPECT_EQ(image, third);
            EXPECT_EQ(renderer_->device().liveObjects(), live) << renderer_->device().liveObjects().text();
        }
    }
}

TEST_F(PipelineSwitch, TwoCamerasInTurnEqualFreshRenderers) {
    const Scene scene = shippedScene("crease");
    View a = sized(640, 360);
    View b = sized(320, 200);
    b.camera = Camera::lookAt({-3, 1, 2}, {0, 0.5f, -1});
    std::vector<Image> alone;
    for (const View* view : {&a, &b}) {
        const auto fresh = makeRenderer();
        fresh->setScene(scene);
        load(*fresh, "ssao-deferred");
        alone.push_back(fresh->render(*view));
        expectSilence(*fresh);
    }
    renderer_->setScene(scene);
    load("ssao-deferred");
    const std::vector<View> views{a, b, a, b};
    const std::vector<Image> images = renderer_->render(views);
    for (std::size_t i = 0; i < images.size(); ++i) EXPECT_EQ(images[i], alone[i % 2]) << i;
}

TEST_F(PipelineSwitch, FiftyRoundsOfPipelinesLeaveNothingOver) {
    renderer_.reset();
    const Scene scene = shippedScene("crease");
    const Log log(LogLevel::Warning, [this](LogLevel, std::string_view text) { messages_.emplace_back(text); });
    Device device({.log = log, .validate = true, .syncValidation = true});
    EffectLibrary effects(AssetRoots::standard(), log);
    StageRegistry registry;
    registerBuiltinStages(registry);
    FrameView view;
    view.extent = {16, 9};
    view.camera = scene.cameras.front();
    fitNearFar(view.camera, scene.bounds());
    view.projection = view.camera.projection(16.0f / 9.0f);
    const char* names[] = {"deferred", "forward", "ao-only", "ssao-deferred"};
    for (std::size_t round = 0; round < 50; ++round) {
        {
            PipelineDesc desc =
                loadPipeline(AssetRoots::standard(), {.nameOrPath = names[round % 4], .options = {}, .sets = {}});
            RenderPipeline pipeline(device, effects, registry, log, std::move(desc), {.width = 1, .height = 1});
            pipeline.prepare(scene);
            pipeline.render(view);
            EXPECT_EQ(pipeline.output().width, 16u);
        }
        ASSERT_EQ(device.liveObjects(), LiveObjects{}) << device.liveObjects().text();
    }
    EXPECT_EQ(device.validationMessageCount(), 0u);
}

TEST_F(PipelineSwitch, ProcessesAndThreadCountsMakeTheSameBytes) {
    std::vector<std::vector<std::byte>> files;
    for (const char* environment : {"", "LP_NUM_THREADS=0 ", "LP_NUM_THREADS=1 "}) {
        const std::filesystem::path out = folder_ / "out.png";
        const std::string command = std::string(environment) + CREVICE_PROGRAM +
                                    " render crease -p ssao-deferred --size 160x90 -o " + out.string();
        ASSERT_EQ(std::system((command + " > /dev/null 2>&1").c_str()), 0) << command;
        files.push_back(readBytes(out));
        std::filesystem::remove(out);
    }
    EXPECT_FALSE(files[0].empty());
    EXPECT_EQ(files[1], files[0]);
    EXPECT_EQ(files[2], files[0]);
}

}  // namespace
}  // namespace crevice
