// `crevice effects list | show`: which effects there are, and what one takes.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/EffectBindings.h"
#include "app/commands/TextTable.h"
#include "core/ParamText.h"
#include "core/Params.h"
#include "core/Text.h"

namespace crevice {
namespace {

constexpr const char* kListExamples =
    "Examples:\n"
    "  crevice effects list\n";
constexpr const char* kShowExamples =
    "Examples:\n"
    "  crevice effects show ssao\n"
    "  crevice effects show ssao-lighting -p ssao-deferred\n";

struct ShowOptions {
    std::string effect, pipeline;
    PluginOptions plugins;
};

std::string programsOf(const EffectPass& pass) {
    if (!pass.compute.empty()) return pass.compute;
    return pass.fragment.empty() ? pass.vertex : pass.vertex + " + " + pass.fragment;
}

std::string rangeText(double min, double max) {
    const bool hasMin = std::isfinite(min), hasMax = std::isfinite(max);
    if (hasMin && hasMax) return fmt::format("{} … {}", numberText(min), numberText(max));
    if (hasMin) return "≥ " + numberText(min);
    return hasMax ? "≤ " + numberText(max) : "";
}

std::string propertyText(const EffectPass& pass) {
    TextTable table;
    table.add({"property", "default", "range", "feeds", "help"});
    for (const EffectProperty& property : pass.properties) {
        table.add({property.name, property.value.isNull() ? "–" : property.value.toJson(-1),
                   rangeText(property.min, property.max), property.target, property.help});
    }
    return table.empty() ? "" : table.text(4);
}

std::string macroValues(const DefineInfo& info) {
    if (info.type == DefineType::Number && info.range)
        return fmt::format("{} … {}", info.range->first, info.range->second);
    if (info.type == DefineType::String) return join(info.options, " | ");
    return info.type == DefineType::Bool ? "0 | 1" : "";
}

std::string macroText(const std::vector<DefineInfo>& infos) {
    TextTable table;
    table.add({"macro", "default", "values"});
    for (const DefineInfo& info : infos) table.add({info.name, info.defaultValue, macroValues(info)});
    return table.empty() ? "" : table.text(4);
}

std::string resourceText(const ShaderInfo& info) {
    TextTable table;
    table.add({"resource", "kind", "set", "binding", "used"});
    for (const ShaderResource& resource : info.resources) {
        table.add({resource.name, kindName(resource.kind), std::to_string(resource.slot.set),
                   std::to_string(resource.slot.binding), resource.active ? "yes" : "no"});
    }
    return table.empty() ? "" : table.text(4);
}

int runShow(const ShowOptions& options) {
    if (options.effect.empty()) throw Error("no effect given", "name one: crevice effects show ssao");
    const Log log;
    EffectLibrary library(effectRoots(options.pipeline), log);
    const BindingMap bindings = effectBindings(options.pipeline, options.plugins, log);
    const EffectAsset& effect = library.asset(options.effect);
    print(fmt::format("{}: {}\n", effect.name, effect.path));
    for (std::size_t t = 0; t < effect.techniques.size(); ++t) {
        const EffectTechnique& technique = effect.techniques[t];
        for (std::size_t p = 0; p < technique.passes.size(); ++p) {
            const EffectPass& pass = technique.passes[p];
            print(fmt::format("\n  technique {}{}, pass {}: {}, phase {}\n", t,
                              technique.name.empty() ? "" : " '" + technique.name + "'", p, programsOf(pass),
                              pass.phase));
            print(propertyText(pass));
            print(macroText(library.discoverDefines(options.effect, t, p)));
            const VariantRequest request{options.effect, t, p, {}, {}};
            print(resourceText(library.get(request, bindings).info));
        }
    }
    return 0;
}

/// Words with commas in lines of at most `width` columns, where a word is not longer itself.
std::vector<std::string> wrapped(const std::vector<std::string>& words, std::size_t width) {
    std::vector<std::string> lines(1);
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string word = words[i] + (i + 1 < words.size() ? "," : "");
        if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width) lines.emplace_back();
        lines.back() += (lines.back().empty() ? "" : " ") + word;
    }
    return lines;
}

void addOnce(std::vector<std::string>& list, const std::string& word) {
    if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
}

void addEffectRows(TextTable& table, const EffectAsset& effect) {
    constexpr std::size_t kPhasesWidth = 24, kPropertiesWidth = 56;
    std::size_t passes = 0;
    std::vector<std::string> phases, properties;
    for (const EffectTechnique& technique : effect.techniques) {
        passes += technique.passes.size();
        for (const EffectPass& pass : technique.passes) {
            addOnce(phases, pass.phase);
            for (const EffectProperty& property : pass.properties) addOnce(properties, property.name);
        }
    }
    std::vector<std::string> left = wrapped(phases, kPhasesWidth), right = wrapped(properties, kPropertiesWidth);
    const std::size_t lines = std::max(left.size(), right.size());
    left.resize(lines);
    right.resize(lines);
    table.add({effect.name, std::to_string(passes), left[0], right[0]});
    for (std::size_t i = 1; i < lines; ++i) table.add({"", "", left[i], right[i]});
}

int runList() {
    const Log log;
    EffectLibrary library(AssetRoots::standard(), log);
    TextTable table;
    table.add({"effect", "passes", "phases", "properties"});
    for (const std::string& name : library.roots().list(AssetKind::Effect)) addEffectRows(table, library.asset(name));
    print(table.text());
    return 0;
}

}  // namespace

void addEffectsListCommand(CLI::App& effects, Action& action) {
    CLI::App* command = effects.add_subcommand("list", "Names of the effects below the asset roots");
    command->footer(kListExamples);
    command->callback([&action] { action = runList; });
}

void addEffectsShowCommand(CLI::App& effects, Action& action) {
    CLI::App* command = effects.add_subcommand("show", "Properties, macros and resources of an effect");
    const auto options = std::make_shared<ShowOptions>();
    command->add_option("effect", options->effect, "Name, or path of an .effect file")->type_name("NAME");
    command->add_option("-p,--pipeline", options->pipeline, "Number set 0 as this pipeline does")
        ->type_name("PIPELINE");
    addPluginOptions(*command, options->plugins);
    command->footer(kShowExamples);
    command->callback([&action, options] { action = [options] { return runShow(*options); }; });
}

void addEffectsCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("effects", "List, show and compile effects");
    addEffectsListCommand(*command, action);
    addEffectsShowCommand(*command, action);
    addEffectsCompileCommand(*command, action);
    command->footer("Examples:\n  crevice effects list\n  crevice effects compile --help\n");
    command->callback([&action, command] {
        if (command->get_subcommands().empty()) action = [] { return runList(); };
    });
}

}  // namespace crevice
