// What the benchmark renders: the scene, and one pipeline per case with the processor time of each of its stages.
#pragma once

#include <string>
#include <vector>

#include "app/Renderer.h"

namespace crevice::bench {

struct BenchView {
    std::uint32_t width = 1280, height = 720;
    std::string scene{};  ///< Path; empty = the atrium, or the default scene where the atrium is not installed.
};

/// A pipeline as it is asked for on the command line.
struct CaseDesc {
    std::string name, help;
    std::string pipeline;
    std::map<std::string, std::string> options{};
    std::vector<StageSet> sets{};
};

/// Everything on; the same without shadows and FXAA; the article's form; the G-buffer without linear depth.
std::vector<CaseDesc> benchCases();

struct StageCost {
    std::string stage;
    double ms = 0;
};

/// One case, ready to render again and again.
class BenchCase {
public:
    BenchCase(const CaseDesc& desc, const BenchView& view);

    /// Renders a frame; keeps the least time seen of each stage and of the frame.
    void run(const std::vector<std::string>& keep = {});

    const CaseDesc& desc() const { return desc_; }
    const Image& picture() const { return picture_; }
    Image target(const std::string& name) const { return renderer_->target(name); }
    Renderer& renderer() { return *renderer_; }
    Camera camera() const { return renderer_->cameraFor(view_); }

    const std::vector<StageCost>& stages() const { return stages_; }
    double stageMs(const std::string& stage) const;
    /// The frame at its quickest, read-back of the picture not included.
    double frameMs() const { return frameMs_; }

private:
    CaseDesc desc_;
    std::unique_ptr<Renderer> renderer_;
    View view_;
    Image picture_;
    std::vector<StageCost> stages_;
    double frameMs_ = 0;
    bool warm_ = false;
};

/// Path of the scene to use; says on stderr when it is not the atrium.
std::string benchScene(const BenchView& view, const Log& log);

}  // namespace crevice::bench
