// Where the program's words go: results to stdout, messages to stderr, a progress line on terminals only.
#pragma once

#include <string_view>

#include "core/Log.h"

namespace CLI {
class App;
}

namespace crevice {

/// -q and -v.
struct ConsoleOptions {
    bool quiet = false;
    bool verbose = false;
};
void addConsoleOptions(CLI::App& command, ConsoleOptions& options);

/// One line on stderr that is overwritten; nothing when stderr is no terminal or `quiet`.
class Progress {
public:
    explicit Progress(bool quiet);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(std::string_view text);
    void clear();

private:
    bool terminal_ = false;
    bool shown_ = false;
};

/// A log that takes the progress line away before it writes. `progress` must outlive it.
Log makeLog(const ConsoleOptions& options, Progress& progress);
Log makeLog(const ConsoleOptions& options);

/// A result to stdout, as it is. Throws RenderError when it cannot be written; a reader that closed its pipe has read
/// enough.
void print(std::string_view text);
void flushResults();

}  // namespace crevice
