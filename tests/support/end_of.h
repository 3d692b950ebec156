// How a piece of work ends that may end the program.
#pragma once

#include <array>
#include <csignal>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/catch.h"

namespace shoal::test {

struct End {
    std::string said;
    int signal = 0;
};

// Does the work in a process of its own. Returns what it says on standard error, and the signal that ends it.
template <typename Work>
End endOf(const Work& work) {
    std::array<int, 2> pipe{};
    REQUIRE(::pipe(pipe.data()) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const rlimit none{0, 0};
        ::setrlimit(RLIMIT_CORE, &none);
        std::signal(SIGABRT, SIG_DFL);
        ::dup2(pipe[1], STDERR_FILENO);
        work();
        ::_exit(0);
    }
    ::close(pipe[1]);
    End end;
    char part[256];
    for (ssize_t bytes = 0; (bytes = ::read(pipe[0], part, sizeof part)) > 0;)
        end.said.append(part, size_t(bytes));
    ::close(pipe[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    return end;
}

}  // namespace shoal::test
