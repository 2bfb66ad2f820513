"""What the baselines share: a case's runs as regression problems, and the bank of columns that each missing effect would add.

A problem is one equation of the inverse model: a target, base columns (the nominal model's own terms, whose numbers float) and
candidates, each an effect's id with one or more variants (a column, or a sine and cosine). Means over 15 ms, sliding rows only.
"""

import csv
import pathlib
import tomllib
from dataclasses import dataclass, field

import numpy as np
from scipy.signal import butter, sosfiltfilt

#: smallest residual that a size threshold counts from; for the force the challenge's own (its README)
FLOORS = {"force": 0.5, "scale": 3e-7, "torque_sensor": 1.5e-3, "force_sensor": 0.5, "power": 0.8}
METER_WINDOW_S = 0.1       # of the power meter, 10 Hz
MEAN = 15                  # samples a row
SLIDING_M_PER_S = 3e-3
SETTLED = 90               # samples since the last reversal or rest
LOW_PASS_HZ = 60.0
CYCLES = {"cogging": (4, 6, 8, 12, 18, 24), "rev_ripple": (1, 2, 3.37, 5.61), "torque_ripple": (1, 2, 4, 6, 12)}
#: ids that a single equation cannot tell apart: named together
ALIKE = [{"cyclic_lead_error", "encoder_eccentricity"}, {"floor_vibration", "process_force"},
         {"current_loop_lag", "input_delay"}, {"torque_gain_error", "sensor_gain"}, {"thermal_friction", "friction_drift"}]


@dataclass
class Problem:
    name: str
    target: np.ndarray
    base: np.ndarray
    floor: float  # what a residual has anyway: a share of it is no finding
    candidates: dict = field(default_factory=dict)  # id -> list of variants, each (rows, columns)
    features: dict = field(default_factory=dict)    # for smooth terms: position_m, velocity_m_per_s, time_s, angle_rad, ...

    def add(self, effect, *variants):
        for v in variants:
            v = np.column_stack(v) if isinstance(v, tuple) else np.asarray(v)[:, None]
            if np.all(np.isfinite(v)) and np.all(np.ptp(v, axis=0) > 1e-12):
                self.candidates.setdefault(effect, []).append(v)


def read_run(path, channels):
    with open(path, newline="") as file:
        rows = csv.reader(file)
        names = next(rows)
        data = np.array([[float(x) for x in row] for row in rows])
    run = {name: data[:, i] for i, name in enumerate(names)}
    for name, source in channels.items():
        run[name] = run[source["column"]] * source.get("scale", 1.0)
    return run


class Case:
    def __init__(self, folder):
        folder = pathlib.Path(folder)
        case = tomllib.loads((folder / "case.toml").read_text())
        self.axis = tomllib.loads((folder / case["axis"]).read_text())
        self.step_s = 1.0 / case.get("sample_rate_Hz", 1000)
        self.runs = [self.motion(read_run(folder / f, case.get("channels", {}))) for f in case["fit"]]

    def motion(self, run):
        # As inverse models are fitted (Gautier): every channel through one zero-phase low-pass, central differences after it;
        # the torque is held over a sample, so that the mean of two stands for the instant between them.
        x, dt = self.low_pass(run["position_m"]), self.step_s
        run["v"], run["a"] = np.gradient(x, dt), np.gradient(np.gradient(x, dt), dt)
        run["a"][1:-1] = (x[2:] - 2 * x[1:-1] + x[:-2]) / dt**2
        for channel in ("torque_sensor_Nm", "force_sensor_N"):
            if channel in run:
                run[channel] = self.low_pass(run[channel])
        held = run["torque_cmd_Nm"]
        run["u"] = self.low_pass(0.5 * (held + np.concatenate([held[:1], held[:-1]])))
        moving = np.abs(run["v"]) > SLIDING_M_PER_S
        direction = np.where(moving, np.sign(run["v"]), 0)
        since = np.zeros(len(x), int)
        for i in range(1, len(x)):
            since[i] = since[i - 1] + 1 if direction[i] == direction[i - 1] != 0 else 0
        run["sliding"] = (since > SETTLED)
        run["sliding"][-SETTLED:] = False
        run["passes"] = np.cumsum(np.abs(np.diff(np.floor(x / self.axis["axis"]["lead_m"] + 0.5), prepend=0.0)))
        return run

    def low_pass(self, value):
        return sosfiltfilt(butter(4, LOW_PASS_HZ, fs=1.0 / self.step_s, output="sos"), value)

    def rows(self, value):
        """Means over 15 ms of the rows that slide throughout, all runs one after another; `value` takes a run."""
        out = []
        for run in self.runs:
            n = len(run["v"]) // MEAN * MEAN
            good = run["sliding"][:n].reshape(-1, MEAN).all(axis=1)
            out.append(np.broadcast_to(value(run), run["v"].shape)[:n].reshape(-1, MEAN).mean(axis=1)[good])
        return np.concatenate(out)

    def has(self, channel):
        return all(channel in run for run in self.runs)


