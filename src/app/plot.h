// Pictures of measurements, through the gnuplot command. Files: .svg or .png.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench.h"
#include "measure/accuracy.h"

namespace shoal::app {

// Before anything is measured. Error: gnuplot is not installed, or `file` cannot be written.
void needGnuplot(const std::string& file);

// ---- `shoal bench`: time per molecule against their number

// Before anything is measured. Error: needGnuplot's; none of the cases is one that is plotted.
void checkPlot(const std::string& file, const std::vector<bench::BenchCase>& cases);

// Error: gnuplot fails, the file cannot be written.
void plotBench(const std::string& file, const std::string& title,
               const std::vector<bench::BenchResult>& results);

// ---- `shoal measure`: error against time

// One square of a picture.
struct AccuracyPanel {
    std::string title, subtitle;
    std::vector<measure::AccuracyPoint> points;
    std::optional<measure::AccuracyPoint> chosen;  // marked
    double target = 0;                             // a line at this error; 0: none
};

// Whether there is anything to draw: a point with error and time.
bool plottable(const std::vector<measure::AccuracyPoint>& points);

// Error: gnuplot fails, the file cannot be written.
void plotAccuracy(const std::string& file, const AccuracyPanel& panel);
}  // namespace shoal::app
