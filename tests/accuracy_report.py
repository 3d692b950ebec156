#!/usr/bin/env python3
"""docs/accuracy: the scenes of grid.py are those of the numbers that they quote, one that it measures by $SHOAL_COMMAND becomes
data, what claims.py asks becomes a table, the cells of the tables say what the points say, and the tables of the pages are
those of the data."""
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile

folder = pathlib.Path(__file__).resolve().parent.parent / "docs/accuracy"
sys.path.insert(0, str(folder))
sys.dont_write_bytecode = True
import data
import grid
import report


def curve(solver, order, cost, timed=True):
    """An error of 1 / n^order at a time of cost n nanoseconds."""
    return [{"solver": solver, "outcome": "measured", "error": n**-order, "stepsPerSecond": n,
             "nanoseconds": cost * n if timed else None} for n in (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024)]


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


def check_cells():
    def text(points, error=1e-2):
        return data.cost_of(points, error).text

    late = {"solver": "euler", "outcome": "left out", "error": None, "stepsPerSecond": 2048, "nanoseconds": None}
    refused = dict(late, outcome="refused")
    euler, leapfrog = curve("euler", 1, 1), curve("leapfrog", 2, 2)
    assert text(euler) == "100" and text(leapfrog) == "20.0"
    assert text(leapfrog[4:]) == "*32.0*"
    assert text(euler, 1e-4) == "floor 1e-3"
    assert text(euler + [late], 1e-4) == "> 1,024"
    # what was not timed takes as long a step as the finest that was
    assert text(euler[:3] + curve("euler", 1, 1, timed=False)[3:]) == "100"
    assert text(curve("euler", 1, 1, timed=False)) == "untimed: 1e-3 at 1,024 steps/s"
    assert (text([late]), text([refused]), text([dict(refused, outcome="not finite")])) == ("no time", "refused", "blows up")
    scene = {"noError": "", "points": euler + leapfrog}
    assert data.best(scene)[::2] == ("leapfrog", "16×") and report.factor(scene, "leapfrog") == "16"
    assert data.best({"noError": "", "points": [late] + leapfrog})[::2] == ("leapfrog", "")
    assert data.best({"noError": "chaotic", "points": euler}) is None


def check_measured(scratch):
    words = [sys.executable, folder / "grid.py", scratch, "--only", "leaf-spin-1e2", "--count", "8", "--molecules", "1",
             "--seconds", "20", "--solvers", "leapfrog"]
    said = subprocess.run(words, check=True, capture_output=True, text=True)
    assert "scene 1 of 1, leaf-spin-1e2" in said.stderr
    found = json.loads((scratch / "leaf-spin-1e2.json").read_text())
    assert {point["fieldSampling"] for point in found["points"]} == {"vertexSubstep"}
    rows = list(data.point_rows("leaf-spin-1e2", found))
    measured = [point for point in found["points"] if point["outcome"] == "measured"]
    assert [float(row["error"]) for row in rows if row["error"]] == [float(f"{point['error']['total']:.4g}") for point in measured]
    assert data.scene_row("leaf-spin-1e2", found)["solver"] == found["chosen"]["solver"]
    again = subprocess.run(words, check=True, capture_output=True, text=True)
    assert not again.stderr
    # the data need all scenes
    said = subprocess.run([sys.executable, folder / "report.py", scratch], capture_output=True, text=True, check=False)
    assert said.returncode == 1 and "47 scenes are missing, such as leaf-fall-1e2" in said.stderr, said.stderr
    for text, message in ((json.dumps(dict(found, commit="another")), "was measured at commit another"), ("{", "is not what")):
        (scratch / "leaf-spin-1e2.json").write_text(text)
        said = subprocess.run(words, capture_output=True, text=True, check=False)
        assert said.returncode == 1 and message in said.stderr and said.stderr.count("\n") == 1, said.stderr
    if importlib.util.find_spec("matplotlib"):
        (scratch / "found.json").write_text(json.dumps(found))
        picture = scratch / "curve.svg"
        subprocess.run([sys.executable, folder.parent / "plot.py", picture, scratch / "found.json"], check=True)
        assert picture.stat().st_size > 10000


def check_claims(scratch):
    """Asks a test that answers as shoal-gl does, ends in the middle, goes on, and sums up."""
    answers = scratch / "answers"
    answers.write_text("""#!/bin/sh
case "$SHOAL_CLAIM" in
"1 1e-2") echo "claim,leapfrog,4,1,4e-3,0,0,6e-3,1e-2,1,0" ;;
"2 1e-2") echo "claim,rk4,2,0.5,5e-3,0,1,2.5e-2,3e-2,9,2" ;;
"2 1e-4") exit 1 ;;
*) echo "refusal,out of reach, at best 0.1" ;;
esac
""")
    answers.chmod(0o755)
    words = [sys.executable, folder / "claims.py", scratch, "--scenes", "2", "--tests", answers]
    said = subprocess.run(words, capture_output=True, text=True, check=False)
    assert said.returncode == 1 and "scene 2, error 1e-4" in said.stderr, said.stderr
    answers.write_text("#!/bin/sh\necho refusal,chaotic\n")
    said = subprocess.run(words, capture_output=True, text=True, check=True)
    assert said.stderr == "scene 2 of 2, error 1e-4\n", said.stderr
    rows = data.claims_in(scratch / "claims.csv")
    assert [row["refusal"] for row in rows] == ["", "out of reach, at best 0.1", "out of reach, at best 0.1", "",
                                                "out of reach, at best 0.1", "chaotic"]
    lines = report.claims_table(rows).splitlines()
    assert lines[2] == "| 1e-2 | 2 | 0 | 1 | 1 | 2.5 | 5 | 10, 2 of 48 | 1 |", lines[2]
    assert lines[3] == "| 1e-3 | 0 | 2 | 0 | 0 | 0 | 0 | 0, 0 of 0 | 0 |", lines[3]
    text = (scratch / "claims.csv").read_text()
    (scratch / "claims.csv").write_text(text.replace(rows[0]["commit"], "another"))
    said = subprocess.run(words, capture_output=True, text=True, check=False)
    assert said.returncode == 1 and "is of commit another" in said.stderr and said.stderr.count("\n") == 1, said.stderr


def check_pages():
    scenes = data.read()
    assert len(scenes) == 48
    assert report.check(scenes)
    # a changed datum shows
    point = next(point for point in scenes["leaf-fall-1e4"]["points"] if point["solver"] == "leapfrog" and point["nanoseconds"])
    point["nanoseconds"] *= 3
    page = report.pages[0].read_text(encoding="utf-8")
    assert report.with_tables(page, scenes) != page


check_scenes()
check_cells()
with tempfile.TemporaryDirectory() as scratch:
    check_measured(pathlib.Path(scratch))
with tempfile.TemporaryDirectory() as scratch:
    check_claims(pathlib.Path(scratch))
check_pages()
