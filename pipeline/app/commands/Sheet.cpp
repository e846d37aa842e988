// `crevice sheet`: many scenes in one picture, with their names below.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/Renderer.h"
#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/EnvironmentOptions.h"
#include "app/commands/OpenScene.h"
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

constexpr const char* kBackground = "#3c3e42";
constexpr std::uint32_t kGap = 8, kLetterScale = 2;
constexpr glm::u8vec4 kPaper{24, 24, 26, 255}, kInk{214, 214, 208, 255};

struct SheetOptions {
    std::vector<std::string> scenes;
    std::string pipeline = kDefaultPipeline;
    std::string out, columns, device, size = "480x270", background;
    PipelineOptions pipelineOptions;
    ConsoleOptions console;
    SceneOptions loading;
    EnvironmentOptions environment;
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

/// A text in the middle of a line that is as wide as a tile, as much of it as there is room for.
void writeCentred(Image& sheet, const Layout& layout, glm::uvec2 place, std::string text) {
    while (!text.empty() && textSize(text, kLetterScale).x > layout.tile.x) text.pop_back();
    const std::uint32_t indent = (layout.tile.x - textSize(text, kLetterScale).x) / 2;
    drawText(sheet, place.x + indent, place.y, text, kLetterScale, kInk);
}

void placeLabel(Image& sheet, const Layout& layout, std::uint32_t index, const std::string& name) {
    writeCentred(sheet, layout, layout.place(index) + glm::uvec2(0, layout.tile.y + kGap), name);
}

void placeTile(Image& sheet, const Layout& layout, std::uint32_t index, const Image& tile) {
    const glm::uvec2 place = layout.place(index);
    for (std::uint32_t y = 0; y < tile.height; ++y)
        std::memcpy(sheet.pixel(place.x, place.y + y), tile.pixel(0, y), tile.width * sizeof kPaper);
}

/// In the place of a scene that cannot be shown.
void placeNote(Image& sheet, const Layout& layout, std::uint32_t index) {
    const std::uint32_t height = textSize("A", kLetterScale).y;
    const std::uint32_t top = layout.tile.y > height ? (layout.tile.y - height) / 2 : 0;
    writeCentred(sheet, layout, layout.place(index) + glm::uvec2(0, top), "NO PICTURE");
}

std::vector<SceneFile> findScenes(const SheetOptions& options, const AssetRoots& roots) {
    if (options.scenes.empty()) {
        throw Error("no scene given", "name files (.gltf, .glb, .scene.json, .scene) or shipped scenes: " +
                                          join(roots.list(AssetKind::Scene)));
    }
    if (options.out.empty()) throw Error("no output given", "say where the picture goes: -o SHEET.png");
    checkPicturePath("-o", options.out);
    std::vector<SceneFile> scenes;
    for (const std::string& argument : options.scenes) scenes.push_back(findScene(roots, argument));
    return scenes;
}

/// One run of the command. A scene that cannot be read or drawn costs its tile and the exit code, not the sheet.
class SheetRun {
public:
    explicit SheetRun(const SheetOptions& options)
        : options_(options),
          pipeline_(options.pipeline, options.pipelineOptions, makeLog(options.console), options.scenes),
          scenes_(findScenes(options, pipeline_.roots())),
          layout_(planLayout(options)),
          view_{
              .width = layout_.tile.x,
              .height = layout_.tile.y,
              .camera = {},
              .background = parseColor("--background", options.background.empty() ? kBackground : options.background)},
          environment_(options.environment),
          progress_(options.console.quiet),
          log_(makeLog(options.console, progress_)),
          sheet_(makePaper(layout_.size())) {
        // What is wrong with the options is no scene's fault.
        limits_ = makeLoadOptions(pipeline_.roots(), log_, options.loading).limits;
        Scene none;
        environment_.apply(none, log_, limits_);
    }

