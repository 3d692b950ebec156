#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <sstream>
#include <vector>

#include "core/child_process.h"
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

void closeFile(int& file) {
    if (file >= 0) close(file);
    file = -1;
}

// Lines of ffmpeg's list of pictures, as `-f framecrc` writes it, that are no comment.
int picturesIn(const std::string& list) {
    std::istringstream lines(list);
    int out = 0;
    for (std::string line; std::getline(lines, line);)
        out += !line.empty() && line[0] != '#';
    return out;
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

VideoWriter::VideoWriter(std::filesystem::path file, int width, int height, double frameRate, bool alpha,
                         double patience)
    : file_(std::move(file)), part_(file_), width_(width), height_(height), patience_(patience) {
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
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Error(concat("cannot make a pipe to ffmpeg: ", std::strerror(errno)));
    pipe_ = ends[1];
    fcntl(pipe_, F_SETFL, O_NONBLOCK);  // of our end alone: one that hangs is not waited for
    // In memory: what ffmpeg has to say about a full disk must not need that disk.
    log_ = std::make_unique<MemoryFile>();
    try {
        process_ = startProgram(arguments, {ends[0], log_->file(), log_->file()});
    } catch (const Error& error) {
        close(ends[0]);
        closeFile(pipe_);
        throw Error(concat("cannot start ffmpeg: ", error.message()));
    }
    close(ends[0]);
}

VideoWriter::~VideoWriter() {
    process_.reset();  // the file is removed: there is nothing to finish
    closeFile(pipe_);
}

void VideoWriter::fail(const std::string& what) {
    closeFile(pipe_);
    process_->wait(1);  // for its last words
    const std::string reason = lastWords(*log_);
    process_->end();
    throw Error(
        concat(file_.string(), ": ", what, ": ", reason.empty() ? "it gave no reason" : indented(reason)));
}

void VideoWriter::failWaiting(const char* forWhat) {
    process_->end();
    fail(concat("ffmpeg has ", forWhat, " for ", patience_, " s and was ended"));
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
        const timespec atOnce{0, 0};
        if (!wasPending_) {
            while (sigtimedwait(&pipe_, nullptr, &atOnce) < 0 && errno == EINTR) {
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
            pollfd ready{pipe_, POLLOUT, 0};
            const int some = poll(&ready, 1, int(1000 * patience_));
            if (some == 0) failWaiting("taken nothing");
            if (some < 0) {
                error = errno == EINTR ? 0 : errno;
                continue;
            }
            const ssize_t count = ::write(pipe_, picture.pixels.data() + sent, picture.pixels.size() - sent);
            if (count > 0) {
                sent += size_t(count);
            } else if (count == 0 || (errno != EINTR && errno != EAGAIN)) {
                error = count == 0 ? EIO : errno;
            }
        }
    }
    if (sent < picture.pixels.size()) fail("ffmpeg stopped before the video's end");
    ++pictures_;
}

// Waits for as long as the program, or what it writes, shows life.
int VideoWriter::waitWhileItWrites(ChildProcess& program, int written) {
    off_t before = -1;
    for (;;) {
        if (const std::optional<int> status = program.wait(patience_)) return exitCode(*status);
        struct stat file {};
        if (::fstat(written, &file) != 0 || file.st_size == before) failWaiting("written nothing");
        before = file.st_size;
    }
}

void VideoWriter::finish() {
    closeFile(pipe_);
    const int status = waitWhileItWrites(*process_, part_.file());
    // It ends well even when the file's end could not be written; then it has said so.
    if (status != 0 || !lastWords(*log_).empty())
        fail(status == 127 ? "ffmpeg cannot be run" : "ffmpeg failed");
    checkPictures();
    part_.replaceTarget();
}

// Its word alone says nothing: the video is decoded, and its pictures are counted.
void VideoWriter::checkPictures() {
    const MemoryFile nothing, list;
    log_ = std::make_unique<MemoryFile>();
    process_ = startProgram({findProgram("ffmpeg"), "-hide_banner", "-loglevel", "error", "-nostdin", "-i",
                             std::filesystem::absolute(part_.path()).string(), "-map", "0:v:0",
                             "-flush_packets", "1", "-f", "framecrc", "pipe:1"},
                            {nothing.file(), list.file(), log_->file()});
    const int status = waitWhileItWrites(*process_, list.file());
    const int found = picturesIn(list.text());
    if (status != 0 || found != pictures_)
        fail(concat("ffmpeg wrote a video of ", found, " pictures, expected ", pictures_));
}

}  // namespace shoal
