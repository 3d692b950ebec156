"""A molecule made in code: a ribbon, pinned at one end, in the wind."""
import matplotlib.image

import shoal

length, links = 0.6, 10
vertices, springs, triangles = [], [], []
for i in range(links + 1):
    for side in (-1, 1):
        # Zigzag a little: what is quite flat does not resist bending.
        place = [i * length / links, 0.008 * (-1) ** i, 0.04 * side]
        vertices.append({"position": place, "mass": 0.002, "pinned": i == 0})
for i in range(links):
    a, b, c, d = 2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3
    springs += [(a, c), (b, d), (a, d), (b, c), (c, d)]
    triangles += [[a, c, d], [a, d, b]]
    if i > 0:
        springs += [(a - 2, c), (b - 2, d)]  # across the fold
springs.append((0, 1))
ribbon = shoal.Molecule(
    {
        "name": "ribbon",
        "defaults": {"stiffness": 40, "damping": 0.01},
        "vertices": vertices,
        "springs": [{"a": a, "b": b} for a, b in springs],
        "triangles": triangles,
        "material": {"color": [0.7, 0.05, 0.05], "secondColor": [0.9, 0.5, 0.05]},
    }
)
scene = shoal.Scene(
    {
        "gravity": [0, -9.81, 0],
        "fields": [{"type": "gust", "direction": [1, 0.1, 0.3], "speed": 5}],
        "colliders": [{"type": "plane", "point": [0, -0.2, 0]}],
        "groups": [
            {
                "molecule": ribbon,
                "count": 60,
                "place": {"on": "volume", "box": {"low": [-1.2, 0.2, -0.8], "high": [0.8, 1.2, 0.8]}, "turn": "none"},
                "drag": {"normal": 12, "tangent": 1},
            }
        ],
        "camera": {"eye": [0.6, 1.1, 3.4], "target": [0, 0.6, 0]},
    }
)
with shoal.Simulation(scene) as simulation:
    simulation.step(180)
    matplotlib.image.imsave("ribbon.png", simulation.picture(800, 450))
    print(simulation.solver(), simulation.energy())
