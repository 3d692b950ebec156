#include "app/gnuplot.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "core/file.h"
#include "core/part_file.h"
#include "core/printable.h"

namespace shoal::app {

namespace fs = std::filesystem;

namespace {

std::string findGnuplot() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string candidate = (folder.empty() ? "." : folder) + "/gnuplot";
        if (access(candidate.c_str(), X_OK) == 0 && !fs::is_directory(candidate)) return candidate;
    }
    return {};
}

int memoryFile(const char* what) {
    const int out = memfd_create(what, MFD_CLOEXEC);
    if (out < 0) throw Error(concat("cannot hold ", what, " in memory: ", std::strerror(errno)));
    return out;
}

std::string contents(int file) {
    std::string out(4096, '\0');
    const ssize_t size = pread(file, out.data(), out.size(), 0);
    out.resize(size_t(std::max<ssize_t>(0, size)));
    return out;
}

// Its exit code; the picture goes to the file `output`, what it says to `log`.
int runGnuplot(const std::string& program, const std::string& script, int output, std::string& log) {
    const int input = memoryFile("gnuplot's script"), messages = memoryFile("gnuplot's messages");
    for (size_t done = 0; done < script.size();) {
        const ssize_t part = write(input, script.data() + done, script.size() - done);
        if (part <= 0) throw Error("cannot write gnuplot's script");
        done += size_t(part);
    }
    lseek(input, 0, SEEK_SET);
    const pid_t process = fork();
    if (process == 0) {
        // Only calls that are safe between fork and exec.
        dup2(input, STDIN_FILENO);
        dup2(output, STDOUT_FILENO);
        dup2(messages, STDERR_FILENO);
        // Without the user's settings, and those of the folder.
        execl(program.c_str(), "gnuplot", "-d", "-", static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = -1;
    while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    log = contents(messages);
    close(input);
    close(messages);
    return process > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string quoted(const std::string& given) {
    std::string text = printable(given);
    for (size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2)
        text.insert(at, "'");
    return "'" + text + "'";
}

std::string plotStart(const std::string& file, int width, int height, int font) {
    return concat(
        "set encoding utf8\n",
        lowerExtension(file) == ".svg"
            ? concat("set terminal svg size ", width, ",", height, " dynamic font 'DejaVu Sans,", font,
                     "' background rgb 'white'\n")
            : concat("set terminal pngcairo size ", width * 3 / 2, ",", height * 3 / 2, " font 'DejaVu Sans,",
                     font, "' fontscale ", font < 14 ? 1.25 : 1.5, " linewidth 1.5 pointscale 1.5\n"),
        "set logscale xy\nset border 3 linecolor rgb '#555555'\nset tics nomirror\n");
}

void needGnuplot(const std::string& file) {
    if (findGnuplot().empty())
        throw Error(
            "--plot needs the gnuplot command, which is not installed (on Debian and Ubuntu: apt install "
            "gnuplot-nox)");
    PartFile{file};  // made, and taken away again
}

void drawWithGnuplot(const std::string& file, const std::string& script) {
    PartFile part(fs::absolute(file));
    std::string log;
    const int code = runGnuplot(findGnuplot(), script, part.file(), log);
    std::error_code error;
    const bool written = fs::exists(part.path(), error) && fs::file_size(part.path(), error) > 0;
    if (code != 0 || !written)
        throw Error(concat(file, ": gnuplot did not draw it", log.empty() ? "" : ": ", indented(log)));
    part.replaceTarget();
}

}  // namespace shoal::app
