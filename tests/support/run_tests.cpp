// Catch2's own code, which is slow to compile: once for all test programs.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // GCC 12 in std::regex, with sanitizers
#endif
#define CATCH_CONFIG_RUNNER
// Its handlers of signals take memory: after a crash within malloc they wait for ever.
#define CATCH_CONFIG_NO_POSIX_SIGNALS
#include "support/run_tests.h"

#include <csignal>
#include <cstdio>
#include <cstring>

#include <execinfo.h>
#include <unistd.h>

#include "support/catch.h"

namespace {

#if __has_include(<catch2/catch_all.hpp>)
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

// A test that takes as long as this hangs, s.
#if defined(__SANITIZE_ADDRESS__)
constexpr unsigned longest = 7200;
#else
constexpr unsigned longest = 1200;
#endif

char running[200];  // name of a test

// Takes no memory, since what crashed may have been within malloc.
[[noreturn]] void end(int signal) {
    const auto print = [](const char* text) { (void)!::write(STDERR_FILENO, text, std::strlen(text)); };
    void* frames[64];
    ::backtrace_symbols_fd(frames, ::backtrace(frames, 64), STDERR_FILENO);
    // Last, where a log that was cut still has it, with the innermost frames once more.
    print(signal == SIGALRM ? "This test hangs: " : "This test crashes: ");
    print(running);
    print(", here:\n");
    ::backtrace_symbols_fd(frames, ::backtrace(frames, 12), STDERR_FILENO);
    ::_exit(1);
}

// Names the test that hangs, where otherwise nothing would ever end.
struct HangingTests : Listener {
    using Listener::Listener;
    void testCaseStarting(const Catch::TestCaseInfo& info) override {
        Listener::testCaseStarting(info);
        std::snprintf(running, sizeof running, "%s", info.name.c_str());
        ::alarm(longest);
    }
};

CATCH_REGISTER_LISTENER(HangingTests)

}  // namespace

int runTests(int argumentCount, char** arguments) {
    void* frame = nullptr;
    ::backtrace(&frame, 1);  // loads what end() needs
    std::signal(SIGALRM, end);
#if !defined(__SANITIZE_ADDRESS__)
    for (const int crash : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV})
        std::signal(crash, end);
#endif
    return Catch::Session().run(argumentCount, arguments);
}
