#!/usr/bin/env python3
"""Fails when two rooms have types of one name, or two sources of a room do: a reader would take one for the other, and two
definitions in one namespace break the program. What is in an anonymous namespace is its source's own.
"""
import collections
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
opens = re.compile(r"(?:inline )?namespace(?: ([\w:]+))? \{$")
closes = re.compile(r"\}  // namespace")
defines = re.compile(r"(?:template <.*> )?(?:struct|class|enum class|enum) (\w+)(?!\w|::)[^;]*$")


def types(file):
    scopes = []
    for line in file.read_text(encoding="utf-8").split("\n"):
        if found := opens.match(line):
            scopes.append(found[1] or "")
        elif closes.match(line) and scopes:
            scopes.pop()
        elif (found := defines.match(line)) and "" not in scopes:
            yield found[1]


def main():
    places = collections.defaultdict(list)
    for file in sorted((root / "src").rglob("*")):
        if file.suffix in (".h", ".cpp"):
            for name in types(file):
                places[name].append(str(file.relative_to(root)))
    if len(places) < 300:
        sys.exit(f"only {len(places)} types found below {root / 'src'}")
    shared = {name: files for name, files in places.items() if len(files) > 1}
    for name, files in sorted(shared.items()):
        print(f"{name} is defined in {' and '.join(files)}")
    sys.exit(1 if shared else 0)


main()
