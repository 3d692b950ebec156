#include "app/bench_plot.h"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

#include "core/error.h"
#include "core/file.h"

namespace shoal::app {

using namespace measure;
namespace fs = std::filesystem;

namespace {

struct Curve {
    Subject subject;
    const char *title, *color;
    int marker;  // gnuplot's point type
};

// Colours that differ for the colour-blind as well (Okabe and Ito).
constexpr Curve curves[] = {{Subject::pingPong, "ping-pong", "#D55E00", 9},
                            {Subject::scalar, "CPU, scalar", "#999999", 5},
                            {Subject::fused, "fused", "#0072B2", 7},
                            {Subject::avx2, "CPU, AVX2", "#009E73", 11},
                            {Subject::avx512, "CPU, AVX-512", "#CC79A7", 13}};

bool plotted(const BenchCase& one) {
    return one.molecule == "quad" && one.label == name(one.subject) &&
           std::any_of(std::begin(curves), std::end(curves),
                       [&](const Curve& curve) { return curve.subject == one.subject; });
}

std::string findGnuplot() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::string candidate = (folder.empty() ? "." : folder) + "/gnuplot";
        if (access(candidate.c_str(), X_OK) == 0 && !fs::is_directory(candidate)) return candidate;
    }
    return {};
}

std::string quoted(std::string text) {
    for (size_t at = 0; (at = text.find('\'', at)) != std::string::npos; at += 2)
        text.insert(at, "'");
    return "'" + text + "'";
}

// Removed unless it becomes the picture.
struct Partial {
    fs::path path;
    ~Partial() {
        std::error_code ignored;
        fs::remove(path, ignored);
    }
};

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

// Its exit code; what it says goes to `log`.
int runGnuplot(const std::string& program, const std::string& script, std::string& log) {
    const int input = memoryFile("gnuplot's script"), output = memoryFile("gnuplot's messages");
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
        dup2(output, STDERR_FILENO);
        execl(program.c_str(), "gnuplot", "-", static_cast<char*>(nullptr));
        _exit(127);
    }
    int status = -1;
    while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    log = contents(output);
    close(input);
    close(output);
    return process > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void addData(std::ostringstream& out, Subject subject, const std::vector<BenchResult>& results) {
    for (const BenchResult& result : results)
        if (result.one.subject == subject && plotted(result.one) && result.frame.min > 0)
            out << result.one.count << " " << result.perMolecule() * 1e9 << "\n";
}

}  // namespace

void checkPlot(const std::vector<BenchCase>& cases) {
    if (std::none_of(cases.begin(), cases.end(), plotted))
        throw Error("--plot draws the quads on each path and yardstick: --only leaves none of them");
    if (findGnuplot().empty())
        throw Error(
            "--plot needs the gnuplot command, which is not installed (on Debian and Ubuntu: apt install "
            "gnuplot-nox)");
}

std::string plotScript(const std::string& file, const std::string& title,
                       const std::vector<BenchResult>& results) {
    std::ostringstream out, lines;
    double low = std::numeric_limits<double>::max(), high = 0;
    for (const BenchResult& result : results) {
        if (!plotted(result.one) || !(result.frame.min > 0)) continue;
        low = std::min(low, result.perMolecule() * 1e9);
        high = std::max(high, result.perMolecule() * 1e9);
    }
    for (size_t i = 0; i < std::size(curves); ++i) {
        std::ostringstream data;
        addData(data, curves[i].subject, results);
        if (data.str().empty()) continue;
        out << "$data" << i << " << END\n" << data.str() << "END\n";
        lines << (lines.str().empty() ? "plot " : ", \\\n     ") << "$data" << i << " title '"
              << curves[i].title << "' with linespoints linewidth 2.5 pointsize 1.3 pointtype "
              << curves[i].marker << " linecolor rgb '" << curves[i].color << "'";
    }
    const bool svg = lowerExtension(file) == ".svg";
    out << "set encoding utf8\n"
        << (svg ? "set terminal svg size 960,600 dynamic font 'DejaVu Sans,15' background rgb 'white'\n"
                : "set terminal pngcairo size 1440,900 font 'DejaVu Sans,20' linewidth 1.5\n")
        << "set output " << quoted(file) << "\n"
        << "set title " << quoted("euler, 4 substeps a frame; " + title) << " noenhanced\n"
        << "set xlabel 'quads' offset 0,-0.3\nset ylabel 'nanoseconds a quad and frame'\n"
        << "set logscale xy\nset xrange [700:1500000]\n"
        << "set yrange [" << low / 1.6 << ":" << high * 1.6 << "]\n"
        << "set xtics ('1,024' 1024, '16,384' 16384, '131,072' 131072, '1,048,576' 1048576)\n"
        << "set ytics ('1' 1, '10' 10, '100' 100, '1,000' 1e3, '10,000' 1e4, '100,000' 1e5)\n"
        << "do for [decade = -2:5] { do for [i = 2:9] { set ytics add ('' i * 10.0**decade 1) } }\n"
        << "set border 3 linecolor rgb '#555555'\nset tics nomirror\n"
        << "set grid xtics ytics mytics linetype 1 linecolor rgb '#BBBBBB' linewidth 0.7, "
           "linetype 1 linecolor rgb '#E4E4E4' linewidth 0.5\n"
        << "set key outside right center Left reverse samplen 2 spacing 1.4\n"
        << lines.str() << "\nset output\n";
    return out.str();
}

void plot(const std::string& file, const std::string& title, const std::vector<BenchResult>& results) {
    const fs::path target = fs::absolute(file);
    std::error_code error;
    fs::create_directories(target.parent_path(), error);
    if (error)
        throw Error(concat(target.parent_path().string(), ": cannot make this folder: ", error.message()));
    const Partial partial{target.parent_path() / concat(".", target.stem().string(), ".", getpid(),
                                                        ".partial", target.extension().string())};
    std::string log;
    const int code = runGnuplot(findGnuplot(), plotScript(partial.path.string(), title, results), log);
    const bool written = fs::exists(partial.path, error) && fs::file_size(partial.path, error) > 0;
    if (code != 0 || !written)
        throw Error(concat(file, ": gnuplot did not draw it", log.empty() ? "" : ": ", log));
    fs::rename(partial.path, target, error);
    if (error) throw Error(concat(file, ": cannot be written: ", error.message()));
}

}  // namespace shoal::app
