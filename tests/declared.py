#!/usr/bin/env python3
"""Fails when a room declares a function in its headers that its own library does not define.

Usage: declared.py BUILD_FOLDER. Declarations are read from the headers below src/ROOM, definitions from libshoal_ROOM.a (nm). A name counts
as defined when the library has as many functions of that name as the headers declare; so overloads are counted apart.
"""
import collections
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent
# Templates, what is inline, deleted or defaulted, and pure virtual functions have no definition elsewhere.
without = re.compile(r"\b(template|inline|constexpr|friend|using|typedef|extern|static_assert)\b|=\s*(0|default|delete)\s*$")
scope = re.compile(r"\b(namespace|class|struct|union|enum)\b(?:\s+class)?\s*([\w:]*)[^()]*$")
function = re.compile(r"([~\w]+|operator\s*[^\s\w(]+|operator\s*\(\))\s*\(")


def statements(text):
    """Each declaration that ends in a semicolon, with the scopes around it."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/|^\s*#(?:[^\n]*\\\n)*[^\n]*$", " ", text, flags=re.S | re.M)
    text = re.sub(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)\'', '""', text)
    scopes, start, depth = [], 0, 0
    for at, c in enumerate(text):
        if c == "(":
            depth += 1
        elif c == ")":
            depth -= 1
        elif depth:
            continue
        elif c == "{":
            found = scope.search(text[start:at])
            template = re.search(r"\btemplate\s*<", text[start:at])  # its members are instantiated where they are used
            scopes.append((found.group(1), found.group(2)) if found and not template else ("body", ""))
            start = at + 1
        elif c == "}":
            scopes.pop()
            start = at + 1
        elif c == ";":
            if all(kind in ("namespace", "class", "struct") for kind, _ in scopes):
                yield [name for _, name in scopes if name], text[start:at].strip()
            start = at + 1
        elif c == ":" and re.fullmatch(r"\s*(public|private|protected)\s*", text[start:at]):
            start = at + 1


def declared(room):
    out = collections.Counter()
    for header in (root / "src" / room).rglob("*.h"):
        for scopes, text in statements(header.read_text(encoding="utf-8")):
            found = function.search(re.sub(r"\[\[.*?\]\]|\balignas\([^)]*\)", "", text))
            if not found or without.search(text) or "=" in text[: found.start()] or not scopes:
                continue
            # a member or a variable with a bracketed initialiser has no parameters but expressions; none of ours do
            if re.search(r"std::function<", text[: found.start()]) or text[found.end() :].startswith("*"):
                continue
            out["::".join(scopes + [re.sub(r"\s", "", found.group(1))])] += 1
    return out


def defined(library):
    lines = subprocess.run(["nm", "-C", "--defined-only", library], capture_output=True, text=True, check=True).stdout
    names = set()
    for line in lines.split("\n"):
        kind, _, name = line[17:].partition(" ")
        if kind in ("T", "W", "V") and "(" in name:
            names.add(re.sub(r"\[abi:\w+\]", "", name))
    out = collections.Counter()
    for name in names:
        called = re.match(r"((?:\w+::)*(?:~?\w+|operator(?:\(\)|[^\s\w(]+)))\(", name)
        if called:
            out[called.group(1)] += 1
    return out


def main():
    rooms = sorted(folder.name for folder in (root / "src").iterdir() if folder.is_dir() and folder.name not in ("app", "python"))
    failures, count = [], 0
    for room in rooms:
        has = defined(pathlib.Path(sys.argv[1]) / f"libshoal_{room}.a")
        for name, times in sorted(declared(room).items()):
            count += times
            if has[name] < times:
                failures.append(f"{room} declares {name} {times} times and defines it {has[name]} times")
    print("\n".join(failures) or f"{count} functions of {len(rooms)} rooms are defined where they are declared")
    sys.exit(1 if failures or count < 500 else 0)


main()
