// Pictures of `shoal measure`: error against time, through gnuplot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure/accuracy.h"

namespace shoal::app {

// One square of a picture.
struct AccuracyPanel {
    std::string title, subtitle;
    std::vector<measure::AccuracyPoint> points;
    std::optional<measure::AccuracyPoint> chosen;  // marked
    double target = 0;                             // a line at this error; 0: none
};

// Whether there is anything to draw: a point with error and time.
bool plottable(const std::vector<measure::AccuracyPoint>& points);

// `file`: .svg or .png. Error: gnuplot fails, the file cannot be written.
void plotAccuracy(const std::string& file, const AccuracyPanel& panel);
// A grid of small panels, row by row; an empty one stays blank. One key for all.
void plotGrid(const std::string& file, const std::string& title, int columns,
              const std::vector<AccuracyPanel>& panels);

}  // namespace shoal::app
