// Fuzzes pipeline documents: reading with extends, flow files, edits, options and sets; flattening; printing.
#include <sstream>

#include "FuzzTargets.h"
#include "plan/PipelineAsset.h"

namespace crevice::fuzz {
namespace {

constexpr std::string_view kRequestMark = "\n%%\n";

/// What follows the mark, line by line: "option NAME=VALUE" or "set PATH=VALUE", as the command line would say it.
PipelineRequest readRequest(std::string_view text) {
    PipelineRequest request;
    request.defaultPriority = [](const std::string& name) -> std::optional<int> {
        if (name.starts_with("Ssao")) return 12;
        return name.ends_with("Stage") ? std::optional(10) : std::nullopt;
    };
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line) && request.sets.size() < 20 && request.options.size() < 20;) {
        const std::size_t space = line.find(' ');
        const std::size_t equals = line.find('=');
        if (space == std::string::npos || equals == std::string::npos || equals < space) continue;
        const std::string name = line.substr(space + 1, equals - space - 1);
        const std::string value = line.substr(equals + 1);
        if (line.starts_with("option ")) request.options[name] = value;
        if (line.starts_with("set ")) request.sets.push_back({name, value});
    }
    return request;
}

}  // namespace

void pipeline(std::string_view input) {
    static const AssetRoots kRoots = AssetRoots::standard();
    const std::size_t mark = input.find(kRequestMark);
    const std::string_view text = input.substr(0, mark);
    const PipelineRequest request =
        mark == std::string_view::npos ? readRequest({}) : readRequest(input.substr(mark + kRequestMark.size()));
    const std::string file = "fuzz.pipeline.json";
    expectAnswer([&] {
        const PipelineDesc desc = parsePipeline(text, file, kRoots, request);
        Problems problems;
        checkPriorities(desc, request.defaultPriority, problems);
    });
    for (const FlattenOptions mode : {FlattenOptions::Keep, FlattenOptions::Resolve})
        expectAnswer([&] { (void)flattenText(flattenParsed(text, file, kRoots, request, mode)); });
}

}  // namespace crevice::fuzz
