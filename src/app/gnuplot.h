// Pictures through the gnuplot command.
#pragma once

#include <string>

namespace shoal::app {

// Before anything is measured. Error: gnuplot is not installed, or `file` cannot be written.
void needGnuplot(const std::string& file);

// `script`: what gnuplot is told; the picture is its standard output, so that it never hears the file's name.
// It replaces `file` (.svg or .png) when it is whole; folders are made.
// Error: gnuplot fails, with its words; the file cannot be written.
void drawWithGnuplot(const std::string& file, const std::string& script);

// The first lines of a script: kind of picture by the ending of `file`, its size in points and letters (a
// .png has 1.5 pixels a point), both axes logarithmic.
std::string plotStart(const std::string& file, int width, int height, int font);

// Text of others for a script: on one line, which it does not leave, and in single quotes, in which gnuplot
// looks for nothing.
std::string quoted(const std::string& text);

}  // namespace shoal::app
