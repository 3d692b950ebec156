#!/usr/bin/env python3
"""Makes the tables and pictures of docs/accuracy.md from its data, docs/accuracy/scenes.csv, points.csv, claims.csv and contact.csv.

report.py                tables and pictures; pictures by Matplotlib
report.py --check        ends with 1 where a table of a page is not what the data say; tells the commit that they are of, and
                         which sources have changed since
report.py --space        tables, and the picture of the error in space alone: space.csv is the unit tests' (SHOAL_UPDATE_SPACE=1)
report.py FOLDER…        takes what grid.py and contact.py have measured and claims.py has asked into these for the data, the
                         last where several have a scene, then does the same as without

A table stands in a page between the comments `report.py: NAME` and `report.py: end`.
"""
import argparse
import itertools
import math
import pathlib
import re
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here), str(here.parent)]
import claims
import data
import grid

pages = here.parent / "accuracy.md", here.parent.parent / "README.md"
# Figures depend on these: the data are as old as the commit that they are of.
sources = ("shaders/physics", "shaders/solver", "shaders/step", "shaders/fused", "src/compile", "src/measure", "src/reference",
           "src/simulate")


# ---- Tables

def table(head, rows):
    return "".join("| " + " | ".join(row) + " |\n" for row in (head, *rows)).replace("\n", "\n" + "|---" * len(head) + "|\n", 1)


def times(factor):
    return f"{factor:.{1 if factor < 9.95 else 0}f}"


stiffness = [f"k = 1e{power}" for power in grid.powers]


def by_stiffness(scenes, cell):
    """A row a motion and molecule, a column a stiffness."""
    return table(["motion, molecule"] + stiffness, [
        [f"{motion}, {molecule}"] + [cell(scenes[grid.id_of((molecule, motion, power))]) for power in grid.powers]
        for motion, molecule in itertools.product(grid.motions, grid.molecules)])


def best_cell(scene):
    if scene["noError"]:
        return "chaotic" if "still changes" in scene["noError"] else "too stiff"
    found = data.best(scene)
    return " ".join(found[::2]).rstrip() if found else "none gets there"


def summary(scenes):
    """A row a motion, a column a stiffness: the methods that are cheapest for its molecules, and the range of their factors."""
    rows = []
    for motion in grid.motions:
        row = [f"**{motion}**"]
        for power in grid.powers:
            found = [data.best(scenes[grid.id_of((molecule, motion, power))]) for molecule in grid.molecules]
            names = dict.fromkeys(one[0] for one in found if one)
            factors = sorted(one[1] for one in found if one and one[1])
            span = ""
            if factors:
                low, high = times(factors[0]), times(factors[-1])
                span = f"<br>{high}×" if low == high else f"<br>{low} to {high}×"
            row.append(", ".join(f"`{name}`" for name in names) + span if names else "none")
        rows.append(row)
    return table([""] + stiffness, rows)


def cost_table(scenes):
    solvers = list(dict.fromkeys(point["solver"] for scene in scenes.values() for point in scene["points"]))
    rows = []
    for motion, molecule, power in itertools.product(grid.motions, grid.molecules, grid.powers):
        scene = scenes[grid.id_of((molecule, motion, power))]
        found = data.costs(scene)
        rows.append([f"{motion}, {molecule}, k = 1e{power}"] + (
            [best_cell(scene)] + [""] * (len(solvers) - 1) if scene["noError"]
            else [found[solver].text if solver in found else "not tried" for solver in solvers]))
    return table(["scene"] + solvers, rows)


def chosen_cell(scene):
    if not scene["solver"]:
        return "none"
    length = "" if float(scene["chosenAfter"]) > 0.99 * duration(scene) else f", after {scene['chosenAfter']} s"
    return f"{scene['solver']} {scene['substeps']}{length}"


def duration(scene):
    return 0.4 if "-impact-" in scene["scene"] else 1


def chosen_ratio(scene):
    """By how much the choice of --error, at its own error, is dearer than the cheapest method in hindsight."""
    found = [cost.value for cost in data.costs(scene).values() if cost.reached]
    steps = float(scene["substeps"]) * grid.frame_rate
    points = [point for point in scene["points"] if point["solver"] == scene["solver"] and point["stepsPerSecond"] == steps]
    if not found or not points or not points[0]["nanoseconds"]:
        return None
    return points[0]["nanoseconds"] / min(found)


