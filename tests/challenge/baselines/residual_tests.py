"""Whiteness of the residual (Ljung-Box) after the base is refitted, then its correlation with what each effect would add.

An effect is named when the correlation leaves the 95 % band of white noise, 1.96 / sqrt(N), as correlation tests are drawn.
"""

import numpy as np
from scipy.stats import chi2

from bank import residual_of

LAGS = 20


def white(residual):
    n, e = len(residual), residual - residual.mean()
    correlations = np.array([np.dot(e[k:], e[:-k]) for k in range(1, LAGS + 1)]) / np.dot(e, e)
    return n * (n + 2) * np.sum(correlations**2 / (n - np.arange(1, LAGS + 1))) < chi2.ppf(0.99, LAGS)


def name(problem):
    residual = residual_of(problem.target, problem.base)
    if white(residual):
        return []
    found = []
    for effect, variants in problem.candidates.items():
        best = 0.0
        for variant in variants:
            new = residual_of(variant, problem.base)  # what the refitted base cannot take itself
            best = max(best, 1.0 - np.sum(residual_of(residual, new) ** 2) / np.sum(residual**2))
        if np.sqrt(best) > 1.96 / np.sqrt(len(residual)):
            found.append((best, effect))
    return [effect for _, effect in sorted(found, reverse=True)]
