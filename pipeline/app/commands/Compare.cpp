// `crevice compare`: are two pictures the same, and if not, how much and where do they differ?
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/ImageDifference.h"
#include "app/commands/OutputFiles.h"
#include "core/Error.h"
#include "core/Exr.h"
#include "core/LimitedFiles.h"
#include "core/Limits.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice compare a.png a.png\n"
    "  crevice compare a.png b.png --rmse 0.5 --max 1 --heat heat.png\n";

struct CompareOptions {
    std::string a, b, rmse, max, heat;
    std::vector<std::string> limits;
};

std::optional<double> readThreshold(const char* option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    const double value = parseNumber(option, text);
    if (value < 0) throw Error(fmt::format("{}: '{}' is out of range", option, text), "write a number from 0");
    return value;
}

/// How many of red, green and blue the file gives values for: 1 for an EXR of R alone, 2 for RG, else 3.
int colourChannels(const std::string& path, const Limits& limits) {
    const std::vector<std::byte> bytes = readBytesWithin(path, limits.maxFileBytes);
    return looksLikeExr(bytes) ? exrColourChannels(bytes, path, limits) : 3;
}

void printDifference(const ImageDifference& difference) {
    const auto& mean = difference.meanAbs;
    print(fmt::format("rmse      {:.6g}\nmax       {:.6g}\n", difference.rmse, difference.max));
    print("mean abs");
    for (std::size_t c = 0; c < static_cast<std::size_t>(difference.colours); ++c)
        print(fmt::format("  {} {:.6g}", "rgb"[c], mean[c]));
    print(difference.alphaCounts ? fmt::format("  a {:.6g}\n", mean[3]) : "\n");
    print(std::isinf(difference.psnr()) && difference.rmse == 0
              ? "psnr      infinite\n"
              : fmt::format("psnr      {:.2f} dB\n", difference.psnr()));
}

/// Without a threshold, any difference is too much.
int runCompare(const CompareOptions& options) {
    if (options.a.empty() || options.b.empty()) {
        throw Error("two pictures are needed", "name them: crevice compare a.png b.png");
    }
    std::optional<double> rmseLimit = readThreshold("--rmse", options.rmse);
    const std::optional<double> maxLimit = readThreshold("--max", options.max);
    if (!rmseLimit && !maxLimit) rmseLimit = 0;
    if (!options.heat.empty()) checkPicturePath("--heat", options.heat);
    Limits limits;
    for (const std::string& limit : options.limits) setLimit(limits, limit);
    const Image a = readImage(options.a, limits);
    const Image b = readImage(options.b, limits);
    if (a.width != b.width || a.height != b.height) {
        throw RenderError(fmt::format("the sizes differ: '{}' is {}x{}, '{}' is {}x{}", options.a, a.width, a.height,
                                      options.b, b.width, b.height),
                          "render both with the same --size");
    }
    const ImageDifference difference =
        compareImages(a, b, std::max(colourChannels(options.a, limits), colourChannels(options.b, limits)));
    printDifference(difference);
    if (!options.heat.empty()) {
        writeImage(options.heat, makeHeatImage(a, b, difference.max));
        print(options.heat + "\n");
    }
    // Written so that a not-a-number is over every limit.
    const bool same = (!rmseLimit || difference.rmse <= *rmseLimit) && (!maxLimit || difference.max <= *maxLimit);
    return same ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("compare", "Compare two pictures; exit code 1 when they differ");
    const auto options = std::make_shared<CompareOptions>();
    command->add_option("a", options->a, "Picture, .png or .exr")->type_name("A");
    command->add_option("b", options->b, "Picture, .png or .exr")->type_name("B");
    command->add_option("--rmse", options->rmse, "Allowed root of the mean square; 1 = black against white")
        ->type_name("T");
    command->add_option("--max", options->max, "Allowed difference of any channel; 1 = black against white")
        ->type_name("T");
    command->add_option("--limit", options->limits, "Raise or lower a limit of `crevice limits` (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_option("--heat", options->heat, "Picture of the differences to write")->type_name("H.png");
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runCompare(*options); }; });
}

}  // namespace crevice
