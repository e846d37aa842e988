// Blocked signals stay pending: no handler and no global flag is needed.
#include "app/commands/Interrupt.h"

#include "core/Error.h"

namespace crevice {

Interrupt::Interrupt() {
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction present {};
        sigaction(signal, nullptr, &present);
        if (present.sa_handler != SIG_IGN) sigaddset(&signals_, signal);  // nohup keeps its meaning
    }
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
}

Interrupt::~Interrupt() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

void Interrupt::check() const {
    sigset_t waiting;
    sigpending(&waiting);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        if (sigismember(&signals_, signal) == 1 && sigismember(&waiting, signal) == 1)
            throw RenderError("interrupted: nothing was written");
    }
}

}  // namespace crevice
