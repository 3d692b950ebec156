// The letters of the interface: the outline font that the system takes for plain text, or the built-in one,
// which has the letters of Western Europe alone.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace shoal::window {

struct FontFile {
    std::string bytes;  // TrueType or OpenType
    int face = 0;       // of a file that holds several
    double line = 1;    // height, over the em square's
};

// Nothing: there is none that can be drawn. One that is broken is told once on standard error.
std::optional<FontFile> systemFont();

// How high a line of a font is over its em square. Nothing: the file is damaged, or no font of outlines.
std::optional<double> lineHeightOf(std::string_view file, int face);

// Puts its letters into ImGui's atlas so that a line is `height` pixels high; null: the built-in ones.
void addLetters(const FontFile* font, float height);

// A text of ours, with what the built-in font lacks spelled out where that is in use.
std::string inLetters(std::string words);

}  // namespace shoal::window
