// docs/hard-cases.md against expected.cpp: the same rows with the same verdicts. Figures may differ.
#include <sstream>

#include "core/file.h"
#include "hard/outcome.h"
#include "support/catch.h"

namespace shoal {

namespace {

// Cells of a row of a Markdown table, without the spaces and stars around them.
std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
        const size_t from = cell.find_first_not_of(" *"), to = cell.find_last_not_of(" *");
        out.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    return out;
}

// Its cells by the row's name: one a solver.
std::vector<std::string> documentedRow(const std::string& text, const std::string& name) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        if (line.rfind(concat("| ", name, " |"), 0) != 0) continue;
        std::vector<std::string> cells = cellsOf(line);
        cells.erase(cells.begin());
        return cells;
    }
    return {};
}

}  // namespace

TEST_CASE("hard: the document tells every outcome", "[hard][document]") {
    const std::string text = readFile(SHOAL_SOURCE_DIR "/docs/hard-cases.md");
    for (const std::string& name : test::expectedNames()) {
        const std::vector<test::Verdict>& row = test::expectedOf(name);
        const std::vector<std::string> documented = documentedRow(text, name);
        INFO("row \"" << name << "\" of docs/hard-cases.md");
        REQUIRE(documented.size() == row.size());
        for (size_t i = 0; i < row.size(); ++i)
            CHECK(documented[i].substr(0, documented[i].find(':')) == word(row[i]));
    }
}

}  // namespace shoal
