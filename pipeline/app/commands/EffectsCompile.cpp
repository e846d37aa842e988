// `crevice effects compile`: do these effects compile, in which variants, and to what?
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/commands/ArgumentText.h"
#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/EffectBindings.h"
#include "app/commands/EffectVariants.h"
#include "core/Text.h"

namespace crevice {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice effects compile ssao vignette\n"
    "  crevice effects compile ssao --define SSAO_SAMPLES=16 --json\n"
    "  crevice effects compile ssao -p ssao-deferred --all-variants\n"
    "  crevice effects compile copy --text\n";

struct CompileOptions {
    std::vector<std::string> effects, defines;
    std::string pipeline;
    PluginOptions plugins;
    ConsoleOptions console;
    bool allVariants = false, json = false, text = false, noCache = false;
};

/// One run of the command.
class CompileRun {
public:
    explicit CompileRun(const CompileOptions& options)
        : options_(options),
          log_(makeLog(options.console)),
          library_(effectRoots(options.pipeline), log_, {.useDiskCache = !options.noCache}),
          bindings_(effectBindings(options.pipeline, options.plugins, log_)) {
        for (const std::string& define : options.defines) {
            auto [name, value] = parseAssignment("--define", define, "NAME=VALUE");
            given_[name] = value;
        }
    }

    int run() {
        checkDefines();
        for (const std::string& effect : options_.effects) compileEffect(effect);
        if (options_.json) {
            print(results_.dump(2) + "\n");
        } else if (!options_.text) {
            print(fmt::format("{} compiled, {} failed; {} effect{}\n", compiled_, failed_, options_.effects.size(),
                              options_.effects.size() == 1 ? "" : "s"));
        }
        return failed_ == 0 ? 0 : 1;
    }

private:
    void compileEffect(const std::string& name);
    void compilePass(const std::string& name, const EffectPass& pass, std::size_t technique, std::size_t index);
    void compileVariant(const VariantRequest& request, const EffectPass& pass);
    void reportVariant(const VariantRequest& request, const EffectPass& pass, const EffectVariant* variant,
                       const std::string& message);
    void checkDefines();
    Defines definesFor(const std::vector<DefineInfo>& infos) const;

    const CompileOptions& options_;
    Log log_;
    EffectLibrary library_;
    BindingMap bindings_;
    Defines given_;
    std::size_t compiled_ = 0, failed_ = 0;
    Json results_ = Json::array();
};

std::string definesText(const Defines& defines) {
    std::string text;
    for (const auto& [name, value] : defines) text += fmt::format(" {}={}", name, value);
    return text;
}

Json resourcesJson(const ShaderInfo& info) {
    Json resources = Json::array();
    for (const ShaderResource& resource : info.resources) {
        resources.push_back({{"name", resource.name},
                             {"kind", kindName(resource.kind)},
                             {"set", resource.slot.set},
                             {"binding", resource.slot.binding},
                             {"size", resource.size},
                             {"active", resource.active}});
    }
    return resources;
}

/// An effect whose header cannot be read is bad input; one whose pass does not compile is a "no".
void CompileRun::compileEffect(const std::string& name) {
    const EffectAsset& effect = library_.asset(name);
    for (std::size_t t = 0; t < effect.techniques.size(); ++t) {
        const std::vector<EffectPass>& passes = effect.techniques[t].passes;
        for (std::size_t p = 0; p < passes.size(); ++p) compilePass(name, passes[p], t, p);
    }
}

void CompileRun::compilePass(const std::string& name, const EffectPass& pass, std::size_t technique,
                             std::size_t index) {
    VariantRequest request{.effect = name, .technique = technique, .pass = index, .defines = {}, .where = {}};
    std::vector<DefineInfo> infos;
    try {
        infos = library_.discoverDefines(name, technique, index);
    } catch (const Error& error) {
        reportVariant(request, pass, nullptr, formatError(error));
        return;
    }
    const Defines fixed = definesFor(infos);
    const std::vector<Defines> variants =
        options_.allVariants ? enumerateVariants(infos, fixed) : std::vector<Defines>{fixed};
    for (const Defines& defines : variants) {
        request.defines = defines;
        compileVariant(request, pass);
    }
}

void CompileRun::compileVariant(const VariantRequest& request, const EffectPass& pass) {
    if (options_.text) {
        for (const ShaderStageBits stage : {kVertexBit, kFragmentBit, kComputeBit})
            print(library_.text(request, stage));
    }
    try {
        reportVariant(request, pass, &library_.get(request, bindings_), {});
    } catch (const Error& error) {
        reportVariant(request, pass, nullptr, formatError(error));
    }
}

void CompileRun::reportVariant(const VariantRequest& request, const EffectPass& pass, const EffectVariant* variant,
                               const std::string& message) {
    ++(variant ? compiled_ : failed_);
    const auto bytes = [](const std::vector<std::uint32_t>& words) { return words.size() * sizeof(std::uint32_t); };
    if (options_.json) {
        Json result = {{"effect", request.effect}, {"technique", request.technique}, {"pass", request.pass},
                       {"phase", pass.phase},      {"defines", request.defines},     {"ok", variant != nullptr}};
        if (variant) {
            result["bytes"] = {{"vertex", bytes(variant->vertex)},
                               {"fragment", bytes(variant->fragment)},
                               {"compute", bytes(variant->compute)}};
            result["resources"] = resourcesJson(variant->info);
        } else {
            result["message"] = message;
        }
        results_.push_back(std::move(result));
        return;
    }
    if (!variant) log_.write(LogLevel::Error, fmt::format("'{}' does not compile", request.effect));
    if (!variant) std::fprintf(stderr, "%s\n", message.c_str());
    if (options_.text) return;
    const std::size_t size = variant ? bytes(variant->vertex) + bytes(variant->fragment) + bytes(variant->compute) : 0;
    print(fmt::format("{} {} technique {} pass {} ({}){}{}\n", variant ? "ok    " : "FAILED", request.effect,
                      request.technique, request.pass, pass.phase, definesText(request.defines),
                      variant ? fmt::format(": {} bytes of SPIR-V", size) : ""));
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
    for (const std::string& name : options_.effects) {
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

int runCompile(const CompileOptions& options) {
    if (options.effects.empty()) throw Error("no effect given", "name one: crevice effects compile ssao");
    if (options.json && options.text) throw Error("--json and --text contradict each other", "choose one of them");
    return CompileRun(options).run();
}

}  // namespace

void addEffectsCompileCommand(CLI::App& effects, Action& action) {
    CLI::App* command = effects.add_subcommand("compile", "Compile effects; exit code 1 when a pass fails");
    const auto options = std::make_shared<CompileOptions>();
    command->add_option("effect", options->effects, "Names, or paths of .effect files")->type_name("NAME");
    command->add_option("--define", options->defines, "Value of a macro (repeatable)")
        ->type_name("NAME=VALUE")
        ->allow_extra_args(false);
    command->add_flag("--all-variants", options->allVariants, "Every combination of macros, or each alone when many");
    command->add_flag("--json", options->json, "Results as JSON: sizes, resources, messages");
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
