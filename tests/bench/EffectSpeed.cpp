// crevice_effect_bench: what Cocos' effects cost beside glslang alone, and from the disk cache.
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include <unistd.h>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <CLI/CLI.hpp>

#include "ProcessClock.h"
#include "cocos/CocosEffects.h"
#include "core/Files.h"
#include "effect/EffectLibrary.h"
#include "effect/ShaderCompiler.h"

namespace crevice::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRounds = 15;           // the least of interleaved rounds is reported
constexpr double kEnough = 10'000;    // milliseconds, after which no other round begins
constexpr std::size_t kLoads = 1000;  // passes that the issue names

struct Pass {
    VariantRequest request;
    std::vector<std::pair<EShLanguage, std::string>> texts;
};

EShLanguage languageOf(ShaderStageBits stage) {
    return stage == kVertexBit ? EShLangVertex : stage == kFragmentBit ? EShLangFragment : EShLangCompute;
}

/// What is measured, and glslang's tables, which are read once by a process.
struct Setup {
    cocos::Roots roots;
    std::shared_ptr<ShaderCompiler> compiler = std::make_shared<ShaderCompiler>();

    std::unique_ptr<EffectLibrary> makeLibrary(bool disk) const {
        auto library = std::make_unique<EffectLibrary>(
            AssetRoots({}), Log(LogLevel::Error), EffectLibrary::Options{.useDiskCache = disk, .compiler = compiler});
        library->addFrontEnd(std::make_unique<cocos::CocosEffects>(roots));
        return library;
    }
};

/// A pass that compiles, with the texts that glslang gets.
std::optional<Pass> collectPass(EffectLibrary& library, const VariantRequest& request) {
    try {
        Pass pass{request, {}};
        library.get(request, {});
        for (const ShaderStageBits stage : {kVertexBit, kFragmentBit, kComputeBit})
            if (std::string text = library.text(request, stage); !text.empty())
                pass.texts.emplace_back(languageOf(stage), std::move(text));
        return pass;
    } catch (const Error&) {
        return std::nullopt;  // What does not compile has no time to compare.
    }
}

std::vector<Pass> collect(const Setup& setup) {
    std::vector<Pass> passes;
    const auto library = setup.makeLibrary(false);
    for (const std::string& name : library->names()) {
        std::vector<EffectTechnique> techniques;
        try {
            techniques = library->asset(name).techniques;
        } catch (const Error&) {
            // An effect that is wrong on purpose.
        }
        for (std::size_t t = 0; t < techniques.size(); ++t)
            for (std::size_t p = 0; p < techniques[t].passes.size(); ++p)
                if (auto pass =
                        collectPass(*library, {.effect = name, .technique = t, .pass = p, .defines = {}, .where = {}}))
                    passes.push_back(std::move(*pass));
    }
    return passes;
}

void compileAlone(EShLanguage language, const std::string& text) {
    glslang::TShader shader(language);
    const char* start = text.c_str();
    const int length = static_cast<int>(text.size());
    constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    shader.setStringsWithLengths(&start, &length, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_2);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_5);
    if (!shader.parse(GetDefaultResources(), 450, false, kMessages)) throw Error("a text does not compile alone");
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(kMessages)) throw Error("a text does not link alone");
    std::vector<unsigned int> words;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(language), words, &options);
}

double glslangAlone(const std::vector<Pass>& passes) {
    ProcessStopwatch watch;
    for (const Pass& pass : passes)
        for (const auto& [language, text] : pass.texts) compileAlone(language, text);
    return watch.lap();
}

/// Each text once, whichever passes have it.
double glslangOnce(const std::vector<Pass>& passes) {
    std::set<std::pair<EShLanguage, std::string_view>> texts;
    for (const Pass& pass : passes) texts.insert(pass.texts.begin(), pass.texts.end());
    ProcessStopwatch watch;
    for (const auto& [language, text] : texts) compileAlone(language, std::string(text));
    return watch.lap();
}

