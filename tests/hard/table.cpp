#define CATCH_CONFIG_EXTERNAL_INTERFACES  // Catch 2: the listener
#include "hard/table.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "core/file.h"
#include "support/catch.h"

namespace shoal::test {

namespace {

constexpr const char* document = SHOAL_SOURCE_DIR "/docs/hard-cases.md";

// Of a row of a Markdown table, without the spaces around them.
std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> out;
    std::istringstream in(line.substr(1));
    for (std::string cell; std::getline(in, cell, '|');) {
        const size_t from = cell.find_first_not_of(' '), to = cell.find_last_not_of(' ');
        out.push_back(from == std::string::npos ? "" : cell.substr(from, to - from + 1));
    }
    return out;
}

std::optional<Verdict> verdictOf(std::string cell) {
    std::erase(cell, '*');
    for (const Verdict verdict : {Verdict::passes, Verdict::refuses, Verdict::fails})
        if (cell.substr(0, cell.find(':')) == word(verdict)) return verdict;
    return {};
}

// A refusal's message names numbers of the scene: the word says it, the document explains.
std::string cellOf(const Outcome& outcome) {
    if (outcome.verdict == Verdict::refuses || outcome.figure.empty()) return word(outcome.verdict);
    const std::string text = concat(word(outcome.verdict), ": ", outcome.figure);
    return outcome.verdict == Verdict::passes ? text : concat("**", text, "**");
}

// The document around its table, and the table's rows in their order with a cell for each solver that it
// knows.
struct Document {
    struct Row {
        std::string name;
        std::map<std::string, std::string> cells;  // by the solver's name
    };
    std::string before, after;
    std::vector<Row> rows;

    Document() {
        std::istringstream in(readFile(document));
        std::vector<std::string> head;
        for (std::string line; std::getline(in, line);) {
            const bool inTable = !head.empty() && after.empty() && line.starts_with("|");
            if (head.empty() && line.starts_with("| case |"))
                head = cellsOf(line);
            else if (inTable && !line.starts_with("|---"))
                addRow(head, cellsOf(line));
            else if (!inTable)
                (head.empty() ? before : after) += line + "\n";
        }
    }
    void addRow(const std::vector<std::string>& head, const std::vector<std::string>& cells) {
        Row& row = rows.emplace_back(Row{cells.at(0), {}});
        for (size_t i = 1; i < cells.size(); ++i)
            row.cells[head.at(i)] = cells[i];
    }
    Row* row(const std::string& name) {
        const auto found =
            std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.name == name; });
        return found == rows.end() ? nullptr : &*found;
    }
    void write() const {
        std::string table = "| case |", line = "|---|";
        for (const Solver& solver : solvers()) {
            table += concat(" ", solver.name, " |");
            line += "---|";
        }
        table += "\n" + line + "\n";
        for (const Row& row : rows) {
            table += concat("| ", row.name, " |");
            for (const Solver& solver : solvers()) {
                const auto cell = row.cells.find(solver.name);
                table += concat(" ", cell == row.cells.end() ? "" : cell->second, " |");
            }
            table += "\n";
        }
        writeFile(document, before + table + after);
    }
};

Document& documented() {
    static Document one;
    return one;
}

#if __has_include(<catch2/catch_all.hpp>)
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

struct TableWriter : Listener {
    using Listener::Listener;
    void testRunEnded(const Catch::TestRunStats&) override {
        if (updatesTable()) documented().write();
    }
};
CATCH_REGISTER_LISTENER(TableWriter)

}  // namespace

std::optional<Verdict> expectedOf(const std::string& name, const Solver& solver) {
    const Document::Row* row = documented().row(name);
    if (!row) return {};
    const auto cell = row->cells.find(solver.name);
    return cell == row->cells.end() ? std::nullopt : verdictOf(cell->second);
}

bool updatesTable() {
    return std::getenv("SHOAL_UPDATE_HARD") != nullptr;
}

void record(const std::string& name, size_t solver, const Outcome& outcome) {
    if (!updatesTable() || outcome.verdict == Verdict::notFinite) return;
    const Solver& by = solvers()[solver];
    if (expectedOf(name, by) == outcome.verdict) return;
    Document::Row* row = documented().row(name);
    if (!row) row = &documented().rows.emplace_back(Document::Row{name, {}});
    row->cells[by.name] = cellOf(outcome);
}

}  // namespace shoal::test