def factor(scene, solver):
    """How many times as fast as `euler` a solver is, as a text."""
    found = data.costs(scene)
    first, cost = found["euler"], found[solver]
    if not cost.reached or first.value is None or first.how == "floor":
        return "not known"
    return ("> " if first.how == "above" else "") + times(first.value / cost.value)


def targets(scenes):
    def factors(solver, *names):
        return ", ".join(factor(scenes[name], solver) for name in names)

    whole = [scene for scene in scenes.values() if scene["solver"] and float(scene["chosenAfter"]) > 0.99 * duration(scene)]
    ratios = {scene["scene"]: chosen_ratio(scene) for scene in whole}
    known = {name: ratio for name, ratio in ratios.items() if ratio}
    worst = max(known, key=known.get)
    least = {}
    for point in itertools.chain.from_iterable(scene["points"] for scene in scenes.values()):
        if point["error"]:
            least[point["solver"]] = min(point["error"], least.get(point["solver"], 1))
    return table(["target", "measured"], [
        ["`leapfrog` at least 10 times `euler`, falling leaf, k = 1e2 and 1e4",
         factors("leapfrog", "leaf-fall-1e2", "leaf-fall-1e4")],
        ["the same, pinned in gusts", factors("leapfrog", "leaf-gusts-1e2", "leaf-gusts-1e4")],
        ["`bdf2-xpbd` at least 8 times at 1e6: falling leaf, fish", factors("bdf2-xpbd", "leaf-fall-1e6", "fish-fall-1e6")],
        ["`bdf2-xpbd` at least 60 times at 1e8: falling leaf, fish", factors("bdf2-xpbd", "leaf-fall-1e8", "fish-fall-1e8")],
        ["`bdf2-corotated` at least 60 times, pinned fish at 1e8", factors("bdf2-corotated", "fish-gusts-1e8")],
        ["the automatic choice within 2 times the best in hindsight",
         f"in {sum(ratio <= 2 for ratio in known.values())} of the {len(known)} scenes where it claims an error after the whole "
         f"time; at most {known[worst]:.1f} times, {worst}"],
        ["every method below 1e-4 somewhere, but `verlet` and `xpbd`",
         ", ".join(f"`{solver}` {value:.1e}" for solver, value in least.items()).replace("e-0", "e-")]])


def claims_table(found):
    """A row an error that was asked for."""
    rows = []
    for text in claims.errors:
        asked = [row for row in found if row["asked"] == float(text)]
        told = [row for row in asked if row["found"] is not None]
        above, unknown = (int(sum(row[key] for row in told)) for key in ("foundAbove", "foundUnknown"))
        within = [sum(row["found"] <= share * row["asked"] for row in told) for share in (1, 2)]
        most = [max((row["found"] / row[key] for row in told), default=0) for key in ("asked", "claimed")]
        rows.append([text, str(len(told)), str(len(asked) - len(told)), *map(str, within), *(f"{value:.2g}" for value in most),
                     f"{above}, {unknown} of {len(told) * claims.molecules:,}", str(sum(row["after"] < 0.95 for row in told))])
    return table(["E", "claims", "refused", "found RMS below E", "below 2 E", "the largest found RMS over E",
                  "found over claimed, at most", "molecules above E, unknown", "claims of less than 1 s"], rows)


def contact_table(found):
    """A row a scene: its defaults, and the cheapest points with a tenth and half of their overlap."""
    rows = []
    for name, points in found.items():
        own = next(point for point in points if point["scenes"])

        def cheapest(share):
            within = [point for point in points if point["overlap"] <= share * own["overlap"]]
            if not within:
                return "none"
            point = min(within, key=lambda each: each["minSeconds"])
            return f"{point['substeps']:.0f} × {point['iterations']:.0f}: {point['minSeconds'] / own['minSeconds']:.2g}×"

        rows.append([name, f"{own['substeps']:.0f} × {own['iterations']:.0f}", f"{own['overlap']:.1e}",
                     f"{own['largestOverlap']:.1e}", f"{own['energyGiven']:.1e}", f"{own['momentum']:.0e}",
                     f"{1e3 * own['minSeconds']:.3g}", f"{1e6 * own['secondsPerContact']:.2g}", cheapest(1), cheapest(0.5)])
    return table(["scene", "its substeps × iterations", "overlap", "largest", "energy given", "momentum", "ms a frame",
                  "µs a contact", "the cheapest with no more overlap", "with half"], rows)


