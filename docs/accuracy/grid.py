#!/usr/bin/env python3
"""Measures the scenes of docs/accuracy.md by `shoal measure`; report.py FOLDER then makes its tables and pictures.

grid.py FOLDER [--only TEXT] [--count N] [options of shoal measure, such as --seconds 15]

FOLDER takes <molecule>-<motion>-<stiffness>.json, what `shoal measure --json` says of a scene, and in `scenes` the scenes
and molecules themselves. A scene whose JSON is there is not measured again, so that a run goes on where it was ended; a
FOLDER of another commit is refused.

Molecules have masses of 1 and springs of stiffness k with a damping of 0.05 sqrt(k), are centred on the origin and start
turned by 0.7 rad about (1, 3, -2); the others of a group are turned at random, so that more than one direction counts.

  fall     in a shear flow, drag 1 /s, gravity
  gusts    two vertices pinned, in a shear flow with four oscillations, drag 2 /s, gravity
  spin     20 rad/s, no drag, no gravity
  impact   thrown onto a plane with restitution 0.5 and friction 0.3, no drag; the time of one impact and its rebound, since
           a second one would make the motion chaotic
"""
import argparse
import itertools
import json
import math
import os
import pathlib
import subprocess
import sys

molecules, motions, powers = ("leaf", "cross", "fish"), ("fall", "gusts", "spin", "impact"), (2, 4, 6, 8)
# Hz: frames are long, because methods are compared by what their steps cost. At the 60 of a demo, reading and writing the
# state takes as long as several steps, and a method with few long ones gains less. So fields are read in every substep.
frame_rate, samplings = 5, "vertexSubstep"


def leaf():
    points = [(-0.5, 0.12, 0), (0.5, -0.12, 0), (0.5, 0.12, -1), (-0.5, -0.12, -1)]
    return points, list(itertools.combinations(range(4), 2)), (0, 1)


def cross():
    points = [(x, layer, -y) for layer in (0, 1) for x, y in ((0, 0), (0.5, 0), (0, 0.5), (-0.5, 0), (0, -0.5))]
    springs = [(0, 5)]
    for arm in (1, 2, 3, 4):
        for layer in (0, 5):
            springs += [(layer, layer + arm), (layer + arm, layer + arm % 4 + 1)]
        springs += [(arm, 5 + arm), (0, 5 + arm), (arm, 5)]
    return points, springs, (0, 5)


def fish():
    points, springs = [], []
    for ring, (rx, rz) in enumerate(((0.08, 0.12), (0.16, 0.28), (0.2, 0.35), (0.16, 0.28), (0.08, 0.16), (0.05, 0.3))):
        first, y = 4 * ring, 0.4 * ring
        points += [(rx, 0, -y), (0, rz, -y), (-rx, 0, -y), (0, -rz, -y)]
        springs += [(first + i, first + (i + 1) % 4) for i in range(4)] + [(first, first + 2), (first + 1, first + 3)]
        if ring:
            springs += [(first - 4 + i, first + (i + turn) % 4) for i in range(4) for turn in (0, 1, 3)]
    return points, springs, (0, 2)


def molecule_file(name, power):
    points, springs, pinned = {"leaf": leaf, "cross": cross, "fish": fish}[name]()
    middle = [sum(axis) / len(points) for axis in zip(*points)]
    vertices = [{"position": [a - b for a, b in zip(point, middle)]} for point in points]
    for vertex in pinned:
        vertices[vertex]["pinned"] = True
    return {
        "format": "shoal-molecule-1", "name": name,
        "defaults": {"mass": 1, "stiffness": 10**power, "damping": 0.05 * 10 ** (power / 2)},
        "vertices": vertices, "springs": [{"a": a, "b": b} for a, b in springs],
        "triangles": [[0, 1, 2], [0, 2, 3]] if name == "leaf" else [],
    }


def random_numbers():
    """The random numbers of src/core/random.h, of seed 1: uniform in [0, 1)."""
    word = 2**64 - 1
    state = (1 + 1) * 6364136223846793005 + 1 & word

    def bits():
        nonlocal state
        old, state = state, state * 6364136223846793005 + 1 & word
        shifted, turn = (old >> 18 ^ old) >> 27 & 2**32 - 1, old >> 59
        return (shifted >> turn | shifted << (32 - turn & 31)) & 2**32 - 1

    while True:
        high, low = bits() >> 5, bits() >> 6
        yield (high << 26 | low) / 2**53


def rotations(count):
    numbers = random_numbers()
    yield {"axis": [1, 3, -2], "angle": 0.7}
    for _ in range(count - 1):
        z, around = 2 * next(numbers) - 1, 2 * math.pi * next(numbers)
        r = math.sqrt(1 - z * z)
        yield {"axis": [r * math.cos(around), r * math.sin(around), z], "angle": 2 * math.pi * next(numbers)}


