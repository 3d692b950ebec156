// The picture of `shoal bench`: time per molecule against their number, through gnuplot.
#pragma once

#include <string>
#include <vector>

#include "bench/bench.h"

namespace shoal::app {

// Before anything is measured. Error: needGnuplot's; none of the cases is one that is plotted.
void checkPlot(const std::string& file, const std::vector<bench::BenchCase>& cases);

// `file`: .svg or .png. Error: gnuplot fails, the file cannot be written.
void plot(const std::string& file, const std::string& title, const std::vector<bench::BenchResult>& results);

}  // namespace shoal::app
