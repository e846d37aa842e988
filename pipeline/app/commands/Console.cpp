// stdio underneath: results and messages keep their order, a closed pipe is no failure.
#include "app/commands/Console.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "core/Error.h"

namespace crevice {
namespace {

LogLevel detailOf(const ConsoleOptions& options) {
    if (options.quiet && options.verbose) {
        throw Error("-q and -v contradict each other", "give one: -q shows errors only, -v tells more");
    }
    return options.quiet ? LogLevel::Error : options.verbose ? LogLevel::Verbose : LogLevel::Note;
}

void checkWrite(int reason) {
    if (reason == EPIPE) return;
    throw RenderError(fmt::format("the results cannot be written to the standard output: {}", std::strerror(reason)));
}

}  // namespace

void addConsoleOptions(CLI::App& command, ConsoleOptions& options) {
    command.add_flag("-q,--quiet", options.quiet, "Errors only");
    command.add_flag("-v,--verbose", options.verbose, "Tell what is done: device, sizes, automatic values");
}

Progress::Progress(bool quiet) : terminal_(!quiet && isatty(STDERR_FILENO) == 1) {}

void Progress::show(std::string_view text) {
    if (!terminal_) return;
    std::fprintf(stderr, "\r\033[K%.*s", static_cast<int>(text.size()), text.data());
    std::fflush(stderr);
    shown_ = true;
}

void Progress::clear() {
    if (!shown_) return;
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    shown_ = false;
}

Log makeLog(const ConsoleOptions& options, Progress& progress) {
    return Log(detailOf(options), [&progress](LogLevel, std::string_view message) {
        progress.clear();
        std::fprintf(stderr, "%.*s\n", static_cast<int>(message.size()), message.data());
    });
}

Log makeLog(const ConsoleOptions& options) { return Log(detailOf(options)); }

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) checkWrite(errno);
}

void flushResults() {
    if (std::fflush(stdout) != 0) checkWrite(errno);
}

}  // namespace crevice
