// Whole programs as the benchmark sees them: started, waited for, their processor time read.
#pragma once

#include <string>
#include <vector>

namespace crevice::bench {

/// Milliseconds of processor time that a program used, its threads included. Throws Error when it fails.
double childMilliseconds(const std::vector<std::string>& arguments);

}  // namespace crevice::bench
