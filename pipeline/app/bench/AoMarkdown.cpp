// The tables of docs/ao-comparison.md: what a reader compares, not every column of the page.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "app/bench/AoFiles.h"
#include "app/bench/AoTable.h"
#include "app/commands/TextTable.h"
#include "core/Error.h"

namespace crevice {
namespace {

constexpr const char* kBegin = "<!-- bench-ao: begin -->";
constexpr const char* kEnd = "<!-- bench-ao: end -->";

std::string show(double value, int digits = 3) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}

std::string showTaps(double taps) { return taps > 0 ? fmt::format("{:g}", taps) : "–"; }

std::string groupTable(const std::vector<AoMean>& means) {
    TextTable table;
    table.add({"case", "fetches", "RMSE", "of white", "MAE", "bias", "abs. bias", "P95", "SSIM", "r", "skill", "noise",
               "edge", "border", "contact", "CPU share", "of it guard"});
    for (const AoMean& m : means) {
        const std::string label = m.onFront ? "**" + m.label + "**" : m.label;
        table.add({label, showTaps(m.tapsPerPixel), show(m.rmse), show(m.ofWhite), show(m.mae), show(m.bias),
                   show(m.absBias), show(m.p95), show(m.ssim), show(m.correlation), show(m.skill), show(m.noise, 4),
                   show(m.edge), show(m.border), show(m.contact), show(m.cpuShare),
                   m.guardShare > 0 ? show(m.guardShare) : "–"});
    }
    return table.markdown();
}

std::string frontText(std::vector<AoMean> means) {
    std::erase_if(means, [](const AoMean& m) { return !m.onFront; });
    if (means.empty()) return {};
    std::sort(means.begin(), means.end(), [](const AoMean& a, const AoMean& b) { return a.cpuShare < b.cpuShare; });
    std::string text = "\nPareto front, from cheap to exact: ";
    for (std::size_t i = 0; i < means.size(); ++i) {
        text += fmt::format("{}{} ({:.3f} at {:.3f})", i > 0 ? ", " : "", means[i].label, means[i].ofWhite,
                            means[i].cpuShare);
    }
    return text + ".\n";
}

std::string fitTable(const AoResults& results) {
    TextTable table;
    table.add({"case", "(a) as shipped", "(b) calibrated", "radius ×", "strength", "power", "(c) matched truth",
               "definition"});
    for (const AoFit& fit : results.fits) {
        table.add({fit.technique + " " + fit.quality, show(fit.before), show(fit.after), show(fit.radius, 2),
                   show(fit.strength, 2), show(fit.power, 2), show(fit.matched), fit.matchedName});
    }
    return table.markdown();
}

std::string splitTable(const AoResults& results) {
    struct Sum {
        double total = 0, estimator = 0, missing = 0, count = 0;
    };
    std::map<std::pair<std::string, std::string>, Sum> sums;
    for (const AoSplit& split : results.splits) {
        if (split.set != "evaluation" || split.white <= 0) continue;
        Sum& sum = sums[{split.kind, split.technique + " " + split.quality}];
        sum.total += split.total / split.white;
        sum.estimator += split.estimator / split.white;
        sum.missing += split.missing / split.white;
        ++sum.count;
    }
    TextTable table;
    table.add({"case", "views", "total", "estimator", "missing information"});
    for (const auto& [key, sum] : sums) {
        table.add({key.second, key.first == "room" ? "rooms" : "thin occluders", show(sum.total / sum.count),
                   show(sum.estimator / sum.count), show(sum.missing / sum.count)});
    }
    return table.markdown();
}

/// Of white, r, skill and bias.
std::vector<std::string> barCells(const MapMetrics& m) {
    return {show(m.ofWhite), show(m.correlation), show(m.skill), show(m.bias)};
}

/// Sums of maps' figures over views; the bias without its sign.
struct FigureSum {
    MapMetrics sum;
    double count = 0;

