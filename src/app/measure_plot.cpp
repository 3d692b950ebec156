#include "app/measure_plot.h"

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

#include "app/gnuplot.h"
#include "core/error.h"
#include "measure/pareto.h"

namespace shoal::app {

using namespace measure;

namespace {

// Colours that differ for the colour-blind as well [Okabe 2008], by the place in the table of solvers.
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

struct Limits {
    double left = 1e30, right = 0, low = 1e30, high = 0;
    void add(const std::vector<AccuracyPoint>& points, double worst = worstError) {
        for (const AccuracyPoint& point : points) {
            if (!drawn(point) || point.error->total > worst) continue;
            left = std::min(left, nanoseconds(point));
            right = std::max(right, nanoseconds(point));
            low = std::min(low, point.error->total);
            high = std::max(high, point.error->total);
        }
    }
    bool any() const { return right > 0; }
};

std::string ranges(const Limits& l) {
    return concat("set xrange [", l.left / 1.5, ":", l.right * 1.5, "]\nset yrange [", l.low / 2, ":",
                  l.high * 2, "]\n");
}

class Script {
  public:
    explicit Script(bool small) : small_(small) {}

    // Curves, front, target, chosen point: the data, then one plot command.
    std::string panel(const AccuracyPanel& panel) {
        data_.str("");
        lines_.str("");
        if (panel.target > 0)
            line(concat(panel.target, " title ", small_ ? "''" : quoted(concat("error ", panel.target)),
                        " with lines linewidth 1 dashtype 4 linecolor rgb '#999999'"));
        front(panel);
        for (const Method& method : methodsOf(panel.points))
            curve(panel, method);
        if (panel.chosen && drawn(*panel.chosen)) chosen(*panel.chosen);
        if (lines_.str().empty()) return {};
        return data_.str() + "plot " + lines_.str() + "\n";
    }

  private:
    void line(const std::string& text) { lines_ << (lines_.str().empty() ? "" : ", \\\n     ") << text; }

    std::string block(const std::vector<std::pair<double, double>>& points) {
        const std::string name = concat("$data", blocks_++);
        data_ << name << " << END\n";
        for (const auto& [x, y] : points)
            data_ << x << " " << y << "\n";
        data_ << "END\n";
        return name;
    }

    void front(const AccuracyPanel& panel) {
        std::vector<std::pair<double, double>> points;
        for (const AccuracyPoint& point : panel.points)
            if (point.front && drawn(point)) points.emplace_back(nanoseconds(point), point.error->total);
        if (points.empty()) return;
        std::sort(points.begin(), points.end());
        line(concat(block(points), " title ", small_ ? "''" : "'Pareto front'", " with lines linewidth ",
                    small_ ? 5 : 9, " linecolor rgb '#F3E3A1'"));
    }

    void curve(const AccuracyPanel& panel, const Method& method) {
        std::vector<std::pair<double, double>> points;
        for (const AccuracyPoint& point : panel.points)
            if (point.method == method && drawn(point))
                points.emplace_back(nanoseconds(point), point.error->total);
        if (points.empty()) return;
        const Stroke& stroke = strokes[size_t(method.sampling)];
        line(concat(block(points), " title ", small_ ? "''" : quoted(title(panel, method)),
                    " with linespoints linewidth ", small_ ? 1.4 : 2, " pointsize ", small_ ? 0.45 : 0.9,
                    " dashtype ", stroke.dash, " pointtype ", stroke.marker, " linecolor rgb '",
                    colors[size_t(method.solver) % std::size(colors)], "'"));
    }

    static std::string title(const AccuracyPanel& panel, const Method& method) {
        const std::vector<Method> all = methodsOf(panel.points);
        const bool one = std::all_of(all.begin(), all.end(),
                                     [&](const Method& m) { return m.sampling == all[0].sampling; });
        return one ? shoal::name(method.solver) : measure::name(method);
    }

    void chosen(const AccuracyPoint& point) {
        line(concat(block({{nanoseconds(point), point.error->total}}), " title ",
                    small_ ? "''"
                           : quoted(concat("chosen: ", shoal::name(point.method.solver), ", ",
                                           point.step.substeps, " substeps")),
                    " with points pointtype 6 linewidth ", small_ ? 1.5 : 2.5, " pointsize ",
                    small_ ? 1.3 : 2.6, " linecolor rgb '#000000'"));
    }