    int run() {
        start();
        for (std::uint32_t i = 0; i < scenes_.size(); ++i) {
            placeLabel(sheet_, layout_, i, scenes_[i].name);
            try {
                placeTile(sheet_, layout_, i, render(i));
            } catch (const Error& error) {
                failed_.push_back(scenes_[i].name);
                problems_.add(error);
                placeNote(sheet_, layout_, i);
            }
        }
        progress_.clear();
        return finish();
    }

private:
    void start() {
        renderer_ = std::make_unique<Renderer>(RendererOptions{.device = options_.device,
                                                               .defaultLight = !options_.noDefaultLight,
                                                               .defaultEnvironment = !environment_.isNone(),
                                                               .roots = pipeline_.roots(),
                                                               .log = log_});
        pipeline_.addEffects(renderer_->effects());
        for (const std::filesystem::path& plugin : pipeline_.classes().pluginFiles()) renderer_->loadPlugin(plugin);
        renderer_->load(pipeline_.request(), {.width = layout_.tile.x, .height = layout_.tile.y});
    }

    Image render(std::uint32_t index) {
        progress_.show(fmt::format("{}/{} {} …", index + 1, scenes_.size(), scenes_[index].name));
        SceneOptions loading = options_.loading;
        loading.aspect = static_cast<float>(layout_.tile.x) / static_cast<float>(layout_.tile.y);
        OpenedScene opened = openScene(scenes_[index], pipeline_, log_, loading);
        environment_.apply(opened.scene, log_, limits_);
        View view = view_;
        if (opened.background && options_.background.empty()) view.background = *opened.background;
        renderer_->setScene(std::move(opened.scene));
        return renderer_->render(view);
    }

    int finish() {
        if (failed_.size() == scenes_.size()) problems_.throwIfErrors();
        OutputFiles files;
        files.add(options_.out, sheet_);
        for (const std::filesystem::path& path : files.commit()) print(path.string() + "\n");
        if (failed_.empty()) return 0;
        for (const Problem& problem : problems_.all()) std::fprintf(stderr, "%s\n", formatProblem(problem).c_str());
        log_.error(fmt::format("no picture of {} of {} scenes: {}", failed_.size(), scenes_.size(), join(failed_)));
        return 1;
    }

    const SheetOptions& options_;
    const PipelineChoice pipeline_;
    const std::vector<SceneFile> scenes_;
    const Layout layout_;
    const View view_;
    EnvironmentChoice environment_;
    Progress progress_;
    Log log_;
    Image sheet_;
    Limits limits_;
    Problems problems_;
    std::vector<std::string> failed_;
    std::unique_ptr<Renderer> renderer_;
};

int runSheet(const SheetOptions& options) { return SheetRun(options).run(); }

}  // namespace

void addSheetCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("sheet", "Render many scenes into one picture with labels");
    const auto options = std::make_shared<SheetOptions>();
    command->add_option("scene", options->scenes, "Files (.gltf, .glb, .scene.json, .scene) or names of shipped scenes")
        ->type_name("SCENE");
    command->add_option("-p,--pipeline", options->pipeline, "Name of a pipeline or path of a .json or .rpp file")
        ->type_name("PIPELINE")
        ->capture_default_str();
    command->add_option("-o,--out", options->out, "Picture to write, .png or .exr")->type_name("OUT");
    command->add_option("--columns", options->columns, "Tiles side by side; default as many as rows")->type_name("N");
    command->add_option("--size", options->size, "Pixels of a tile")->type_name("WxH")->capture_default_str();
    command
        ->add_option("--background", options->background,
                     "Behind scenes without a sky; default #3c3e42, or a Cocos camera's colour")
        ->type_name("COLOR");
    command->add_option("--device", options->device, "Device to use: see `crevice info`")->type_name("NAME|INDEX");
    command->add_flag("--no-default-light", options->noDefaultLight, "Leave scenes without lights dark");
    addPipelineOptions(*command, options->pipelineOptions);
    addEnvironmentOptions(*command, options->environment);
    addSceneOptions(*command, options->loading);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runSheet(*options); }; });
}

}  // namespace crevice
