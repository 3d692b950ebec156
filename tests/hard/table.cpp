#define CATCH_CONFIG_EXTERNAL_INTERFACES  // Catch 2: the listener
#include "hard/table.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>

#include "core/file.h"
#include "support/catch.h"

namespace shoal::test {

namespace {

constexpr const char* document = SHOAL_SOURCE_DIR "/docs/hard-cases.md";
constexpr const char* figuresFile = SHOAL_SOURCE_DIR "/docs/hard-cases.tsv";

std::optional<Verdict> verdictOf(const std::string& text) {
    for (const Verdict verdict : {Verdict::passes, Verdict::refuses, Verdict::fails})
        if (text == word(verdict)) return verdict;
    return {};
}

// Outcomes of cases in their order, as the file has them.
class Table {
  public:
    struct Row {
        std::string name;
        std::map<std::string, Outcome> outcomes;  // by the solver's name
    };

    Table() {
        std::istringstream in(readFile(figuresFile));
        std::string line;
        std::getline(in, line);  // the head
        while (std::getline(in, line)) {
            std::istringstream cells(line);
            std::string name, solver, text, figure;
            std::getline(cells, name, '\t');
            std::getline(cells, solver, '\t');
            std::getline(cells, text, '\t');
            std::getline(cells, figure);
            if (const std::optional<Verdict> verdict = verdictOf(text))
                (*this)[name].outcomes[solver] = {*verdict, figure};
        }
    }

    // Returns what the row of that name has for a solver; null without.
    const Outcome* find(const std::string& name, const Solver& solver) const {
        for (const Row& row : rows_)
            if (row.name == name) return find(row, solver);
        return nullptr;
    }

    // Returns the row of that name, which is made at the end where there is none.
    Row& operator[](const std::string& name) {
        for (Row& row : rows_)
            if (row.name == name) return row;
        return rows_.emplace_back(Row{name, {}});
    }

    // A refusal's message names numbers of the scene: its figures are left out, and the document explains.
    std::string text() const {
        std::string out = "case\tsolver\toutcome\tfigures\n";
        for (const Row& row : rows_) {
            for (const Solver& solver : solvers()) {
                const Outcome* found = find(row, solver);
                if (!found) continue;
                out += concat(row.name, "\t", solver.name, "\t", word(found->verdict), "\t",
                              found->verdict == Verdict::refuses ? "" : found->figure, "\n");
            }
        }
        return out;
    }

    std::string markdown() const {
        std::string out = "| case |", line = "|---|";
        for (const Solver& solver : solvers()) {
            out += concat(" ", solver.name, " |");
            line += "---|";
        }
        out += "\n" + line + "\n";
        for (const Row& row : rows_) {
            out += concat("| ", row.name, " |");
            for (const Solver& solver : solvers()) {
                const Outcome* found = find(row, solver);
                const std::string verdict = found ? word(found->verdict) : "";
                out += concat(" ", verdict == word(Verdict::fails) ? "**" + verdict + "**" : verdict, " |");
            }
            out += "\n";
        }
        return out;
    }

  private:
    static const Outcome* find(const Row& row, const Solver& solver) {
        const auto found = row.outcomes.find(solver.name);
        return found == row.outcomes.end() ? nullptr : &found->second;
    }

    std::vector<Row> rows_;
};

Table& documented() {
    static Table table;
    return table;
}

// Returns the document with this table.
std::string documentWith(const std::string& table) {
    std::string text = readFile(document);
    const size_t start = text.find("| case |"), end = text.find("\n\n", start);
    return text.replace(start, end + 1 - start, table);
}

#if __has_include(<catch2/catch_all.hpp>)
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

struct TableWriter : Listener {
    using Listener::Listener;
    void testRunEnded(const Catch::TestRunStats&) override {
        if (!updatesTable()) return;
        writeFile(figuresFile, documented().text());
        writeFile(document, documentWith(documented().markdown()));
    }
};
CATCH_REGISTER_LISTENER(TableWriter)

}  // namespace

std::optional<Verdict> expectedOf(const std::string& name, const Solver& solver) {
    const Outcome* found = documented().find(name, solver);
    return found ? std::optional(found->verdict) : std::nullopt;
}

bool updatesTable() {
    return std::getenv("SHOAL_UPDATE_HARD") != nullptr;
}

void record(const std::string& name, size_t solver, const Outcome& outcome) {
    if (!updatesTable() || outcome.verdict == Verdict::notFinite) return;
    const Solver& by = solvers()[solver];
    if (expectedOf(name, by) != outcome.verdict) documented()[name].outcomes[by.name] = outcome;
}

TEST_CASE("the table of hard cases is what their figures say", "[table]") {
    CHECK(readFile(figuresFile) == documented().text());
    CHECK(readFile(document) == documentWith(documented().markdown()));
}

}  // namespace shoal::test