    bool small_;
    int blocks_ = 0;
    std::ostringstream data_, lines_;
};

const char* axes =
    "set format y '10^{%T}'\n"
    "set xtics ('0.1' 0.1, '1' 1, '10' 10, '100' 100, '1 µs' 1e3, '10 µs' 1e4, '100 µs' 1e5, '1 ms' 1e6, "
    "'10 ms' 1e7)\n"
    "do for [decade = -1:6] { do for [i = 2:9] { set xtics add ('' i * 10.0**decade 1) } }\n"
    "set mytics 10\n"
    "set grid xtics ytics linetype 1 linecolor rgb '#D8D8D8' linewidth 0.6\n";

// The key of a grid: every solver that appears, in a panel of its own.
std::string key(const std::vector<AccuracyPanel>& panels) {
    std::map<Method, bool> methods;
    for (const AccuracyPanel& panel : panels)
        for (const AccuracyPoint& point : panel.points)
            if (drawn(point)) methods[point.method] = true;
    std::ostringstream out;
    out << "unset title\nunset xlabel\nunset ylabel\nunset border\nunset tics\nunset grid\nunset logscale\n"
        << "set xrange [0:1]\nset yrange [0:1]\n"
        << "set key center center horizontal Left reverse samplen 2.5 width 1 maxrows 7 font ',10'\n"
        << "plot NaN title 'Pareto front' with lines linewidth 5 linecolor rgb '#F3E3A1'";
    for (const auto& [method, used] : methods) {
        const Stroke& stroke = strokes[size_t(method.sampling)];
        out << ", \\\n     NaN title " << quoted(measure::name(method))
            << " with linespoints linewidth 1.6 pointsize 0.6 dashtype " << stroke.dash << " pointtype "
            << stroke.marker << " linecolor rgb '" << colors[size_t(method.solver) % std::size(colors)]
            << "'";
    }
    return out.str() + "\n";
}

std::string gridScript(const std::string& output, const std::string& title, int columns,
                       const std::vector<AccuracyPanel>& panels) {
    const int rows = (int(panels.size()) + columns - 1) / columns;
    constexpr int cell = 300, head = 46, foot = 150;
    const int width = cell * columns + 60, height = cell * rows + head + foot;
    std::ostringstream out;
    out << plotStart(output, width, height, 11) << "set multiplot\n"
        << "set label 1 " << quoted(title) << " at screen 0.5," << 1 - 0.45 * head / height
        << " center font ',15' noenhanced\n"
        << axes << "set xtics add ('' 10, '' 1e4, '' 1e6)\nunset key\n";
    Limits all;
    for (const AccuracyPanel& panel : panels)
        all.add(panel.points);
    if (!all.any()) return out.str();
    out << ranges(all);
    Script script(true);
    for (size_t i = 0; i < panels.size(); ++i) {
        const int row = int(i) / columns, column = int(i) % columns;
        const std::string plot = script.panel(panels[i]);
        if (plot.empty()) continue;
        out << "set origin " << (column * cell + 40.0) / width << ","
            << 1 - (head + (row + 1.0) * cell) / height << "\nset size " << double(cell) / width << ","
            << double(cell) / height << "\nset lmargin 7\nset rmargin 1\nset tmargin 2\nset bmargin 3\n"
            << "set title " << quoted(panels[i].title) << " noenhanced offset 0,-0.6\n"
            << (column == 0 ? "set ylabel 'relative error' offset 1.5\n" : "unset ylabel\n")
            << (row + 1 == rows ? "set xlabel 'time per vertex and simulated second' offset 0,0.5\n"
                                : "unset xlabel\n")
            << plot << "unset label 1\n";
    }
    out << "set origin 0,0\nset size 1," << double(foot) / height
        << "\nset lmargin 1\nset rmargin 1\nset tmargin 0\nset bmargin 0\n"
        << key(panels) << "unset multiplot\nset output\n";
    return out.str();
}

}  // namespace

bool plottable(const std::vector<AccuracyPoint>& points) {
    return std::any_of(points.begin(), points.end(), drawn);
}

static std::string accuracyScript(const std::string& output, const AccuracyPanel& panel) {
    Limits limits;
    limits.add(panel.points);
    if (!limits.any()) limits.add(panel.points, std::numeric_limits<double>::infinity());
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
        << Script(false).panel(panel) << "set output\n";
    return out.str();
}

void plotAccuracy(const std::string& file, const AccuracyPanel& panel) {
    if (!plottable(panel.points))
        throw Error(concat(file, ": no point has both an error and a time to draw"));
    drawWithGnuplot(file, accuracyScript(file, panel));
}

void plotGrid(const std::string& file, const std::string& title, int columns,
              const std::vector<AccuracyPanel>& panels) {
    drawWithGnuplot(file, gridScript(file, title, columns, panels));
}

}  // namespace shoal::app
