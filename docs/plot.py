#!/usr/bin/env python3
"""Draws what `shoal measure --json` or `shoal bench --json` found, by Matplotlib; PICTURE ends in .png, .svg or .pdf.

plot.py PICTURE FILE          of measure: one scene's error against time; of bench: time a quad against their number
plot.py PICTURE FILE FILE…    of measure: small panels, four in a row, with one key: what docs/accuracy/grid.py measured
"""
import json
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

# Colours differ for the colour-blind as well [Okabe 2008].
colors = {"euler": "#555555", "verlet": "#56B4E9", "leapfrog": "#0072B2", "rk4": "#009E73", "xpbd": "#E69F00",
          "bdf2-xpbd": "#D55E00", "bdf2-corotated": "#CC79A7", "bdf2-newton": "#F0E442"}
strokes = {"vertexSubstep": ("-", "o"), "vertexFrame": ("--", "s"), "moleculeFrame": (":", "^")}
quads = (1024, 16384, 131072, 1048576)
bench_curves = (("ping-pong", "ping-pong", "#D55E00", "v"), ("scalar", "CPU, scalar", "#999999", "s"),
                ("fragments", "fused, in fragments", "#56B4E9", "P"), ("fused", "fused", "#0072B2", "o"),
                ("AVX2", "CPU, AVX2", "#009E73", "^"), ("AVX-512", "CPU, AVX-512", "#CC79A7", "D"))
# The axes leave out points of a larger relative error: their steps are too long to mean anything.
worst_error = 2


def drawn(report):
    """Of each method (solver and field sampling) the points that have an error and a time: nanoseconds, error, point."""
    curves = {}
    for point in report["points"]:
        if point["outcome"] == "measured" and point["error"] and point["error"]["total"] > 0 and point["samples"]:
            curve = curves.setdefault((point["solver"], point["fieldSampling"]), [])
            curve.append((point["minSecondsPerVertexAndSecond"] * 1e9, point["error"]["total"], point))
    return curves


def panel(axes, report, size):
    """Curves, Pareto front, target and the chosen point."""
    curves = drawn(report)
    points = [point for curve in curves.values() for point in curve]
    axes.axhline(report["target"], linestyle="--", linewidth=0.8, color="#999999", label=f"error {report['target']:g}")
    front = sorted(point[:2] for point in points if point[2]["front"])
    if front:
        axes.plot(*zip(*front), linewidth=6 * size, color="#F3E3A1", label="Pareto front")
    several = len({sampling for _, sampling in curves}) > 1
    for (solver, sampling), curve in curves.items():
        line, marker = strokes[sampling]
        axes.plot(*zip(*(point[:2] for point in curve)), linestyle=line, marker=marker, linewidth=1.5 * size,
                  markersize=5 * size, color=colors.get(solver, "#8A6FD1"), label=f"{solver}, {sampling}" if several else solver)
    chosen = report["chosen"] or {}
    for time, error, point in points:
        if point["framesPerFrame"] == 1 and all(point[key] == chosen.get(key) for key in ("solver", "fieldSampling", "substeps")):
            axes.plot(time, error, "o", markersize=12 * size, fillstyle="none", color="black", label="chosen")
    axes.set(xscale="log", yscale="log")
    axes.grid(color="#D8D8D8", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    return [point for point in points if point[1] <= worst_error] or points


def limits(axes, points):
    times, errors = [point[0] for point in points], [point[1] for point in points]
    axes.set(xlim=(min(times) / 1.5, max(times) * 1.5), ylim=(min(errors) / 2, max(errors) * 2))


def draw(reports, picture):
    columns, few = min(4, len(reports)), len(reports) == 1
    rows = -(-len(reports) // columns)
    figure, all_axes = plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True, layout="constrained",
                                    figsize=(11, 7) if few else (3 * columns, 3 * rows + 1))
    found = []
    for axes, report in zip(all_axes.flat, reports):
        found += panel(axes, report, 1 if few else 0.6)
        why = "chaotic, no error" if report["chaotic"] else "too stiff, no error" if report["tooStiff"] else ""
        axes.set_title(report["scene"] + (f": error after {report['duration']:g} s" if few else why and f": {why}"),
                       fontsize=13 if few else 9)
    if not found:
        sys.exit(f"{picture}: no point has both an error and a time to draw")
    limits(all_axes[0][0], found)
    for axes in all_axes.flat[len(reports):]:
        axes.axis("off")
    figure.supxlabel("time per vertex and simulated second, ns", fontsize=10)
    figure.supylabel("error after the run / size of a molecule", fontsize=10)
    figure.suptitle(f"{reports[0]['machine']['processor']}, {reports[0]['context']['renderer']}", fontsize=9, color="#666666")
    named = {name: line for axes in all_axes.flat for line, name in zip(*axes.get_legend_handles_labels())}
    figure.legend(named.values(), named.keys(), frameon=False, fontsize=9, ncol=1 if few else 5,
                  **({"loc": "center left", "bbox_to_anchor": (1, 0.5)} if few
                     else {"loc": "upper center", "bbox_to_anchor": (0.5, 0)}))
    figure.savefig(picture, dpi=110, bbox_inches="tight")


def draw_bench(report, picture):
    figure, axes = plt.subplots(figsize=(9, 5.5), layout="constrained")
    for label, name, color, marker in bench_curves:
        curve = sorted((case["count"], case["nanosecondsPerMolecule"]) for case in report["cases"]
                       if case["molecule"] == "quad" and case["case"] == label and case.get("minSeconds"))
        if curve:
            axes.plot(*zip(*curve), linewidth=2, marker=marker, color=color, label=name)
    axes.set(xscale="log", yscale="log", xlabel="quads", ylabel="nanoseconds a quad and frame", xticks=quads,
             xticklabels=[f"{count:,}" for count in quads], xlim=(700, 1500000))
    axes.minorticks_off()
    axes.set_title(f"euler, 4 substeps a frame; {report['machine']['processor']}, {report['context']['renderer']}", fontsize=10)
    axes.grid(which="both", color="#D8D8D8", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1, 0.5))
    figure.savefig(picture, dpi=110)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    reports = [json.loads(pathlib.Path(file).read_text(encoding="utf-8")) for file in sys.argv[2:]]
    if "cases" in reports[0]:
        draw_bench(reports[0], sys.argv[1])
    else:
        draw(reports, sys.argv[1])


if __name__ == "__main__":
    main()
