// The subcommands: each adds itself to the parser and says what to run once parsing is over.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace crevice {

/// Set by the subcommand that was parsed; returns the exit code.
using Action = std::function<int()>;

void addRenderCommand(CLI::App& program, Action& action);

}  // namespace crevice
