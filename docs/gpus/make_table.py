#!/usr/bin/env python3
"""Writes the table of docs/gpus/README.md from the reports beside it (`shoal bench --report`), between its markers.

make_table.py           writes it
make_table.py --check   fails where it is not what the reports say, or a report lacks a key
"""
import json
import pathlib
import sys

folder = pathlib.Path(__file__).resolve().parent
page = folder / "README.md"
begin, end = "<!-- made by make_table.py -->\n", "<!-- end -->"


def case(report, group, label):
    for one in report.get("speeds", {}).get("cases", []):
        if one["group"] == group and one["case"] == label and "minSeconds" in one:
            return one
    return None


def short(value):
    """Three digits that count, without an exponent."""
    return f"{float(f'{value:.3g}'):,.10g}"


def milliseconds(one):
    """Wall time, and the device's own where it was measured."""
    if one is None:
        return ""
    own = one.get("deviceMinSeconds")
    return short(one["minSeconds"] * 1e3) + (f" ({short(own * 1e3)})" if own is not None else "")


def rate(one, key, unit):
    return short(one[key] / unit) if one and one.get(key) else ""


def checks(report):
    ran = [one for one in report["checks"] if "leftOut" not in one]
    return f"{sum(one['held'] for one in ran)} of {len(ran)}" if ran else ""


def drawn(report, width):
    for one in report["drawn"]:
        if one["scene"] == "tree/leaves" and one["width"] == width and "draw" in one:
            return short((one["simulate"]["minSeconds"] + one["draw"]["minSeconds"]) * 1e3)
    return ""


columns = [
    ("device", lambda r: f"[{r['machine']['renderer'].split(' (')[0].split('/')[0]}]({r['file']})"),
    ("driver", lambda r: r["machine"]["openGL"].split(" (Core Profile) ")[-1]),
    ("processor", lambda r: f"{r['machine']['processor']}, {r['machine']['cores']} cores"),
    ("commit, date", lambda r: f"{r['commit']}, {r['date']}"),
    ("checks held", checks),
    ("copy, GB/s", lambda r: rate(case(r, "1,048,576 quads", "copy, kernel"), "bytesPerSecond", 1e9)),
    ("multiply-adds, Gop/s", lambda r: rate(case(r, "1,048,576 quads", "multiply-adds"), "operationsPerSecond", 1e9)),
    ("16,384 quads", lambda r: milliseconds(case(r, "16,384 quads", "fused"))),
    ("1,048,576 quads", lambda r: milliseconds(case(r, "1,048,576 quads", "fused"))),
    ("16,384 fish", lambda r: milliseconds(case(r, "16,384 fish", "fused"))),
    ("leaves drawn, 1280 x 720", lambda r: drawn(r, 1280)),
    ("1920 x 1080", lambda r: drawn(r, 1920)),
]


def table():
    reports = []
    for file in sorted(folder.glob("*.json")):
        report = json.loads(file.read_text(encoding="utf-8"))
        if report["format"] != "shoal-device-1":
            sys.exit(f"{file}: expected the format \"shoal-device-1\", found \"{report['format']}\"")
        reports.append(report | {"file": file.name})
    lines = [[name for name, _ in columns], ["---"] * len(columns)]
    lines += [[cell(report) for _, cell in columns] for report in reports]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def main():
    text = page.read_text(encoding="utf-8")
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{page}: expected one pair of markers")
    first, last = text.index(begin) + len(begin), text.index(end)
    made = text[:first] + table() + text[last:]
    if sys.argv[1:] == ["--check"]:
        if made != text:
            sys.exit(f"{page} is not what the reports say: run docs/gpus/make_table.py")
        return
    page.write_text(made, encoding="utf-8")


main()
