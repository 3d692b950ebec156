// Which font files the window takes, and how high their lines are.
#include "support/catch.h"
#include "window/font.h"

using namespace shoal::window;

namespace {

std::string bigEndian(unsigned number, int bytes) {
    std::string out;
    for (int i = bytes - 1; i >= 0; --i)
        out += char(number >> 8 * i & 255);
    return out;
}

// Tables of 64 bytes: an em of 1000 units, 900 above the line and 300 below it.
std::string font(const char* kind, const std::vector<std::string>& tables) {
    std::string rows, contents;
    for (const std::string& name : tables) {
        const size_t begin = 12 + 16 * tables.size() + contents.size();
        rows += name + bigEndian(0, 4) + bigEndian(unsigned(begin), 4) + bigEndian(64, 4);
        std::string content(64, '\0');
        if (name == "head") content.replace(18, 2, bigEndian(1000, 2));
        if (name == "hhea") content.replace(4, 4, bigEndian(900, 2) + bigEndian(65536 - 300, 2));
        contents += content;
    }
    return kind + bigEndian(unsigned(tables.size()), 2) + std::string(6, '\0') + rows + contents;
}

}  // namespace

TEST_CASE("a font's line is as high as it says, and what is no whole font of outlines is refused",
          "[window-font]") {
    const std::vector<std::string> tables = {"cmap", "head", "hhea", "hmtx", "maxp", "CFF "};
    const std::string whole = font("OTTO", tables);
    REQUIRE(lineHeightOf(whole, 0));
    CHECK(*lineHeightOf(whole, 0) == Approx(1.2));
    for (size_t length = 0; length < whole.size(); ++length)
        CHECK_FALSE(lineHeightOf(std::string_view(whole).substr(0, length), 0));
    for (size_t left = 0; left < tables.size(); ++left) {
        std::vector<std::string> others = tables;
        others.erase(others.begin() + std::ptrdiff_t(left));
        CHECK_FALSE(lineHeightOf(font("OTTO", others), 0));
    }
    CHECK_FALSE(lineHeightOf(font("none", tables), 0));
    CHECK_FALSE(lineHeightOf("", 0));
}
