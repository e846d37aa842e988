// The program `crevice`: parses the command line, runs one subcommand, turns its outcome into an exit code.
#pragma once

namespace crevice {

/// 0 done; 1 it ran and the answer is no, or the work failed; 2 bad input or usage.
int runProgram(int argc, char** argv);

}  // namespace crevice
