// posix_spawn and wait4: the kernel counts a child's processor time for its parent.
#include "Children.h"

#include <sys/resource.h>
#include <sys/wait.h>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/Error.h"

namespace crevice::bench {
namespace {

double milliseconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_usec) * 1e-3;
}

}  // namespace

ChildCost runChild(const std::vector<std::string>& arguments) {
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = posix_spawn(&child, argv[0], &quiet, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&quiet);
    if (failed != 0) throw Error(fmt::format("cannot start '{}'", arguments[0]), "build the target crevice_program");
    int status = 0;
    rusage usage{};
    if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(fmt::format("'{}' failed", arguments[0]), "its message is above");
    return {milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime), std::uint64_t(usage.ru_maxrss) * 1024};
}

double childMilliseconds(const std::vector<std::string>& arguments) { return runChild(arguments).milliseconds; }

}  // namespace crevice::bench
