// CSV as RFC 4180 has it; JSON with null where a value is unknown.
#include "app/bench/AoFiles.h"

#include <cmath>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/AoColumns.h"
#include "app/bench/AoTable.h"

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

std::string csvText(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

/// An object from a struct with columns.
template <class Columns>
Json columnsJson(const Columns& columns) {
    Json json = Json::object();
    visitColumns(columns, [&](const char* name, const auto& value) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
            json[name] = number(value);
        } else {
            json[name] = value;
        }
    });
    return json;
}

Json tablesJson(const AoResults& results) {
    Json tables = Json::array();
    for (const AoGroup& group : listGroups(results.rows)) {
        Json rows = Json::array();
        for (const AoMean& mean : meanRows(results.rows, group)) {
            Json row = columnsJson(mean);
            row["on_front"] = mean.onFront;
            rows.push_back(std::move(row));
        }
        tables.push_back({{"title", group.title()},
                          {"kind", group.kind},
                          {"set", group.set},
                          {"scene", group.scene},
                          {"radius_share", group.share},
                          {"rows", std::move(rows)}});
    }
    return tables;
}

Json fitsJson(const AoResults& results) {
    Json fits = Json::array();
    for (const AoFit& fit : results.fits) {
        fits.push_back({{"technique", fit.technique},
                        {"quality", fit.quality},
                        {"radius", fit.radius},
                        {"strength", fit.strength},
                        {"power", fit.power},
                        {"before", number(fit.before)},
                        {"after", number(fit.after)},
                        {"fitted", number(fit.fitted)},
                        {"matched", number(fit.matched)},
                        {"matched_name", fit.matchedName}});
    }
    return fits;
}

Json splitsJson(const AoResults& results) {
    Json splits = Json::array();
    for (const AoSplit& split : results.splits) {
        splits.push_back({{"scene", split.scene},
                          {"kind", split.kind},
                          {"view", split.view},
                          {"set", split.set},
                          {"technique", split.technique},
                          {"quality", split.quality},
                          {"radius_share", split.share},
                          {"total", split.total},
                          {"estimator", split.estimator},
                          {"missing", split.missing},
                          {"white", split.white},
                          {"correlation", split.map.correlation},
                          {"skill", split.map.skill},
                          {"bias", split.map.bias},
                          {"floor_correlation", split.floor.correlation},
                          {"floor_skill", split.floor.skill},
                          {"floor_bias", split.floor.bias}});
    }
    return splits;
}

Json curvesJson(const AoResults& results) {
    Json curves = Json::array();
    for (const AoCurveResult& curve : results.curves) {
        Json points = Json::array();
        for (const AoCurvePoint& point : curve.points) {
            points.push_back({{"x", point.x},
                              {"cpu_share", number(point.cpuShare)},
                              {"of_white", point.ofWhite},
                              {"label", point.label}});
        }
        curves.push_back({{"name", curve.name}, {"points", std::move(points)}});
    }
    return curves;
}

}  // namespace

std::string aoCsv(const AoResults& results) {
    std::string text;
    visitColumns(AoRow{},
                 [&](const char* name, const auto&) { text += (text.empty() ? "" : ",") + std::string(name); });
    text += '\n';
    for (const AoRow& row : results.rows) {
        std::string line;
        visitColumns(row, [&](const char* name, const auto& value) {
            if (std::string_view(name) != "scene") line += ',';
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
                if (std::isfinite(value)) line += fmt::format("{}", value);  // shortest text that reads back exactly
            } else {
                line += csvText(value);
            }
        });
        text += line + '\n';
    }
    return text;
}

std::string aoJson(const AoResults& results) {
    Json sizes = Json::array();
    for (const glm::uvec2& size : results.sizes) sizes.push_back(fmt::format("{}x{}", size.x, size.y));
    Json rows = Json::array();
    for (const AoRow& row : results.rows) rows.push_back(columnsJson(row));
    const Json json{{"command", results.command},
                    {"device", results.device},
                    {"sizes", std::move(sizes)},
                    {"study_size", fmt::format("{}x{}", results.studySize.x, results.studySize.y)},
                    {"truth_samples", results.samples},
                    {"timed_rounds", results.repeats},
                    {"middle_radius", middleShare(results.rows)},
                    {"tables", tablesJson(results)},
                    {"calibration", fitsJson(results)},
                    {"split", splitsJson(results)},
                    {"curves", curvesJson(results)},
                    {"rows", std::move(rows)}};
    return json.dump(1) + "\n";
}

}  // namespace crevice
