#!/usr/bin/env python3
"""Measures contact between molecules for docs/accuracy.md by `shoal measure --contact`; report.py FOLDER then makes its table and
picture.

contact.py FOLDER [options of shoal measure, such as --seconds 60]

FOLDER takes contact-<scene>.json, and in `scenes` the scenes themselves; what is there is not measured again, and a FOLDER of
another commit is refused.

  pile     216 marbles of 5 cm and 1 kg fall into a box
  stack    20 of them on one another, at rest
  ratio    six, of 1 kg and 100 kg in turn, the light ones below
  bowl     48 leaves fall into a bowl of six slopes, spheres on their triangles
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys

import grid

radius = 0.05


def marbles(mass, places):
    return {"molecule": f"marble-{mass}.json", "count": len(places), "drag": 0, "contact": {"radius": radius}, "restitution": 0.2,
            "friction": 0.5, "place": {"on": "list", "turn": "none", "items": [{"position": place} for place in places]}}


def plane(point, normal):
    return {"type": "plane", "point": point, "normal": normal, "restitution": 0.2, "friction": 0.5}


def pile():
    numbers = grid.random_numbers()
    spread = [0.01 * (next(numbers) - 0.5) for _ in range(648)]
    places = [[0.12 * (i % 6) - 0.3 + spread[3 * i], 0.1 + 0.12 * (i // 36) + spread[3 * i + 1],
               0.12 * (i // 6 % 6) - 0.3 + spread[3 * i + 2]] for i in range(216)]
    walls = [plane([0.38 * x, 0, 0.38 * z], [-x, 0, -z]) for x, z in ((1, 0), (-1, 0), (0, 1), (0, -1))]
    return {"colliders": [plane([0, 0, 0], [0, 1, 0])] + walls, "groups": [marbles(1, places)]}, 8


def stack():
    return {"colliders": [plane([0, 0, 0], [0, 1, 0])],
            "groups": [marbles(1, [[0, radius * (2 * i + 1), 0] for i in range(20)])]}, 4


def ratio():
    groups = [dict(marbles(mass, [[0, radius * (2 * i + 1), 0] for i in range(first, 6, 2)]), name=f"{mass} kg")
              for first, mass in ((0, 1), (1, 100))]
    return {"colliders": [plane([0, 0, 0], [0, 1, 0])], "groups": groups}, 4


def bowl():
    angles = [math.pi / 3 * i for i in range(6)]
    slopes = [plane([0.25 * math.cos(a), 0, 0.25 * math.sin(a)], [-0.7 * math.cos(a), 1, -0.7 * math.sin(a)]) for a in angles]
    leaves = {"molecule": "leaf", "count": 48, "held": False, "drag": 1, "restitution": 0.2, "friction": 0.5,
              "contact": {"radius": 0.004, "triangles": True},
              "place": {"on": "volume", "box": {"low": [-0.15, 0.1, -0.15], "high": [0.15, 0.6, 0.15]}, "turn": "any"}}
    return {"colliders": [plane([0, 0, 0], [0, 1, 0])] + slopes, "groups": [leaves]}, 8


scenes = {"pile": pile, "stack": stack, "ratio": ratio, "bowl": bowl}


def measure(name, given, more):
    inputs = given.folder / "scenes"
    inputs.mkdir(parents=True, exist_ok=True)
    for mass in (1, 100):
        molecule = {"format": "shoal-molecule-1", "vertices": [{"position": [0, 0, 0], "mass": mass}]}
        (inputs / f"marble-{mass}.json").write_text(json.dumps(molecule))
    scene, substeps = scenes[name]()
    file = inputs / f"{name}.scene.json"
    file.write_text(json.dumps({"format": "shoal-scene-1", "name": name, "gravity": [0, -9.81, 0],
                                "solver": {"substeps": substeps}} | scene))
    words = [given.shoal, "measure", str(file), "--contact", "--json", "--duration", "2"]
    if name == "bowl":  # whose finest steps take a minute
        words += ["--substeps", "4,8,16", "--iterations", "3,6,11,22"]
    said = subprocess.run(words + more, stdout=subprocess.PIPE, check=False)
    if said.returncode:
        sys.exit(said.returncode)
    part = given.folder / f"contact-{name}.part"
    part.write_bytes(said.stdout)
    part.rename(given.folder / f"contact-{name}.json")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--shoal", default=os.environ.get("SHOAL_COMMAND", "build/shoal"), help="the command")
    given, more = parser.parse_known_args()
    grid.check_commit(given)
    for name in scenes:
        if not (given.folder / f"contact-{name}.json").exists():
            print(f"contact, {name}", file=sys.stderr)
            measure(name, given, more)


if __name__ == "__main__":
    main()
