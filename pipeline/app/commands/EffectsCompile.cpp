// `crevice effects compile`: do these effects compile, in which variants, and to what?
#include <algorithm>
#include <cctype>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/EffectBindings.h"
#include "app/commands/EffectPaths.h"
#include "app/commands/EffectReport.h"
#include "app/commands/EffectVariants.h"
#include "cocos/reflection/EffectReflection.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice effects compile ssao vignette\n"
    "  crevice effects compile ssao --define SSAO_SAMPLES=16 --json\n"
    "  crevice effects compile ssao -p ssao-deferred --all-variants\n"
    "  crevice effects compile copy --text\n"
    "  crevice effects compile --engine cocos-engine\n";

struct CompileOptions {
    std::vector<std::string> effects, defines;
    std::string pipeline;
    CocosOptions cocos;
    PluginOptions plugins;
    ConsoleOptions console;
    bool allVariants = false, json = false, text = false, noCache = false;
};

void checkMacro(const std::string& name, const std::string& value) {
    const auto isWord = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
    if (!std::all_of(name.begin(), name.end(), isWord) || std::isdigit(static_cast<unsigned char>(name.front())) != 0)
        throw Error(fmt::format("--define: '{}' is no name of a macro", name),
                    "names have letters, digits and '_', and begin with no digit");
    if (value.empty())
        throw Error(fmt::format("--define: macro '{}' has no value", name), fmt::format("write --define {}=1", name));
}

/// One run of the command.
class CompileRun {
public:
    explicit CompileRun(const CompileOptions& options)
        : options_(options),
          progress_(options.console.quiet),
          log_(makeLog(options.console, progress_)),
          roots_(effectRoots(options.pipeline)),
          effects_(expandEffects(options.effects, roots_)),
          library_(roots_, log_, {.useDiskCache = !options.noCache}),
          report_(options.json, options.text, log_) {
        for (const std::string& define : options.defines) {
            auto [name, value] = parseAssignment("--define", define, "NAME=VALUE");
            checkMacro(name, value);
            given_[name] = value;
        }
        const bool cocos = readsCocos(options.cocos, effects_, roots_);
        // Without a pipeline Cocos' own numbers stay as they are written.
        if (!cocos || !options.pipeline.empty()) bindings_ = effectBindings(options.pipeline, options.plugins, log_);
        if (!cocos) return;
        auto reader = std::make_unique<cocos::CocosEffects>(cocosRoots(options.cocos, effects_));
        cocos_ = reader.get();
        library_.addFrontEnd(std::move(reader));
    }

    int run() {
        if (cocos_ == nullptr) checkDefines();
        for (const std::string& effect : effects_) {
            ++begun_;
            showProgress(effect);
            compileEffect(effect);
        }
        progress_.clear();
        report_.finish(effects_.size(), cocos_ != nullptr);
        return report_.failed() == 0 ? 0 : 1;
    }

private:
    /// Results may go to the same terminal: whoever prints one clears this first.
    void showProgress(const std::string& effect) {
        progress_.show(fmt::format("{} of {}: {}, {} done", begun_, effects_.size(), effect, done_));
    }
    void compileEffect(const std::string& name);
    void compilePass(const std::string& name, const EffectPass& pass, std::size_t technique, std::size_t index);
    void compileVariant(const VariantRequest& request, const EffectPass& pass);
    void reflect(const EffectAsset& effect);
    void checkDefines();
    std::vector<Defines> variantsOf(const VariantRequest& request, const std::vector<DefineInfo>& infos,
                                    const Defines& fixed) const;
    Defines definesFor(const std::vector<DefineInfo>& infos) const;

    const CompileOptions& options_;
    Progress progress_;
    Log log_;
    AssetRoots roots_;
    std::vector<std::string> effects_;
    EffectLibrary library_;
    cocos::CocosEffects* cocos_ = nullptr;  ///< Owned by the library; null = our own dialect.
    EffectReport report_;
    BindingMap bindings_;
    Defines given_;
    std::size_t begun_ = 0;  ///< Effects.
    std::size_t done_ = 0;   ///< Variants of passes.
};

/// An effect whose header cannot be read is bad input; one whose pass does not compile is a "no". Of a folder of Cocos'
/// effects the others are still worth an answer.
void CompileRun::compileEffect(const std::string& name) {
    const EffectAsset* effect = nullptr;
    try {
        effect = &library_.asset(name);
    } catch (const Error& error) {
        if (cocos_ == nullptr || effects_.size() == 1) throw;
        progress_.clear();
        report_.unreadable(name, formatError(error));
        return;
    }
    for (std::size_t t = 0; t < effect->techniques.size(); ++t) {
        const std::vector<EffectPass>& passes = effect->techniques[t].passes;
        for (std::size_t p = 0; p < passes.size(); ++p) compilePass(name, passes[p], t, p);
    }
    if (cocos_ != nullptr && options_.json) reflect(*effect);
    library_.dropVariants();  // a folder with all variants would fill the memory
}

void CompileRun::reflect(const EffectAsset& effect) {
    Problems problems;  // Said before, pass by pass.
    report_.addReflection(cocos::reflectEffect(*cocos_, effect, problems));
}

