#!/usr/bin/env python3
"""Fails when a test uses a name of Catch2 that one of its major versions may lack.

Every `Catch::name` must be declared in tests/support/catch.h, for both versions.
"""
import pathlib
import re
import sys

tests = pathlib.Path(__file__).resolve().parent
header = tests / "support/catch.h"
listeners = (tests / "support/run_tests.cpp", tests / "hard/table.cpp")  # choose by version themselves


def main():
    newer, older = header.read_text(encoding="utf-8").split("#else")
    declared = [set(re.findall(r"using \w+::(\w+);|inline auto (\w+)\(", part)) for part in (newer, older)]
    known = [{name for pair in names for name in pair if name} for names in declared]
    once = {"Approx"}  # which 3 declares there itself
    known[0] |= once
    failures = [f"{header.name}: {name} is declared for one version only" for name in known[0] ^ known[1]]
    for file in sorted(tests.rglob("*.cpp")) + sorted(tests.rglob("*.h")):
        if file == header or file in listeners:
            continue
        text = file.read_text(encoding="utf-8")
        for name in sorted(set(re.findall(r"\bCatch::(?:Generators::)?(\w+)", text)) - known[0] - {"Matchers"}):
            failures.append(f"{file.relative_to(tests)}: Catch::{name} is not declared in support/catch.h")
        # the header's own names: those of Catch::Matchers mean other things from version to version
        for wrong in re.findall(r"\bCatch::Matchers\b|#include [<\"]catch2/[^>\"]+[>\"]|using namespace Catch\b[\w:]*", text):
            failures.append(f"{file.relative_to(tests)}: {wrong}; include support/catch.h")
    print("\n".join(failures) or f"{len(known[0])} names of Catch2, all of both versions")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
