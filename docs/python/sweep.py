"""How far a gust carries leaves, by its speed: the mean over 200 leaves, and their spread as error bars."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import shoal

speeds = np.linspace(0, 4, 9)
means, spreads = [], []
for speed in speeds:
    scene = shoal.Scene(
        {
            "gravity": [0, -9.81, 0],
            "fields": [{"type": "gust", "direction": [1, 0, 0.2], "speed": float(speed)}],
            "groups": [
                {
                    "molecule": shoal.Molecule("molecules/leaf.json"),
                    "count": 200,
                    "held": False,
                    "place": {"on": "volume", "box": {"low": [-2, 3, -2], "high": [2, 4, 2]}},
                    "drag": {"normal": 8, "tangent": 0.8},
                }
            ],
        }
    )
    with shoal.Simulation(scene) as simulation:
        start = simulation.positions().mean(axis=1)
        simulation.step(120)
        moved = simulation.positions().mean(axis=1)[:, 0] - start[:, 0]
    means.append(moved.mean())
    spreads.append(moved.std())

plt.figure(figsize=(6.4, 3.6))
plt.errorbar(speeds, means, yerr=spreads, marker="o", capsize=4)
plt.xlabel("speed of the gust, m/s")
plt.ylabel("way after 2 s, m")
plt.tight_layout()
plt.savefig("sweep.png", dpi=100)
