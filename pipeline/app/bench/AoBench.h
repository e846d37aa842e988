// The occlusion benchmark: every case at every view and radius, against the truth and against the clock.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/bench/AoRenderer.h"
#include "app/bench/AoResults.h"
#include "app/bench/AoStudy.h"
#include "app/bench/AoTruth.h"

namespace crevice {

struct AoBenchSettings {
    std::vector<glm::uvec2> sizes{{1280, 720}};
    glm::uvec2 studySize{480, 270};
    AoTruthSettings truth{};
    std::uint32_t repeats = 3;  ///< Timed frames of each case; 0 = no timing.
    bool study = true;          ///< Calibration, split, matched truths and curves.
    RendererOptions renderer{};
    /// Words for what is done and the share of the whole that is done.
    std::function<void(const std::string&, double)> progress = [](const std::string&, double) {};
};

class AoBench {
public:
    AoBench(AoBenchSettings settings, AoViewList views, std::vector<AoCase> cases);

    /// Throws Error.
    AoResults run();

private:
    struct Truths;
    void runScene(AoScene& scene, const glm::uvec2& size);
    Truths traceScene(const AoScene& scene, const glm::uvec2& size);
    void addFixedRows(const AoScene& scene, const Truths& truths, bool hasBaked);
    void runCase(const AoScene& scene, const Truths& truths, const AoCase& wanted, std::size_t radius);
    void addPicture(const AoScene& scene, const Truths& truths, const AoCase& wanted, std::size_t radius,
                    const std::vector<float>& map);
    struct Cost {
        double passesMs = 0;  ///< The occlusion's passes.
        double guardMs = 0;   ///< What the guard adds to the G-buffer.
        double all() const { return passesMs + guardMs; }
    };
    Cost measureCost(const AoCase& wanted, double radius, const glm::uvec2& size, const AoView& view);
    void setShares(std::size_t firstRow);
    void runCurves(const AoScene& scene, const Truths& truths);
    void addLit(const AoScene& scene, const Scene& loaded);
    AoRow rowFor(const AoScene& scene, const AoView& view, const Truths& truths, std::size_t radius) const;
    std::size_t middle() const { return views_.radii.size() / 2; }
    void did(const std::string& what, double work);
    double planWork() const;

    AoBenchSettings settings_;
    AoViewList views_;
    std::vector<AoCase> cases_;
    std::vector<AoCurve> curves_;
    AoRenderer renderer_;
    std::unique_ptr<AoYardstick> yardstick_;
    std::unique_ptr<AoStudy> study_;
    AoResults results_;
    bool isTimed_ = false;    ///< Of the scene at hand.
    double yardstickMs_ = 0;  ///< Least so far, of the scene at hand.
    double done_ = 0, planned_ = 1;
};

}  // namespace crevice