/// As a renderer does it; with `check` as `effects compile` does it, whose SPIR-V is validated.
double wholeLibrary(const Setup& setup, const std::vector<Pass>& passes, bool disk, bool check) {
    ProcessStopwatch watch;
    const auto library = setup.makeLibrary(disk);
    for (const Pass& pass : passes) {
        VariantRequest request = pass.request;
        request.checkOnly = check;
        library->get(request, {});
    }
    return watch.lap();
}

/// Milliseconds. A fresh library for every round over all passes, until a thousand were loaded.
double loadThousand(const Setup& setup, const std::vector<Pass>& passes) {
    double sum = 0;
    std::size_t loaded = 0;
    for (; loaded < kLoads; loaded += passes.size()) sum += wholeLibrary(setup, passes, true, false);
    return sum * static_cast<double>(kLoads) / static_cast<double>(loaded);
}

/// glslang's process-wide tables, kept between libraries.
struct ShaderTables {
    ShaderTables() { glslang::InitializeProcess(); }
    ~ShaderTables() { glslang::FinalizeProcess(); }
    ShaderTables(const ShaderTables&) = delete;
    ShaderTables& operator=(const ShaderTables&) = delete;
};

struct Times {
    double alone = std::numeric_limits<double>::max(), once = alone, drawn = alone, checked = alone, loaded = alone;
};

void keepLeast(double& least, double time) { least = std::min(least, time); }

Times measure(const Setup& setup, const std::vector<Pass>& passes, int rounds) {
    Times times;
    const double begun = processMilliseconds();
    for (int round = 0; round < rounds && processMilliseconds() - begun < kEnough; ++round) {
        keepLeast(times.alone, glslangAlone(passes));
        keepLeast(times.once, glslangOnce(passes));
        keepLeast(times.drawn, wholeLibrary(setup, passes, false, false));
        keepLeast(times.checked, wholeLibrary(setup, passes, false, true));
    }
    wholeLibrary(setup, passes, true, false);
    for (int round = 0; round < std::min(rounds, 5); ++round) keepLeast(times.loaded, loadThousand(setup, passes));
    return times;
}

int run(int argc, char** argv) {
    CLI::App app("What Cocos' effects cost beside glslang alone, and from the disk cache");
    Setup setup;
    cocos::Roots& roots = setup.roots;
    int rounds = kRounds;
    app.add_option("engine", roots.engine, "An engine checkout, or a folder like one");
    app.add_option("--project", roots.project, "A project: its effects too");
    app.add_option("--rounds", rounds, "Most rounds")->check(CLI::Range(1, 1000));
    bool profile = false;
    app.add_flag("--profile", profile, "Only the passes without cache, for a profiler");
    CLI11_PARSE(app, argc, argv);
    if (roots.engine.empty() && roots.project.empty()) roots.engine = CREVICE_BENCH_COCOS;
    const fs::path cache = fs::temp_directory_path() / fmt::format("crevice-effect-bench-{}", getpid());
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    const ShaderTables tables;
    const std::vector<Pass> passes = collect(setup);  // warms them up
    if (passes.empty()) throw Error("no pass compiles", "give an engine checkout: crevice_effect_bench DIR");
    for (int round = 0; profile && round < rounds; ++round) wholeLibrary(setup, passes, false, false);
    if (profile) return 0;
    const Times times = measure(setup, passes, rounds);
    fs::remove_all(cache);
    fmt::print("{} passes\nglslang alone      {:8.1f} ms, each text once {:.1f}\n", passes.size(), times.alone,
               times.once);
    const auto report = [&](const char* what, double time) {
        fmt::print("{} {:8.1f} ms   {:.2f} times glslang, each text once {:.2f}\n", what, time, time / times.alone,
                   time / times.once);
    };
    report("without cache     ", times.drawn);
    report("and validated     ", times.checked);
    fmt::print("1000 from the disk {:8.1f} ms\n", times.loaded);
    return 0;
}

}  // namespace
}  // namespace crevice::bench

int main(int argc, char** argv) try { return crevice::bench::run(argc, argv); } catch (const crevice::Error& error) {
    fmt::print(stderr, "{}\n", crevice::formatError(error));
    return 2;
}