void CompileRun::compilePass(const std::string& name, const EffectPass& pass, std::size_t technique,
                             std::size_t index) {
    VariantRequest request{
        .effect = name, .technique = technique, .pass = index, .defines = {}, .where = {}, .checkOnly = true};
    // A macro set is switched over a whole folder: what a pass does not know says nothing to it.
    std::vector<Defines> variants{given_};
    if (cocos_ == nullptr || options_.allVariants) {
        try {
            std::vector<DefineInfo> infos = library_.discoverDefines(name, technique, index);
            const Defines fixed = definesFor(infos);
            // What a pass sets itself has one value.
            std::erase_if(infos, [&](const DefineInfo& info) { return pass.embeddedMacros.contains(info.name); });
            variants = options_.allVariants ? variantsOf(request, infos, fixed) : std::vector<Defines>{fixed};
        } catch (const Error& error) {
            progress_.clear();
            report_.failure(request, pass, error);
            return;
        }
    }
    for (const Defines& defines : variants) {
        request.defines = defines;
        compileVariant(request, pass);
    }
}

std::vector<Defines> CompileRun::variantsOf(const VariantRequest& request, const std::vector<DefineInfo>& infos,
                                            const Defines& fixed) const {
    VariantList list = enumerateVariants(infos, fixed);
    if (list.alone)
        log_.write(LogLevel::Note,
                   fmt::format("{} technique {} pass {}: {} macros have more than {} combinations: each value is tried "
                               "alone, {} variants",
                               request.effect, request.technique, request.pass, list.macros, kMaxCombinations,
                               list.variants.size()));
    return std::move(list.variants);
}

void CompileRun::compileVariant(const VariantRequest& request, const EffectPass& pass) {
    try {
        if (options_.text) {
            progress_.clear();
            for (const ShaderStageBits stage : {kVertexBit, kFragmentBit, kComputeBit})
                print(library_.text(request, stage));
        }
        const EffectVariant& variant = library_.get(request, bindings_);
        progress_.clear();
        report_.success(request, pass, variant);
    } catch (const Error& error) {
        std::vector<MissingName> missing = missingNames(error);
        if (cocos_ != nullptr && !missing.empty()) {
            Problems said;  // by the attempt to compile
            explainMissing(missing, cocos_->flatten(library_.asset(request.effect), pass, said));
        }
        progress_.clear();
        report_.failure(request, pass, error, missing);
    }
    ++done_;
    showProgress(request.effect);
}

Defines CompileRun::definesFor(const std::vector<DefineInfo>& infos) const {
    Defines defines;
    for (const DefineInfo& info : infos) {
        const auto given = given_.find(info.name);
        if (given != given_.end()) defines.insert(*given);
    }
    return defines;
}

/// A macro may be unknown to some of the passes, not to all of them.
void CompileRun::checkDefines() {
    std::vector<std::string> known;
    for (const std::string& name : effects_) {
        const std::vector<EffectTechnique>& techniques = library_.asset(name).techniques;
        for (std::size_t t = 0; t < techniques.size(); ++t) {
            for (std::size_t p = 0; p < techniques[t].passes.size() && !given_.empty(); ++p) {
                for (const DefineInfo& info : library_.discoverDefines(name, t, p)) known.push_back(info.name);
            }
        }
    }
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    for (const auto& [name, value] : given_) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw Error(fmt::format("--define: no pass of these effects tests macro '{}'", name),
                    known.empty() ? "they have no macros" : didYouMean(name, known, "macros"));
    }
}

/// Without a name: all effects of the project and the engine that are given, an engine's templates for new ones too.
void chooseEffects(CompileOptions& options) {
    if (!options.effects.empty()) return;
    const cocos::Roots roots = cocosRoots(options.cocos, {});
    std::error_code error;
    if (std::filesystem::is_directory(roots.projectAssets(), error))
        options.effects.push_back(roots.projectAssets().string());
    if (!roots.engine.empty() && std::filesystem::is_directory(roots.engineAssets() / "effects", error))
        options.effects.push_back(roots.engineAssets().string());
    if (options.effects.empty() && !roots.engine.empty())
        throw Error(fmt::format("--engine: '{}' holds no effects of an engine", options.cocos.engine),
                    "name the folder that holds editor/assets/effects");
    if (options.effects.empty()) throw Error("no effect given", "name one: crevice effects compile ssao");
}

int runCompile(CompileOptions options) {
    chooseEffects(options);
    if (options.json && options.text) throw Error("--json and --text contradict each other", "choose one of them");
    return CompileRun(options).run();
}

}  // namespace

void addEffectsCompileCommand(CLI::App& effects, Action& action) {
    CLI::App* command = effects.add_subcommand("compile", "Compile effects; exit code 1 when a pass fails");
    const auto options = std::make_shared<CompileOptions>();
    command->add_option("effect", options->effects, "Names, .effect files, or folders of them")->type_name("PATH");
    addCocosOptions(*command, options->cocos);
    command->add_option("--define", options->defines, "Value of a macro (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--all-variants", options->allVariants,
                      "Every combination of macros; above 128 each value alone");
    command->add_flag("--json", options->json,
                      "Results as JSON: sizes, resources, messages; for Cocos' effects their reflection");
    command->add_flag("--text", options->text, "Print the GLSL that is compiled");
    command->add_flag("--no-cache", options->noCache, "Compile all shaders anew");
    command->add_option("-p,--pipeline", options->pipeline, "Number set 0 as this pipeline does")
        ->type_name("PIPELINE");
    addPluginOptions(*command, options->plugins);
    addConsoleOptions(*command, options->console);
    command->footer(kExamples);
    command->callback([&action, options] { action = [options] { return runCompile(*options); }; });
}

}  // namespace crevice