def waves(case, cycles, scale=lambda r: 1.0):
    lead = case.axis["axis"]["lead_m"]

    def wave(function, n):
        return case.rows(lambda r: scale(r) * function(2 * np.pi * n * r["position_m"] / lead))

    return [(wave(np.cos, n), wave(np.sin, n)) for n in cycles]


def side(case, sign):
    return lambda value: case.rows(lambda r: np.where(np.sign(r["v"]) == sign, value(r), 0.0))


def friction_base(case, stribeck_m_per_s, mass=True):
    columns = [case.rows(lambda r: r["a"])] if mass else []
    for sign in (1, -1):
        of = side(case, sign)
        columns += [of(lambda r: sign), of(lambda r: r["v"]), of(lambda r: sign * np.exp(-np.abs(r["v"]) / stribeck_m_per_s))]
    return np.column_stack(columns)


def dt(case, name):
    return case.rows(lambda r: np.gradient(r[name], case.step_s))


def features(case):
    lead = case.axis["axis"]["lead_m"]
    return {"position_m": case.rows(lambda r: r["position_m"]), "velocity_m_per_s": case.rows(lambda r: r["v"]),
            "time_s": case.rows(lambda r: r["time_s"]), "angle_rad": case.rows(lambda r: 2 * np.pi * r["position_m"] / lead),
            "torque_Nm": case.rows(lambda r: r["u"]), "torque_rate_Nm_per_s": dt(case, "u")}


def frequencies(residual, time_s, low_Hz, high_Hz):
    """The strongest sine in a band, of rows that need not be evenly spaced (Lomb)."""
    grid = np.arange(low_Hz, min(high_Hz, 0.5e3 / MEAN), 0.1)
    if len(grid) == 0:
        return []
    phase = 2 * np.pi * np.outer(grid, time_s)
    power = (np.cos(phase) @ residual) ** 2 + (np.sin(phase) @ residual) ** 2
    f = grid[int(np.argmax(power))]
    return [(np.cos(2 * np.pi * f * time_s), np.sin(2 * np.pi * f * time_s))]


def force_problem(case):
    lead = case.axis["axis"]["lead_m"]
    k = 2 * np.pi / lead
    stribeck = 0.5 * (case.axis["ball_screw"]["stribeck_pos_m_per_s"] + case.axis["ball_screw"]["stribeck_neg_m_per_s"])
    y = case.rows(lambda r: k * r["u"])
    p = Problem("force", y, friction_base(case, max(stribeck, 5e-4)), FLOORS["force"], features=features(case))
    f = p.features
    x, v, t = f["position_m"], f["velocity_m_per_s"], f["time_s"]
    s, half = np.sign(v), 0.5 * case.axis["axis"]["stroke_m"]
    p.add("torque_ripple", *waves(case, CYCLES["torque_ripple"], lambda r: k * r["u"]))
    p.add("cogging", *waves(case, CYCLES["cogging"]))
    p.add("rev_ripple", *waves(case, CYCLES["rev_ripple"]))
    p.add("position_friction", s * x / half)
    p.add("local_friction", *[s * np.exp(-((x - c) / 2e-3) ** 2) for c in np.arange(x.min(), x.max(), 1e-3)])
    p.add("sublinear_viscous", s * np.abs(v) ** 0.7, s * np.abs(v) ** 0.5)
    p.add("quadratic_drag", v * np.abs(v))
    p.add("cable_spring", np.copy(x))
    p.add("frictional_lag", case.rows(lambda r: np.gradient(np.abs(r["v"]), case.step_s) * np.sign(r["v"])))
    p.add("input_delay", k * f["torque_rate_Nm_per_s"])
    p.add("friction_drift", *[s * np.exp(-t / tau) for tau in (1.0, 2.5, 5.0)])
    heat = case.rows(lambda r: np.cumsum(np.abs(k * r["u"] * r["v"])) * case.step_s)
    p.add("thermal_friction", *[v * (1 - np.exp(-heat / e)) for e in (5.0, 12.0, 25.0)])
    top = np.abs(f["torque_Nm"]).max()
    p.add("torque_saturation", *[np.sign(y) * np.maximum(0.0, np.abs(y) - k * share * top) for share in (0.75, 0.8, 0.85, 0.9)])
    reach = np.abs(x).max()
    p.add("hard_stop", *[np.maximum(0.0, x - share * reach) for share in (0.96, 0.98)])
    p.add("hidden_friction_compensation", *[np.tanh(v / w) - s for w in (1e-3, 3e-3, 5e-3)])
    if case.has("force_sensor_N"):
        p.add("load_dependent_friction", s * np.abs(case.rows(lambda r: r["force_sensor_N"])))
    residual = y - p.base @ np.linalg.lstsq(p.base, y, rcond=None)[0]
    p.add("floor_vibration", *frequencies(residual, t, 8.0, 40.0))
    return p


