"""The data of docs/accuracy.md: what grid.py has measured, kept as scenes.csv and points.csv, what claims.py has asked, kept as
claims.csv, what contact.py has measured, kept as contact.csv, and what an error costs."""
import csv
import itertools
import json
import math
import pathlib
import shutil
import sys

import claims
import contact
import grid

here = pathlib.Path(__file__).resolve().parent
target = 1e-3  # the error that costs are of
scene_keys = ("scene", "noError", "referenceError", "solver", "substeps", "chosenError", "chosenAfter", "notChosen", "measured",
              "timed", "commit", "date", "processor", "cores", "renderer", "openGL")
point_keys = ("scene", "solver", "stepsPerSecond", "outcome", "error", "worst", "nanoseconds", "samples", "why")


# ---- Files

def short(value, digits=4):
    return "" if value is None else f"{value:.{digits}g}"


def scene_row(name, report):
    machine, context, chosen, group = report["machine"], report["context"], report["chosen"] or {}, report["groups"][0]
    return {"scene": name, "noError": report["chaotic"] or report["tooStiff"] or "",
            "referenceError": short(report["referenceError"], 2), "solver": chosen.get("solver", ""),
            "substeps": chosen.get("substeps", ""), "chosenError": short(chosen.get("error"), 3),
            "chosenAfter": short(chosen.get("duration"), 3), "notChosen": report.get("notChosen", ""),
            "measured": group["measuredMolecules"], "timed": group["timedMolecules"], "commit": report["commit"],
            "date": report["date"], "processor": machine["processor"], "cores": machine["cores"],
            "renderer": context["renderer"], "openGL": context["version"]}


def point_rows(name, report):
    """All but the steps that a method refuses before the last such one."""
    points = report["points"]
    for point, after in itertools.zip_longest(points, points[1:]):
        refused = point["outcome"] == "refused"
        if refused and after and after["outcome"] == "refused" and after["solver"] == point["solver"]:
            continue
        timed = point.get("samples")
        yield {"scene": name, "solver": point["solver"], "stepsPerSecond": point["stepsPerSecond"],
               "outcome": point["outcome"], "error": short((point.get("error") or {}).get("total")),
               "worst": short((point.get("error") or {}).get("worst"), 3),
               "nanoseconds": short(point["minSecondsPerVertexAndSecond"] * 1e9) if timed else "",
               "samples": timed or 0, "why": point.get("why", "")}


