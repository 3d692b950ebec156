"""A loop as in training: 1,000 episodes look for the throw that lands a quad on a mark, by the cross-entropy method."""
import time

import numpy as np

import shoal

mark = np.array([3.0, -2.0])  # m, along x and z
scene = shoal.Scene(
    {
        "gravity": [0, -9.81, 0],
        "colliders": [{"type": "plane", "restitution": 0, "friction": 1}],
        "groups": [
            {
                "molecule": shoal.Molecule("molecules/quad.json"),
                "place": {"on": "list", "items": [{"position": [0, 1, 0]}]},
                "drag": {"normal": 0.5, "tangent": 0.5},
            }
        ],
    }
)
random = np.random.default_rng(7)
mean, spread = np.array([0.0, 3.0, 0.0]), np.array([4.0, 2.0, 4.0])
start = time.time()
with shoal.Simulation(scene) as simulation:
    for generation in range(20):
        throws = random.normal(mean, spread, (50, 3))
        misses = []
        for throw in throws:
            simulation.restart()
            simulation.set_state(velocities=np.broadcast_to(throw, (1, 4, 3)))
            simulation.step(90)
            misses.append(np.linalg.norm(simulation.positions().mean(axis=1)[0, [0, 2]] - mark))
        best = throws[np.argsort(misses)[:10]]
        mean, spread = best.mean(axis=0), best.std(axis=0) + 1e-3
print(f"1,000 episodes of 90 frames in {time.time() - start:.1f} s: throw {mean.round(2)} m/s misses by {min(misses):.3f} m")
