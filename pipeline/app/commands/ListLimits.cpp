// `crevice limits`: how much an input may ask for before it is refused.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands/Commands.h"
#include "app/commands/Console.h"
#include "app/commands/TextTable.h"
#include "core/Limits.h"

namespace crevice {
namespace {

constexpr const char* kExamples =
    "Examples:\n"
    "  crevice limits\n"
    "  crevice info default --limit vertices=200M\n";

TextTable limitTable() {
    TextTable table;
    table.add({"limit", "default", "unit", "what it bounds"});
    const Limits limits;
    visitLimits(limits, [&](const auto& field, const LimitInfo& info) {
        table.add({info.name, limitText(static_cast<std::size_t>(field), info.unit), info.unit, info.help});
    });
    return table;
}

}  // namespace

void addLimitsCommand(CLI::App& program, Action& action) {
    CLI::App* command = program.add_subcommand("limits", "List what bounds the memory that an input can ask for");
    const auto markdown = std::make_shared<bool>(false);
    command->add_flag("--markdown", *markdown, "As a table for documents");
    command->footer(kExamples);
    command->callback([&action, markdown] {
        action = [markdown] {
            print(*markdown ? limitTable().markdown() : limitTable().text());
            return 0;
        };
    });
}

}  // namespace crevice
