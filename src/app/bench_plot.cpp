#include "app/bench_plot.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "app/gnuplot.h"
#include "app/options.h"
#include "core/error.h"

namespace shoal::app {

using namespace bench;

namespace {

struct Curve {
    Subject subject;
    const char *title, *color;
    int marker;  // gnuplot's point type
};

// Colours that differ for the colour-blind as well [Okabe 2008].
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

void addData(std::ostringstream& out, Subject subject, const std::vector<BenchResult>& results) {
    for (const BenchResult& result : results)
        if (result.one.subject == subject && plotted(result.one) && result.frame.min > 0)
            out << result.one.count << " " << result.perMolecule() * 1e9 << "\n";
}

}  // namespace

void checkPlot(const std::string& file, const std::vector<BenchCase>& cases) {
    if (std::none_of(cases.begin(), cases.end(), plotted))
        throw WrongUse("--plot draws the quads on each path and baseline: --only leaves none of them");
    needGnuplot(file);
}

static std::string plotScript(const std::string& file, const std::string& title,
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
    out << plotStart(file, 960, 600, 15) << "set title " << quoted("euler, 4 substeps a frame; " + title)
        << " noenhanced\n"
        << "set xlabel 'quads' offset 0,-0.3\nset ylabel 'nanoseconds a quad and frame'\n"
        << "set xrange [700:1500000]\n"
        << "set yrange [" << low / 1.6 << ":" << high * 1.6 << "]\n"
        << "set xtics ('1,024' 1024, '16,384' 16384, '131,072' 131072, '1,048,576' 1048576)\n"
        << "set ytics ('1' 1, '10' 10, '100' 100, '1,000' 1e3, '10,000' 1e4, '100,000' 1e5)\n"
        << "do for [decade = -2:5] { do for [i = 2:9] { set ytics add ('' i * 10.0**decade 1) } }\n"
        << "set grid xtics ytics mytics linetype 1 linecolor rgb '#BBBBBB' linewidth 0.7, "
           "linetype 1 linecolor rgb '#E4E4E4' linewidth 0.5\n"
        << "set key outside right center Left reverse samplen 2 spacing 1.4\n"
        << lines.str() << "\nset output\n";
    return out.str();
}

void plot(const std::string& file, const std::string& title, const std::vector<BenchResult>& results) {
    drawWithGnuplot(file, plotScript(file, title, results));
}

}  // namespace shoal::app
