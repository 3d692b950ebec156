#include "app/plot.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>
#include <string_view>

#include "app/options.h"
#include "core/child_process.h"
#include "core/file.h"
#include "core/image.h"
#include "core/printable.h"

namespace shoal::app {

using namespace bench;
using namespace measure;
namespace fs = std::filesystem;

namespace {

// ---- gnuplot

constexpr double gnuplotSeconds = 120;  // the largest picture takes a few

// What it has drawn is read again, since gnuplot ends well also when the disk was full. Error: it is cut off.
void checkPicture(const std::string& bytes, const std::string& file) {
    if (lowerExtension(file) != ".svg") {
        decodePng(bytes, file);
        return;
    }
    const size_t end = bytes.find_last_not_of(" \n");
    constexpr std::string_view last = "</svg>";
    if (end == std::string::npos || !std::string_view(bytes).substr(0, end + 1).ends_with(last))
        throw Error(concat("the picture does not end with ", last));
}

// `script`: what gnuplot is told; the picture is its standard output, so that it never hears the file's name.
// It replaces `file` (.svg or .png) when it is whole; folders are made.
// Error: gnuplot fails, with its words, hangs, or draws half of it; the file cannot be written.
void drawWithGnuplot(const std::string& file, const std::string& script) {
    PartFile part(fs::absolute(file));
    const MemoryFile input(script), messages;
    // Without the user's settings, and those of the folder.
    const auto gnuplot =
        startProgram({findProgram("gnuplot"), "-d", "-"}, {input.file(), part.file(), messages.file()});
    const std::optional<int> status = gnuplot->wait(gnuplotSeconds);
    const std::string log = lastWords(messages);
    const auto fail = [&](const std::string& why) {
        throw Error(concat(file, ": gnuplot did not draw it", why.empty() ? "" : ": ", indented(why)));
    };
    if (!status) fail(concat("it had not ended after ", gnuplotSeconds, " s"));
    if (exitCode(*status) != 0) fail(log);
    try {
        checkPicture(readFile(part.path()), file);
    } catch (const Error& error) {
        fail(concat("what it wrote is not whole, ", log.empty() ? error.message() : log));
    }
    part.replaceTarget();
}

// Text of others for a script: on one line, which it does not leave, and in single quotes, in which gnuplot
// looks for nothing.
std::string quoted(const std::string& given) {
    std::string text = printable(given);
    for (size_t quote = 0; (quote = text.find('\'', quote)) != std::string::npos; quote += 2)
        text.insert(quote, "'");
    return "'" + text + "'";
}

// The first lines of a script: kind of picture by the ending of `file`, its size in points and letters (a
// .png has 1.5 pixels a point), both axes logarithmic.
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

// Data blocks, then one plot command that draws them.
class Curves {
  public:
    // `what`: data and style, as gnuplot has them.
    void add(const std::string& what) { lines_ << (lines_.str().empty() ? "plot " : ", \\\n     ") << what; }
    // `rows`: x and y, a line a point; without any nothing is drawn.
    void add(const std::string& rows, const std::string& style) {
        if (rows.empty()) return;
        const std::string name = concat("$data", blocks_++);
        data_ << name << " << END\n" << rows << "END\n";
        add(name + style);
    }
    // Returns the script; what is added from now on belongs to another.
    std::string take() {
        std::string out = lines_.str().empty() ? "" : data_.str() + lines_.str() + "\n";
        data_.str("");
        lines_.str("");
        return out;
    }

