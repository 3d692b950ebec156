#!/usr/bin/env python3
"""Fails when a source, a shader or a document cites a key that docs/references.md lacks, or when an entry is never cited.

A key is a name and a year in square brackets, perhaps with a place behind it: [Name 1999], [Name 1999, section 2].
A name and a year in round brackets, or with "et al.", is a citation without a key, and fails as well.
So does a CITATION.cff, by which Shoal itself is cited, or a README.md that states another version than CMakeLists.txt.
"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
name = r"(?:van )?[A-Z][\w']+"
year = r"(?:19|20)\d\d"
cited = re.compile(rf"\[({name} {year})[\],]")
bare = re.compile(rf"\(({name}(?:,? (?:and |et al\.|{name}))* {year})[),;]|\b({name} et al\.(?: {year})?)")
endings = (".h", ".cpp", ".glsl", ".vert", ".frag", ".comp", ".md", ".py")


def text(file):
    """One line, so that a citation may be broken between two lines of a comment."""
    return re.sub(r"\s*\n[ \t]*(?://+|#)?[ \t]*", " ", file.read_text(encoding="utf-8"))


def versions():
    """What is wrong with the versions that are stated; the README has the first two numbers of it."""
    project = re.search(r"^project\(Shoal VERSION ((\d+\.\d+)\.\d+)\s", (root / "CMakeLists.txt").read_text(), re.M)
    if not project:
        return ["CMakeLists.txt: expected project(Shoal VERSION, and three numbers"]
    stated = {"CITATION.cff": (r"^version: (.*)$", project[1]), "README.md": (r"^Version (\d[\d.]*\d)", project[2])}
    found = {file: re.findall(pattern, (root / file).read_text(encoding="utf-8"), re.M)
             for file, (pattern, _) in stated.items()}
    return [f"{file}: expected version {version}, as CMakeLists.txt has it, found {', '.join(found[file]) or 'none'}"
            for file, (_, version) in stated.items() if found[file] != [version]]


def main():
    bibliography = root / "docs/references.md"
    entries = re.findall(rf"^- \[({name} {year})\] ", bibliography.read_text(encoding="utf-8"), re.M)
    folders = ["src", "shaders", "tests", "docs", "models", "molecules"]
    files = [f for folder in folders for f in (root / folder).rglob("*") if f.suffix in endings] + [root / "README.md"]
    failures, used = versions(), set()
    for file in files:
        if file in (bibliography, pathlib.Path(__file__).resolve()):
            continue
        line = text(file)
        for key in cited.findall(line):
            used.add(key)
            if key not in entries:
                failures.append(f"{file.relative_to(root)}: cites [{key}], which docs/references.md lacks")
        for parts in bare.findall(line):
            failures.append(f"{file.relative_to(root)}: cites {''.join(parts)} without a key in square brackets")
    failures += [f"docs/references.md: nothing cites [{key}]" for key in entries if key not in used]
    failures += [f"docs/references.md: [{key}] stands twice" for key in set(entries) if entries.count(key) > 1]
    if len(entries) < 40 or entries != sorted(entries, key=str.lower):
        failures.append("docs/references.md: expected 40 entries or more, in the order of their keys")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
