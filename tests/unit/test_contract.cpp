// A broken contract ends the program and says which and where, in every build that is tested.
#include <array>
#include <csignal>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/contract.h"
#include "support/catch.h"

namespace {

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

}  // namespace

TEST_CASE("a broken contract ends the program and says which", "[contract]") {
    const int three = 3;
    const End broken = endOf([&] { EXPECTS(1 + 1 == three && "sums are right"); });
    CHECK(broken.signal == SIGABRT);
    CHECK_THAT(broken.said, Catch::Contains("test_contract.cpp:") &&
                                Catch::Contains(": broken contract: 1 + 1 == three && \"sums are right\""));
    const End kept = endOf([&] { EXPECTS(1 + 2 == three); });
    CHECK(kept.signal == 0);
    CHECK(kept.said.empty());
}