def scene_file(name, motion, power, count):
    position = [0, 2.2, 0] if motion == "impact" else [0, 0, 0]
    group = {
        "name": name, "molecule": f"{name}-1e{power}.json", "held": motion == "gusts",
        "place": {"on": "list", "turn": "none", "items": [{"position": position, "rotation": r} for r in rotations(count)]},
    }
    scene = {"format": "shoal-scene-1", "name": f"{name}, {motion}, k = 1e{power}", "frameRate": frame_rate,
             "gravity": [0, 0 if motion == "spin" else -9.81, 0], "groups": [group]}

    def oscillating(velocity, frequency, phase):
        return {"type": "oscillating", "velocity": velocity, "frequency": frequency, "phase": phase}

    if motion == "fall":
        group |= {"drag": 1, "velocity": [0.5, 0, 0], "spin": [0.6, 0.4, 0.9]}
        scene["fields"] = [
            {"type": "shear", "velocity": [2, 0, 0], "gradient": [[0, 0.8, 0], [0, 0, -0.3], [-0.5, 0, 0]]}]
    elif motion == "gusts":
        group["drag"] = 2
        scene["fields"] = [
            {"type": "shear", "velocity": [4, 0, 0], "gradient": [[0, 0.5, 0], [0, 0, 0], [-0.3, 0, 0]]},
            oscillating([2, 0, 0], 3, 0), oscillating([0, 0, -2], 1.3, math.pi / 2),
            oscillating([0, 0, -1.2], 7.3, 1), oscillating([0, 1, 0], 5.1, 0)]
    elif motion == "spin":
        group["spin"] = [12, 12.5, -10]
    else:
        group["velocity"] = [0.3, -3, 0]
        scene["colliders"] = [{"type": "plane", "restitution": 0.5, "friction": 0.3}]
    return scene


def scene_ids():
    """Molecule, motion and power of ten of the stiffness of each scene, in the order of the tables."""
    return list(itertools.product(molecules, motions, powers))


def id_of(scene):
    return "{}-{}-1e{}".format(*scene)


def measure(scene, given, more):
    inputs, name = given.folder / "scenes", id_of(scene)
    inputs.mkdir(parents=True, exist_ok=True)
    (inputs / f"{scene[0]}-1e{scene[2]}.json").write_text(json.dumps(molecule_file(scene[0], scene[2])))
    file = inputs / f"{name}.scene.json"
    file.write_text(json.dumps(scene_file(*scene, given.count)))
    duration = "0.4" if scene[1] == "impact" else "1"
    words = [given.shoal, "measure", str(file), "--json", "--samplings", samplings, "--duration", duration]
    said = subprocess.run(words + ["--error", given.error] + more, stdout=subprocess.PIPE, check=False)
    if said.returncode:
        sys.exit(said.returncode)
    # A name of its own until it is whole: what is ended in the middle, or finds the disk full, is measured again.
    part = given.folder / f"{name}.part"
    part.write_bytes(said.stdout)
    part.rename(given.folder / f"{name}.json")


def check_commit(given):
    """Ends where scenes in the folder are of another commit than the command."""
    said = subprocess.run([given.shoal, "info", "--json"], stdout=subprocess.PIPE, check=False)
    commit = json.loads(said.stdout)["commit"]
    for file in sorted(given.folder.glob("*.json")):
        try:
            found = json.loads(file.read_text())["commit"]
        except (ValueError, KeyError, TypeError):
            sys.exit(f"{file}: this is not what shoal measure --json writes: give another folder")
        if found != commit:
            sys.exit(f"{file}: this was measured at commit {found}, and {given.shoal} is of {commit}: give another folder")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--only", default="", help="scenes with this in their name, such as leaf-fall")
    parser.add_argument("--count", type=int, default=512, help="molecules of each scene: enough to fill the device")
    parser.add_argument("--error", default="1e-3", help="what the choice of a method is for")
    parser.add_argument("--shoal", default=os.environ.get("SHOAL_COMMAND", "build/shoal"), help="the command")
    given, more = parser.parse_known_args()
    check_commit(given)
    wanted = [scene for scene in scene_ids() if given.only in id_of(scene)]
    missing = [scene for scene in wanted if not (given.folder / f"{id_of(scene)}.json").exists()]
    for number, scene in enumerate(missing, 1):
        print(f"scene {number} of {len(missing)}, {id_of(scene)}", file=sys.stderr)
        measure(scene, given, more)


if __name__ == "__main__":
    main()
