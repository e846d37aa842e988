// Mistakes on the command line in our own words.
#pragma once

#include <string>
#include <vector>

#include "core/Error.h"

namespace CLI {
class App;
class Error;
}  // namespace CLI

namespace crevice {

/// What the parser found wrong, with near names of options and subcommands.
Error explainUsage(const CLI::App& program, const CLI::Error& error);

/// The arguments in the reverse order that the parser takes, with a value that starts with '-' joined to its option:
/// `--eye -1,0,0` becomes `--eye=-1,0,0`.
std::vector<std::string> prepareArguments(int argc, char** argv);

}  // namespace crevice
