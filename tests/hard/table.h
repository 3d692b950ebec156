// The table of docs/hard-cases.md: what each solver is expected to do in each case, and did.
#pragma once

#include <optional>
#include <string>

#include "hard/outcome.h"

namespace shoal::test {

// What the document says; nothing where it has no such row or column.
std::optional<Verdict> expectedOf(const std::string& name, const Solver& solver);

// Whether SHOAL_UPDATE_HARD asks for the document to be renewed when all tests have run: cells whose verdict
// is another, or that it lacks, are written, and the others keep their figures.
bool updatesTable();
void record(const std::string& name, size_t solver, const Outcome& outcome);

}  // namespace shoal::test
