// Scene by scene, so that one is in memory at a time; within it case by case, so that pipelines are made once a radius.
#include "app/bench/AoBench.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "app/bench/AoPictures.h"

namespace crevice {
namespace {

constexpr std::uint32_t kPictureWidth = 256, kLitWidth = 512;
constexpr float kErrorGain = 4;  // an error of 1/4 is white
// What a million rays and a million rendered or measured pixels take, in seconds on two cores: for the time left only.
constexpr double kRays = 0.1, kMap = 0.35, kStudyMap = 0.4;
// The yardstick's radius is 1 whatever the scene: only scenes of that scale compare. These come first in the list.
constexpr std::size_t kTimedScenes = 2;

double megapixels(const glm::uvec2& size) { return 1e-6 * size.x * size.y; }

/// The view that stands for a scene in pictures and timings.
const AoView& shownView(const AoScene& scene) {
    for (const AoView& view : scene.views) {
        if (view.set == "evaluation") return view;
    }
    return scene.views.front();
}

bool hasOcclusionTexture(const Scene& scene) {
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return bool(scene.materials[std::size_t(instance.material)].occlusionMap);
    });
}

}  // namespace

struct AoBench::Truths {
    glm::uvec2 size{0};
    std::vector<double> radii;     ///< World units.
    std::vector<AmbientMap> maps;  ///< One per view, a layer per radius.
    std::vector<double> excluded;
    std::vector<std::vector<float>> baked;  ///< One per view; empty without occlusion textures.
    std::vector<PictureRegions> regions;    ///< View by view, radius by radius.
    const PictureRegions* regionsOf(std::size_t view, std::size_t radius) const {
        return &regions[view * radii.size() + radius];
    }
};

AoBench::AoBench(AoBenchSettings settings, AoViewList views, std::vector<AoCase> cases)
    : settings_(std::move(settings)),
      views_(std::move(views)),
      cases_(std::move(cases)),
      renderer_(settings_.renderer) {
    if (settings_.repeats > 0) yardstick_ = std::make_unique<AoYardstick>(settings_.renderer, settings_.sizes.front());
    if (settings_.study) {
        curves_ = listAoCurves(renderer_.renderer().roots(), cases_);
        AoTruthSettings truth = settings_.truth;
        truth.progress = {};
        truth.samples = std::max(2u, truth.samples / 2);  // of three direction laws each; means over views need no more
        study_ = std::make_unique<AoStudy>(truth, settings_.studySize, [this](double maps) {
            did("calibration", maps * kStudyMap * megapixels(settings_.studySize));
        });
    }
    planned_ = planWork();
}

double AoBench::planWork() const {
    double views = 0, radii = 0, work = 0;
    for (const AoScene& scene : views_.scenes) views += double(std::max<std::size_t>(1, scene.views.size()));
    for (const AoCase& c : cases_) radii += c.everyRadius ? double(views_.radii.size()) : 1;
    for (const glm::uvec2& size : settings_.sizes) {
        work += megapixels(size) * views * (kRays * settings_.truth.samples + kMap * radii);
    }
    if (yardstick_) {
        const double scenes = double(std::min(kTimedScenes, views_.scenes.size()));
        work += megapixels(settings_.sizes.front()) * scenes * double(cases_.size()) * kMap * (settings_.repeats + 2);
    }
    if (study_) {
        const auto maps = AoStudy::countMaps(cases_, std::size_t(views));
        work += megapixels(settings_.studySize) * (kStudyMap * maps + 1.5 * kRays * settings_.truth.samples * views);
    }
    return std::max(work, 1e-6);
}

void AoBench::did(const std::string& what, double work) {
    done_ += work;
    settings_.progress(what, std::min(1.0, done_ / planned_));
}

