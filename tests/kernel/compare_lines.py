#!/usr/bin/env python3
"""The lines as they were read back against the recording: every state that the recorded counts pass through, in their order,
and no other; one index a revolution.

    compare_lines.py CHANGES RECORDING COUNTS_PER_REV COUNTS_PER_M SPACING_US
"""
import csv
import sys

CYCLE = {0: (0, 0), 1: (1, 0), 2: (1, 1), 3: (0, 1)}  # A leads B in positive motion


def state(count, per_rev):
    a, b = CYCLE[count % 4]
    return a, b, int(count % per_rev == 0)


def main():
    changes, recording = sys.argv[1], sys.argv[2]
    per_rev, counts_per_m, spacing_us = int(sys.argv[3]), float(sys.argv[4]), float(sys.argv[5])
    with open(recording, newline="") as file:
        counts = [round(float(r["position_m"]) * counts_per_m) for r in csv.DictReader(file)]
    path = [counts[1]]  # the first report places the lines
    for to in counts[2:]:
        while path[-1] != to:
            path.append(path[-1] + (1 if to > path[-1] else -1))
    expected = [state(c, per_rev) for c in path]
    with open(changes) as file:
        read = [(int(t), (int(s) & 1, int(s) >> 1 & 1, int(s) >> 2 & 1)) for t, s in map(str.split, file)]
    seen = list(read)
    while seen and seen[0][1] != expected[0]:  # before the server had the lines
        seen.pop(0)
    states = [s for _, s in seen]
    wrong = next((i for i, (e, s) in enumerate(zip(expected, states)) if e != s), None)
    indices = sum(s[2] for s in expected), sum(s[2] for s in states[: len(expected)])
    reversals = sum(1 for a, b, c in zip(path, path[1:], path[2:]) if a == c)
    gaps = sorted(b[0] - a[0] for a, b in zip(seen, seen[1 : len(expected)]))
    print(f"lines against the recording: {len(expected)} states to pass, {len(states)} read back; counts {min(path)}..{max(path)}, "
          f"{reversals} reversals; index states {indices[0]} expected, {indices[1]} read; "
          f"median distance of edges {gaps[len(gaps) // 2] / 1e3:.1f} us (minimum stated {spacing_us:g} us)")
    if wrong is not None:
        sys.exit(f"state {wrong}: expected {expected[wrong - 2 : wrong + 4]}, read {states[wrong - 2 : wrong + 4]}")
    if len(states) < len(expected) or len(states) > len(expected) + 30:  # the last tick's edges, and the lines let go of
        sys.exit("states are missing or too many")
    if indices[0] != indices[1] or indices[0] < 3 or reversals < 3 or len(expected) < 1000:
        sys.exit("index states do not agree, or the motion was too small to tell")


if __name__ == "__main__":
    main()
