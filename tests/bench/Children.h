// Whole programs as the benchmark sees them: started, waited for, their processor time read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace crevice::bench {

struct ChildCost {
    double milliseconds = 0;  ///< Processor time, threads included.
    /// Most resident memory. Linux counts what the caller held at most when it started the program: start programs
    /// before loading much.
    std::uint64_t peakBytes = 0;
};

/// Throws Error when the program fails.
ChildCost runChild(const std::vector<std::string>& arguments);

/// Milliseconds of processor time that a program used, its threads included. Throws Error when it fails.
double childMilliseconds(const std::vector<std::string>& arguments);

}  // namespace crevice::bench