AoResults AoBench::run() {
    results_.device = renderer_.renderer().device().deviceName();
    results_.sizes = settings_.sizes;
    results_.studySize = settings_.studySize;
    results_.samples = settings_.truth.samples;
    results_.repeats = settings_.repeats;
    results_.cases = cases_;
    for (const AoCurve& curve : curves_) results_.curves.push_back({curve.name, {}});
    for (const glm::uvec2& size : settings_.sizes) {
        for (AoScene& scene : views_.scenes) runScene(scene, size);
    }
    if (study_) results_.fits = study_->fits();
    return std::move(results_);
}

void AoBench::runScene(AoScene& scene, const glm::uvec2& size) {
    const bool isFirst = size == settings_.sizes.front();
    did("loading " + scene.name, 0);
    Scene loaded = loadAoScene(scene, renderer_.renderer().roots(), settings_.renderer.log);
    isTimed_ = yardstick_ && isFirst && std::size_t(&scene - views_.scenes.data()) < kTimedScenes;
    if (isTimed_) yardstick_->setScene(loaded);
    yardstickMs_ = 1e30;
    const std::size_t firstRow = results_.rows.size();
    renderer_.setScene(loaded);
    const Truths truths = traceScene(scene, size);
    addFixedRows(scene, truths, hasOcclusionTexture(loaded));
    for (const AoCase& c : cases_) {
        for (std::size_t radius = 0; radius < truths.radii.size(); ++radius) {
            if (!c.everyRadius && radius != middle()) continue;
            did(fmt::format("{}: {}", scene.name, c.label()), 0);
            renderer_.choose(c, truths.radii[radius], size);
            runCase(scene, truths, c, radius);
        }
    }
    if (!isFirst) return;
    if (study_) {
        study_->addScene(renderer_, scene, views_.radii[middle()], cases_, results_.splits);
        if (&scene == &views_.scenes.front()) runCurves(scene, truths);
    }
    addLit(scene, loaded);
    if (isTimed_) setShares(firstRow);
}

AoBench::Truths AoBench::traceScene(const AoScene& scene, const glm::uvec2& size) {
    Truths truths;
    truths.size = size;
    std::vector<AmbientTerm> terms;
    for (const double share : views_.radii) {
        truths.radii.push_back(share * renderer_.scene().bounds().diagonal());
        terms.push_back({static_cast<float>(truths.radii.back()), &hardFalloff()});
    }
    const double work = megapixels(size) * kRays * settings_.truth.samples;
    renderer_.choose(cases_.front(), truths.radii.front(), size);
    const bool hasBaked = hasOcclusionTexture(renderer_.scene());
    renderer_.keep(hasBaked ? std::vector<std::string>{"viewDepth", "cc_gbuffer_emissiveMap"}
                            : std::vector<std::string>{"viewDepth"});
    for (const AoView& view : scene.views) {
        AoTruthSettings settings = settings_.truth;
        const std::string what = fmt::format("{}: rays of '{}'", scene.name, view.name);
        settings.progress = [&](float share) {
            settings_.progress(what, std::min(1.0, (done_ + share * work) / planned_));
        };
        AmbientMap map = traceAoTruth(renderer_.scene(), view.camera, size, terms, settings);
        did(what, work);
        renderer_.render(view);
        const double surface = std::max(1.0, double(map.countedCount()));
        const std::size_t before = map.countedCount();
        excludeOtherSurfaces(map, renderer_.target("viewDepth"));
        truths.excluded.push_back(double(before - map.countedCount()) / surface);
        truths.maps.push_back(std::move(map));
        if (hasBaked) truths.baked.push_back(firstChannel(renderer_.target("cc_gbuffer_emissiveMap"), 3));
    }
    renderer_.keep({});
    truths.regions.resize(truths.maps.size() * truths.radii.size());
    runParallel(truths.regions.size(), [&](std::size_t i) {
        const std::size_t view = i / truths.radii.size(), radius = i % truths.radii.size();
        AoMeasurement m{{}, &truths.maps[view], radius, &scene.views[view].camera, {}};
        m.row.radius = truths.radii[radius];
        truths.regions[i] = findRegions(pictureInput(m));
    });
    return truths;
}