    void add(const MapMetrics& metrics) {
        sum.ofWhite += metrics.ofWhite;
        sum.correlation += metrics.correlation;
        sum.skill += metrics.skill;
        sum.bias += std::abs(metrics.bias);
        ++count;
    }
    MapMetrics mean() const {
        MapMetrics mean;
        mean.ofWhite = sum.ofWhite / count;
        mean.correlation = sum.correlation / count;
        mean.skill = sum.skill / count;
        mean.bias = sum.bias / count;
        return mean;
    }
};

/// One row of the floor's table: maps by the name of what made them, the heightfield's as "floor".
struct FloorRow {
    std::string view;
    std::map<std::string, MapMetrics> maps;
};

/// Views in the order of the splits; last the mean of the views that judge.
std::vector<FloorRow> floorRows(const AoResults& results) {
    std::vector<FloorRow> rows;
    std::map<std::string, FigureSum> sums;
    for (const AoSplit& split : results.splits) {
        if (split.quality != "high" || split.white <= 0) continue;
        const std::string view = fmt::format("{} {} ({})", split.scene, split.view, split.set);
        auto row = std::find_if(rows.begin(), rows.end(), [&](const FloorRow& other) { return other.view == view; });
        if (row == rows.end()) row = rows.insert(rows.end(), {view, {}});
        for (const auto& [name, metrics] :
             std::map<std::string, MapMetrics>{{"floor", split.floor}, {split.technique, split.map}}) {
            const bool isNew = row->maps.emplace(name, metrics).second;
            if (isNew && split.kind == "room" && split.set == "evaluation") sums[name].add(metrics);
        }
    }
    if (sums.empty()) return rows;
    FloorRow mean{"**mean of the rooms (evaluation)**, bias absolute", {}};
    for (const auto& [name, sum] : sums) mean.maps.emplace(name, sum.mean());
    rows.push_back(std::move(mean));
    return rows;
}

/// What the screen cannot know, view by view, beside what the two best techniques make of it. A bar above what the
/// floor reaches asks for what no map of one depth can know.
std::string floorTable(const AoResults& results) {
    TextTable table;
    table.add({"view", "heightfield", "r", "skill", "bias", "gtao high", "r", "skill", "bias", "vbao high", "r",
               "skill", "bias"});
    for (const FloorRow& row : floorRows(results)) {
        std::vector<std::string> cells = {row.view};
        for (const char* name : {"floor", "gtao", "vbao"}) {
            const auto known = row.maps.find(name);
            const std::vector<std::string> four =
                known == row.maps.end() ? std::vector<std::string>(4, "–") : barCells(known->second);
            cells.insert(cells.end(), four.begin(), four.end());
        }
        table.add(std::move(cells));
    }
    return table.markdown();
}

std::string curveTable(const AoResults& results) {
    TextTable table;
    table.add({"curve", "case", "texels read", "CPU share", "of white"});
    for (const AoCurveResult& curve : results.curves) {
        for (const AoCurvePoint& point : curve.points) {
            table.add({curve.name, point.label, showTaps(point.x), show(point.cpuShare), show(point.ofWhite)});
        }
    }
    return table.markdown();
}

std::string generated(const AoResults& results) {
    std::string sizes;
    for (const glm::uvec2& size : results.sizes)
        sizes += fmt::format("{}{}x{}", sizes.empty() ? "" : ", ", size.x, size.y);
    std::string text = fmt::format("Made by\n\n```\n{}\n```\n\n{}; {} rays a pixel; least of {} interleaved rounds.\n",
                                   results.command, sizes, results.samples, results.repeats);
    for (const AoGroup& group : listGroups(results.rows)) {
        const std::vector<AoMean> means = meanRows(results.rows, group);
        text += fmt::format("\n### Table: {}\n\n{}", group.title(), groupTable(means));
        if (group.scene.empty()) text += frontText(means);
    }
    if (!results.fits.empty()) {
        text += fmt::format("\n### Calibration\n\nOf white, evaluation views, {}x{}.\n\n{}", results.studySize.x,
                            results.studySize.y, fitTable(results));
    }
    if (!results.splits.empty()) {
        text += "\n### Where errors come from\n\nOf white, evaluation views, the middle radius.\n\n" +
                splitTable(results) + "\nThe heightfield reference (the floor) and two techniques, view by view:\n\n" +
                floorTable(results);
    }
    if (!results.curves.empty()) text += "\n### Cost over samples and over blur taps\n\n" + curveTable(results);
    return text;
}

}  // namespace

std::string aoMarkdown(const AoResults& results, const std::string& text) {
    const std::string part = fmt::format("{}\n{}{}", kBegin, generated(results), kEnd);
    if (text.empty()) return part + "\n";
    const std::size_t begin = text.find(kBegin), end = text.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
        throw Error("--markdown: the file has text but no marks",
                    fmt::format("put the lines {} and {} into it", kBegin, kEnd));
    }
    return text.substr(0, begin) + part + text.substr(end + std::string_view(kEnd).size());
}

}  // namespace crevice
