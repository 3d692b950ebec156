#!/usr/bin/env python3
"""Fails when a source, a shader or a document cites a key that docs/references.md lacks, or when an entry is never cited.

A key is a name and a year in square brackets, perhaps with a place behind it: [Name 1999], [Name 1999, section 2].
A name and a year in round brackets, or with "et al.", is a citation without a key, and fails as well.
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


def main():
    bibliography = root / "docs/references.md"
    entries = re.findall(rf"^- \[({name} {year})\] ", bibliography.read_text(encoding="utf-8"), re.M)
    folders = ["src", "shaders", "tests", "docs", "models", "molecules"]
    files = [f for folder in folders for f in (root / folder).rglob("*") if f.suffix in endings] + [root / "README.md"]
    failures, used = [], set()
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
