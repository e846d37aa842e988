// `crevice bench-ao`: every ambient occlusion technique against ray-traced truth and against the clock.
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/bench/AoBench.h"
#include "app/bench/AoFiles.h"
#include "app/bench/AoTable.h"
#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/TextTable.h"
#include "core/Error.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice bench-ao crease --techniques gtao --qualities fast --sizes 96x54 --samples 16 --no-study --repeats 1 -o "
    ".\n";

constexpr std::uint32_t kMaxSamples = 1u << 16, kMaxRepeats = 1000;

struct BenchAoOptions {
    std::vector<std::string> scenes, variants;
    std::string views, techniques, qualities, sizes = "1280x720", radii, studySize = "480x270", samples = "128",
                                              repeats = "3", device, out, markdown;
    bool noStudy = false, noCache = false;
    ConsoleOptions console;
};

std::vector<std::string> splitList(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; !text.empty() && begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// A share of the diagonal: "0.025" or "1/40".
double readRadius(const std::string& text) {
    const std::size_t slash = text.find('/');
    const double share = slash == std::string::npos ? parseNumber("--radii", text)
                                                    : parseNumber("--radii", text.substr(0, slash)) /
                                                          parseNumber("--radii", text.substr(slash + 1));
    if (!(share > 0 && share <= 1)) {
        throw Error(fmt::format("--radii: '{}' is out of range", text),
                    "write shares of the scene's diagonal: 1/80,1/40");
    }
    return share;
}

/// The list that comes with Crevice's sources.
std::filesystem::path defaultViews(const AssetRoots& roots) {
    for (const std::filesystem::path& root : roots.roots()) {
        std::error_code failed;
        const std::filesystem::path path = root / "tests/bench/ao-views.json";
        if (std::filesystem::is_regular_file(path, failed)) return path;
    }
    return {};
}

AoViewList readViews(const BenchAoOptions& options, const AssetRoots& roots, const Log& log) {
    const std::filesystem::path path =
        options.views.empty() ? defaultViews(roots) : std::filesystem::path(options.views);
    AoViewList views{{1.0 / 40}, {}};
    if (!path.empty()) views = readAoViews(path, options.scenes.empty() ? log : Log(LogLevel::Error));
    chooseScenes(views, options.scenes, roots);
    if (views.scenes.empty()) {
        throw Error("there is no scene to measure", "name scene files, or a list whose scenes are there: --views FILE");
    }
    if (!options.radii.empty()) {
        views.radii.clear();
        for (const std::string& radius : splitList(options.radii)) views.radii.push_back(readRadius(radius));
        std::sort(views.radii.begin(), views.radii.end());
    }
    return views;
}

/// Shares of the whole → "37 %, 3 min 20 s left".
class Eta {
public:
    std::string text(double share) const {
        const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        if (share < 0.01 || elapsed < 1) return fmt::format("{:.0f} %", 100 * share);
        const int left = static_cast<int>(elapsed * (1 - share) / share);
        return fmt::format("{:.0f} %, {} min {} s left", 100 * share, left / 60, left % 60);
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The folder need not be there yet: it is made when there is something to put into it.
void checkFolder(const std::string& out) {
    std::error_code failed;
    if (out.empty()) throw Error("no output given", "say where the results go: -o FOLDER");
    const std::filesystem::path folder = std::filesystem::absolute(out).lexically_normal();
    if (std::filesystem::is_directory(folder, failed)) return checkOutputPath("-o", folder / "results.csv");
    const std::filesystem::path parent = (folder.has_filename() ? folder : folder.parent_path()).parent_path();
    if (std::filesystem::exists(folder, failed) || !std::filesystem::is_directory(parent, failed)) {
        throw Error(fmt::format("-o: folder '{}' cannot be made", out), "name one that is there, or make its parent");
    }
}

/// As a reader can repeat it.
std::string commandLine(const BenchAoOptions& options) {
    std::string text = "crevice bench-ao";
    for (const std::string& scene : options.scenes) text += " " + std::filesystem::path(scene).filename().string();
    const auto add = [&](const char* name, const std::string& value, const std::string& usual) {
        if (value != usual) text += fmt::format(" {} {}", name, value);
    };
    add("--views", options.views.empty() ? "" : std::filesystem::path(options.views).filename().string(), "");
    add("--techniques", options.techniques, "");
    add("--qualities", options.qualities, "");
    for (const std::string& variant : options.variants) text += fmt::format(" --variant \"{}\"", variant);
    add("--sizes", options.sizes, "1280x720");
    add("--radii", options.radii, "");
    add("--study-size", options.studySize, "480x270");
    add("--samples", options.samples, "128");
    add("--repeats", options.repeats, "3");
    return text + (options.noStudy ? " --no-study" : "") + " -o FOLDER";
}

/// A dash where nothing was timed.
std::string shareText(const AoMean& mean) {
    if (!std::isfinite(mean.cpuShare)) return "–";
    return fmt::format("{:.3f}{}", mean.cpuShare, mean.onFront ? " *" : "");
}

/// What the terminal shows of it.
std::string summary(const AoResults& results) {
    std::string text;
    for (const AoGroup& group : listGroups(results.rows)) {
        if (!group.scene.empty()) continue;
        TextTable table;
        table.add({"case", "rows", "fetches", "rmse", "of white", "r", "skill", "|bias|", "cpu share"});
        for (const AoMean& m : meanRows(results.rows, group)) {
            table.add({m.label, fmt::format("{}", m.rows), fmt::format("{:g}", m.tapsPerPixel),
                       fmt::format("{:.4f}", m.rmse), fmt::format("{:.3f}", m.ofWhite),
                       fmt::format("{:.3f}", m.correlation), fmt::format("{:.3f}", m.skill),
                       fmt::format("{:.3f}", m.absBias), shareText(m)});
        }
        text += fmt::format("{}\n{}\n", group.title(), table.text(2));
    }
    return text + "*: nothing measured is both cheaper and nearer to the truth\n";
}

/// Empty when there is no such file yet.
std::string readMarkdown(const BenchAoOptions& options) {
    std::error_code failed;
    return std::filesystem::exists(options.markdown, failed) ? readText(options.markdown) : std::string();
}

void writeResults(const BenchAoOptions& options, const AoResults& results, const AssetRoots& roots) {
    const std::filesystem::path folder = options.out;
    std::filesystem::create_directories(folder);
    OutputFiles files;
    files.add(folder / "results.csv", aoCsv(results));
    files.add(folder / "results.json", aoJson(results));
    files.add(folder / "index.html", aoPage(results, roots));
    if (!options.markdown.empty()) {
        files.add(options.markdown, aoMarkdown(results, readMarkdown(options)));
    }
    print(summary(results));
    for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
}

int runBenchAo(const BenchAoOptions& options) {
    checkFolder(options.out);
    if (!options.markdown.empty()) {
        checkOutputPath("--markdown", options.markdown);
        aoMarkdown({}, readMarkdown(options));  // says now whether the file has its marks
    }
    const AssetRoots roots = AssetRoots::standard();
    AoBenchSettings settings;
    settings.sizes.clear();
    for (const std::string& size : splitList(options.sizes)) settings.sizes.push_back(parseSize("--sizes", size));
    if (settings.sizes.empty()) throw Error("--sizes: no size given", "write --sizes 1280x720");
    settings.studySize = parseSize("--study-size", options.studySize);
    settings.truth.samples = parseCount("--samples", options.samples, 2, kMaxSamples);
    settings.truth.useCache = !options.noCache;
    settings.repeats = parseCount("--repeats", options.repeats, 0, kMaxRepeats);
    settings.study = !options.noStudy;
    Progress progress(options.console.quiet);
    const Log log = makeLog(options.console, progress);
    AoViewList views = readViews(options, roots, log);
    std::vector<AoCase> cases =
        listAoCases(roots, {splitList(options.techniques), splitList(options.qualities), options.variants});
    if (cases.empty()) throw Error("there is nothing to measure", "name other --techniques or --qualities");
    // Documents are measured as they are: what they warn of is told by `crevice validate`.
    settings.renderer = {.device = options.device, .roots = roots, .log = Log(LogLevel::Error)};
    const Eta eta;
    settings.progress = [&](const std::string& what, double share) {
        progress.show(fmt::format("{}  {}", eta.text(share), what));
    };
    AoResults results = AoBench(std::move(settings), std::move(views), std::move(cases)).run();
    results.command = commandLine(options);
    progress.clear();
    writeResults(options, results, roots);
    return 0;
}

}  // namespace

void addBenchAoCommand(CLI::App& program, Action& action) {
    CLI::App* command =
        program.add_subcommand("bench-ao", "Measure occlusion techniques against ray-traced truth and the clock");
    const auto options = std::make_shared<BenchAoOptions>();
    const auto add = [&](const char* name, std::string& value, const char* type, const char* help) {
        return command->add_option(name, value, help)->type_name(type);
    };
    command->add_option("scene", options->scenes, "Scenes of the list of views, or files; default all of the list")
        ->type_name("SCENE");
    add("--views", options->views, "FILE.json",
        "List of scenes, cameras, radii and lights; default tests/bench/ao-views.json");
    add("--techniques", options->techniques, "A,B", "Techniques; default all but off");
    add("--qualities", options->qualities, "A,B", "Presets; default all but reference");
    command->add_option("--variant", options->variants, "A case besides, with options of its own (repeatable)")
        ->type_name("\"TECHNIQUE PRESET NAME=VALUE …\"")
        ->allow_extra_args(false);
    add("--sizes", options->sizes, "WxH,…", "Sizes of the pictures; the first is timed and shown")
        ->capture_default_str();
    add("--radii", options->radii, "S,…", "Radii as shares of the scene's diagonal; default those of the list");
    add("--study-size", options->studySize, "WxH", "Size for calibration and the split of errors")
        ->capture_default_str();
    add("--samples", options->samples, "N", "Rays per pixel of the truth")->capture_default_str();
    add("--repeats", options->repeats, "N", "Timed rounds, 0 = none; the least counts")->capture_default_str();
    command->add_flag("--no-study", options->noStudy, "Without calibration, split and curves");
    command->add_flag("--no-cache", options->noCache, "Trace again what has been traced before");
    add("-o,--out", options->out, "FOLDER", "Where results.csv, results.json and index.html go");
    add("--markdown", options->markdown, "FILE.md", "Writes the tables between the marks of a text, too");
    add("--device", options->device, "NAME|INDEX", "Device to use: see `crevice info`");
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runBenchAo(*options); }; });
}

}  // namespace crevice