  private:
    int blocks_ = 0;
    std::ostringstream data_, lines_;
};

// Colours differ for the colour-blind as well [Okabe 2008]. `marker`: gnuplot's point type.
std::string marked(double width, double size, int marker, const char* color) {
    return concat(" with linespoints linewidth ", width, " pointsize ", size, " pointtype ", marker,
                  " linecolor rgb '", color, "'");
}

struct Limits {
    double left = 1e30, right = 0, low = 1e30, high = 0;
    void add(double x, double y) {
        left = std::min(left, x);
        right = std::max(right, x);
        low = std::min(low, y);
        high = std::max(high, y);
    }
    bool any() const { return right > 0; }
};

// ---- `shoal bench`: time per molecule against their number

struct BenchCurve {
    Subject subject;
    const char *title, *color;
    int marker;
};

constexpr BenchCurve benchCurves[] = {{Subject::pingPong, "ping-pong", "#D55E00", 9},
                                      {Subject::scalar, "CPU, scalar", "#999999", 5},
                                      {Subject::fragments, "fused, in fragments", "#56B4E9", 3},
                                      {Subject::fused, "fused", "#0072B2", 7},
                                      {Subject::avx2, "CPU, AVX2", "#009E73", 11},
                                      {Subject::avx512, "CPU, AVX-512", "#CC79A7", 13}};

bool plotted(const BenchCase& benchCase) {
    return benchCase.molecule == "quad" && benchCase.label == bench::name(benchCase.subject) &&
           std::any_of(std::begin(benchCurves), std::end(benchCurves),
                       [&](const BenchCurve& each) { return each.subject == benchCase.subject; });
}

std::string benchScript(const std::string& file, const std::string& title,
                        const std::vector<BenchResult>& results) {
    Curves curves;
    Limits limits;
    for (const BenchCurve& each : benchCurves) {
        std::ostringstream rows;
        for (const BenchResult& result : results) {
            if (result.benchCase.subject != each.subject || !plotted(result.benchCase) ||
                !(result.frame.min > 0))
                continue;
            const double nanoseconds = result.perMolecule() * 1e9;
            rows << result.benchCase.count << " " << nanoseconds << "\n";
            limits.add(result.benchCase.count, nanoseconds);
        }
        curves.add(rows.str(),
                   concat(" title '", each.title, "'", marked(2.5, 1.3, each.marker, each.color)));
    }
    std::ostringstream out;
    out << plotStart(file, 960, 600, 15) << "set title " << quoted("euler, 4 substeps a frame; " + title)
        << " noenhanced\n"
        << "set xlabel 'quads' offset 0,-0.3\nset ylabel 'nanoseconds a quad and frame'\n"
        << "set xrange [700:1500000]\n"
        << "set yrange [" << limits.low / 1.6 << ":" << limits.high * 1.6 << "]\n"
        << "set xtics ('1,024' 1024, '16,384' 16384, '131,072' 131072, '1,048,576' 1048576)\n"
        << "set ytics ('1' 1, '10' 10, '100' 100, '1,000' 1e3, '10,000' 1e4, '100,000' 1e5)\n"
        << "do for [decade = -2:5] { do for [i = 2:9] { set ytics add ('' i * 10.0**decade 1) } }\n"
        << "set grid xtics ytics mytics linetype 1 linecolor rgb '#BBBBBB' linewidth 0.7, "
           "linetype 1 linecolor rgb '#E4E4E4' linewidth 0.5\n"
        << "set key outside right center Left reverse samplen 2 spacing 1.4\n"
        << curves.take() << "set output\n";
    return out.str();
}

// ---- `shoal measure`: error against time

// By the place in the table of solvers.
constexpr const char* colors[] = {"#555555", "#56B4E9", "#0072B2", "#009E73",
                                  "#E69F00", "#D55E00", "#CC79A7", "#8A6FD1"};
// Line style and marker of a field sampling (gnuplot's dash and point types).
struct Stroke {
    int dash, marker;
};
constexpr Stroke strokes[] = {{1, 7}, {2, 5}, {3, 9}};

bool drawn(const AccuracyPoint& point) {
    return point.error && point.error->total > 0 && point.time.samples > 0;
}

double nanoseconds(const AccuracyPoint& point) {
    return point.time.min * 1e9;
}

// The axes leave out points of a larger relative error: their steps are too long to mean anything.
constexpr double worstError = 2;

void add(Limits& limits, const std::vector<AccuracyPoint>& points, double worst = worstError) {
    for (const AccuracyPoint& point : points)
        if (drawn(point) && point.error->total <= worst) limits.add(nanoseconds(point), point.error->total);
}

std::string ranges(const Limits& l) {
    return concat("set xrange [", l.left / 1.5, ":", l.right * 1.5, "]\nset yrange [", l.low / 2, ":",
                  l.high * 2, "]\n");
}

std::string marked(double width, double size, const Method& method) {
    const Stroke& stroke = strokes[size_t(method.sampling)];
    return concat(marked(width, size, stroke.marker, colors[size_t(method.solver) % std::size(colors)]),
                  " dashtype ", stroke.dash);
}

class Panels {
  public:
    explicit Panels(bool small) : small_(small) {}

    // Curves, front, target, chosen point: the data, then one plot command.
    std::string panel(const AccuracyPanel& panel) {
        if (panel.target > 0)
            curves_.add(concat(panel.target, " title ",
                               small_ ? "''" : quoted(concat("error ", panel.target)),
                               " with lines linewidth 1 dashtype 4 linecolor rgb '#999999'"));
        front(panel);
        for (const Method& method : methodsOf(panel.points))
            curve(panel, method);
        if (panel.chosen && drawn(*panel.chosen)) chosen(*panel.chosen);
        return curves_.take();
    }

  private:
    using Points = std::vector<std::pair<double, double>>;

