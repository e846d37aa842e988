// Each stage is a submission of its own and the clock is read between them, as in tests/bench.
#include "app/bench/AoRenderer.h"

#include <ctime>

#include <fmt/format.h>

namespace crevice {
namespace {

/// Milliseconds of all threads: other programs disturb them less than wall time.
double processMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

bool isOcclusion(std::string_view stage) {
    return stage != "readback" && stage != "GbufferStage" && stage != "ShadowStage" && stage != "SpotShadowStage";
}

/// Renders; calls `each` with every stage and what it took.
template <class Each>
Image renderTimed(Renderer& renderer, const View& view, Each each) {
    double last = processMilliseconds();
    renderer.pipeline().observeStages([&](std::string_view stage) {
        const double now = processMilliseconds();
        each(stage, now - last);
        last = processMilliseconds();
    });
    Image image = renderer.render(view);
    renderer.pipeline().observeStages({});
    return image;
}

View viewOf(const AoView& view, const glm::uvec2& size) {
    return {.width = size.x, .height = size.y, .camera = view.camera};
}

constexpr std::uint32_t kManyFrames = 100;

}  // namespace

void AoRenderer::choose(const AoCase& wanted, double radius, const glm::uvec2& size) {
    size_ = size;
    PipelineRequest request{aoMapPipeline(renderer_.roots()), wanted.options, wanted.sets};
    request.options["radius"] = fmt::format("{}", radius);
    renderer_.load(std::move(request), {.width = size.x, .height = size.y, .frames = kManyFrames});
}

AoFrame AoRenderer::render(const AoView& view) {
    AoFrame frame;
    View wanted = viewOf(view, size_);
    wanted.keep = keep_;
    const Image map = renderTimed(renderer_, wanted, [&](std::string_view stage, double ms) {
        if (isOcclusion(stage)) frame.aoMs += ms;
        if (stage == "GbufferStage") frame.geometryMs += ms;
        if (stage == "AoMain" || stage == "AoArticle") frame.mainMs += ms;
    });
    frame.openness = firstChannel(map);
    return frame;
}

AoYardstick::AoYardstick(RendererOptions options, const glm::uvec2& size) : renderer_(std::move(options)), size_(size) {
    renderer_.load({.nameOrPath = "ssao-deferred",
                    .options = {{"form", "article"}, {"shadows", "false"}, {"fxaa", "false"}},
                    .sets = {{"cc_gbuffer_positionMap.format", "RGBA32F"}}},
                   {.width = size.x, .height = size.y, .frames = kManyFrames});
}

double AoYardstick::measure(const AoView& view) {
    double pass = 0;
    renderTimed(renderer_, viewOf(view, size_), [&](std::string_view stage, double ms) {
        if (stage == "SsaoStage") pass += ms;
    });
    return pass;
}

std::vector<float> firstChannel(const Image& image, int channel) {
    std::vector<float> values;
    values.reserve(std::size_t(image.width) * image.height);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) values.push_back(image.at(x, y)[channel]);
    }
    return values;
}

}  // namespace crevice
