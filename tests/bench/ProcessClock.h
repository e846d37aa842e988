// The benchmark's clock: processor time of the whole process, all threads, which other programs disturb less than wall
// time.
#pragma once

#include <ctime>

namespace crevice::bench {

inline double processMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

/// Milliseconds since the last lap.
class ProcessStopwatch {
public:
    double lap() {
        const double now = processMilliseconds();
        const double elapsed = now - last_;
        last_ = now;
        return elapsed;
    }

private:
    double last_ = processMilliseconds();
};

}  // namespace crevice::bench
