#!/usr/bin/env python3
"""Checks that the schemas are valid, accept every shipped file and refuse broken ones.

Exits with 77 without python3-jsonschema."""
import copy
import json
import pathlib
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("python3-jsonschema is not installed: nothing was checked")
    sys.exit(77)

root = pathlib.Path(__file__).resolve().parent.parent

# What each change breaks: the path of a value, and what takes its place (GONE: its key is left out).
GONE = object()
broken_molecules = [
    (["format"], GONE),
    (["format"], "shoal-molecule-2"),
    (["noSuchKey"], 1),
    (["vertices"], GONE),
    (["vertices"], {}),
    (["vertices"], []),
    (["vertices", 0, "position"], GONE),
    (["vertices", 0, "position"], [0, 0]),
    (["vertices", 0, "position"], [0, 0, "0"]),
    (["vertices", 0, "mass"], 0),
    (["vertices", 0, "mass"], -1),
    (["vertices", 0, "pinned"], 1),
    (["vertices", 0, "pined"], True),
    (["springs", 0, "a"], -1),
    (["springs", 0, "a"], 0.5),
    (["springs", 0, "b"], GONE),
    (["springs", 0, "stiffness"], -1),
    (["springs", 0, "stifness"], 1),
    (["material", "blend"], "alfa"),
    (["material", "opacity"], 0.5),
    (["triangles", 0], [0, 1]),
    (["triangles", 0], [0, 1, -1]),
    (["skin", "weights"], GONE),
    (["skin", "triangles"], GONE),
    (["skin", "weights", 0], [0]),
    (["skin", "weights", 0], "0"),
    (["skin", "uvs", 0], [0]),
    (["skin", "triangles", 0], [0, 1]),
    (["skin", "triangles", 0], [0, 1, -1]),
    (["skin", "triangels"], []),
    (["material"], []),
    (["material", "colour"], [1, 1, 1]),
]
broken_scenes = [
    (["format"], GONE),
    (["format"], "shoal-molecule-1"),
    (["noSuchKey"], 1),
    (["seed"], -1),
    (["frameRate"], 0),
    (["gravity"], [0, -9.81]),
    (["gravity"], -9.81),
    (["solver"], {"method": "eulr"}),
    (["solver"], {"substeps": 0}),
    (["fields"], [{"type": "wind"}]),
    (["forces"], [{"type": "wind"}]),
    (["forces"], [{"type": "attract", "strength": 1}]),
    (["forces"], [{"type": "attract", "falloff": "constant", "strength": 1, "radius": 1, "most": 1}]),
    (["forces"], [{"type": "vortexLine", "core": 0}]),
    (["forces"], [{"type": "thrust", "rate": 1}]),
    (["forces"], [{"type": "thrust", "rate": 1, "limit": 0}]),
    (["forces"], [{"type": "wind", "velocity": [1, 0, 0], "mouse": True}]),
    (["forces"], [{"type": "wind", "velocity": [1, 0, 0], "groups": []}]),
    (["forces"], [{"type": "wind", "velocity": [1, 0, 0], "path": {"keyframes": [{"time": 0}]}}]),
    (["fields"], [{"type": "uniform"}]),
    (["fields"], [{"type": "oscillating", "velocity": [1, 0, 0]}]),
    (["fields"], [{"type": "oscillating", "velocity": [1, 0, 0], "frequency": -1}]),
    (["fields"], [{"type": "gust", "velocity": [1, 0, 0]}]),
    (["fields"], [{"type": "grid"}]),
    (["fields"], [{"type": "grid", "file": "w-##.vti", "sequence": {}}]),
    (["fields"], [{"type": "grid", "file": "w-##.vti", "sequence": {"frameRate": 1, "times": [0, 1]}}]),
    (["fields"], [{"type": "waves", "trains": []}]),
    (["fields"], [{"type": "waves", "trains": [{"amplitude": 1}]}]),
    (["fields"], [{"type": "hurricane", "shape": 9}]),
    (["colliders"], [{"type": "cube"}]),
    (["colliders"], [{"type": "distanceField"}]),
    (["colliders"], [{"type": "distanceField", "model": "m", "resolution": 3}]),
    (["colliders"], [{"type": "distanceField", "model": "m", "resolution": 8, "error": 0.1}]),
    (["colliders"], [{"type": "distanceField", "model": "m", "shell": 0}]),
    (["colliders"], [{"type": "box"}]),
    (["colliders"], [{"type": "box", "center": [0, 0, 0], "size": [1, 0, 1]}]),
    (["colliders"], [{"type": "capsule", "from": [0, 0, 0], "to": [0, 0, 0], "radius": 0}]),
    (["colliders"], [{"type": "plane", "path": {"keyframes": [{"time": 0}]}}]),
    (["colliders"], [{"type": "plane", "path": {"keyframes": [{"time": 0}, {"time": 1, "turn": 2}]}}]),
    (["surfacePairs"], [{"between": ["leaf"], "friction": 0}]),
    (["surfacePairs"], [{"between": ["leaf", "ice"]}]),
    (["colliders"], [{"type": "plane", "restitution": 1.5}]),
    (["colliders"], [{"type": "plane", "friction": -1}]),
    (["groups"], GONE),
    (["groups"], {}),
    (["groups", 0, "molecule"], GONE),
    (["groups", 0, "count"], 0),
    (["groups", 0, "count"], 1.5),
    (["groups", 0, "place"], "volume"),
    (["groups", 0, "place"], {"on": "air"}),
    (["groups", 0, "drag"], -1),
    (["groups", 0, "velocities"], [0, 0, 0]),
    (["groups", 0, "life"], {"span": 0}),
    (["groups", 0, "life"], {"span": [1, 2, 3]}),
    (["groups", 0, "life"], {"allocator": "gpus"}),
    (["groups", 0, "life"], {"capacity": 0}),
    (["groups", 0, "life"], {"dies": {}}),
    (["groups", 0, "emitters"], [{"rate": 1}]),
    (["groups", 0, "emitters"], [{"from": "air", "rate": 1}]),
    (["groups", 0, "emitters"], [{"from": "point", "rate": -1}]),
    (["groups", 0, "emitters"], [{"from": "disc", "radius": 1, "hollow": 2}]),
    (["groups", 0, "emitters"], [{"from": "point", "bursts": [{"time": 1}]}]),
    (["groups", 0, "emitters"], [{"from": "point", "speed": [1, 2, 3]}]),
    (["groups", 0, "particle"], {"shape": "cubes"}),
    (["groups", 0, "particle"], {"size": -1}),
    (["groups", 0, "particle"], {"colors": []}),
    (["groups", 0, "particle"], {"image": {"columns": 2}}),
    (["camera", "eye"], [0, 0]),
    (["light"], {"color": "white"}),
]


