#!/usr/bin/env python3
"""Prints how much angular momentum and energy a cube has left after 20 s of spin, by solver, stiffness and speed.

spin.py [--seconds S] [--solvers NAME…]        with build/python in PYTHONPATH

The cube has edges of 1 m, vertices of 1 kg and a spring without damping between each two of them. Eight of them, turned at
random, spin about the same axis. Explicit solvers take 8 substeps a frame, or as many as keep them stable. What changes is
the solver's error: nothing acts on the cubes.
"""
import argparse
import itertools
import warnings

import numpy as np

import shoal

solvers = ("euler", "verlet", "leapfrog", "rk4", "xpbd", "bdf2-xpbd", "bdf2-corotated")
implicit = ("xpbd", "bdf2-xpbd", "bdf2-corotated", "bdf2-newton")  # the last one takes minutes a case
corners = [{"position": [x - 0.5, y - 0.5, z - 0.5]} for x, y, z in itertools.product((0, 1), repeat=3)]
springs = [{"a": a, "b": b} for a, b in itertools.combinations(range(8), 2)]


def momentum(simulation):
    """The length of the angular momentum of each cube about its own middle."""
    places, velocities = simulation.positions(), simulation.velocities()
    arms = places - places.mean(axis=1, keepdims=True)
    own = velocities - velocities.mean(axis=1, keepdims=True)
    return np.linalg.norm(np.cross(arms, own).sum(axis=1), axis=1)


def left(solver, substeps, stiffness, speed, seconds):
    """The least and the largest share of angular momentum that a cube has left, and the share of all energy."""
    molecule = {"format": "shoal-molecule-1", "name": "cube", "vertices": corners, "springs": springs,
                "defaults": {"mass": 1, "stiffness": stiffness, "damping": 0}}
    scene = shoal.Scene({"gravity": [0, 0, 0], "groups": [
        {"molecule": molecule, "count": 8, "spin": [0, speed, 0],
         "place": {"on": "grid", "origin": [0, 0, 0], "cells": [8, 1, 1], "spacing": [4, 1, 1], "turn": "any"}}]})
    with shoal.Simulation(scene, solver=solver, substeps=substeps) as simulation:
        def energy():
            now = simulation.energy()
            return now["kinetic"] + now["elastic"]
        first, begun = momentum(simulation), energy()
        simulation.step(round(60 * seconds))
        kept = momentum(simulation) / first
        return kept.min(), kept.max(), energy() / begun


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=20)
    parser.add_argument("--solvers", nargs="+", default=solvers)
    options = parser.parse_args()
    warnings.simplefilter("ignore")  # of implicit solvers that strain the springs
    cases = list(itertools.product((20, 100), (1e4, 1e6, 1e8)))
    print("| solver, substeps | " + " | ".join(f"{speed} rad/s, {k:.0e}" for speed, k in cases) + " |")
    print("|---" * (len(cases) + 1) + "|")
    for solver in options.solvers:
        for substeps in (8, 64) if solver in implicit else (None,):
            row = []
            for speed, stiffness in cases:
                taken = substeps
                # stable where a substep is no longer than 2 / w for Verlet's methods; w is at most sqrt(2 * 8 k)
                if taken is None:
                    taken = max(8, int(np.ceil(1.05 * np.sqrt(16 * stiffness) / 60 / 2)))
                try:
                    least, most, energy = left(solver, taken, stiffness, speed, options.seconds)
                    spin = f"{least:.3f}" if most - least < 0.002 else f"{least:.3f} to {most:.3f}"
                    row.append(f"{spin}, {energy:.3f}" + ("" if substeps else f" ({taken})"))
                except shoal.Error:
                    row.append("refused")
            print(f"| {solver}{f', {substeps}' if substeps else ''} | " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
