#include "run/signals.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string_view>

#include "core/contract.h"
#include "core/error.h"
#include "core/file.h"

namespace shoal {

namespace {

// A handler may touch these, and any thread may run it.
std::atomic<int> asked = 0;
std::atomic<bool> finishes = false, ends = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

bool onTerminal = false;  // there the line has begun, with a bar and ^C

void say(std::string_view line) {
    if (::write(STDERR_FILENO, line.data(), line.size()) < 0) return;  // nobody reads it: no matter
}

void onSignal(int signal) {
    const int before = errno;
    int none = 0;
    if (onTerminal) say("\n");
    if (!finishes || !asked.compare_exchange_strong(none, signal)) {
        if (ends.exchange(true)) ::pause();  // another thread is at it
        const char digits[] = {char('0' + signal / 10), char('0' + signal % 10)};
        say("shoal: stopped by signal ");
        say(std::string_view(digits + (signal < 10), signal < 10 ? 1 : 2));
        say("; what was not whole is removed\n");
        endBySignal(signal);
    }
    say("shoal: stops after this frame; a second signal ends it at once\n");
    errno = before;
}

}  // namespace

void catchSignals() {
    onTerminal = ::isatty(STDERR_FILENO) != 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        ::sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;
        action = {};
        action.sa_handler = onSignal;
        action.sa_flags = SA_RESTART;
        ::sigaction(signal, &action, nullptr);
    }
}

FinishesOnSignal::FinishesOnSignal() {
    EXPECTS(!finishes);
    finishes = true;
}

FinishesOnSignal::~FinishesOnSignal() {
    finishes = false;
}

void leaveSignalsToMain() {
    sigset_t all;
    sigfillset(&all);
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP})  // faults of the thread's own
        sigdelset(&all, own);
    ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

int signalThatAsked() {
    return asked;
}

std::string stoppedBySignal() {
    return concat("stopped by signal ", int(asked), " (", ::strsignal(asked), ")");
}

void endBySignal(int signal) {
    removePartFiles();
    struct sigaction plain {};
    plain.sa_handler = SIG_DFL;
    ::sigaction(signal, &plain, nullptr);
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &held, nullptr);
    ::raise(signal);
    ::_exit(128 + signal);  // the first process of a container is not ended by a signal of its own
}

}  // namespace shoal
