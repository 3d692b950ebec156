#include "app/small_font.h"

#include <map>

namespace shoal::app {

namespace {

constexpr int dot = 2, advance = 6 * dot;

struct Figure {
    const char* rows[7];
};

const Figure& figureOf(char c) {
    static const std::map<char, Figure> figures{
        {'0', {{" ### ", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}}},
        {'1', {{"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "}}},
        {'2', {{" ### ", "#   #", "    #", "  ## ", " #   ", "#    ", "#####"}}},
        {'3', {{" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "}}},
        {'4', {{"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "}}},
        {'5', {{"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "}}},
        {'6', {{" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "}}},
        {'7', {{"#####", "    #", "   # ", "  #  ", "  #  ", "  #  ", "  #  "}}},
        {'8', {{" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "}}},
        {'9', {{" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "}}},
        {'.', {{"     ", "     ", "     ", "     ", "     ", " ##  ", " ##  "}}},
        {'-', {{"     ", "     ", "     ", " ### ", "     ", "     ", "     "}}},
        {'+', {{"     ", "  #  ", "  #  ", "#####", "  #  ", "  #  ", "     "}}},
        {'e', {{"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "}}},
        {'m', {{"     ", "     ", "## # ", "# # #", "# # #", "# # #", "# # #"}}},
        {' ', {{"     ", "     ", "     ", "     ", "     ", "     ", "     "}}},
    };
    const auto found = figures.find(c);
    return found != figures.end() ? found->second : figures.at(' ');
}

}  // namespace

int textWidth(const std::string& text) {
    return advance * int(text.size()) - dot;
}

void drawText(Image& image, int left, int top, const std::string& text) {
    for (size_t i = 0; i < text.size(); ++i)
        for (int y = 0; y < 7 * dot; ++y)
            for (int x = 0; x < 5 * dot; ++x) {
                const int column = left + int(i) * advance + x, row = top + y;
                if (figureOf(text[i]).rows[y / dot][x / dot] != '#') continue;
                if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
                for (int c = 0; c < 3; ++c)
                    image.pixels[(size_t(row) * size_t(image.width) + size_t(column)) * 3 + size_t(c)] = 60;
            }
}

}  // namespace shoal::app
