// crevice_bench: the tables of docs/performance.md on this machine.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "ArticleCheck.h"
#include "Cases.h"
#include "Children.h"
#include "ProcessClock.h"
#include "Report.h"
#include "Scale.h"

namespace crevice::bench {
namespace {

struct Options {
    int repeats = 7;
    std::string json{};
    bool smoke = false;
    BenchView view{};
};

/// Three pipelines, the loop, a PNG and a whole process, round after round; the least of each counts.
class Bench {
public:
    explicit Bench(const Options& options) : options_(options) {
        for (const CaseDesc& desc : benchCases()) cases_.push_back(std::make_unique<BenchCase>(desc, options.view));
        if (hasArticleLoop()) check_.emplace(article());
    }

    Report run() {
        for (int round = 0; round < options_.repeats; ++round) runRound(round == 0);
        report_.device = full().renderer().device().deviceName();
        report_.scene = full().renderer().scene().name;
        report_.width = options_.view.width;
        report_.height = options_.view.height;
        report_.repeats = options_.repeats;
        for (const auto& c : cases_)
            report_.cases.push_back({c->desc().name, c->desc().help, c->frameMs(), c->stages()});
        if (check_) report_.loopDifference = check_->difference();
        addBars();
        return report_;
    }

    const Image& picture(std::size_t index) const { return cases_[index]->picture(); }

private:
    BenchCase& full() { return *cases_[0]; }
    BenchCase& plain() { return *cases_[1]; }
    BenchCase& article() { return *cases_[2]; }

    static void keepLeast(double& least, double value, bool first) { least = first ? value : std::min(least, value); }

    void runRound(bool first) {
        for (const auto& c : cases_) c->run();
        if (check_) keepLeast(report_.loopMs, check_->run(), first);
        ProcessStopwatch watch;
        encodePng(full().picture());
        keepLeast(report_.pngMs, watch.lap(), first);
        keepLeast(report_.processMs, renderProcess(), first);
    }

    /// `crevice render` of the same frame.
    double renderProcess() const {
        const std::filesystem::path out = std::filesystem::temp_directory_path() / "crevice-bench.png";
        const double ms = childMilliseconds(
            {CREVICE_PROGRAM, "render", benchScene(options_.view, Log(LogLevel::Error)), "--allow-outside", "--quiet",
             "--size", fmt::format("{}x{}", options_.view.width, options_.view.height), "-o", out.string()});
        std::filesystem::remove(out);
        return ms;
    }

    void addBars() {
        const double yardstick = article().stageMs("SsaoStage");
        const double occlusion = full().stageMs("SsaoStage");
        const double blur = full().stageMs("SsaoBlurX") + full().stageMs("SsaoBlurY");
        report_.bars = {
            {.name = "SsaoStage / article's pass", .value = occlusion / yardstick, .most = 0.18},
            {.name = "SsaoStage and its blur / article's pass", .value = (occlusion + blur) / yardstick, .most = 0.18},
            {.name = "frame without shadows and FXAA / article's pass",
             .value = plain().frameMs() / yardstick,
             .most = 0.42},
            {.name = "frame with everything / article's pass", .value = full().frameMs() / yardstick, .most = 0.65},
            {.name = "crevice render, whole process",
             .value = report_.processMs,
             .most = 1.5 * full().frameMs() + 150,
             .unit = "ms"},
            {.name = "PNG of the frame", .value = report_.pngMs, .most = 15, .unit = "ms"},
        };
        if (report_.loopMs <= 0) return;
        report_.bars.push_back(
            {.name = "article's pass / AVX2 loop", .value = yardstick / report_.loopMs, .least = 5.5, .most = 8.5});
        report_.bars.push_back(
            {.name = "loop's picture against the article's, 1/255", .value = report_.loopDifference, .most = 1.0});
    }

    const Options& options_;
    std::vector<std::unique_ptr<BenchCase>> cases_;
    std::optional<ArticleCheck> check_;
    Report report_;
};

double meanByte(const Image& image) {
    double sum = 0;
    for (const std::byte b : image.pixels) sum += std::to_integer<int>(b);
    return sum / static_cast<double>(image.pixels.size());
}

/// What a single round can tell: that pictures are there, and that the loop draws the article's.
int checkPictures(const Bench& bench, const Report& report) {
    int failures = 0;
    const auto expect = [&](bool holds, const std::string& what) {
        if (holds) return;
        ++failures;
        fmt::print(stderr, "error: {}\n", what);
    };
    for (std::size_t i = 0; i < report.cases.size(); ++i) {
        const double mean = meanByte(bench.picture(i));
        expect(mean > 70 && mean < 250, fmt::format("the picture of '{}' has mean {:.1f}", report.cases[i].name, mean));
    }
    expect(bench.picture(0) != bench.picture(1), "shadows and FXAA change nothing");
    expect(bench.picture(1) != bench.picture(2), "the article's form looks like the default");
    if (report.loopMs > 0)
        expect(report.loopDifference <= 1.5,
               fmt::format("the loop's picture is off by {:.2f}/255", report.loopDifference));
    return failures == 0 ? 0 : 1;
}

int run(const Options& options) {
    Bench bench(options);
    const Report report = bench.run();
    fmt::print("{}", reportText(report));
    if (!options.json.empty()) writeFileAtomically(options.json, reportJson(report));
    return options.smoke ? checkPictures(bench, report) : 0;
}

}  // namespace
}  // namespace crevice::bench

int main(int argc, char** argv) {
    using namespace crevice::bench;
    Options options;
    CLI::App app("Measures Crevice and compares it with the bars of docs/performance.md");
    app.add_option("--repeats", options.repeats, "Rounds")->check(CLI::Range(1, 1000));
    app.add_option("--json", options.json, "Write the results as JSON too")->type_name("FILE");
    app.add_option("--scene", options.view.scene, "Another scene than the atrium")->type_name("FILE");
    app.add_flag("--smoke", options.smoke, "One small round; fails when a picture is wrong");
    ScaleOptions scale;
    CLI::Option* scaled =
        app.add_option("--scale", scale.curves, "Curves instead: objects, triangles, lights, pixels, textures, or all")
            ->type_name("CURVE")
            ->expected(0, 5);
    CLI11_PARSE(app, argc, argv);
    if (options.smoke) {
        options.repeats = 1;
        options.view.width = 640;
        options.view.height = 360;
    }
    try {
        if (scaled->count() == 0) return run(options);
        scale.repeats = std::min(options.repeats, 5);
        if (scale.curves == std::vector<std::string>{"all"} || scale.curves == std::vector<std::string>{""})
            scale.curves.clear();
        runScale(scale);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
