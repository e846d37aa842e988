// Stages of all cases side by side: a row per stage, a column per case.
#include "Report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace crevice::bench {
namespace {

std::vector<std::string> stageNames(const Report& report) {
    std::vector<std::string> names;
    for (const CaseResult& result : report.cases) {
        for (const StageCost& stage : result.stages) {
            if (std::find(names.begin(), names.end(), stage.stage) == names.end()) names.push_back(stage.stage);
        }
    }
    return names;
}

std::string cell(const CaseResult& result, const std::string& stage) {
    for (const StageCost& cost : result.stages) {
        if (cost.stage == stage) return fmt::format("{:.1f}", cost.ms);
    }
    return "-";
}

std::string limits(const Bar& bar) {
    return bar.least > 0 ? fmt::format("{:g} to {:g}", bar.least, bar.most) : fmt::format("at most {:.4g}", bar.most);
}

}  // namespace

std::string reportText(const Report& report) {
    std::string text = fmt::format("{}, {}x{}, scene {}, least of {} interleaved rounds, process CPU ms\n\n",
                                   report.device, report.width, report.height, report.scene, report.repeats);
    text += fmt::format("{:<18}", "stage");
    for (const CaseResult& result : report.cases) text += fmt::format("{:>10}", result.name);
    text += '\n';
    for (const std::string& stage : stageNames(report)) {
        text += fmt::format("{:<18}", stage);
        for (const CaseResult& result : report.cases) text += fmt::format("{:>10}", cell(result, stage));
        text += '\n';
    }
    text += fmt::format("{:<18}", "frame");
    for (const CaseResult& result : report.cases) text += fmt::format("{:>10.1f}", result.frameMs);
    text += "\n\n";
    for (const CaseResult& result : report.cases) text += fmt::format("{:<10}{}\n", result.name, result.help);
    text += '\n';
    if (report.loopMs > 0)
        text += fmt::format("AVX2 loop, one thread: {:.1f} ms; its picture differs from the article's by {:.2f}/255\n",
                            report.loopMs, report.loopDifference);
    text += fmt::format("crevice render, whole process, caches warm: {:.1f} ms; PNG: {:.1f} ms\n\n", report.processMs,
                        report.pngMs);
    for (const Bar& bar : report.bars) {
        text += fmt::format("{:<8}{:<52}{:>9.3f} {:<3} {}\n", bar.isMet() ? "met" : "MISSED", bar.name, bar.value,
                            bar.unit, limits(bar));
    }
    return text;
}

std::string reportJson(const Report& report) {
    nlohmann::ordered_json json{{"device", report.device}, {"scene", report.scene},     {"width", report.width},
                                {"height", report.height}, {"repeats", report.repeats}, {"unit", "process CPU ms"}};
    for (const CaseResult& result : report.cases) {
        nlohmann::ordered_json stages;
        for (const StageCost& stage : result.stages) stages[stage.stage] = stage.ms;
        json["cases"][result.name] = {{"frame", result.frameMs}, {"stages", stages}};
    }
    json["avx2_loop"] = {{"ms", report.loopMs}, {"mean_difference_255", report.loopDifference}};
    json["process"] = report.processMs;
    json["png"] = report.pngMs;
    for (const Bar& bar : report.bars) {
        json["bars"].push_back(
            {{"name", bar.name}, {"value", bar.value}, {"least", bar.least}, {"most", bar.most}, {"met", bar.isMet()}});
    }
    return json.dump(2) + "\n";
}

}  // namespace crevice::bench
