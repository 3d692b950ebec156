#!/usr/bin/env python3
"""Fails when a document or a comment names a source file or a document of the project that is not there.

A name with a folder must be a path from the root, from src, shaders, tests or docs, or from the file that names it.
A name alone must be some file's. Files in "generated" exist in memory only: some source must make them.
"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
endings = r"glsl|vert|frag|comp|h|cpp|cmake|md|py|sh"
named = re.compile(r"(?<![\w./<*$-])((?:[\w.-]+/)*[\w-]+\.(?:%s))(?![\w/]|\.\w)" % endings)
# What is not ours to hold: headers of others, a placeholder, an example's sources.
foreign = re.compile(r"GL/.*|folder/file\.glsl|mine\.cpp")


def comment(line, mark):
    """What follows the mark, unless it stands in a string."""
    before, found, after = line.partition(mark)
    return after if found and before.count('"') % 2 == 0 else ""


def texts(file):
    mark = "#" if file.suffix in (".cmake", ".py", ".sh") else "//"
    for number, line in enumerate(file.read_text(encoding="utf-8").split("\n"), 1):
        yield number, line if file.suffix == ".md" else comment(line, mark)


def main():
    folders = ["src", "shaders", "tests", "docs", "cmake", "models", "molecules"]
    files = [f for folder in folders for f in (root / folder).rglob("*") if f.is_file()] + list(root.glob("*.md"))
    if len(files) < 500:
        sys.exit(f"only {len(files)} files found below {root}")
    names = {f.name for f in files}
    generated = "\n".join(f.read_text(encoding="utf-8") for f in files if f.suffix in (".cpp", ".h"))
    failures = []
    for file in files:
        if not re.fullmatch(r"\.(%s)" % endings, file.suffix) or file.name == "CHANGELOG.md":
            continue
        for number, text in texts(file):
            for path in named.findall(text):
                if path.startswith("generated/"):
                    there = f'"{path}"' in generated
                elif "/" in path:
                    bases = [root, file.parent] + [root / f for f in ("src", "shaders", "tests", "docs")]
                    there = any((base / path).exists() for base in bases)
                else:
                    there = path in names
                if not there and not foreign.fullmatch(path):
                    failures.append(f"{file.relative_to(root)}:{number}: names {path}, which is not there")
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