def commits_of(scenes):
    """How many scenes are of each commit, in the order of the tables."""
    commits = [scene["commit"] for scene in scenes.values()]
    return {commit: commits.count(commit) for commit in commits}


def machine(scenes):
    first = next(iter(scenes.values()))
    dates = sorted({scene["date"] for scene in scenes.values()})
    commits = ", ".join(f"{commit[:10]} ({count} scenes)" for commit, count in commits_of(scenes).items())
    return (f"Machine: {first['processor']}, {first['cores']} cores; {first['renderer']}, OpenGL {first['openGL']}. "
            f"{int(first['timed']):,} molecules timed, {first['measured']} measured. Of commit {commits}; "
            f"{' to '.join(dict.fromkeys((dates[0], dates[-1])))}.\n")


# ---- The error in space

space_figures = {"sag": "sag", "first": "1st frequency", "second": "2nd", "third": "3rd", "buckling": "buckling", "twist": "twist"}
space_shapes = {"sheet": 2, "leaf": 2, "rod": 1, "fish": 1}  # vertices grow with this power of the rows along it


def percent(error):
    if error is None:
        return ""
    return f"{1 + error:.1f}×" if error > 1 else f"{100 * error:+.{1 if abs(error) < 0.0995 else 0}f} %"


def order(rows, figure, shape):
    """Of the error in the length of a cell, from the last but two to the last number of vertices."""
    first, last = rows[-3], rows[-1]
    if not first[figure] or not last[figure] or abs(first[figure]) < 0.005 or first[figure] * last[figure] < 0:
        return ""
    cells = math.log(last["vertices"] / first["vertices"]) / space_shapes[shape]
    return f"{math.log(abs(first[figure] / last[figure])) / cells:.1f}"


def space(_):
    every = list(data.read_space())
    rows = []
    for made, shape in itertools.product(("before", "now"), space_shapes):
        found = [row for row in every if (row["made"], row["shape"]) == (made, shape)]
        rows += [[f"{shape}, {made}", str(row["vertices"])] + [percent(row[figure]) for figure in space_figures] for row in found]
        if made == "now":
            rows.append([f"{shape}, order", ""] + ["" if figure in ("sag", "first") else order(found, figure, shape)
                                                  for figure in space_figures])
    return table(["", "vertices", *space_figures.values()], rows)


tables = {
    "space": space,
    "machine": machine,
    "summary": summary,
    "best": lambda scenes: by_stiffness(scenes, best_cell),
    "costs": cost_table,
    "chosen": lambda scenes: by_stiffness(scenes, chosen_cell),
    "targets": targets,
    "contact": lambda _: contact_table(data.contact_in()),
    "claims": lambda _: claims_table(data.claims_in()),
}


def with_tables(text, scenes):
    def replaced(match):
        if match["name"] not in tables:
            sys.exit(f"report.py: a page asks for the table \"{match['name']}\", and there are {', '.join(tables)}")
        return f"<!-- report.py: {match['name']} -->\n\n{tables[match['name']](scenes)}\n<!-- report.py: end -->"
    return re.sub(r"<!-- report\.py: (?P<name>\w+) -->\n.*?<!-- report\.py: end -->", replaced, text, flags=re.S)


# ---- Pictures

def as_report(scene):
    """A scene as plot.py has it from `shoal measure --json`."""
    points = [{"solver": point["solver"], "fieldSampling": grid.samplings, "outcome": point["outcome"],
               "error": point["error"] and {"total": point["error"]}, "samples": int(point["samples"]),
               "minSecondsPerVertexAndSecond": point["nanoseconds"] and point["nanoseconds"] * 1e-9, "framesPerFrame": 1,
               "substeps": point["stepsPerSecond"] / grid.frame_rate, "front": False} for point in scene["points"]]
    chosen = scene["solver"] and {"solver": scene["solver"], "fieldSampling": grid.samplings,
                                  "substeps": float(scene["substeps"])}
    molecule, motion, power = scene["scene"].split("-")
    return {"scene": f"{molecule}, {motion}, k = {power}", "points": points, "chosen": chosen, "target": data.target,
            "chaotic": scene["noError"], "tooStiff": None, "duration": duration(scene),
            "machine": {"processor": scene["processor"]}, "context": {"renderer": scene["renderer"]}}


