#define CATCH_CONFIG_EXTERNAL_INTERFACES  // Catch 2: the listener
#include "hard/table.h"

#include <cstdlib>

#include "core/file.h"
#include "support/catch.h"

namespace shoal::test {

namespace {

struct Row {
    std::string name;
    std::vector<Outcome> outcomes;
};

std::vector<Row>& rows() {
    static std::vector<Row> all;
    return all;
}

#if __has_include(<catch2/catch_all.hpp>)
using Listener = Catch::EventListenerBase;
#else
using Listener = Catch::TestEventListenerBase;
#endif

// Writes the table when all tests have run, where SHOAL_HARD_TABLE names a file.
struct TableWriter : Listener {
    using Listener::Listener;
    void testRunEnded(const Catch::TestRunStats&) override {
        if (const char* file = std::getenv("SHOAL_HARD_TABLE")) writeFile(file, markdownTable());
    }
};
CATCH_REGISTER_LISTENER(TableWriter)

}  // namespace

void record(const std::string& name, size_t solver, const Outcome& outcome) {
    if (rows().empty() || rows().back().name != name) rows().push_back({name, {}});
    rows().back().outcomes.resize(solvers().size());
    rows().back().outcomes[solver] = outcome;
}

// A refusal's message names numbers of the scene: the word says it, the document explains.
std::string markdownCell(const Outcome& outcome) {
    if (outcome.verdict == Verdict::refuses || outcome.figure.empty()) return word(outcome.verdict);
    const std::string text = concat(word(outcome.verdict), ": ", outcome.figure);
    return outcome.verdict == Verdict::passes ? text : concat("**", text, "**");
}

std::string markdownTable() {
    std::string head = "| case |", line = "|---|", body;
    for (const Solver& solver : solvers()) {
        head += concat(" ", solver.name, " |");
        line += "---|";
    }
    for (const Row& row : rows()) {
        body += concat("| ", row.name, " |");
        for (const Outcome& outcome : row.outcomes)
            body += concat(" ", markdownCell(outcome), " |");
        body += "\n";
    }
    return concat(head, "\n", line, "\n", body);
}

}  // namespace shoal::test
