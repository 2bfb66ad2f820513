"""Sparse regression: sequentially thresholded least squares (Brunton, Proctor, Kutz 2016) over the whole bank at once.

Columns are scaled to unit rms, so that a coefficient is what its term contributes; the base is never thresholded. The
threshold is swept from a quarter of the residual that there is anyway, and BIC chooses, as is usual without a second record.
"""

import numpy as np

from bank import residual_of, rms

THRESHOLDS = (0.25, 0.5, 1.0, 2.0)  # of the residual that there is anyway
RIDGE = 1e-6


def solve(a, y):
    return np.linalg.solve(a.T @ a + RIDGE * len(y) * np.eye(a.shape[1]), a.T @ y)


def name(problem):
    y, base = problem.target, problem.base / np.sqrt(np.mean(problem.base**2, axis=0))
    owners, blocks = [], []
    for effect, variants in problem.candidates.items():
        for variant in variants:
            for column in variant.T:
                owners.append(effect)
                blocks.append(column / rms(column))
    if not blocks:
        return []
    library, b = np.column_stack(blocks), base.shape[1]
    size = problem.floor
    best, chosen = np.inf, []
    for share in THRESHOLDS:
        active = np.arange(library.shape[1])
        for _ in range(20):
            coefficients = solve(np.column_stack([base, library[:, active]]), y)[b:]
            keep = active[np.abs(coefficients) >= share * size]
            if len(keep) == len(active):
                break
            active = keep
        a = np.column_stack([base, library[:, active]])
        score = len(y) * np.log(np.mean((y - a @ solve(a, y)) ** 2) + 1e-30) + a.shape[1] * np.log(len(y))
        if score < best:
            best, chosen = score, [owners[i] for i in active]
    return list(dict.fromkeys(chosen))
