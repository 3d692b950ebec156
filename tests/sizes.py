#!/usr/bin/env python3
"""Fails when the tree grows without a word, when a file or function grows past its limit, or when a name is a function
word.

tests/sizes.txt says how large each room of src and of shaders is, and shaders/switches.txt who sets and who reads each
switch of a shader. `--write` renews both (the reason of a new switch is written by hand); what changes in them belongs
into the commit that changes it, with a line of why.
"""
import collections
import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parent.parent
sizes, switches = root / "tests/sizes.txt", root / "shaders/switches.txt"
most_lines, most_function, most_shader = 450, 90, 200
switch_head = "# What conditions of shaders ask for: the switch | who sets it | which files of shaders read it | when it is set"
control = re.compile(r"\s*(?:\} )?(?:if|for|while|do|else|switch|try|catch|case|default)\b")
container = re.compile(r"(?:template <.*> *)?(?:inline )?(?:namespace|struct|class|enum|union|extern \"C\")\b")
word = r"\b(one|at|it|now|with|by|of|is|otherwise|there|both)\b"
# After a type, as one more name of a declaration or a capture, and in a structured binding.
function_word = re.compile(rf"(?:[\w:>\]]\s*[&*]{{0,2}}\s+|[\w>]\s*[&*]{{1,2}}\s*){word}\s*(?:=(?!=)|;|,|\)|\s:\s|\{{|\[|\()"
                           rf"|[,\[]\s*[&*]{{0,2}}{word}\s*=(?!=)|\bauto\s*&{{0,2}}\s*\[[^\]]*{word}[^\]]*\]")
# Strings, characters and comments hold no names.
no_code = re.compile(r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'|//.*')
condition = re.compile(r"^\s*#\s*(?:if|elif|ifdef|ifndef)\b(.*)")


def text_of(file):
    return file.read_text(encoding="utf-8")


def files_of(folder, *endings):
    return sorted(f for f in (root / folder).rglob("*") if f.suffix in endings)


def shader_files():
    return files_of("shaders", ".glsl", ".vert", ".frag", ".geom", ".comp")


def functions(text):
    """Name and length of each function, by the indentation that the formatter gives."""
    open_blocks, head = [], []
    for number, line in enumerate(text.split("\n"), 1):
        bare = line.split("//")[0].rstrip()
        if not bare.strip() or bare.lstrip().startswith("#"):
            continue
        indent = len(bare) - len(bare.lstrip())
        while open_blocks and bare.lstrip().startswith("}") and indent <= open_blocks[-1][0]:
            kind, start, what = open_blocks.pop()[1:]
            if kind == "function":
                yield what, number - start + 1
        head.append((indent, number, bare.strip()))
        if bare.endswith("{"):
            # The statement begins at the last line that is indented as far as its block is closed.
            first = next((h for h in reversed(head) if h[0] <= indent and not h[2].startswith((")", "}", ":"))), head[-1])
            whole = " ".join(h[2] for h in head[head.index(first):])
            inside = all(kind == "container" for _, kind, _, _ in open_blocks)
            kind = "other"
            if container.match(whole) and "(" not in whole.split("{")[0].split(":")[0]:
                kind = "container"
            elif inside and "(" in whole and not control.match(whole) and not re.search(r"= *\{$", whole):
                kind = "function"
            name = re.search(r"([\w:~]+|operator\S+)\(", whole)
            open_blocks.append((first[0], kind, first[1], name[1] if name else whole))
            head = []
        elif bare.endswith(";") or bare.endswith("}") or bare.endswith(":"):
            head = []


def function_words(files):
    """Errors: names that are function words, with file and line of each declaration."""
    found = []
    for file in files:
        text = no_code.sub(lambda match: "" if match[0].startswith("//") else '""' + "\n" * match[0].count("\n"), text_of(file))
        for match in function_word.finditer(text):
            start = match.start(match.lastindex)
            before = re.search(r"(\w+)\W*$", text[:start])
            if not before or before[1] not in ("return", "case", "else", "throw", "new", "delete"):
                line = text.count("\n", 0, start) + 1
                found.append(f"{file.relative_to(root)}:{line}: {match[match.lastindex]} is a function word: a name says what the "
                             "thing is")
    return found


def names_in(condition_text):
    words = re.findall(r"[A-Za-z_]\w*", condition_text)
    return [word for word in words if word != "defined"]


def read_switches():
    """Each name that a condition of a shader asks for: the files that ask, and the files that set it."""
    readers, setters, conditions = collections.defaultdict(set), collections.defaultdict(set), collections.Counter()
    for file in shader_files():
        name = str(file.relative_to(root / "shaders"))
        for line in text_of(file).split("\n"):
            if found := condition.match(line):
                conditions[name.split("/")[0]] += 1
                for word in names_in(found[1]):
                    readers[word].add(name)
            elif found := re.match(r"\s*#\s*define\s+(\w+)", line):
                setters[found[1]].add(name)
    for file in files_of("src", ".cpp", ".h"):
        text = re.sub(r"//.*", "", text_of(file))
        for quoted in re.findall(r'"((?:[^"\\]|\\.)*)"', text):
            for word in re.findall(r"(?:^|#define )([A-Z][A-Z0-9_]+)(?: |$|\\)", quoted):
                setters[word].add("src/" + str(file.relative_to(root / "src")))
    return readers, setters, conditions