def scale_problem(case):
    y = case.rows(lambda r: r["scale_position_m"] - r["position_m"])
    f = features(case)
    x, v, t = f["position_m"], f["velocity_m_per_s"], f["time_s"]
    p = Problem("scale", y, np.ones((len(y), 1)), FLOORS["scale"], features=f)
    p.add("lead_error", np.copy(x))
    p.add("screw_growth", *[(x + 0.5 * case.axis["axis"]["stroke_m"]) * (1 - np.exp(-t / tau)) for tau in (2.0, 4.0, 6.0)])
    p.add("cyclic_lead_error", *waves(case, (1, 2)))
    p.add("backlash", np.sign(v))
    p.add("screw_compliance", f["torque_Nm"])
    p.add("count_loss", case.rows(lambda r: r["passes"]))
    return p


def torque_sensor_problem(case):
    y = case.rows(lambda r: r["torque_sensor_Nm"] - r["u"])
    f = features(case)
    p = Problem("torque_sensor", y, friction_base(case, 1e-3)[:, [0, 1, 2, 4, 5]], FLOORS["torque_sensor"], features=f)
    p.add("cogging", *waves(case, CYCLES["cogging"]))
    p.add("torque_ripple", *waves(case, CYCLES["torque_ripple"], lambda r: r["u"]))
    p.add("torque_gain_error", f["torque_Nm"])
    p.add("current_loop_lag", f["torque_rate_Nm_per_s"])
    p.add("channel_skew", dt(case, "torque_sensor_Nm"))
    p.add("hidden_friction_compensation", *[np.tanh(f["velocity_m_per_s"] / w) - np.sign(f["velocity_m_per_s"]) for w in (1e-3, 3e-3, 5e-3)])
    return p


def force_sensor_problem(case):
    y = case.rows(lambda r: r["force_sensor_N"])
    f = features(case)
    p = Problem("force_sensor", y, friction_base(case, 3e-3), FLOORS["force_sensor"], features=f)
    p.add("cable_spring", f["position_m"])
    p.add("channel_skew", dt(case, "force_sensor_N"))
    p.add("payload", f["velocity_m_per_s"] * np.abs(f["velocity_m_per_s"]))
    p.candidates.pop("payload")  # the mass floats in the base: a number, not physics
    return p


def power_problem(case):
    omega = 2 * np.pi / case.axis["axis"]["lead_m"]
    window = round(METER_WINDOW_S / case.step_s)

    def metered(value, samples=window):
        """As a meter shows it: the mean over the window before, held until the next one is full."""
        whole = len(value) // samples
        means = np.concatenate([[0.0], value[: whole * samples].reshape(whole, samples).mean(axis=1)])
        return np.repeat(means, samples)[: len(value)] if (whole + 1) * samples >= len(value) else value

    def raw(r):
        return r["u"] * omega * r["v"]

    y = case.rows(lambda r: r["power_W"] - metered(raw(r)))
    columns = [np.ones(len(y))]
    for sign in (1, -1):
        columns += [case.rows(lambda r, n=n: metered(np.where(np.sign(r["v"]) == sign, np.abs(r["v"]) ** n, 0.0))) for n in (1, 2)]
    p = Problem("power", y, np.column_stack(columns), FLOORS["power"], features=features(case))
    p.add("copper_loss", case.rows(lambda r: metered(r["u"] ** 2)))
    p.add("regeneration_clipped", case.rows(lambda r: metered(np.maximum(0.0, -raw(r)))))
    p.add("power_meter_window",
          *[case.rows(lambda r, n=n: metered(raw(r), n) - metered(raw(r))) for n in (20, 30, 40, 60, 150, 200, 300)])
    return p


def problems(case):
    out = [force_problem(case)]
    for channel, make in (("scale_position_m", scale_problem), ("torque_sensor_Nm", torque_sensor_problem),
                          ("force_sensor_N", force_sensor_problem), ("power_W", power_problem)):
        if case.has(channel):
            out.append(make(case))
    return out


def set_up_findings(case):
    """Typos that any user sees in a plot: a channel upside down, a scale that runs at another pitch."""
    found = []
    for channel in ("torque_sensor_Nm", "force_sensor_N"):
        if case.has(channel):
            if np.corrcoef(case.rows(lambda r: r[channel]), case.rows(lambda r: r["u"]))[0, 1] < -0.3:
                found.append("wrong_sign")
    if case.has("scale_position_m"):
        x, y = case.rows(lambda r: r["position_m"]), case.rows(lambda r: r["scale_position_m"])
        if abs(np.polyfit(x, y, 1)[0] - 1.0) > 0.05:
            found.append("wrong_lead")
    return found


def residual_of(target, columns):
    return target - columns @ np.linalg.lstsq(columns, target, rcond=None)[0]


def rms(x):
    return float(np.sqrt(np.mean(np.square(x))))


def answer(ids):
    """In the form of `feedtwin diagnose --json`, as far as a baseline can say it."""
    ids = list(dict.fromkeys(ids))
    alternatives = [sorted(group) for group in ALIKE if group & set(ids)]
    return {"verdict": "named" if ids else "recalibrate", "effects": [{"id": i, "parameters": {}} for i in ids],
            "alternatives": alternatives, "holdout": {}}
