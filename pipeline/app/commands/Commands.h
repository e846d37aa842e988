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
void addSheetCommand(CLI::App& program, Action& action);
void addValidateCommand(CLI::App& program, Action& action);
void addFlattenCommand(CLI::App& program, Action& action);
void addPlanCommand(CLI::App& program, Action& action);
void addImportCommand(CLI::App& program, Action& action);
void addStagesCommand(CLI::App& program, Action& action);
void addEffectsCommand(CLI::App& program, Action& action);
void addSchemaCommand(CLI::App& program, Action& action);
void addInfoCommand(CLI::App& program, Action& action);
void addLimitsCommand(CLI::App& program, Action& action);
void addReferenceCommand(CLI::App& program, Action& action);
void addCompareCommand(CLI::App& program, Action& action);
void addBenchAoCommand(CLI::App& program, Action& action);

// Below `effects`.
void addEffectsListCommand(CLI::App& effects, Action& action);
void addEffectsShowCommand(CLI::App& effects, Action& action);
void addEffectsCompileCommand(CLI::App& effects, Action& action);

}  // namespace crevice
