// Renders occlusion maps and takes the processor's time for them.
#pragma once

#include <vector>

#include "app/Renderer.h"
#include "app/bench/AoCases.h"
#include "app/bench/AoViews.h"

namespace crevice {

/// 8-bit openness as lighting samples it, row by row from the top, and the cost of all passes that made it.
struct AoFrame {
    std::vector<float> openness;
    double aoMs = 0;        ///< Process CPU time of every stage but the G-buffer's and the shadow maps'.
    double mainMs = 0;      ///< Of the technique's own pass alone.
    double geometryMs = 0;  ///< Of the G-buffer.
};

/// One scene, one case at a time.
class AoRenderer {
public:
    explicit AoRenderer(RendererOptions options) : renderer_(std::move(options)) {}

    void setScene(Scene scene) { renderer_.setScene(std::move(scene)); }
    const Scene& scene() const { return renderer_.scene(); }
    /// `radius` in world units. Throws Error.
    void choose(const AoCase& wanted, double radius, const glm::uvec2& size);
    AoFrame render(const AoView& view);
    /// Targets as the last render() left them; name them before.
    void keep(std::vector<std::string> targets) { keep_ = std::move(targets); }
    Image target(const std::string& name) const { return renderer_.target(name); }
    Renderer& renderer() { return renderer_; }

private:
    Renderer renderer_;
    glm::uvec2 size_{0};
    std::vector<std::string> keep_;
};

/// The yardstick: the occlusion pass of the Cocos article as written, 64 samples, without its blur.
class AoYardstick {
public:
    AoYardstick(RendererOptions options, const glm::uvec2& size);

    void setScene(Scene scene) { renderer_.setScene(std::move(scene)); }
    /// Process CPU milliseconds of the pass.
    double measure(const AoView& view);

private:
    Renderer renderer_;
    glm::uvec2 size_;
};

/// The first channel as numbers.
std::vector<float> firstChannel(const Image& image, int channel = 0);

}  // namespace crevice
