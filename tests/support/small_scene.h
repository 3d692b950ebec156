// A small scene that uses every kind of element, with the files that it names, in a scratch folder.
#pragma once

#include <string>

#include "support/scratch.h"

namespace shoal::test {

inline const char* const smallMolecule = R"({
  "format": "shoal-molecule-1",
  "name": "blade",
  "defaults": {"mass": 0.01, "stiffness": 20, "damping": 0.02},
  "vertices": [
    {"position": [0, 0, 0], "pinned": true},
    {"position": [0.1, 0.2, 0]},
    {"position": [-0.1, 0.2, 0.05]}
  ],
  "springs": [{"a": 0, "b": 1}, {"a": 1, "b": 2}, {"a": 0, "b": 2, "restLength": 0.23}],
  "triangles": [[0, 1, 2]],
  "material": {"color": [0.2, 0.5, 0.1]}
})";

inline const char* const smallField = "2, 1, 1,\n-1, -1, -1,\n1, 1, 1,\n0.5, 0, 0,\n1.5, 0, -0.25,\n";

inline const char* const smallModel =
    "o ground\nv -4 0 4\nv 4 0 4\nv 4 1 -4\nv -4 1 -4\nf 1 2 3 4\n"
    "o post\nv 0 1 0\nv 1 1 0\nv 0 3 0\nf 5 6 7\n";