AoRow AoBench::rowFor(const AoScene& scene, const AoView& view, const Truths& truths, std::size_t radius) const {
    AoRow row;
    row.scene = scene.name;
    row.kind = scene.kind;
    row.view = view.name;
    row.set = view.set;
    row.size = truths.size;
    row.share = views_.radii[radius];
    row.radius = truths.radii[radius];
    row.excluded = truths.excluded[std::size_t(&view - scene.views.data())];
    return row;
}

void AoBench::addFixedRows(const AoScene& scene, const Truths& truths, bool hasBaked) {
    std::vector<AoMeasurement> measurements;
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
        for (std::size_t radius = 0; radius < truths.radii.size(); ++radius) {
            AoMeasurement m{rowFor(scene, scene.views[v], truths, radius), &truths.maps[v], radius,
                            &scene.views[v].camera, std::vector<float>(std::size_t(truths.size.x) * truths.size.y, 1)};
            m.regions = truths.regionsOf(v, radius);
            m.row.technique = "white";
            m.row.cpuShare = m.row.cpuMs = 0;
            measurements.push_back(m);
            if (!hasBaked) continue;
            m.row.technique = "baked";
            m.map = truths.baked[v];
            measurements.push_back(std::move(m));
        }
    }
    for (AoRow& row : measureRows(measurements)) results_.rows.push_back(std::move(row));
}

void AoBench::runCase(const AoScene& scene, const Truths& truths, const AoCase& wanted, std::size_t radius) {
    std::vector<AoMeasurement> measurements;
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
        const AoView& view = scene.views[v];
        AoMeasurement m{rowFor(scene, view, truths, radius), &truths.maps[v], radius, &view.camera,
                        renderer_.render(view).openness};
        m.regions = truths.regionsOf(v, radius);
        m.row.technique = wanted.technique;
        m.row.quality = wanted.quality;
        m.row.extras = wanted.extras;
        m.row.taps = wanted.taps;
        m.row.tapsPerPixel = wanted.tapsPerPixel();
        m.row.denoiseTaps = wanted.denoiseTaps;
        measurements.push_back(std::move(m));
    }
    const bool isShown = radius == middle() && truths.size == settings_.sizes.front();
    const std::size_t shown = std::size_t(&shownView(scene) - scene.views.data());
    if (isShown) addPicture(scene, truths, wanted, radius, measurements[shown].map);
    const bool isTimed = isShown && isTimed_;
    if (isTimed) {
        const Cost cost = measureCost(wanted, truths.radii[radius], truths.size, scene.views[shown]);
        measurements[shown].row.cpuMs = cost.all();
        measurements[shown].row.guardMs = cost.guardMs;
    }
    for (AoRow& row : measureRows(measurements)) results_.rows.push_back(std::move(row));
    did(fmt::format("{}: {}", scene.name, wanted.label()),
        megapixels(truths.size) * kMap * (double(scene.views.size()) + (isTimed ? settings_.repeats + 2 : 0)));
}

/// Least of the rounds; the yardstick is measured between them, and its least over the scene counts. A guard makes the
/// G-buffer larger: by how much dearer, the same case without it shows.
AoBench::Cost AoBench::measureCost(const AoCase& wanted, double radius, const glm::uvec2& size, const AoView& view) {
    yardstickMs_ = std::min(yardstickMs_, yardstick_->measure(view));
    Cost cost{1e30, 0};
    double geometry = 1e30;
    const auto render = [&] {
        const AoFrame frame = renderer_.render(view);
        geometry = std::min(geometry, frame.geometryMs);
        return frame.aoMs;
    };
    for (std::uint32_t round = 0; round < settings_.repeats; ++round) cost.passesMs = std::min(cost.passesMs, render());
    if (wanted.guard <= 0) return cost;
    const double guarded = std::exchange(geometry, 1e30);
    renderer_.choose(withoutGuard(wanted), radius, size);
    renderer_.render(view);  // the first frame after a choice is not counted: the case's own was rendered before
    for (std::uint32_t round = 0; round < settings_.repeats; ++round) render();
    cost.guardMs = std::max(0.0, guarded - geometry);
    return cost;
}