def write(file, keys, rows):
    with open(file, "w", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, keys, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


contact_keys = ("scene", "substeps", "iterations", "outcome", "overlap", "largestOverlap", "energyGiven", "momentum", "contacts",
                "minSeconds", "medianSeconds", "secondsPerContact", "front", "scenes", "commit", "date")


def contact_rows(name, report):
    for point in report["points"]:
        row = {key: point.get(key) for key in contact_keys}
        yield row | {key: short(value, 3) for key, value in row.items() if isinstance(value, float)} | {
            "scene": name, "front": int(point.get("front", False)), "scenes": int(point.get("scenes", False)),
            "commit": report["commit"], "date": report["date"]}


def found_in(folders):
    """The reports by scene. A folder is of one commit; what a later one has takes the place of what an earlier one has."""
    reports = {}
    for folder in folders:
        found = {grid.id_of(scene): folder / f"{grid.id_of(scene)}.json" for scene in grid.scene_ids()}
        found = {name: json.loads(file.read_text(encoding="utf-8")) for name, file in found.items() if file.exists()}
        commits = {report["commit"] for report in found.values()}
        if len(commits) > 1:
            sys.exit(f"{folder}: its scenes were measured at more than one commit: {', '.join(sorted(commits))}")
        reports |= found
    return reports


def take(folders):
    asked = [folder / "claims.csv" for folder in folders if (folder / "claims.csv").exists()]
    if asked:
        claims.rows_of(asked[-1])
        shutil.copy(asked[-1], here / "claims.csv")
    touching = [folder for folder in folders if (folder / "contact-pile.json").exists()]
    if touching:
        found = {name: json.loads((touching[-1] / f"contact-{name}.json").read_text(encoding="utf-8")) for name in contact.scenes}
        write(here / "contact.csv", contact_keys,
              itertools.chain.from_iterable(contact_rows(name, report) for name, report in found.items()))
    found = found_in(folders)
    if (asked or touching) and not found:
        return
    names = [grid.id_of(scene) for scene in grid.scene_ids()]
    missing = [name for name in names if name not in found]
    if missing:
        sys.exit(f"{folders[-1]}: {len(missing)} scenes are missing, such as {missing[0]}: grid.py measures them")
    write(here / "scenes.csv", scene_keys, (scene_row(name, found[name]) for name in names))
    write(here / "points.csv", point_keys, itertools.chain.from_iterable(point_rows(name, found[name]) for name in names))


def number(text):
    return float(text) if text else None


def read():
    """The scenes by name, in the order of the tables, each with its `points`."""
    with open(here / "scenes.csv", newline="", encoding="utf-8") as file:
        scenes = {row["scene"]: row | {"points": []} for row in csv.DictReader(file)}
    with open(here / "points.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            row |= {key: number(row[key]) for key in ("stepsPerSecond", "error", "worst", "nanoseconds")}
            scenes[row["scene"]]["points"].append(row)
    return scenes


def claims_in(file=here / "claims.csv"):
    """A row a scene and error, with numbers; without a claim `found` is None."""
    rows = claims.rows_of(file)
    for row in rows:
        row |= {key: number(row[key]) for key in ("asked", *claims.found_keys[1:])}
    return rows


def contact_in(file=here / "contact.csv"):
    """The points that were measured and timed, by scene."""
    scenes = {name: [] for name in contact.scenes}
    with open(file, newline="", encoding="utf-8") as rows:
        for row in csv.DictReader(rows):
            if row["minSeconds"]:
                row |= {key: number(row[key]) for key in contact_keys[1:3] + contact_keys[4:14]}
                scenes[row["scene"]].append(row)
    return scenes


def read_space():
    """The rows of space.csv: a shape, how its molecule was made, its vertices and relative errors."""
    with open(here / "space.csv", newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            yield {key: value if key in ("shape", "made") else number(value) for key, value in row.items()} | {
                "vertices": int(row["vertices"])}


# ---- What an error costs

class Cost:
    """What a solver costs at an error, in nanoseconds per vertex and simulated second, and how that is known: "" measured,
    "longest" by the longest step that it can take, "above" from there on, "floor" never (then its least error), "untimed",
    "no time" for any step, "refused" or "blows up" at all of them."""

    def __init__(self, how, value, text):
        self.how, self.value, self.text = how, value, text

    @property
    def reached(self):
        return self.how in ("", "longest")


def plain(value):
    digits = 2 if value < 10 else 1 if value < 100 else 0
    return f"{value:,.{digits}f}"


def exponent(value):
    return f"{value:.0e}".replace("e-0", "e-")


def times(points):
    """Seconds are missing where a point took too long to be timed: it takes as long a step as the finest that was timed."""
    finest = [point for point in points if point["nanoseconds"]][-1]
    for point in points:
        yield point["nanoseconds"] or finest["nanoseconds"] * point["stepsPerSecond"] / finest["stepsPerSecond"]


def cost_of(points, error=target):
    """`points`: of one solver."""
    measured = [point for point in points if point["outcome"] == "measured" and point["error"] is not None]
    if not measured:
        outcomes = {point["outcome"] for point in points}
        why = "no time" if "left out" in outcomes else "refused" if outcomes == {"refused"} else "blows up"
        return Cost(why, None, why)
    least = min(point["error"] for point in measured)
    if not any(point["nanoseconds"] for point in measured):
        steps = next(point["stepsPerSecond"] for point in measured if point["error"] == least)
        return Cost("untimed", None, f"untimed: {exponent(least)} at {steps:,.0f} steps/s")
    curve = [(time, max(point["error"], 1e-12)) for point, time in zip(measured, times(measured))]
    found = []
    if curve[0][1] <= error:
        found.append(Cost("longest", curve[0][0], f"*{plain(curve[0][0])}*"))
    for (time, high), (after, low) in zip(curve, curve[1:]):
        if high > error >= low:
            # Between two points both logarithms are interpolated.
            value = time * (after / time) ** (math.log(high / error) / math.log(high / low))
            found.append(Cost("", value, plain(value)))
    if found:
        return min(found, key=lambda cost: cost.value)
    if any(point["outcome"] == "left out" for point in points):
        return Cost("above", curve[-1][0], f"> {plain(curve[-1][0])}")
    return Cost("floor", least, f"floor {exponent(least)}")


def costs(scene):
    by_solver = {}
    for point in scene["points"]:
        by_solver.setdefault(point["solver"], []).append(point)
    return {solver: cost_of(points) for solver, points in by_solver.items()}


def best(scene):
    """The cheapest solver, and how many times as fast as `euler` it is as a text; nothing where none gets there."""
    found = costs(scene)
    reached = {solver: cost for solver, cost in found.items() if cost.reached}
    if scene["noError"] or not reached:
        return None
    solver = min(reached, key=lambda name: reached[name].value)
    first = found["euler"]
    if first.value is None or first.how == "floor":
        return solver, None, ""
    ratio = first.value / reached[solver].value
    return solver, ratio, f"{'> ' if first.how == 'above' else ''}{ratio:.{1 if ratio < 9.95 else 0}f}×"
