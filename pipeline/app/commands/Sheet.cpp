// `crevice sheet`: many scenes in one picture, with their names below.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/Renderer.h"
#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/OutputFiles.h"
#include "app/commands/PipelineOptions.h"
#include "app/commands/SceneFiles.h"
#include "app/commands/TinyFont.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice sheet default crease -o sheet.png\n"
    "  crevice sheet default crease -o ao.png -p ao-only --columns 1 --size 320x180\n";

constexpr std::uint32_t kGap = 8, kLetterScale = 2;
constexpr glm::u8vec4 kPaper{24, 24, 26, 255}, kInk{214, 214, 208, 255};

struct SheetOptions {
    std::vector<std::string> scenes;
    std::string pipeline = kDefaultPipeline;
    std::string out, columns, device, size = "480x270", background = "#3c3e42";
    PipelineOptions pipelineOptions;
    ConsoleOptions console;
    SceneOptions loading;
    bool noDefaultLight = false;
};

/// Where tiles and labels go, in pixels.
struct Layout {
    glm::uvec2 tile;
    std::uint32_t columns, rows;
    std::uint32_t labelHeight = textSize("A", kLetterScale).y + kGap;
    glm::uvec2 size() const { return {columns * (tile.x + kGap) + kGap, rows * (tile.y + labelHeight + kGap) + kGap}; }
    glm::uvec2 place(std::uint32_t index) const {
        const std::uint32_t column = index % columns, row = index / columns;
        return {kGap + column * (tile.x + kGap), kGap + row * (tile.y + labelHeight + kGap)};
    }
};

/// As wide as it is high, roughly, unless --columns says otherwise.
Layout planLayout(const SheetOptions& options) {
    const auto count = static_cast<std::uint32_t>(options.scenes.size());
    const auto square = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const std::uint32_t columns =
        options.columns.empty() ? square : std::min(count, parseCount("--columns", options.columns, 1, 1000));
    const Layout layout{parseSize("--size", options.size), columns, (count + columns - 1) / columns};
    if (layout.size().x > kMaxImageSide || layout.size().y > kMaxImageSide) {
        throw Error(fmt::format("the sheet would be {}x{} pixels, and {} is the most", layout.size().x, layout.size().y,
                                kMaxImageSide),
                    "choose a smaller --size or other --columns");
    }
    return layout;
}

Image makePaper(glm::uvec2 size) {
    Image paper(size.x, size.y, Format::RGBA8);
    for (std::size_t i = 0; i < paper.pixels.size(); i += sizeof kPaper) {
        std::memcpy(&paper.pixels[i], &kPaper, sizeof kPaper);
    }
    return paper;
}

void placeTile(Image& sheet, const Layout& layout, std::uint32_t index, const Image& tile, const std::string& name) {
    const glm::uvec2 place = layout.place(index);
    for (std::uint32_t y = 0; y < tile.height; ++y) {
        std::memcpy(sheet.pixel(place.x, place.y + y), tile.pixel(0, y), tile.width * sizeof kPaper);
    }
    std::string label = name;
    while (!label.empty() && textSize(label, kLetterScale).x > layout.tile.x) label.pop_back();
    const std::uint32_t indent = (layout.tile.x - textSize(label, kLetterScale).x) / 2;
    drawText(sheet, place.x + indent, place.y + layout.tile.y + kGap, label, kLetterScale, kInk);
}

std::vector<SceneFile> findScenes(const SheetOptions& options, const AssetRoots& roots) {
    if (options.scenes.empty()) {
        throw Error("no scene given",
                    "name files (.gltf, .glb, .scene.json) or shipped scenes: " + join(roots.list(AssetKind::Scene)));
    }
    if (options.out.empty()) throw Error("no output given", "say where the picture goes: -o SHEET.png");
    checkPicturePath("-o", options.out);
    std::vector<SceneFile> scenes;
    for (const std::string& argument : options.scenes) scenes.push_back(findScene(roots, argument));
    return scenes;
}

int runSheet(const SheetOptions& options) {
    const PipelineChoice pipeline(options.pipeline, options.pipelineOptions);
    const std::vector<SceneFile> scenes = findScenes(options, pipeline.roots());
    const Layout layout = planLayout(options);
    const View view{.width = layout.tile.x,
                    .height = layout.tile.y,
                    .camera = {},
                    .background = parseColor("--background", options.background)};
    Progress progress(options.console.quiet);
    Renderer renderer({.device = options.device,
                       .defaultLight = !options.noDefaultLight,
                       .roots = pipeline.roots(),
                       .log = makeLog(options.console, progress)});
    for (const std::filesystem::path& plugin : pipeline.classes().pluginFiles()) renderer.loadPlugin(plugin);
    renderer.load(pipeline.request(), {.width = layout.tile.x, .height = layout.tile.y});
    Image sheet = makePaper(layout.size());
    for (std::uint32_t i = 0; i < scenes.size(); ++i) {
        progress.show(fmt::format("{}/{} {} …", i + 1, scenes.size(), scenes[i].name));
        renderer.setScene(loadSceneFile(scenes[i], pipeline.roots(), renderer.log(), options.loading));
        placeTile(sheet, layout, i, renderer.render(view), scenes[i].name);
    }
    progress.clear();
    OutputFiles files;
    files.add(options.out, sheet);
    for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
    return 0;
}

}  // namespace

void addSheetCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("sheet", "Render many scenes into one picture with labels");
    const auto options = std::make_shared<SheetOptions>();
    command->add_option("scene", options->scenes, "Files (.gltf, .glb, .scene.json) or names of shipped scenes")
        ->type_name("SCENE");
    command->add_option("-p,--pipeline", options->pipeline, "Name of a pipeline or path of a .json file")
        ->type_name("PIPELINE")
        ->capture_default_str();
    command->add_option("-o,--out", options->out, "Picture to write, .png or .exr")->type_name("OUT");
    command->add_option("--columns", options->columns, "Tiles side by side; default as many as rows")->type_name("N");
    command->add_option("--size", options->size, "Pixels of a tile")->type_name("WxH")->capture_default_str();
    command->add_option("--background", options->background, "Behind scenes without a sky")
        ->type_name("COLOR")
        ->capture_default_str();
    command->add_option("--device", options->device, "Device to use: see `crevice info`")->type_name("NAME|INDEX");
    command->add_flag("--no-default-light", options->noDefaultLight, "Leave scenes without lights dark");
    addPipelineOptions(*command, options->pipelineOptions);
    addSceneOptions(*command, options->loading);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runSheet(*options); }; });
}

}  // namespace crevice