def room_of(file, top):
    parts = file.relative_to(root / top).parts
    return parts[0] if len(parts) > 1 else "."


def measure():
    """The text of sizes.txt, and what is beyond a limit."""
    beyond, rows = [], []
    total = 0
    rooms = collections.defaultdict(list)
    for file in files_of("src", ".h", ".cpp"):
        rooms[room_of(file, "src")].append(file)
    rows.append("room | lines | largest file | headers | sources without a header of their name")
    for room, files in sorted(rooms.items()):
        lines = {f: text_of(f).count("\n") for f in files}
        largest = max(lines.values())
        headers = {f.with_suffix("") for f in files if f.suffix == ".h"}
        alone = [f for f in files if f.suffix == ".cpp" and f.with_suffix("") not in headers]
        beyond += function_words(files)
        rows.append(f"{room} | {sum(lines.values())} | {largest} | {len(headers)} | {len(alone)}")
        total += sum(lines.values())
    for file in files_of("src", ".h", ".cpp") + files_of("tests", ".h", ".cpp"):
        text = text_of(file)
        where = file.relative_to(root)
        if text.count("\n") > most_lines:
            beyond.append(f"{where} has {text.count(chr(10))} lines; at most {most_lines} are allowed")
        for name, length in functions(text):
            if length > most_function:
                beyond.append(f"{where}: {name} has {length} lines; at most {most_function} are allowed")
    readers, _, conditions = read_switches()
    rows.append("shaders | lines | largest file | files | conditions")
    rooms = collections.defaultdict(list)
    for file in shader_files():
        rooms[room_of(file, "shaders")].append(file)
    for room, files in sorted(rooms.items()):
        lines = {f: text_of(f).count("\n") for f in files}
        beyond += function_words(files)
        rows.append(f"{room} | {sum(lines.values())} | {max(lines.values())} | {len(files)} | {conditions[room]}")
        total += sum(lines.values())
        for file, count in lines.items():
            if count > most_shader:
                beyond.append(f"{file.relative_to(root)} has {count} lines; at most {most_shader} are allowed")
    rows.append(f"all | {total} lines of src and shaders | {len(readers)} switches | {sum(conditions.values())} conditions")
    return "\n".join(rows) + "\n", beyond


def circles():
    """Folders of shaders that include one another, each way with a file that does."""
    leads = collections.defaultdict(dict)
    for file in shader_files():
        name = str(file.relative_to(root / "shaders"))
        for included in re.findall(r'^\s*#include "([^"]+)"', text_of(file), re.M):
            here, there = name.split("/")[0], included.split("/")[0]
            if here != there and "/" in included and (root / "shaders" / there).is_dir():
                leads[here].setdefault(there, f"{name} includes {included}")
    found = []

    def follow(path):
        for there in sorted(leads[path[-1]]):
            if there == path[0] and there == min(path):
                found.append("; ".join(leads[a][b] for a, b in zip(path, path[1:] + [path[0]])))
            elif there not in path:
                follow(path + [there])

    for folder in sorted(leads):
        follow([folder])
    return found


def switch_table():
    """The text of switches.txt with the reasons that stand there, and what is wrong."""
    readers, setters, _ = read_switches()
    reasons = {}
    if switches.exists():
        for line in text_of(switches).split("\n"):
            if line and not line.startswith("#"):
                name, _, _, why = line.split(" | ")
                reasons[name] = why
    wrong = [f"nobody sets the switch {name}, which {', '.join(sorted(files))} reads"
             for name, files in sorted(readers.items()) if not setters[name]]
    wrong += [f"shaders/switches.txt does not say why there is {name}" for name in sorted(readers) if not reasons.get(name)]
    lines = [switch_head]
    for name, files in sorted(readers.items()):
        lines.append(f"{name} | {' '.join(sorted(setters[name]))} | {' '.join(sorted(files))} | {reasons.get(name, '')}")
    return "\n".join(lines) + "\n", wrong


def main():
    size_text, wrong = measure()
    switch_text, unknown = switch_table()
    wrong += unknown + [f"folders of shaders include one another: {circle}" for circle in circles()]
    for file, text in ((sizes, size_text), (switches, switch_text)):
        if "--write" in sys.argv:
            file.write_text(text, encoding="utf-8")
        elif not file.exists() or text_of(file) != text:
            there = set(text_of(file).split("\n")) if file.exists() else set()
            new = [line for line in text.split("\n") if line not in there]
            wrong.append(f"{file.relative_to(root)} is not as the tree is now (tests/sizes.py --write renews it):\n  "
                         + "\n  ".join(new))
    print("\n".join(wrong) or size_text)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