    static std::string rows(const Points& points) {
        std::ostringstream out;
        for (const auto& [x, y] : points)
            out << x << " " << y << "\n";
        return out.str();
    }

    void front(const AccuracyPanel& panel) {
        Points points;
        for (const AccuracyPoint& point : panel.points)
            if (point.front && drawn(point)) points.emplace_back(nanoseconds(point), point.error->total);
        std::sort(points.begin(), points.end());
        curves_.add(rows(points),
                    concat(" title ", small_ ? "''" : "'Pareto front'", " with lines linewidth ",
                           small_ ? 5 : 9, " linecolor rgb '#F3E3A1'"));
    }

    void curve(const AccuracyPanel& panel, const Method& method) {
        Points points;
        for (const AccuracyPoint& point : panel.points)
            if (point.method == method && drawn(point))
                points.emplace_back(nanoseconds(point), point.error->total);
        curves_.add(rows(points), concat(" title ", small_ ? "''" : quoted(title(panel, method)),
                                         marked(small_ ? 1.4 : 2, small_ ? 0.45 : 0.9, method)));
    }

    static std::string title(const AccuracyPanel& panel, const Method& method) {
        const std::vector<Method> all = methodsOf(panel.points);
        const bool sameSampling = std::all_of(all.begin(), all.end(),
                                              [&](const Method& m) { return m.sampling == all[0].sampling; });
        return sameSampling ? shoal::name(method.solver) : measure::name(method);
    }

    void chosen(const AccuracyPoint& point) {
        curves_.add(rows({{nanoseconds(point), point.error->total}}),
                    concat(" title ",
                           small_ ? "''"
                                  : quoted(concat("chosen: ", shoal::name(point.method.solver), ", ",
                                                  point.step.substeps, " substeps")),
                           " with points pointtype 6 linewidth ", small_ ? 1.5 : 2.5, " pointsize ",
                           small_ ? 1.3 : 2.6, " linecolor rgb '#000000'"));
    }

    bool small_;
    Curves curves_;
};

const char* axes =
    "set format y '10^{%T}'\n"
    "set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6, "
    "'10 ms' 1e7)\n"
    "do for [decade = -1:6] { do for [i = 2:9] { set xtics add ('' i * 10.0**decade 1) } }\n"
    "set mytics 10\n"
    "set grid xtics ytics linetype 1 linecolor rgb '#D8D8D8' linewidth 0.6\n";

std::string accuracyScript(const std::string& output, const AccuracyPanel& panel) {
    Limits limits;
    add(limits, panel.points);
    if (!limits.any()) add(limits, panel.points, std::numeric_limits<double>::infinity());
    std::ostringstream out;
    const size_t curves = methodsOf(panel.points).size();
    out << plotStart(output, 1080, 680 + (curves > 18 ? 160 : 0), 14) << "set tmargin 5\nset label 1 "
        << quoted(panel.title) << " at graph 0, screen 0.955 left noenhanced font ',17'\n"
        << "set label 2 " << quoted(panel.subtitle)
        << " at graph 0, screen 0.912 left noenhanced font ',11' textcolor rgb '#666666'\n"
        << "set xlabel 'time per vertex and simulated second' offset 0,-0.3\n"
        << "set ylabel 'error after the run / size of a molecule' offset -0.5\n"
        << axes << ranges(limits)
        << "set key outside right center Left reverse samplen 3 spacing 1.25 font ',11'\n"
        << Panels(false).panel(panel) << "set output\n";
    return out.str();
}

}  // namespace

void needGnuplot(const std::string& file) {
    if (findProgram("gnuplot").empty())
        throw Error(
            "--plot needs the gnuplot command, which is not installed (on Debian and Ubuntu: apt install "
            "gnuplot-nox)");
    PartFile{file};  // made, and taken away again
}

void checkPlot(const std::string& file, const std::vector<BenchCase>& cases) {
    if (std::none_of(cases.begin(), cases.end(), plotted))
        throw WrongUse("--plot draws the quads on each path and baseline: --only leaves none of them");
    needGnuplot(file);
}

void plotBench(const std::string& file, const std::string& title, const std::vector<BenchResult>& results) {
    drawWithGnuplot(file, benchScript(file, title, results));
}

bool plottable(const std::vector<AccuracyPoint>& points) {
    return std::any_of(points.begin(), points.end(), drawn);
}

void plotAccuracy(const std::string& file, const AccuracyPanel& panel) {
    if (!plottable(panel.points))
        throw Error(concat(file, ": no point has both an error and a time to draw"));
    drawWithGnuplot(file, accuracyScript(file, panel));
}

}  // namespace shoal::app
