// The outcomes of a run, and the table of them as Markdown.
#pragma once

#include <string>

#include "hard/outcome.h"

namespace shoal::test {

void record(const std::string& name, size_t solver, const Outcome& outcome);

// One row a case in the order they ran: what each solver did, in the words of docs/hard-cases.md.
std::string markdownTable();
// "| passes | fails | ..." of a row, with or without figures: what the document's rows begin with.
std::string markdownCell(const Outcome& outcome);

}  // namespace shoal::test
