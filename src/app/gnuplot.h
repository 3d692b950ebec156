// Pictures through the gnuplot command.
#pragma once

#include <functional>
#include <string>

namespace shoal::app {

// Before anything is measured. Error: gnuplot is not installed, or `file` cannot be written.
void needGnuplot(const std::string& file);

// `script` gives what gnuplot is told, for the name of the file that it is to write. The picture replaces
// `file` (.svg or .png) when it is whole; folders are made.
// Error: gnuplot fails, with its words; the file cannot be written.
void drawWithGnuplot(const std::string& file,
                     const std::function<std::string(const std::string& output)>& script);

// As gnuplot quotes.
std::string quoted(std::string text);

}  // namespace shoal::app
