// The outcomes of docs/hard-cases.tsv, and the table of docs/hard-cases.md, which follows from them: what
// each solver is expected to do in each case, and did.
#pragma once

#include <optional>
#include <string>

#include "hard/outcome.h"

namespace shoal::test {

// What the file says; nothing where it has no such case or solver.
std::optional<Verdict> expectedOf(const std::string& name, const Solver& solver);

// Whether SHOAL_UPDATE_HARD asks for both to be renewed when all tests have run: outcomes whose verdict is
// another, or that they lack, are written, and the others keep their figures.
bool updatesTable();
void record(const std::string& name, size_t solver, const Outcome& outcome);

}  // namespace shoal::test
