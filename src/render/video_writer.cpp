#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "core/printable.h"
#include "render/picture.h"

namespace shoal {

// Looked up here so that a missing program is told from one that failed.
bool VideoWriter::installed() {
    return !findProgram("ffmpeg").empty();
}

void VideoWriter::checkInstalled() {
    if (!installed())
        throw Error(
            "a video needs the ffmpeg command, which is not installed (on Debian and Ubuntu: apt install "
            "ffmpeg); name a folder to get PNG pictures instead");
}

namespace {

// ffmpeg gets what ends the whole group of processes as we do (Ctrl-C, systemd, timeout), and would stop
// before the last picture. It inherits that these are held back; when the pipe is closed, it ends by itself.
class EndingSignalsHeld {
  public:
    EndingSignalsHeld() {
        sigset_t ending;
        sigemptyset(&ending);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP})
            sigaddset(&ending, signal);
        pthread_sigmask(SIG_BLOCK, &ending, &before_);
    }
    ~EndingSignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    EndingSignalsHeld(const EndingSignalsHeld&) = delete;
    EndingSignalsHeld& operator=(const EndingSignalsHeld&) = delete;

  private:
    sigset_t before_{};
};

void closeFile(int& file) {
    if (file >= 0) close(file);
    file = -1;
}

}  // namespace

// How a video is encoded, by the ending of its name.
static std::vector<std::string> codecOf(const std::filesystem::path& file, bool alpha) {
    const bool vp9 = lowerExtension(file) == ".webm";
    if (alpha && vp9)
        return {"-pix_fmt", "yuva420p", "-c:v", "libvpx-vp9", "-crf", "24", "-auto-alt-ref", "0"};
    if (alpha) return {"-pix_fmt", "yuva444p10le", "-c:v", "prores_ks", "-profile:v", "4444"};
    return {"-pix_fmt", "yuv420p", "-c:v", vp9 ? "libvpx-vp9" : "libx264", "-crf", vp9 ? "24" : "18"};
}

VideoWriter::VideoWriter(std::filesystem::path file, int width, int height, double frameRate, bool alpha)
    : file_(std::move(file)), part_(file_), width_(width), height_(height) {
    const std::string program = findProgram("ffmpeg");
    if (program.empty()) checkInstalled();
    // ffmpeg chooses the container by the extension, which part_ has, too.
    std::vector<std::string> arguments = {
        program, "-hide_banner", "-loglevel", "error", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt", "rgba",
        "-video_size", concat(width_, "x", height_), "-framerate", concat(frameRate), "-i", "pipe:0",
        // Chroma at half size needs even sides; a side that is odd gains a row or column.
        "-vf", concat("pad=ceil(iw/2)*2:ceil(ih/2)*2", alpha ? ":color=black@0" : "")};
    for (std::string& word : codecOf(file_, alpha))
        arguments.push_back(std::move(word));
    arguments.push_back(std::filesystem::absolute(part_.path()).string());
    std::vector<char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);

    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error(concat("cannot make a pipe to ffmpeg: ", std::strerror(errno)));
    // In memory: what ffmpeg has to say about a full disk must not need that disk.
    log_ = memfd_create("ffmpeg's log", MFD_CLOEXEC);
    const EndingSignalsHeld held;
    const pid_t parent = getpid();
    process_ = log_ >= 0 ? fork() : -1;
    if (process_ == 0) {
        // Only calls that are safe between fork and exec.
        prctl(PR_SET_PDEATHSIG, SIGKILL);     // its file is removed with us
        if (getppid() != parent) _exit(127);  // who has died before that sends no signal
        dup2(ends[0], STDIN_FILENO);
        dup2(log_, STDOUT_FILENO);
        dup2(log_, STDERR_FILENO);
        execv(argv[0], argv.data());
        _exit(127);
    }
    const int forkError = errno;
    close(ends[0]);
    pipe_ = ends[1];
    if (process_ > 0) return;
    closeFile(pipe_);
    closeFile(log_);
    throw Error(concat("cannot start ffmpeg: ", std::strerror(forkError)));
}

VideoWriter::~VideoWriter() {
    if (process_ > 0) {
        kill(process_, SIGKILL);  // the file is removed: there is nothing to finish
        closeFile(pipe_);
        wait();
    }
    closeFile(log_);
}

int VideoWriter::wait() {
    int status = 0;
    pid_t ended;
    do {
        ended = waitpid(process_, &status, 0);
    } while (ended < 0 && errno == EINTR);
    process_ = -1;
    return ended > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string VideoWriter::complaint() const {
    std::string text;
    char chunk[1024];
    ssize_t count;
    while ((count = pread(log_, chunk, sizeof chunk, off_t(text.size()))) > 0)
        text.append(chunk, size_t(count));
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    return text.size() > 600 ? "..." + text.substr(text.size() - 600) : text;
}

void VideoWriter::fail(const std::string& what) {
    closeFile(pipe_);
    if (process_ > 0) wait();
    const std::string reason = complaint();
    throw Error(
        concat(file_.string(), ": ", what, ": ", reason.empty() ? "it gave no reason" : indented(reason)));
}

namespace {

// A reader that has gone makes write() raise SIGPIPE, which would end the program. It is held back for this
// thread and taken off again, so that nobody else's handling of signals changes.
class BrokenPipeHeld {
  public:
    BrokenPipeHeld() {
        sigemptyset(&pipe_);
        sigaddset(&pipe_, SIGPIPE);
        sigset_t pending;
        sigpending(&pending);
        wasPending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
    }
    ~BrokenPipeHeld() {
        const timespec now{0, 0};
        if (!wasPending_) {
            while (sigtimedwait(&pipe_, nullptr, &now) < 0 && errno == EINTR) {
            }
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    BrokenPipeHeld(const BrokenPipeHeld&) = delete;
    BrokenPipeHeld& operator=(const BrokenPipeHeld&) = delete;

  private:
    sigset_t pipe_{}, before_{};
    bool wasPending_ = false;
};

}  // namespace

void VideoWriter::write(const Image& picture) {
    if (picture.width != width_ || picture.height != height_ || picture.channels != 4)
        throw Error(concat(file_.string(), ": expected pictures of ", width_, " x ", height_,
                           " RGBA, found one of ", picture.width, " x ", picture.height));
    size_t sent = 0;
    int error = 0;
    {
        const BrokenPipeHeld held;
        while (sent < picture.pixels.size() && error == 0) {
            const ssize_t count = ::write(pipe_, picture.pixels.data() + sent, picture.pixels.size() - sent);
            if (count > 0) {
                sent += size_t(count);
            } else if (count == 0 || errno != EINTR) {
                error = count == 0 ? EIO : errno;
            }
        }
    }
    if (sent < picture.pixels.size()) fail("ffmpeg stopped before the video's end");
}

void VideoWriter::finish() {
    closeFile(pipe_);
    const int status = wait();
    // It ends well even when the file's end could not be written; then it has said so.
    if (status != 0 || !complaint().empty()) fail(status == 127 ? "ffmpeg cannot be run" : "ffmpeg failed");
    part_.replaceTarget();
}

}  // namespace shoal
