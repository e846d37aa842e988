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
    addSheetCommand(program, action);
    addValidateCommand(program, action);
    addFlattenCommand(program, action);
    addPlanCommand(program, action);
    addImportCommand(program, action);
    addStagesCommand(program, action);
    addEffectsCommand(program, action);
    addSchemaCommand(program, action);
    addInfoCommand(program, action);
    addLimitsCommand(program, action);
    addReferenceCommand(program, action);
    addCompareCommand(program, action);
    addBenchAoCommand(program, action);
}

int parseAndRun(int argc, char** argv) {
    CLI::App program("Render pipelines written as JSON documents", "crevice");
    Action action;
    program.set_version_flag("--version", "crevice " CREVICE_VERSION, "Print the version");
    program.footer(
        "Examples:\n"
        "  crevice render default -o default.png\n"
        "  crevice render --help\n");
    addCommands(program, action);
    try {
        program.parse(prepareArguments(argc, argv));
    } catch (const CLI::CallForHelp&) {
        action = [&program] { return print(program.help()), kDone; };
    } catch (const CLI::CallForVersion& version) {
        action = [text = std::string(version.what())] { return print(text + "\n"), kDone; };
    } catch (const CLI::Error& error) {
        throw explainUsage(program, error);
    }
    if (!action) throw Error("no subcommand given", "crevice --help lists them");
    const int code = action();
    flushResults();
    return code;
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
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond `ulimit -f` is an error in words, not the end
    return runCatching(argc, argv);
}

}  // namespace crevice
