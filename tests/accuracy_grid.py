#!/usr/bin/env python3
"""docs/accuracy/grid.py: its scenes are those of the numbers that they quote, its tables say what the points say, and a
scene that it measures by $SHOAL_COMMAND comes out as the JSON says."""
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile

script = pathlib.Path(__file__).resolve().parent.parent / "docs/accuracy/grid.py"
sys.path.insert(0, str(script.parent))
sys.dont_write_bytecode = True
import grid


def curve(solver, order, cost):
    """An error of 1 / n^order at a time of cost n nanoseconds."""
    return [{"solver": solver, "outcome": "measured", "error": {"total": n**-order}, "samples": 3, "stepsPerSecond": n,
             "minSecondsPerVertexAndSecond": cost * n * 1e-9} for n in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024)]


def report(points, chaotic=None, chosen=None):
    return {"points": points, "chaotic": chaotic, "tooStiff": None, "chosen": chosen}


def rows(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines() if "---" not in line]


def check_scenes():
    scenes = grid.scene_ids()
    assert len(scenes) == 48 and len({grid.id_of(scene) for scene in scenes}) == 48
    for name, vertices, springs in (("leaf", 4, 6), ("cross", 10, 29), ("fish", 24, 96)):
        molecule = grid.molecule_file(name, 4)
        pairs = {frozenset((spring["a"], spring["b"])) for spring in molecule["springs"]}
        assert (len(molecule["vertices"]), len(molecule["springs"]), len(pairs)) == (vertices, springs, springs), name
        assert sum("pinned" in vertex for vertex in molecule["vertices"]) == 2
        assert molecule["defaults"] == {"mass": 1, "stiffness": 1e4, "damping": 5}
    # the first numbers of Random(1) in src/core/random.h
    numbers = grid.random_numbers()
    assert [round(next(numbers), 6) for _ in range(3)] == [0.883685, 0.825449, 0.541571]


def check_tables():
    points = curve("euler", 1, 1) + curve("leapfrog", 2, 2)
    rk4 = [dict(point, solver="rk4", error={"total": 1e-6}) for point in points[:1]]
    late = [{"solver": "rk4", "outcome": "left out"}]
    reports = {("leaf", "fall", 2): report(points, chosen={"solver": "leapfrog", "substeps": 7}),
               ("leaf", "fall", 4): report(points, chaotic="so it is"),
               ("leaf", "fall", 6): report(rk4), ("leaf", "fall", 8): report(late)}
    # euler 100 ns, leapfrog 20
    assert rows(grid.by_stiffness(reports, lambda found: grid.speed_up(found, 1e-2)))[1] == [
        "fall, leaf", "leapfrog 5.0×", "chaotic", "rk4", "…"]
    assert rows(grid.cost_table(reports, 1e-2)) == [
        ["scene", "euler", "leapfrog", "rk4"], ["fall, leaf, k = 1e2", "100", "20.0", "–"],
        ["fall, leaf, k = 1e6", "–", "–", "≤ 1.00"], ["fall, leaf, k = 1e8", "–", "–", "…"]]
    assert rows(grid.by_stiffness(reports, grid.chosen))[1] == ["fall, leaf", "leapfrog 7", "none", "none", "none"]


def check_measured(folder):
    words = [sys.executable, script, folder, "--only", "leaf-spin-1e2", "--count", "8", "--molecules", "1", "--seconds", "20",
             "--solvers", "leapfrog"]
    said = subprocess.run(words, check=True, capture_output=True, text=True)
    assert "scene 1 of 1, leaf-spin-1e2" in said.stderr
    assert "8 molecules timed, 1 measured" in said.stdout
    found = json.loads((folder / "leaf-spin-1e2.json").read_text())
    assert {point["fieldSampling"] for point in found["points"]} == {"vertexSubstep"}
    points = [point for point in found["points"] if point["outcome"] == "measured" and point["samples"]]
    cell = next(line for line in said.stdout.splitlines() if line.startswith("| spin, leaf, k = 1e2 |")).split("|")[2].strip()
    near = [point["minSecondsPerVertexAndSecond"] * 1e9 for point in points if point["error"]["total"] <= 1e-3]
    far = [point["minSecondsPerVertexAndSecond"] * 1e9 for point in points if point["error"]["total"] > 1e-3]
    # between a point that is not there yet and one that is; on a slow machine none is measured
    assert min(near + far) - 1 <= float(cell) <= max(near) + 1 if near else cell in "…–", (cell, near, far)
    chosen = found["chosen"]
    assert f"| spin, leaf | {chosen['solver']} {chosen['substeps']} |" in said.stdout
    again = subprocess.run(words, check=True, capture_output=True, text=True)
    assert again.stdout == said.stdout and not again.stderr
    if importlib.util.find_spec("matplotlib"):
        picture = folder / "curve.svg"
        subprocess.run([sys.executable, script.parent.parent / "plot.py", picture, folder / "leaf-spin-1e2.json"], check=True)
        assert picture.stat().st_size > 10000


check_scenes()
check_tables()
with tempfile.TemporaryDirectory() as scratch:
    check_measured(pathlib.Path(scratch))
