#include "core/child_process.h"

#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/error.h"

namespace shoal {

namespace {

using Clock = std::chrono::steady_clock;

// Handlers of the parent's (of crashes, of Ctrl-C) would act on what is not theirs here. What it ignores
// stays so, as it does over exec.
void forgetHandlers() {
    for (int signal = 1; signal < NSIG; ++signal) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler == SIG_IGN) continue;
        std::signal(signal, SIG_DFL);  // of those that cannot be caught it fails, and need not succeed
    }
}

}  // namespace

ChildProcess::ChildProcess(const std::function<void()>& work) {
    // No handler of the parent's runs between the fork and forgetHandlers().
    sigset_t all, before, ending;
    sigfillset(&all);
    sigemptyset(&ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&ending, signal);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);     // nobody waits any more
        if (getppid() != parent) _exit(127);  // who has died before that sends no signal
        forgetHandlers();
        pthread_sigmask(SIG_SETMASK, &ending, nullptr);
        work();
        _exit(0);
    }
    const int why = errno;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (process_ < 0) throw Error(concat("no process can be made: ", std::strerror(why)));
}

ChildProcess::~ChildProcess() {
    end();
}

std::optional<int> ChildProcess::wait(double seconds) {
    const auto limit = Clock::now() + std::chrono::duration<double>(seconds);
    for (auto pause = std::chrono::milliseconds(1); process_ > 0;) {
        int status = 0;
        const pid_t ended = waitpid(process_, &status, WNOHANG);
        if (ended == process_ || (ended < 0 && errno != EINTR)) {
            status_ = ended > 0 ? status : 0;
            process_ = -1;
        } else if (Clock::now() >= limit) {
            return std::nullopt;
        } else {
            std::this_thread::sleep_for(pause);
            pause = std::min(2 * pause, std::chrono::milliseconds(20));
        }
    }
    return status_;
}

void ChildProcess::end() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    int status = 0;
    pid_t ended = -1;
    while ((ended = waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
    }
    status_ = ended > 0 ? status : 0;
    process_ = -1;
}

MemoryFile::MemoryFile(const std::string& text) : file_(memfd_create("shoal", MFD_CLOEXEC)) {
    if (file_ < 0) throw Error(concat("no file can be made in memory: ", std::strerror(errno)));
    for (size_t done = 0; done < text.size();) {
        const ssize_t part = ::write(file_, text.data() + done, text.size() - done);
        if (part <= 0) {
            close(file_);
            throw Error("a file in memory cannot be written");
        }
        done += size_t(part);
    }
    lseek(file_, 0, SEEK_SET);
}

MemoryFile::~MemoryFile() {
    close(file_);
}

std::string MemoryFile::text() const {
    std::string out;
    char chunk[4096];
    ssize_t count;
    while ((count = pread(file_, chunk, sizeof chunk, off_t(out.size()))) > 0)
        out.append(chunk, size_t(count));
    return out;
}

std::unique_ptr<ChildProcess> startProgram(std::vector<std::string> command, const ProgramStreams& streams) {
    std::vector<char*> argv;
    for (std::string& word : command)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    return std::make_unique<ChildProcess>([&] {
        // Only calls that are safe between fork and exec.
        dup2(streams.in, STDIN_FILENO);
        dup2(streams.out, STDOUT_FILENO);
        dup2(streams.err, STDERR_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    });
}

int exitCode(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string lastWords(const MemoryFile& file) {
    constexpr size_t most = 600;
    std::string text = file.text();
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    return text.size() > most ? "..." + text.substr(text.size() - most) : text;
}

}  // namespace shoal
