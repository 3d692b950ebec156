// Processes of our own: how they end, and what is known of it.
#include <chrono>
#include <csignal>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/child_process.h"
#include "support/catch.h"

using namespace shoal;

namespace {

void sleepLong() {
    std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

TEST_CASE("a child's end is known, whichever it is", "[child-process]") {
    CHECK(*ChildProcess([] {}).wait(60) == 0);
    CHECK(exitCode(*ChildProcess([] { ::_exit(7); }).wait(60)) == 7);
    const int crashed = *ChildProcess([] { std::raise(SIGSEGV); }).wait(60);
    CHECK((WIFSIGNALED(crashed) && WTERMSIG(crashed) == SIGSEGV));
    CHECK(exitCode(crashed) == -1);
}

TEST_CASE("a child that does not end is waited for no longer than is said, and then ended",
          "[child-process]") {
    const auto start = std::chrono::steady_clock::now();
    pid_t process = 0;
    {
        int ends[2];
        REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
        ChildProcess child([&] {
            const pid_t own = ::getpid();
            if (::write(ends[1], &own, sizeof own) == sizeof own) sleepLong();
        });
        REQUIRE(::read(ends[0], &process, sizeof process) == sizeof process);
        ::close(ends[0]);
        ::close(ends[1]);
        CHECK_FALSE(child.wait(0.1).has_value());
        ::kill(process, SIGINT);  // as a terminal sends it to both: the parent decides
        CHECK_FALSE(child.wait(0.1).has_value());
    }
    CHECK(::kill(process, 0) != 0);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(60));
}

TEST_CASE("a program gets its words as they are, and a handler of its parent's is not its own",
          "[child-process]") {
    const MemoryFile input("in \n"), output, messages;
    const auto shell = startProgram({"/bin/sh", "-c", "cat; echo \"$1\"; echo bad >&2; exit 3", "sh", "a; b"},
                                    {input.file(), output.file(), messages.file()});
    CHECK(exitCode(*shell->wait(60)) == 3);
    CHECK(output.text() == "in \na; b\n");
    CHECK(lastWords(messages) == "bad");
    const auto missing = startProgram({"/nowhere"}, {input.file(), output.file(), messages.file()});
    CHECK(exitCode(*missing->wait(60)) == 127);
    CHECK(lastWords(MemoryFile(std::string(700, 'x'))) == "..." + std::string(600, 'x'));
}