def draw_summary(scenes, picture):
    """A cell a scene: the colour of the cheapest method, with its name and factor."""
    import plot
    figure, axes = plot.plt.subplots(figsize=(9, 6.2), layout="constrained")
    rows = list(itertools.product(grid.motions, grid.molecules))
    for (y, (motion, molecule)), (x, power) in itertools.product(enumerate(rows), enumerate(grid.powers)):
        scene = scenes[grid.id_of((molecule, motion, power))]
        found = data.best(scene)
        top = y + 0.25 * (y // len(grid.molecules))
        color = plot.colors.get(found[0], "#8A6FD1") if found else "#EEEEEE"
        axes.add_patch(plot.plt.Rectangle((x, top), 0.96, 0.92, color=color, alpha=0.75 if found else 1))
        axes.text(x + 0.48, top + 0.46, "  ".join(found[::2]) if found else best_cell(scene), ha="center", va="center",
                  fontsize=9, color="black" if found else "#777777")
        if x == 0:
            axes.text(-0.05, top + 0.46, molecule, ha="right", va="center", fontsize=9)
        if x == 0 and y % len(grid.molecules) == 1:
            axes.text(-0.62, top + 0.46, motion, ha="right", va="center", fontsize=11, fontweight="bold")
    axes.set(xlim=(-1.1, len(grid.powers)), ylim=(len(rows) + 0.75, -0.7))
    for x, power in enumerate(grid.powers):
        axes.text(x + 0.48, -0.2, f"k = 1e{power} N/m", ha="center", fontsize=10)
    axes.axis("off")
    axes.set_title(f"The cheapest method for an error of {data.target:g} of a molecule's size, "
                   "and how many times as fast as euler it is", fontsize=11)
    figure.savefig(picture, dpi=110)


def draw_claims(picture):
    """A dot a claim: what was claimed and what was found, by what was asked for."""
    import plot
    figure, axes = plot.plt.subplots(figsize=(6.2, 5.4), layout="constrained")
    rows = [row for row in data.claims_in() if row["found"]]
    ends = [min([row["found"] for row in rows] + [1e-6]) / 2, 3e-2]
    axes.plot(ends, ends, color="#999999", linewidth=0.8, label="found = claimed")
    axes.plot(ends, [2 * end for end in ends], color="#999999", linewidth=0.8, linestyle="--", label="twice as much")
    for text, color in zip(claims.errors, plot.colors.values()):
        told = [row for row in rows if row["asked"] == float(text)]
        axes.plot([row["claimed"] for row in told], [row["found"] for row in told], "o", color=color, markersize=5, alpha=0.8,
                  label=f"{text} asked for")
        axes.axvline(float(text), color=color, linewidth=0.6)
    axes.set(xscale="log", yscale="log", xlabel="claimed error, RMS of the sample", ylabel="found error, RMS of all molecules")
    axes.grid(color="#D8D8D8", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=9)
    figure.savefig(picture, dpi=110)


def draw_contact(picture):
    """A panel a scene, a curve a number of substeps, along which iterations grow."""
    import plot
    found = data.contact_in()
    figure, panels = plot.plt.subplots(1, len(found), figsize=(13, 3.6), layout="constrained")
    for axes, (name, points) in zip(panels, found.items()):
        front = sorted((point["minSeconds"] * 1e3, point["overlap"]) for point in points if point["front"])
        axes.plot(*zip(*front), linewidth=6, color="#F3E3A1", label="Pareto front")
        for substeps, color in zip(sorted({point["substeps"] for point in points}), list(plot.colors.values())[1:]):
            curve = [point for point in points if point["substeps"] == substeps]
            axes.plot([1e3 * point["minSeconds"] for point in curve], [point["overlap"] for point in curve], "o-", color=color,
                      markersize=4, linewidth=1.2, label=f"{substeps:.0f} substeps")
        own = next(point for point in points if point["scenes"])
        axes.plot(1e3 * own["minSeconds"], own["overlap"], "o", markersize=11, fillstyle="none", color="black",
                  label="the scene's")
        axes.set(xscale="log", yscale="log", title=name, xlabel="ms a frame")
        axes.grid(color="#D8D8D8", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False, fontsize=7)
    panels[0].set_ylabel("overlap, RMS, of the radius")
    figure.savefig(picture, dpi=110)


def draw_space(picture):
    """A panel a figure, a curve a shape: the error by the number of vertices, before and now."""
    import plot
    figures = dict(list(space_figures.items())[:5])
    figure, all_axes = plot.plt.subplots(1, len(figures), figsize=(13, 3.6), sharey=True, layout="constrained")
    colors = dict(zip(space_shapes, ("#0072B2", "#009E73", "#D55E00", "#E69F00")))
    every = list(data.read_space())
    for axes, (key, name) in zip(all_axes, figures.items()):
        axes.axhspan(1e-4, 0.05, color="#F0F0F0")
        for shape, (made, stroke) in itertools.product(space_shapes, (("before", ":"), ("now", "-"))):
            found = [row for row in every if (row["made"], row["shape"]) == (made, shape)]
            axes.plot([row["vertices"] for row in found], [max(abs(row[key]), 1e-3) for row in found], stroke,
                      color=colors[shape], marker="o" if made == "now" else "", markersize=4, linewidth=1.6 if made == "now" else 1,
                      label=f"{shape}, {made}")
        axes.set(xscale="log", yscale="log", ylim=(8e-4, 100), title=name, xticks=(12, 24, 48, 96, 192),
                 xticklabels=("12", "24", "48", "96", "192"))
        axes.minorticks_off()
        axes.grid(color="#D8D8D8", linewidth=0.6)
        axes.spines[["top", "right"]].set_visible(False)
    all_axes[0].set_ylabel("error, as a share of the beam's")
    figure.supxlabel("simulated vertices", fontsize=10)
    figure.legend(*all_axes[0].get_legend_handles_labels(), frameon=False, fontsize=9, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.savefig(picture, dpi=110, bbox_inches="tight")


def draw(scenes):
    import plot
    draw_contact(here.parent / "accuracy-contact.png")
    if data.claims_in():
        draw_claims(here.parent / "accuracy-claims.png")
    draw_space(here.parent / "accuracy-space.png")
    for molecule in grid.molecules:
        plot.draw([as_report(scenes[grid.id_of((molecule, motion, power))])
                   for motion, power in itertools.product(grid.motions, grid.powers)], here.parent / f"accuracy-{molecule}.png")
    draw_summary(scenes, here.parent / "accuracy.png")


# ---- The pages

def check(scenes):
    """Whether all tables are what the data say."""
    right = True
    for page in pages:
        text = page.read_text(encoding="utf-8")
        if with_tables(text, scenes) != text:
            print(f"{page.relative_to(here.parent.parent)}: a table is not what docs/accuracy/*.csv say; docs/accuracy/report.py "
                  "makes it")
            right = False
    for commit, count in commits_of(scenes).items():
        said = subprocess.run(["git", "diff", "--name-only", commit, "HEAD", "--", *sources], cwd=here.parent.parent, capture_output=True,
                              text=True, check=False)
        if said.returncode:
            print(f"{count} scenes are of commit {commit}, which git does not have here.")
        else:
            changed = said.stdout.split()
            print(f"{count} scenes are of commit {commit}; since then {len(changed)} sources have changed that a figure may "
                  "depend on" + "".join(f"\n  {name}" for name in changed))
    return right


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="*")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--space", action="store_true")
    given = parser.parse_args()
    if given.folders:
        data.take(given.folders)
    scenes = data.read()
    if given.check:
        sys.exit(0 if check(scenes) else 1)
    for page in pages:
        page.write_text(with_tables(page.read_text(encoding="utf-8"), scenes), encoding="utf-8")
    if given.space:
        draw_space(here.parent / "accuracy-space.png")
    else:
        draw(scenes)


if __name__ == "__main__":
    main()