def broken(document, path, value):
    """A copy with one value replaced; None where the document does not reach that far."""
    copied = copy.deepcopy(document)
    inner = copied
    for key in path[:-1]:
        try:
            inner = inner[key]
        except (KeyError, IndexError):
            return None
    if value is GONE:
        if path[-1] not in inner:
            return None
        del inner[path[-1]]
    else:
        inner[path[-1]] = value
    return copied


failures = 0
for schema, files, changes in (
    ("molecules/molecule.schema.json", root.glob("molecules/*.json"), broken_molecules),
    ("models/scene.schema.json", root.glob("models/**/*.scene.json"), broken_scenes),
):
    rules = json.loads((root / schema).read_text())
    Draft202012Validator.check_schema(rules)
    validator = Draft202012Validator(rules)
    refused = [0] * len(changes)
    files = sorted(file for file in files if not file.name.endswith(".schema.json"))
    for file in files:
        document = json.loads(file.read_text())
        for error in validator.iter_errors(document):
            print(f"{file}: {error.json_path}: {error.message}")
            failures += 1
        for index, (path, value) in enumerate(changes):
            variant = broken(document, path, value)
            if variant is None:
                continue
            refused[index] += 1
            if validator.is_valid(variant):
                shown = "left out" if value is GONE else json.dumps(value)
                print(f"{schema} accepts {file.name} with {'.'.join(map(str, path))} {shown}")
                failures += 1
    # Nothing checked is nothing proved.
    for (path, value), count in zip(changes, refused):
        if count == 0:
            print(f"{schema}: no file has {'.'.join(map(str, path))} to break")
            failures += 1
    print(f"{schema}: {len(files)} files, {sum(refused)} broken ones")
    if not files:
        failures += 1
sys.exit(1 if failures else 0)
