"""Forward selection with backward elimination by BIC on the inverse model, then a size threshold."""

import numpy as np

from bank import residual_of, rms

SMALLEST_SHARE = 0.25  # of the residual's rms that a named term must make


def bic(target, columns):
    n, k = columns.shape
    return n * np.log(np.mean(residual_of(target, columns) ** 2) + 1e-30) + k * np.log(n)


def name(problem):
    y, chosen = problem.target, {}

    def columns(terms):
        return np.column_stack([problem.base, *terms.values()])

    best = bic(y, problem.base)
    while len(chosen) < 8:
        trials = [(bic(y, columns({**chosen, e: v})), e, v) for e, variants in problem.candidates.items() if e not in chosen for v in variants]
        if not trials:
            break
        score, effect, variant = min(trials, key=lambda trial: trial[0])
        if score >= best:
            break
        best, chosen[effect] = score, variant
        for other in [e for e in chosen if e != effect]:  # backward: what the new one has made superfluous
            without = {e: v for e, v in chosen.items() if e != other}
            if bic(y, columns(without)) < best:
                best, chosen = bic(y, columns(without)), without
    left = rms(residual_of(y, columns(chosen))) if chosen else 1.0
    named = []
    for effect in chosen:
        without = {e: v for e, v in chosen.items() if e != effect}
        added = rms(residual_of(y, columns(without)))
        if np.sqrt(max(0.0, added**2 - left**2)) >= SMALLEST_SHARE * max(left, problem.floor):
            named.append(effect)
    return named
