#!/usr/bin/env python3
"""Fails when a document or a comment names a file or a folder of the project that is not there.

Looked at are names of source files and documents, and outside blocks of code also whatever begins with a folder of the
project (tests/gl), what stands in backquotes and begins with a folder in one of those (`scene/json`), lists of bare
names in backquotes, most of which are such folders, and links. Stars are a shell's; what ends in a slash must be a folder.
A name with a folder must be a path from the root, from one of its folders or from the file that names it, or a scene as
`shoal scenes` lists it; a link is a path from its file. A name alone must be some file's. Files in "generated" exist in
memory only: some source must make them. docs/index.md leads to every document.
"""
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
folders = ["src", "shaders", "tests", "docs", "cmake", "models", "molecules"]
roots = [root] + [root / folder for folder in folders]
rooms = {folder: {f.name for f in (root / folder).iterdir() if f.is_dir()} for folder in folders}
within = sorted(set().union(*rooms.values()))
endings = r"glsl|vert|frag|comp|h|cpp|cmake|md|py|sh|yml"
named = re.compile(r"(?<![\w./<*$-])((?:[\w.-]+/)*[\w-]+\.(?:%s))(?![\w/]|\.\w)" % endings)
below = re.compile(r"(?<![\w./<*$-])((?:%s)/[\w./*-]*)(?![\w/*{<$])" % "|".join(folders))
quoted = re.compile(r"`((?:%s)/[\w./*-]*)`" % "|".join(within))
listed = re.compile(r"`[\w-]+`(?:(?:, and |, | and | or )`[\w-]+`){3,}")
linked = re.compile(r"\]\((?!\w+:)([^)\s#]+)")
# What is not ours to hold: headers of others, placeholders, an example's sources.
foreign = re.compile(r"GL/.*|folder/file\.glsl|mine\.cpp|models/mine(?:/.*)?|src/NAME")


def comment(line, mark):
    """What follows the mark, unless it stands in a string."""
    before, found, after = line.partition(mark)
    return after if found and before.count('"') % 2 == 0 else ""


def texts(file):
    """Each line's number and text, and whether it stands outside blocks of code."""
    document = file.suffix in (".md", ".yml")
    mark = "//" if re.fullmatch(r"\.(glsl|vert|frag|comp|h|cpp)", file.suffix) else "#"
    fenced = False
    for number, line in enumerate(file.read_text(encoding="utf-8").split("\n"), 1):
        fenced ^= document and line.startswith("```")
        prose = not fenced and not (file.suffix == ".md" and line.startswith("    "))
        if text := line if document else comment(line, mark):
            yield number, text, prose


def is_there(path, bases):
    if "*" in path:
        return any(any(base.glob(path)) for base in bases)
    return any((base / path).is_dir() if path.endswith("/") else (base / path).exists() for base in bases)


def strangers(text):
    """In lists of four or more bare names of which three quarters are folders of one folder: the others."""
    for names in (re.findall(r"`([\w-]+)`", found) for found in listed.findall(text)):
        for inside in rooms.values():
            others = [name for name in names if name not in inside]
            if 4 * len(others) <= len(names):
                yield from others


def missing(file, text, prose, names, generated):
    """The names in a line of what is not there."""
    bases = roots + [file.parent]
    for path in named.findall(text):
        if path.startswith("generated/"):
            there = f'"{path}"' in generated
        else:
            there = is_there(path, bases) if "/" in path else path in names
        if not there:
            yield path
    if prose:
        yield from (path for path in map(lambda path: path.rstrip(".-"), below.findall(text))
                    if not is_there(path, [root, file.parent]))
        yield from (path for path in quoted.findall(text)
                    if not is_there(path, bases) and not is_there(path + ".scene.json", [root / "models"]))
        yield from strangers(text)
        if file.suffix == ".md":
            yield from (path for path in linked.findall(text) if not is_there(path, [file.parent]))


def main():
    files = [f for folder in folders + [".github", ".ci"] for f in (root / folder).rglob("*") if f.is_file()]
    files += [f for f in root.iterdir() if f.suffix == ".md" or f.name in ("CMakeLists.txt", "dev")]
    if len(files) < 500:
        sys.exit(f"only {len(files)} files found below {root}")
    names = {f.name for f in files}
    generated = "\n".join(f.read_text(encoding="utf-8") for f in files if f.suffix in (".cpp", ".h"))
    failures = []
    for file in files:
        with_names = re.fullmatch(r"\.(%s)" % endings, file.suffix) or file.name in ("CMakeLists.txt", "dev", "run")
        if not with_names or file.name == "CHANGELOG.md":
            continue
        for number, text, prose in texts(file):
            for path in dict.fromkeys(missing(file, text, prose, names, generated)):
                if not foreign.fullmatch(path):
                    failures.append(f"{file.relative_to(root)}:{number}: names {path}, which is not there")
    index = root / "docs/index.md"
    led = {(index.parent / path).resolve() for path in linked.findall(index.read_text(encoding="utf-8"))} | {index}
    failures += [f"docs/index.md: does not lead to {file.relative_to(root)}" for file in files
                 if file.suffix == ".md" and index.parent in file.parents and file not in led]
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


main()
