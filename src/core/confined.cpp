#include "core/confined.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <limits>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shoal {

namespace {

constexpr int outOfMemory = 3;           // exit code
constexpr size_t longestMessage = 1000;  // bytes
constexpr bool limitsMemory =
#if defined(__SANITIZE_ADDRESS__)
    false;
#else
    true;
#endif

double steadyTime() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Bytes of address space that this process has; 0 where nothing says it.
double addressSpace() {
    std::ifstream in("/proc/self/statm");
    double pages = 0;
    in >> pages;
    return pages * double(sysconf(_SC_PAGESIZE));
}

// Soft limits can be raised later, up to the hard one.
void setLimit(decltype(RLIMIT_AS) what, double soft, double most) {
    rlimit limit{};
    if (getrlimit(what, &limit) != 0) return;
    limit.rlim_max = std::min(limit.rlim_max, rlim_t(most));
    limit.rlim_cur = std::min(limit.rlim_max, rlim_t(soft));
    setrlimit(what, &limit);
}

// Drops the standard streams, because what a dying library prints is no message of ours, and closes the
// parent's files except the pipe.
void keepOnly(int pipe) {
    const int nothing = open("/dev/null", O_RDWR);
    for (int stream = 0; stream < 3 && nothing >= 0; ++stream)
        dup2(nothing, stream);
#ifdef SYS_close_range
    syscall(SYS_close_range, 3u, unsigned(pipe) - 1, 0u);
    syscall(SYS_close_range, unsigned(pipe) + 1, ~0u, 0u);
#endif
}

[[noreturn]] void workInChild(ToParent& parent, const std::string& file,
                              const std::function<void(ToParent&)>& work) {
    try {
        parent.limit();
        work(parent);
    } catch (const Error& error) {
        parent.refuse(error.message(), error.location().file == file ? error.location().line : 0);
    } catch (const std::bad_alloc&) {
        _exit(outOfMemory);
    } catch (const std::length_error&) {
        _exit(outOfMemory);
    } catch (const std::exception& error) {
        parent.refuse(concat("cannot be read: ", error.what()));
    } catch (...) {
        _exit(1);
    }
    _exit(0);
}

}  // namespace

void ToParent::limit() const {
    setLimit(RLIMIT_CPU, limits_.secondsFor(fileBytes_), limits_.mostSeconds);
    if (limitsMemory && memoryBefore_ > 0)
        setLimit(RLIMIT_AS, memoryBefore_ + limits_.memoryFor(fileBytes_),
                 memoryBefore_ + limits_.mostMemory);
}

void ToParent::opened(uint64_t fileBytes) {
    fileBytes_ += double(fileBytes);
    record('F', nullptr, fileBytes);
    limit();
}

void ToParent::refuse(const std::string& message, int line) {
    record('L', nullptr, uint64_t(line));
    record('E', message.data(), std::min(message.size(), longestMessage));
}

void ToParent::record(char kind, const void* data, uint64_t bytes) {
    write(&kind, 1);
    write(&bytes, sizeof bytes);
    if (data) write(data, size_t(bytes));
}

void ToParent::write(const void* data, size_t bytes) {
    const char* from = static_cast<const char*>(data);
    while (bytes > 0) {
        const ssize_t count = ::write(pipe_, from, bytes);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) _exit(1);
        from += count;
        bytes -= size_t(count);
    }
}

Confined::Confined(const Location& file, const ConfinedLimits& limits,
                   const std::function<void(ToParent&)>& work)
    : file_(file), limits_(limits), start_(steadyTime()) {
    const double memoryBefore = addressSpace();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail(concat("no pipe to a reader: ", std::strerror(errno)));
    pipe_ = ends[0];
    const auto inChild = [&] {
        prctl(PR_SET_DUMPABLE, 0);                    // a crash leaves no core
        std::signal(SIGXCPU, SIG_DFL);                // of the limit, also where the parent ignores it
        const int pipe = fcntl(ends[1], F_DUPFD, 3);  // beyond the streams, which may be closed
        keepOnly(pipe);
        std::set_new_handler([] { _exit(outOfMemory); });
        ToParent to(pipe, limits, memoryBefore);
        workInChild(to, file.file, work);
    };
    try {
        child_ = std::make_unique<ChildProcess>(inChild);
    } catch (const Error& error) {
        close(ends[0]);
        close(ends[1]);
        fail(error.message());
    }
    close(ends[1]);
}

Confined::~Confined() {
    close(pipe_);
}

uint64_t Confined::nextArray(size_t elementBytes) {
    for (;;) {
        char kind = 0;
        uint64_t bytes = 0;
        read(&kind, 1);
        read(&bytes, sizeof bytes);
        if (kind == 'F') {
            fileBytes_ += double(bytes);
        } else if (kind == 'L' && bytes <= uint64_t(std::numeric_limits<int>::max())) {
            file_.line = int(bytes);
        } else if (kind == 'E' && bytes <= longestMessage) {
            std::string message(size_t(bytes), ' ');
            read(message.data(), message.size());
            throw Error(file_, message);
        } else {
            // The child's word is not taken for it: its memory may be another's by now.
            taken_ += double(bytes);
            if (kind != 'A' || bytes % elementBytes != 0 || taken_ > limits_.memoryFor(fileBytes_))
                fail("its reader went astray");
            return bytes;
        }
    }
}

void Confined::read(void* data, size_t bytes) {
    char* to = static_cast<char*>(data);
    while (bytes > 0) {
        const double left = start_ + limits_.clockFor(fileBytes_) - steadyTime();
        if (left <= 0) failTime(limits_.clockFor(fileBytes_), "");
        pollfd ready{pipe_, POLLIN, 0};
        const int some = poll(&ready, 1, int(std::min(1000 * left + 1, 1e6)));
        if (some == 0 || (some < 0 && errno == EINTR)) continue;
        const ssize_t count = ::read(pipe_, to, bytes);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count < 0) fail(concat("nothing comes from its reader: ", std::strerror(errno)));
        if (count == 0) failEnded();
        to += count;
        bytes -= size_t(count);
    }
}

void Confined::fail(const std::string& message) const {
    throw Error(file_, "cannot be read: " + message);
}

std::string Confined::filesText() const {
    return concat("the most for files of ", std::uint64_t(fileBytes_),
                  " bytes in all (SHOAL_TRUST_MODELS=1 reads without limits)");
}

void Confined::failTime(double seconds, const char* what) const {
    fail(concat("takes more than ", seconds, " s", what, ", ", filesText()));
}

void Confined::failEnded() {
    const int status = *child_->wait(1e9);  // the pipe is closed: it has ended, or is about to
    const double seconds = limits_.secondsFor(fileBytes_);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) failTime(seconds, " of processor time");
    if (WIFSIGNALED(status))
        fail(concat("its reader crashed (", strsignal(WTERMSIG(status)),
                    "), so the file is damaged or unusual"));
    if (WIFEXITED(status) && WEXITSTATUS(status) == outOfMemory)
        fail(concat("takes more than ", std::round(limits_.memoryFor(fileBytes_) / 1e6), " MB of memory, ",
                    filesText()));
    fail("its reader ended early");
}

}  // namespace shoal
