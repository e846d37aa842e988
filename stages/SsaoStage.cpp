// Ambient occlusion from the G-buffer: one full-screen draw into cc_ssaoMap, in the form of its effect.
#include "CocosTargets.h"
#include "SsaoKernel.h"
#include "flow/RenderStage.h"

namespace crevice {
namespace {

struct SsaoBlock {         // Mirrors `CCSsao` in effects/chunks/ssao-constant.chunk.
    glm::vec4 nearFar{0};  ///< near, far, 1/far, 1/near
    glm::vec4 samples[kSsaoMaxSamples]{};
};
static_assert(sizeof(SsaoBlock) == 1040);

enum Bake { kBakeAuto, kBakeOn, kBakeOff };
constexpr const char* kBakeNames[] = {"auto", "on", "off"};
constexpr const char* kKernelNames[] = {"article", "stratified", "crytek", "learnopengl", "songjihu"};
/// Pixels x samples of a run from which constants in the shader repay their compile: half a frame at 1280x720.
constexpr std::uint64_t kBakeFrom = 30'000'000;

class SsaoStage final : public RenderStage {
public:
    void params(ParamVisitor& v) override {
        v.field("seed", seed_, {.help = "Kernel seed. The same seed renders the same picture."});
        v.field("samples", samples_,
                {.min = 1, .max = kSsaoMaxSamples, .help = "Kernel size; the radius ladder is made for it."});
        v.choice("kernel", kernel_, kKernelNames,
                 {.help = "Directions and lengths: the Cocos article's, cosine-weighted, or another technique's."});
        v.field("rayPoints", rayPoints_,
                {.min = 0, .max = 16, .help = "Samples on each cosine-weighted ray; 0 = the kernel's own points."});
        v.choice("bake", bake_, kBakeNames,
                 {.help = "Kernel as shader constants: the same picture, faster over many pixels."});
    }
    void declare(StageIo& io) override {
        io.color("cc_ssaoMap");
        // An effect that also packs its values for a denoiser has a second output; the document names its target.
        if (io.documentWrites().size() > 1) io.color(io.documentWrites()[1]);
        block_ = io.block<SsaoBlock>("CCSsao");
        draw_ = io.fullscreen(isCocos(io.profile()) ? "pipeline/ssao-effect" : "ssao");
        bindGbuffer(io, draw_);
        const std::uint32_t perRay = rayPoints_ < samples_ ? rayPoints_ : samples_;
        const auto kernel = makeSsaoSamples(kindFor(io.profile()), seed_, perRay, {data_.samples, samples_});
        const bool baked = bake_ == kBakeOn || (bake_ == kBakeAuto && io.run().pixels() * kernel.size() >= kBakeFrom);
        io.define(draw_, "SSAO_SAMPLES", std::to_string(kernel.size()));
        if (perRay > 0) io.define(draw_, "RAY_POINTS", std::to_string(perRay));
        io.define(draw_, "SSAO_BAKED", baked ? "1" : "0");
        io.chunk("ssao-kernel", ssaoKernelChunk(kernel));
    }
    void render(FrameContext& frame) override {
        const Camera& camera = frame.camera();
        data_.nearFar = {camera.near, camera.far, 1.0f / camera.far, 1.0f / camera.near};
        frame.upload(block_, data_);
        frame.draw(draw_);
    }

private:
    /// A Cocos project's stage has the article's kernel unless the document says otherwise.
    SsaoKernelKind kindFor(Profile profile) const {
        if (isCocos(profile) && kernel_ == static_cast<int>(SsaoKernelKind::Stratified)) return SsaoKernelKind::Article;
        return static_cast<SsaoKernelKind>(kernel_);
    }

    std::uint32_t seed_ = 1;
    std::uint32_t samples_ = kSsaoMaxSamples;
    std::uint32_t rayPoints_ = 0;
    int kernel_ = static_cast<int>(SsaoKernelKind::Stratified);
    int bake_ = kBakeAuto;
    SsaoBlock data_;
    BlockId block_;
    DrawId draw_;
};

}  // namespace

void registerSsaoStage(StageRegistry& registry) {
    registry.add<SsaoStage>("SsaoStage", {.priority = 12, .help = "Screen-space ambient occlusion into cc_ssaoMap."});
}

}  // namespace crevice
