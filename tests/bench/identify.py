#!/usr/bin/python3
"""Identification beside scipy's differential evolution and the source's plain genetic algorithm: the same costs (computed by the
same compiled code) and data, in one run. Prints the table; exit 1 where a general search finds a lower cost.

    /usr/bin/python3 tests/bench/identify.py [build/release/bench_identify]
"""

import json
import pathlib
import subprocess
import sys
import time

from scipy.optimize import differential_evolution

PROGRAM = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2] / "build/release/bench_identify"
STRIBECK = [(0.1, 300.0), (0.0, 300.0), (1e-4 / 3, 0.1 / 3), (0.0, 6000.0)]
INVERSE = [(20.0, 200.0), (20.0, 300.0), (0.0, 200.0), (1e-4, 2e-2), (0.0, 1e4), (1e6, 2e8), (0.0, 1e6), (-50.0, 50.0)]


def evolution(costs, what, bounds):
    def cost(points):
        columns = points.reshape(len(bounds), -1)
        lines = [f"{what} {columns.shape[1]}"] + [" ".join(map(repr, map(float, column))) for column in columns.T]
        costs.stdin.write("\n".join(lines) + "\n")
        costs.stdin.flush()
        answers = [float(costs.stdout.readline()) for _ in range(columns.shape[1])]
        return answers if points.ndim > 1 else answers[0]

    begin = time.perf_counter()
    found = differential_evolution(cost, bounds, seed=1, vectorized=True, updating="deferred", maxiter=1000)
    return found.fun, time.perf_counter() - begin


ours = json.loads(subprocess.run([str(PROGRAM)], stdout=subprocess.PIPE, check=True).stdout)
with subprocess.Popen([str(PROGRAM), "costs"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
    theirs = {"stribeck": evolution(server, "stribeck", STRIBECK), "inverse": evolution(server, "inverse", INVERSE)}
    server.stdin.close()

worse = False
print(f"{'':44} {'cost':>14} {'time':>12} {'times as long':>14}")
for key, title in (("stribeck", "Stribeck curve, 200 points, 4 parameters"), ("inverse", "inverse model, 8 s, 8 parameters")):
    own = ours[key]
    rows = [("  projected", own["cost"], own["seconds"]), ("  the source's genetic algorithm", own["ga_cost"], own["ga_seconds"]),
            ("  scipy differential_evolution", *theirs[key])]
    print(title)
    for name, cost, seconds in rows:
        print(f"{name:44} {cost:14.6g} {1e3 * seconds:9.3f} ms {seconds / own['seconds']:14.0f}")
        worse = worse or cost < own["cost"] * (1.0 - 1e-6)
print(f"inverse model: {ours['inverse']['starts_at_optimum']} of {ours['inverse']['starts']} random starts at the optimum")
for name, seconds in ours["output_error"].items():
    print(f"closed-loop output error of an 8 s record, {name.removeprefix('seconds_').replace('_', ' ')}: {seconds:.3f} s")
sys.exit(1 if worse else 0)