void AoBench::setShares(std::size_t firstRow) {
    for (std::size_t i = firstRow; i < results_.rows.size(); ++i) {
        AoRow& row = results_.rows[i];
        if (row.technique != "white" && row.technique != "baked")
            row.cpuShare = row.cpuMs / yardstickMs_, row.guardShare = row.guardMs / yardstickMs_;
    }
    if (firstRow > 0) return;  // curves are those of the first scene
    for (AoCurveResult& curve : results_.curves) {
        for (AoCurvePoint& point : curve.points) point.cpuShare /= yardstickMs_;
    }
}

void AoBench::addPicture(const AoScene& scene, const Truths& truths, const AoCase& wanted, std::size_t radius,
                         const std::vector<float>& map) {
    const AoView& view = shownView(scene);
    const AmbientMap& truth = truths.maps[std::size_t(&view - scene.views.data())];
    const std::vector<float>& openness = truth.layers[radius].openness;
    const bool isFirst = results_.pictures.empty() || results_.pictures.back().scene != scene.name;
    if (isFirst) {
        results_.pictures.push_back(
            {scene.name, view.name, "ray-traced truth", greyPicture(openness, truths.size, kPictureWidth), {}});
    }
    std::vector<float> error(map.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (truth.isCounted[i]) error[i] = std::abs(map[i] - openness[i]);
    }
    results_.pictures.push_back({scene.name, view.name, wanted.label(), greyPicture(map, truths.size, kPictureWidth),
                                 greyPicture(error, truths.size, kPictureWidth, kErrorGain)});
}

void AoBench::addLit(const AoScene& scene, const Scene& loaded) {
    Renderer& renderer = renderer_.renderer();
    const AoView& view = shownView(scene);
    const glm::uvec2 size = settings_.sizes.front();
    const auto render = [&](const std::map<std::string, std::string>& options) {
        renderer.load({"ao-deferred", options, {}}, {.width = size.x, .height = size.y});
        return shrunk(renderer.render({.width = size.x, .height = size.y, .camera = view.camera}), kLitWidth);
    };
    const Image without = render({{"ao", "off"}});
    std::map<std::string, const AoCase*> shown;  // of each technique "high", else its first
    for (const AoCase& c : cases_) {
        const AoCase*& chosen = shown[c.technique];
        if (!chosen || (c.quality == "high" && c.extras.empty())) chosen = &c;
    }
    for (const auto& [technique, c] : shown) {
        std::map<std::string, std::string> options = c->options;
        options["radius"] = fmt::format("{}", views_.radii[middle()] * loaded.bounds().diagonal());
        results_.lit.push_back({scene.name, view.name, c->label(), render(options), without});
    }
}

void AoBench::runCurves(const AoScene& scene, const Truths& truths) {
    const std::size_t shown = std::size_t(&shownView(scene) - scene.views.data());
    const AmbientMap& truth = truths.maps[shown];
    for (std::size_t i = 0; i < curves_.size(); ++i) {
        for (const AoCase& c : curves_[i].cases) {
            renderer_.choose(c, truths.radii[middle()], truths.size);
            const std::vector<float> map = renderer_.render(scene.views[shown]).openness;
            AoCurvePoint point;
            point.label = c.label();
            point.x = curves_[i].name.starts_with("blur") ? c.denoiseTaps : c.taps;
            point.ofWhite = measureMap(map, truth.layers[middle()].openness, truth.isCounted).ofWhite;
            point.cpuShare =
                isTimed_ ? measureCost(c, truths.radii[middle()], truths.size, scene.views[shown]).all() : kUnknown;
            results_.curves[i].points.push_back(point);
        }
    }
}

}  // namespace crevice
