// Runs the program on a case in a folder of its own and says what it printed, returned and left behind.
#pragma once

#include <string>
#include <vector>

#include "CaseFile.h"

namespace crevice::errors {

struct Answer {
    int exitCode = -1;     ///< -1: a signal ended it, or it took longer than the limit.
    std::string end;       ///< How it ended, in words.
    std::string results;   ///< stdout.
    std::string messages;  ///< stderr; the folder of the case is $CASE, that of shipped assets $DATA, their lines LINE.
    std::vector<std::string> newFiles;  ///< Files that were not there before, and inputs that changed.
};

Answer runCase(const Case& theCase);

}  // namespace crevice::errors