inline const char* const smallScene = R"({
  "format": "shoal-scene-1",
  "name": "all",
  "seed": 18446744073709551615,
  "frameRate": 30,
  "gravity": [0, -9.81, 0],
  "solver": {"method": "euler", "substeps": 12},
  "fields": [
    {"type": "uniform", "name": "wind", "velocity": [1, 2, 3], "weight": 0.5,
     "box": {"low": [-1, -2, -3], "high": [1, 2, 3]}},
    {"type": "gust", "direction": [0, 0, 4], "speed": 7, "strength": 0.1, "length": 2, "width": 3,
     "frontSpeed": 4, "seed": 5},
    {"type": "shear", "origin": [1, 0, 0], "velocity": [0, 1, 0], "gradient": [[1, 2, 3], [4, 5, 6], [7, 8, 9]]},
    {"type": "vortex", "axis": [0, 2, 0], "speed": 4, "radius": 0.5, "lift": 1},
    {"type": "abc", "a": 1, "b": 2, "c": 3, "wavelength": 4},
    {"type": "taylorGreen", "speed": 2, "wavelength": 3},
    {"type": "curlNoise", "speed": 0.5, "length": 1, "period": 3, "octaves": 4},
    {"type": "grid", "file": "wind.fga", "axes": "zUp", "scale": 2, "outside": "wrap", "origin": [0, 1, 0]},
    {"type": "oscillating", "velocity": [0.5, 0, 2], "frequency": 1.5, "phase": -0.25},
    {"type": "waves", "origin": [0, 2, 0], "depth": 3, "gravity": 9,
     "trains": [{"amplitude": 0.1, "wavelength": 4, "direction": [1, 0, 1], "phase": 0.5}]},
    {"type": "hurricane", "origin": [1, 0, 0], "speed": 9, "radius": 4, "shape": 1.2,
     "inflow": 0.3, "height": 5, "coriolis": 0.001}
  ],
  "colliders": [
    {"type": "plane", "normal": [0, 3, 0], "restitution": 0.9, "friction": 0, "draw": false},
    {"type": "sphere", "center": [1, 2, 3], "radius": 0.5, "thickness": 0.01, "color": [1, 0, 0]},
    {"type": "heightField", "model": "hill", "resolution": 5, "normals": "sampled"}
  ],
  "models": [
    {"name": "hill", "file": "hill.obj", "position": [1, 0, 0], "scale": 2,
     "rotation": {"axis": [0, 1, 0], "angle": 1.5707963267948966}}
  ],
  "groups": [
    {"name": "on it", "molecule": "blade.json", "count": 3,
     "place": {"on": "vertices", "model": "hill", "select": {"object": "post", "minHeight": 2.5},
               "droop": 0.5, "tilt": 0.1, "scale": [0.5, 2], "offset": 0.1},
     "drag": {"normal": 9, "tangent": 1}, "release": {"force": 0.5, "rate": 0.25, "after": 2}},
    {"molecule": "blade.json", "count": 4, "place": {"on": "surface", "model": "hill", "align": "up", "turn": "none"},
     "drag": 2, "held": false, "velocity": [1, 0, 0], "spin": [0, 1, 0], "phaseSpread": 6, "collide": false},
    {"molecule": "blade.json", "count": 5, "place": {"on": "volume", "box": {"low": [0, 0, 0], "high": [1, 0, 1]},
     "turn": "any"}, "stiffness": 2, "damping": 3, "color": [1, 0, 0], "secondColor": [0, 1, 0], "variation": 0.5},
    {"molecule": "blade.json", "place": {"on": "grid", "spacing": [1, 1, 1], "cells": [2, 3, 4], "scale": 3}},
    {"molecule": "blade.json", "place": {"on": "list", "items": [
      {"position": [1, 2, 3], "rotation": [0, 0, 2, 2], "scale": 2}, {}]}},
    {"name": "born", "molecule": "blade.json", "held": false,
     "life": {"span": [0.5, 1], "capacity": 40, "allocator": "stack", "scale": [0.5, 1], "turn": "yaw",
              "spin": [1, 0, 1], "grow": 0.1, "shrink": 0.2,
              "dies": {"outside": {"low": [-9, -9, -9], "high": [9, 9, 9]}, "afterContact": 0.25}},
     "emitters": [
       {"from": "surface", "model": "hill", "select": {"object": "ground"}, "rate": 20, "begin": 0.1, "until": 2},
       {"from": "disc", "position": [0, 1, 0], "radius": 1, "hollow": 0.5, "rate": 3, "random": true,
        "direction": [1, 1, 0], "spread": 0.5, "speed": [1, 2], "inherit": 0.5,
        "path": {"keyframes": [{"time": 0}, {"time": 1, "position": [0, 1, 0]}]}},
       {"from": "box", "box": {"low": [0, 0, 0], "high": [1, 0, 1]}, "bursts": [{"time": 0.1, "count": 3, "every": 0.5}]}]},
    {"name": "sparks", "particle": {"mass": 0.001, "size": [0.01, 0.02], "blend": "additive",
     "colors": [{"color": [3, 2, 1]}, {"age": 1, "opacity": 0}]},
     "life": {"span": 0.3, "capacity": 20}, "emitters": [{"from": "death", "of": "born", "count": 2, "speed": 1}]}
  ],
  "camera": {"eye": [1, 2, 3], "target": [0, 0, 0], "fieldOfView": 1, "exposure": 2},
  "light": {"direction": [0, -2, 0], "color": [1, 1, 1], "intensity": 1, "shadows": false},
  "sky": {"zenith": [0, 0, 1], "horizon": [1, 1, 1], "ground": [0, 0, 0], "intensity": 2, "fog": 0.1},
  "forces": [
    {"type": "attract", "name": "hive", "position": [0, 1, 0], "strength": 2, "most": 9, "groups": ["on it"],
     "mouse": true, "path": {"repeats": true, "keyframes": [{"time": 0}, {"time": 2, "offset": [1, 0, 0], "factor": 0.5}]}},
    {"type": "attract", "falloff": "constant", "strength": -2, "radius": 3},
    {"type": "vortexLine", "axis": [0, 0, 2], "pull": 2, "turn": 3, "core": 0.5, "radius": 4},
    {"type": "thrust", "rate": 0.5, "limit": 3}, {"type": "thrust", "rate": -0.25},
    {"type": "wind", "velocity": [0.5, 0, 1], "path": {"keyframes": [{"time": 1, "factor": 0}, {"time": 3}]}}
  ]
}
)";

// Writes the files that the scene names and returns the scene file's path.
inline std::string writeSmallScene(const Scratch& scratch, const std::string& scene = smallScene) {
    scratch.write("blade.json", smallMolecule);
    scratch.write("wind.fga", smallField);
    scratch.write("hill.obj", smallModel);
    return scratch.write("all.scene.json", scene);
}

}  // namespace shoal::test
