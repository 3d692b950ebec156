"""Blender reads what `shoal export --vat` wrote, plays it back on the imported mesh, and every vertex is compared with
the run's own CSV files.

blender --background --factory-startup --python-exit-code 1 --python blender.py -- FOLDER NAME CSV_FOLDER

CSV_FOLDER holds state-NNNNN.csv of the frames 0 to F - 1. Fails where a vertex is off by more than a step of 16 bits.
"""
import csv
import os
import sys

import bpy
import numpy

sys.path.append(os.path.join(os.path.dirname(__file__), "../../docs/vat"))
from play_in_blender import Player

folder, name, states = sys.argv[sys.argv.index("--") + 1 :]
bpy.ops.wm.read_factory_settings(use_empty=True)
player = Player(folder, name)
step = numpy.ptp(player.offsets, axis=(0, 1)).max() / 65535
worst = turned = 0.0
seen = 0
for frame in range(player.frames):
    with open(os.path.join(states, f"state-{frame:05d}.csv")) as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    # Blender's axes: x, -z and y of ours.
    places = numpy.array([(row["x"], -row["z"], row["y"]) for row in rows])[player.column]
    normals = numpy.array([(row["nx"], -row["nz"], row["ny"]) for row in rows])[player.column]
    bpy.context.scene.frame_set(frame)
    player.show(bpy.context.scene)
    shown = numpy.array([vertex.co[:] for vertex in player.object.data.vertices])
    worst = max(worst, abs(shown - places).max())
    turned = max(turned, abs(player.normals[frame][player.column] - normals).max())
    seen += len(shown)
print(f"{seen} places: worst {worst:.3g} m, step {step:.3g} m; normals within {turned:.3g}")
if seen == 0 or worst > step or turned > 1e-3:
    raise RuntimeError("Blender plays back something else")
