// One set of rays per view yields the hard truth and those of all definitions.
#include "app/bench/AoStudy.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "truth/HeightfieldReference.h"

namespace crevice {
namespace {

constexpr double kFactors[] = {0.7, 1, 1.5};

struct StudyView {
    const AoView* view;
    AmbientMap truth;
    std::vector<float> heightfield;
};

double rms(const std::vector<float>& a, const std::vector<float>& b, const std::vector<std::uint8_t>& isCounted) {
    return measureMap(a, b, isCounted).rmse;
}

/// The hard truth, then every other definition of a technique among the cases.
std::vector<AmbientTerm> listTerms(const std::vector<AoCase>& cases, float radius) {
    std::vector<AmbientTerm> terms{{radius, &hardFalloff()}};
    std::set<std::string> names;
    for (const AoCase& c : cases) {
        const Falloff* matched = findFalloff("matched:" + c.technique);
        if (matched && names.insert(c.technique).second) terms.push_back({radius, matched});
    }
    return terms;
}

std::vector<float> brute(const StudyView& view, float radius, bool useCache) {
    HeightfieldSettings settings{.radius = radius, .slices = 32};
    if (useCache) settings.cache = cacheFolder("truth");
    return traceHeightfield({.size = view.truth.size,
                             .camera = view.view->camera,
                             .viewDepth = view.truth.viewDepth,
                             .normal = view.truth.normal},
                            settings);
}

}  // namespace

std::vector<AoCase> AoStudy::choose(const std::vector<AoCase>& cases) {
    std::vector<AoCase> chosen;
    for (const AoCase& c : cases) {
        if (c.extras.empty() && (c.quality == "high" || c.quality == "article")) chosen.push_back(c);
    }
    return chosen;
}

double AoStudy::countMaps(const std::vector<AoCase>& cases, std::size_t views) {
    return static_cast<double>(std::size(kFactors) * choose(cases).size() * views);
}

void AoStudy::addMatched(Technique& technique, const AmbientMap& truth, const std::vector<float>& map) const {
    for (std::size_t i = 1; i < truth.layers.size(); ++i) {
        const AmbientLayer& layer = truth.layers[i];
        if (layer.term.falloff->name != "matched:" + technique.shown.technique) continue;
        technique.matched += measureMap(map, layer.openness, truth.isCounted).ofWhite;
        technique.matchedName = layer.term.falloff->name;
        ++technique.matchedCount;
    }
}

void AoStudy::addScene(AoRenderer& renderer, const AoScene& scene, double share, const std::vector<AoCase>& cases,
                       std::vector<AoSplit>& splits) {
    const std::vector<AoCase> chosen = choose(cases);
    if (chosen.empty()) return;
    const double radius = share * renderer.scene().bounds().diagonal();
    const auto terms = listTerms(chosen, static_cast<float>(radius));
    std::vector<StudyView> views;
    renderer.choose(chosen.front(), radius, size_);
    renderer.keep({"viewDepth"});
    for (const AoView& view : scene.views) {
        views.push_back({&view, traceAoTruth(renderer.scene(), view.camera, size_, terms, truth_), {}});
        views.back().heightfield = brute(views.back(), static_cast<float>(radius), truth_.useCache);
        renderer.render(view);
        excludeOtherSurfaces(views.back().truth, renderer.target("viewDepth"));
    }
    renderer.keep({});
    for (const AoCase& c : chosen) {
        Technique& technique = techniques_[c.label()];
        technique.shown = c;
        for (const double factor : kFactors) {
            renderer.choose(c, factor * radius, size_);
            for (const StudyView& v : views) {
                const std::vector<float> map = renderer.render(*v.view).openness;
                const std::vector<float>& truth = v.truth.layers[0].openness;
                LevelSums sums;
                sums.add(map, truth, v.truth.isCounted);
                const bool forCalibration = v.view->set == "calibration";
                technique.fitter.add(factor, forCalibration, sums);
                if (factor != 1) continue;
                if (!forCalibration) addMatched(technique, v.truth, map);
                splits.push_back({scene.name, scene.kind, v.view->name, v.view->set, c.technique, c.quality, c.extras,
                                  share, 0, rms(map, v.heightfield, v.truth.isCounted), 0, std::sqrt(sums.whiteError()),
                                  measureMap(map, truth, v.truth.isCounted),
                                  measureMap(v.heightfield, truth, v.truth.isCounted)});
                splits.back().total = splits.back().map.rmse;
                splits.back().missing = splits.back().floor.rmse;
            }
            progress_(static_cast<double>(views.size()));
        }
    }
}

std::vector<AoFit> AoStudy::fits() const {
    std::vector<AoFit> fits;
    for (const auto& [label, technique] : techniques_) {
        AoFit fit;
        fit.technique = technique.shown.technique;
        fit.quality = technique.shown.quality;
        technique.fitter.fit(fit);
        fit.matchedName = technique.matchedName;
        if (technique.matchedCount > 0) fit.matched = technique.matched / technique.matchedCount;
        fits.push_back(std::move(fit));
    }
    return fits;
}

}  // namespace crevice
