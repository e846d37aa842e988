// The parser's exceptions carry English of their own; only their kind and the names in them are used here.
#include "app/commands/Usage.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "core/Text.h"

namespace crevice {
namespace {

/// Options whose value may begin with a minus sign.
constexpr std::array kSignedOptions = {"--eye",  "--target", "--up",   "--fov",  "--ortho", "--near",   "--far",
                                       "--size", "--frames", "--seed", "--rmse", "--max",   "--columns"};

const CLI::App& deepest(const CLI::App& app) {
    for (const CLI::App* sub : app.get_subcommands({})) {
        if (sub->parsed()) return deepest(*sub);
    }
    return app;
}

std::vector<std::string> optionNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    return names;
}

std::vector<std::string> subcommandNames(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands({})) names.push_back(sub->get_name());
    return names;
}

/// "crevice effects": the words that lead to a subcommand.
std::string commandOf(const CLI::App& app) {
    return app.get_parent() ? commandOf(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

Error explainExtra(const CLI::App& app, const std::string& extra) {
    const std::string helpCommand = fmt::format("{} --help shows what it takes", commandOf(app));
    if (extra.starts_with('-') && extra.size() > 1) {
        const std::string name = extra.substr(0, extra.find('='));
        const std::vector<std::string> near = nearestNames(name, optionNames(app));
        return Error(fmt::format("unknown option '{}'", name),
                     near.empty() ? helpCommand : fmt::format("did you mean '{}'? {}", near.front(), helpCommand));
    }
    const std::vector<std::string> subcommands = subcommandNames(app);
    if (!subcommands.empty()) {
        return Error(fmt::format("unknown subcommand '{}'", extra), didYouMean(extra, subcommands, "subcommands"));
    }
    return Error(fmt::format("unexpected argument '{}'", extra), helpCommand);
}

}  // namespace

Error explainUsage(const CLI::App& program, const CLI::Error& error) {
    const CLI::App& app = deepest(program);
    const std::string text = error.what();
    const std::string helpCommand = fmt::format("{} --help shows how to use it", commandOf(app));
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        std::vector<std::string> extras = app.remaining(true);
        if (extras.empty()) extras = program.remaining(true);
        if (!extras.empty()) return explainExtra(app, extras.front());
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
        const std::string name = text.substr(0, text.find(':'));
        const bool repeated = text.find("received") != std::string::npos;  // "At most 1 required but received 2"
        return Error(repeated ? fmt::format("option '{}' is given more than once", name)
                              : fmt::format("option '{}' needs a value", name),
                     helpCommand);
    }
    return Error(text, helpCommand);
}

std::vector<std::string> prepareArguments(int argc, char** argv) {
    std::vector<std::string> arguments;
    for (int i = 1; i < argc; ++i) {
        std::string argument = argv[i];
        const bool takesSigned =
            std::find(kSignedOptions.begin(), kSignedOptions.end(), argument) != kSignedOptions.end();
        if (takesSigned && i + 1 < argc && argv[i + 1][0] == '-') {
            const char next = argv[i + 1][1];
            if (std::isdigit(static_cast<unsigned char>(next)) || next == '.') argument += std::string("=") + argv[++i];
        }
        arguments.push_back(std::move(argument));
    }
    std::reverse(arguments.begin(), arguments.end());
    return arguments;
}

}  // namespace crevice
