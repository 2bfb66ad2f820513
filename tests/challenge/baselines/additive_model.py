"""A generalised additive model: the base plus smooth terms (cubic P-splines, Eilers and Marx 1996; one penalty by GCV) over what
can be seen: velocity, position, position times direction, time, angle of the revolution, and the angle times the torque.

A term is kept when an F test says p < 0.001 and it makes a quarter of the residual; its shape gives the effect's name.
"""

import numpy as np
from scipy.interpolate import BSpline
from scipy.stats import f as f_distribution

from bank import rms

PENALTIES = np.logspace(-3, 5, 9)
KNOTS = 16
SMALLEST_SHARE = 0.25


def basis(x, cyclic=False):
    low, high = np.min(x), np.max(x) + 1e-12
    if cyclic:  # whole orders up to 24
        orders = np.arange(1, 25)
        return np.column_stack([np.cos(np.outer(x, orders)), np.sin(np.outer(x, orders))]), np.diag(np.tile(orders / 12.0, 2) ** 4)
    step = (high - low) / KNOTS
    knots = np.arange(-3, KNOTS + 4) * step + low
    b = BSpline.design_matrix(np.clip(x, low, high - 1e-9 * step), knots, 3).toarray()
    d = np.diff(np.eye(b.shape[1]), n=2, axis=0)
    return b, d.T @ d


def terms(problem):
    f = problem.features
    s, y = np.sign(f["velocity_m_per_s"]), f["torque_Nm"]
    made = {"position": basis(f["position_m"]), "time": basis(f["time_s"]), "angle": basis(f["angle_rad"], cyclic=True)}
    if problem.name == "force":
        b, p = basis(f["position_m"])
        made["direction x position"] = (b * s[:, None], p)
        b, p = basis(f["time_s"])
        made["direction x time"] = (b * s[:, None], p)
        b, p = basis(np.abs(f["velocity_m_per_s"]))
        made["direction x speed"] = (b * s[:, None], p)
        b, p = basis(f["angle_rad"], cyclic=True)
        made["torque x angle"] = (b * y[:, None], p)
        made["torque rate"] = (f["torque_rate_Nm_per_s"][:, None], np.zeros((1, 1)))
    if problem.name == "scale":
        made["direction"] = (s[:, None], np.zeros((1, 1)))
        made["torque"] = (y[:, None], np.zeros((1, 1)))
    if problem.name == "power":
        made["torque"] = basis(np.abs(y))
    return made


class Fit:
    def __init__(self, problem, made, penalty):
        blocks, self.at, n = [problem.base], {}, problem.base.shape[1]
        for name, (b, _) in made.items():
            self.at[name] = slice(n, n + b.shape[1])
            n += b.shape[1]
            blocks.append(b - b.mean(axis=0))
        a = np.column_stack(blocks)
        scale = np.sqrt(np.mean(a**2, axis=0)) + 1e-30
        a = a / scale
        ridge = 1e-8 * np.eye(n)
        for name, (_, p) in made.items():
            ridge[self.at[name], self.at[name]] += penalty * p * len(problem.target) / 1000.0
        gram = a.T @ a
        solve = np.linalg.solve(gram + ridge, np.column_stack([a.T @ problem.target, gram]))
        self.coefficients = solve[:, 0]
        self.freedom = float(np.trace(solve[:, 1:]))
        self.a = a
        self.rss = float(np.sum((problem.target - a @ self.coefficients) ** 2))
        self.gcv = len(problem.target) * self.rss / max(1.0, len(problem.target) - self.freedom) ** 2

    def part(self, name):
        return self.a[:, self.at[name]] @ self.coefficients[self.at[name]]


def straight(x, y):
    line = np.polyval(np.polyfit(x, y, 1), x)
    return 1.0 - np.var(y - line) / max(np.var(y), 1e-30) > 0.8


def shape_name(problem, term, part):
    f = problem.features
    s = np.sign(f["velocity_m_per_s"])
    linear = straight(f["position_m"], part * (s if term == "direction x position" else 1.0))
    if problem.name == "scale":
        return {"position": "lead_error", "time": "screw_growth", "angle": "cyclic_lead_error", "direction": "backlash",
                "torque": "screw_compliance"}.get(term)
    if problem.name == "power":
        return "copper_loss" if term == "torque" else None
    if problem.name != "force":
        return "cogging" if term == "angle" and problem.name == "torque_sensor" else None
    if term == "direction x speed":
        speed = np.abs(f["velocity_m_per_s"])
        return "quadratic_drag" if np.polyfit(speed, part * s, 2)[0] > 0 else "sublinear_viscous"
    if term == "angle":
        return "cogging"
    return {"position": "cable_spring" if linear else "local_friction",
            "direction x position": "position_friction" if linear else "local_friction", "direction x time": "friction_drift",
            "torque x angle": "torque_ripple", "torque rate": "input_delay", "time": None}[term]


def name(problem):
    made = terms(problem)
    penalty = min(PENALTIES, key=lambda p: Fit(problem, made, p).gcv)
    full = Fit(problem, made, penalty)
    noise = full.rss / max(1.0, len(problem.target) - full.freedom)
    named = []
    for term in made:
        without = Fit(problem, {k: v for k, v in made.items() if k != term}, penalty)
        degrees = max(1.0, full.freedom - without.freedom)
        p = f_distribution.sf((without.rss - full.rss) / degrees / noise, degrees, len(problem.target) - full.freedom)
        size = np.sqrt(max(0.0, without.rss - full.rss) / len(problem.target))
        if p < 1e-3 and size >= SMALLEST_SHARE * max(np.sqrt(noise), problem.floor):
            effect = shape_name(problem, term, full.part(term))
            if effect:
                named.append((size / np.sqrt(noise), effect))
    return [effect for _, effect in sorted(named, reverse=True)]
