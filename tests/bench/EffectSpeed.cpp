// crevice_effect_bench: what Cocos' effects cost beside glslang alone, and from the disk cache.
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>

#include <unistd.h>

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include "ProcessClock.h"
#include "cocos/CocosEffects.h"
#include "core/Files.h"
#include "effect/EffectLibrary.h"

namespace crevice::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRounds = 5;            // the least of interleaved rounds is reported
constexpr std::size_t kLoads = 1000;  // passes that the issue names

struct Pass {
    VariantRequest request;
    std::vector<std::pair<EShLanguage, std::string>> texts;
};

EShLanguage languageOf(ShaderStageBits stage) {
    return stage == kVertexBit ? EShLangVertex : stage == kFragmentBit ? EShLangFragment : EShLangCompute;
}

std::unique_ptr<EffectLibrary> makeLibrary(const cocos::Roots& roots, bool disk) {
    auto library = std::make_unique<EffectLibrary>(AssetRoots({}), Log(LogLevel::Error),
                                                   EffectLibrary::Options{.useDiskCache = disk});
    library->addFrontEnd(std::make_unique<cocos::CocosEffects>(roots));
    return library;
}

/// Passes that compile, with the texts that glslang gets.
std::vector<Pass> collect(const cocos::Roots& roots) {
    std::vector<Pass> passes;
    const auto library = makeLibrary(roots, false);
    for (const std::string& name : library->names()) {
        try {
            const EffectAsset& effect = library->asset(name);
            for (std::size_t t = 0; t < effect.techniques.size(); ++t) {
                for (std::size_t p = 0; p < effect.techniques[t].passes.size(); ++p) {
                    Pass pass;
                    pass.request = {.effect = name, .technique = t, .pass = p, .defines = {}, .where = {}};
                    library->get(pass.request, {});
                    for (const ShaderStageBits stage : {kVertexBit, kFragmentBit, kComputeBit})
                        if (std::string text = library->text(pass.request, stage); !text.empty())
                            pass.texts.emplace_back(languageOf(stage), std::move(text));
                    passes.push_back(std::move(pass));
                }
            }
        } catch (const Error&) {
            // What does not compile has no time to compare.
        }
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

double wholeLibrary(const cocos::Roots& roots, const std::vector<Pass>& passes, bool disk) {
    ProcessStopwatch watch;
    const auto library = makeLibrary(roots, disk);
    for (const Pass& pass : passes) library->get(pass.request, {});
    return watch.lap();
}

/// Milliseconds. A fresh library for every round over all passes, until a thousand were loaded.
double loadThousand(const cocos::Roots& roots, const std::vector<Pass>& passes) {
    double sum = 0;
    std::size_t loaded = 0;
    for (; loaded < kLoads; loaded += passes.size()) sum += wholeLibrary(roots, passes, true);
    return sum * static_cast<double>(kLoads) / static_cast<double>(loaded);
}

/// glslang's process-wide tables, kept between libraries.
struct ShaderTables {
    ShaderTables() { glslang::InitializeProcess(); }
    ~ShaderTables() { glslang::FinalizeProcess(); }
    ShaderTables(const ShaderTables&) = delete;
    ShaderTables& operator=(const ShaderTables&) = delete;
};

int run(int argc, char** argv) {
    cocos::Roots roots;
    roots.engine = argc > 1 ? argv[1] : CREVICE_BENCH_COCOS;
    const fs::path cache = fs::temp_directory_path() / fmt::format("crevice-effect-bench-{}", getpid());
    setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    const ShaderTables tables;
    const std::vector<Pass> passes = collect(roots);  // warms them up
    if (passes.empty()) throw Error("no pass compiles", "give an engine checkout: crevice_effect_bench DIR");
    double alone = std::numeric_limits<double>::max(), whole = alone;
    for (int round = 0; round < kRounds; ++round) {
        alone = std::min(alone, glslangAlone(passes));
        whole = std::min(whole, wholeLibrary(roots, passes, false));
    }
    wholeLibrary(roots, passes, true);
    double load = std::numeric_limits<double>::max();
    for (int round = 0; round < kRounds; ++round) load = std::min(load, loadThousand(roots, passes));
    fs::remove_all(cache);
    fmt::print(
        "{} passes\nglslang alone      {:8.1f} ms\nwithout cache      {:8.1f} ms   {:.2f} times glslang\n"
        "1000 from the disk {:8.1f} ms\n",
        passes.size(), alone, whole, whole / alone, load);
    return 0;
}

}  // namespace
}  // namespace crevice::bench

int main(int argc, char** argv) try { return crevice::bench::run(argc, argv); } catch (const crevice::Error& error) {
    fmt::print(stderr, "{}\n", crevice::formatError(error));
    return 2;
}
