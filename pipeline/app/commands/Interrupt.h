// Lets a run that writes many files clean up when it is interrupted.
#pragma once

#include <csignal>

namespace crevice {

/// While it lives, SIGINT, SIGTERM and SIGHUP wait; check() notices them. At its end they take their course.
/// Make it before any thread starts, so that all threads inherit the wait.
class Interrupt {
public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    /// Throws RenderError when a signal waits.
    void check() const;

private:
    sigset_t signals_, before_;
};

}  // namespace crevice
