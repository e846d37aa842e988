// One parser with all subcommands; whatever is thrown ends here as a message and an exit code.
#include "app/commands/Program.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/Usage.h"
#include "core/Error.h"

namespace crevice {
namespace {

constexpr int kDone = 0, kFailed = 1, kBadInput = 2;

void reportError(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

void addCommands(CLI::App& program, Action& action) {
    addRenderCommand(program, action);
    addValidateCommand(program, action);
    addFlattenCommand(program, action);
    addPlanCommand(program, action);
    addStagesCommand(program, action);
    addEffectsCommand(program, action);
    addSchemaCommand(program, action);
    addInfoCommand(program, action);
    addCompareCommand(program, action);
}

int parseAndRun(int argc, char** argv) {
    CLI::App program("Render pipelines written as JSON documents", "crevice");
    Action action;
    program.set_version_flag("--version", std::string("crevice ") + kVersion, "Print the version");
    program.footer("`crevice COMMAND --help` tells more and shows examples.");
    addCommands(program, action);
    try {
        program.parse(prepareArguments(argc, argv));
    } catch (const CLI::CallForHelp&) {
        print(program.help());
        return kDone;
    } catch (const CLI::CallForVersion& version) {
        print(std::string(version.what()) + "\n");
        return kDone;
    } catch (const CLI::Error& error) {
        throw explainUsage(program, error);
    }
    if (!action) throw Error("no subcommand given", "crevice --help lists them");
    return action();
}

int runCatching(int argc, char** argv) {
    try {
        return parseAndRun(argc, argv);
    } catch (const RenderError& error) {
        reportError(formatError(error));
        return kFailed;
    } catch (const Error& error) {
        reportError(formatError(error));
        return kBadInput;
    } catch (const std::bad_alloc&) {
        reportError("error: out of memory\nhelp: choose a smaller --size or scene");
        return kFailed;
    } catch (const std::exception& error) {
        reportError(std::string("error: ") + error.what());
        return kFailed;
    }
}

}  // namespace

int runProgram(int argc, char** argv) {
    std::signal(SIGPIPE, SIG_IGN);  // `crevice plan … | head` is no failure
    const int code = runCatching(argc, argv);
    if (flushResults()) return code;
    reportError("error: the results cannot be written to the standard output");
    return code == kDone ? kFailed : code;
}

}  // namespace crevice
