#!/usr/bin/env python3
"""Fails where code takes a kind or a solver that it does not know for another, without a word.

A kind that is added has to be told to whoever asks for it: a switch over kinds has no `default:`, and no overload for
kinds takes any other. What a Runge-Kutta method is stands in its row of src/scene/solver.cpp: no other source asks for
one by name.
"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
enumerations = {"SolverKind", "PassKind", "From"}
shapes = re.compile(r"struct (\w+(?:Collider|Field|Force)) \{")
switch = re.compile(r"\bswitch \(")
label = re.compile(r"\bcase (?:\w+::)*?(\w+)::\w+:")
# An overload of a visitor that takes whatever no other takes, and does not look at it.
generic = re.compile(r"operator\(\)\((?:const )?auto&{1,2}\)|\]\s*\((?:const )?auto&{1,2}\)")
templated = re.compile(r"template <(?:typename|class) (\w+)>\s*[\w:<>, ]+ (?:operator\(\)|\w+)\((?:const )?\1&{1,2}(?: \w+)?\)")
method = re.compile(r'rungeKutta\((?:SolverKind::(\w+))')


def body(text, start):
    """From the first brace behind `start` to the one that closes it."""
    depth, at = 0, text.index("{", start)
    for end in range(at, len(text)):
        depth += {"{": 1, "}": -1}.get(text[end], 0)
        if depth == 0:
            return text[at:end]
    return text[at:]


def without_inner(text):
    """The text of a switch without those that it holds."""
    inner = switch.search(text, 1)
    while inner:
        text = text[:inner.start()] + text[inner.start():].replace(body(text, inner.start()), "", 1).replace("switch (", "(", 1)
        inner = switch.search(text, 1)
    return text


def failures(name, text, kinds, methods):
    line = lambda at: text.count("\n", 0, at) + 1
    for found in switch.finditer(text):
        block = without_inner(body(text, found.start()))
        asked = enumerations & set(label.findall(block))
        if asked and re.search(r"\bdefault:", block):
            yield f"{name}:{line(found.start())}: a switch over {' and '.join(sorted(asked))} has a `default:`"
    for found in templated.finditer(text):
        # beside overloads for kinds
        start = max(text.rfind("\nstruct ", 0, found.start()), text.rfind("\nclass ", 0, found.start()))
        beside = body(text, start) if start >= 0 else ""
        if any(re.search(rf"operator\(\)\((?:const )?{kind}&", beside) for kind in kinds):
            yield f"{name}:{line(found.start())}: an overload beside those for kinds takes any other"
    for found in generic.finditer(text):
        yield f"{name}:{line(found.start())}: an overload takes anything and looks at nothing"
    if name not in ("src/scene/solver.cpp", "src/bench/particle_cases.cpp"):
        for one in methods:
            for found in re.finditer(rf"SolverKind::{one}\b", text):
                yield f"{name}:{line(found.start())}: asks for {one} by name; its row says what it is"


def main():
    files = {str(f.relative_to(root)): f.read_text(encoding="utf-8")
             for f in sorted((root / "src").rglob("*")) if f.suffix in (".h", ".cpp")}
    kinds = {kind for text in files.values() for kind in shapes.findall(text)}
    methods = set(method.findall(files["src/scene/solver.cpp"]))
    if len(kinds) < 20 or not methods:
        sys.exit(f"only {len(kinds)} kinds and {len(methods)} Runge-Kutta methods found in src")
    found = [failure for name, text in files.items() for failure in failures(name, text, kinds, methods)]
    print("\n".join(found))
    sys.exit(1 if found else 0)


main()
