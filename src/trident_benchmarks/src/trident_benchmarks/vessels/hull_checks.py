# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Hulls and waves: how a box floats, swings and rides a sea; what an irregular sea holds."""

from __future__ import annotations

import numpy as np

from trident_benchmarks.vessels.check import Check, Curve, Figure, Panel
from trident_benchmarks.vessels.trial import GRAVITY, Array, Barge, Motion, Trial, mass_matrices

_BARGE = Barge()
_HOUR_S = 3600.0


def static_check() -> Check:
    """Draft and trim of a box by Archimedes and its metacentric height."""
    loads, shifts = np.linspace(0.6, 1.2, 5), np.linspace(-0.02, 0.02, 5)
    drafts = np.array([_rest(load * _BARGE.mass, 0.0)[0] for load in loads])
    trims = np.array([_rest(_BARGE.mass, shift)[1] for shift in shifts])
    wanted = loads * _BARGE.draft
    gm = -_BARGE.draft / 2 + _BARGE.length**2 / (12 * _BARGE.draft)
    wanted_trim = np.arctan(shifts / gm)
    draft = Panel("Draft", "mass [kg]", "draft [m]")
    draft.measured = [Curve("simulator", loads * _BARGE.mass, drafts, dots=True)]
    draft.reference = [Curve("m / (ρ L B)", loads * _BARGE.mass, wanted)]
    draft.bands = [(loads * _BARGE.mass, 0.99 * wanted, 1.01 * wanted)]
    trim = Panel("Trim", "centre of gravity ahead [cm]", "bow down [mrad]")
    trim.measured = [Curve("simulator", 1e2 * shifts, 1e3 * trims, dots=True)]
    trim.reference = [Curve("atan(x / GM_L)", 1e2 * shifts, 1e3 * wanted_trim)]
    legal = 0.01 * np.max(np.abs(wanted_trim))
    trim.bands = [(1e2 * shifts, 1e3 * (wanted_trim - legal), 1e3 * (wanted_trim + legal))]
    figures = [
        Figure("draft at 0.6 of the mass", drafts[0], wanted[0], 0.01 * wanted[0], "m"),
        Figure("draft at 1.2 of the mass", drafts[-1], wanted[-1], 0.01 * wanted[-1], "m"),
        Figure("trim at 2 cm", trims[-1], wanted_trim[-1], legal, "rad"),
    ]
    return Check("A box of 10 m x 1.5 m x 0.5 m at rest in still water", [draft, trim], figures)


def _rest(mass: float, x_cg: float) -> tuple[float, float]:
    """Draft [m] and pitch [rad] at which the box comes to rest, heavily damped."""
    vessel = _BARGE.vessel()
    vessel |= {"mass": mass, "center_of_gravity": [x_cg, 0.0, 0.0]}
    M = np.diag(np.add(*mass_matrices(vessel)))
    vessel["linear_damping"] = [float(value) for value in 4.0 * M]
    trial = Trial(vessel)
    trial.world.step(1500)
    _, _, _, z, _, pitch, *_ = trial.state()
    return _BARGE.draft - z, pitch


def decay_check() -> Check:
    """Free decay in heave, roll and pitch against the damped oscillator."""
    weight = _BARGE.mass * GRAVITY
    stiffness = {
        2: _BARGE.density * GRAVITY * _BARGE.length * _BARGE.breadth,
        3: weight * (-_BARGE.draft / 2 + _BARGE.breadth**2 / (12 * _BARGE.draft)),
        4: weight * (-_BARGE.draft / 2 + _BARGE.length**2 / (12 * _BARGE.draft)),
    }
    starts = {2: 0.02, 3: 0.03, 4: 0.004}
    labels = {2: ("heave", "m"), 3: ("roll", "rad"), 4: ("pitch", "rad")}
    panels, figures = [], []
    for axis, (name, unit) in labels.items():
        omega, motion = _let_go(axis, stiffness[axis], starts[axis])
        value = motion.position[:, 2] if axis == 2 else motion.rpy[:, axis - 3]
        damped = omega * np.sqrt(1 - _RATIO**2)
        swing = np.cos(damped * motion.t) + _RATIO / np.sqrt(1 - _RATIO**2) * np.sin(
            damped * motion.t
        )
        wanted = starts[axis] * np.exp(-_RATIO * omega * motion.t) * swing
        legal = 0.03 * starts[axis]
        panels.append(Panel(name, "t [s]", f"{name} [{unit}]"))
        panels[-1].measured = [Curve("simulator", motion.t, value)]
        panels[-1].reference = [Curve("damped oscillator", motion.t, wanted)]
        panels[-1].bands = [(motion.t, wanted - legal, wanted + legal)]
        period, ratio = period_and_damping(motion.t, value)
        T = 2 * np.pi / damped
        figures.append(Figure(f"period of {name}", period, T, 0.01 * T, "s"))
        figures.append(Figure(f"damping ratio of {name}", ratio, _RATIO, 0.03 * _RATIO))
    return Check("The box let go: periods within 1 %, damping ratios within 3 %", panels, figures)


_RATIO = 0.1


def _let_go(axis: int, stiffness: float, start: float) -> tuple[float, Motion]:
    """Undamped angular frequency [rad/s] and motion of the box with one axis displaced."""
    vessel = _BARGE.vessel()
    M = float(np.diag(np.add(*mass_matrices(vessel)))[axis])
    omega = float(np.sqrt(stiffness / M))
    vessel["linear_damping"][axis] = 2.0 * _RATIO * omega * M
    pose = [0.0] * 6
    pose[axis] = start
    trial = Trial(vessel, step_s=1e-3, pose=(pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]))
    return omega, trial.run(3.2 * 2 * np.pi / omega, every=5)


def period_and_damping(t: Array, value: Array) -> tuple[float, float]:
    """Period [s] and damping ratio of a swing about 0, from zero crossings and peaks between."""
    at = np.flatnonzero(value[:-1] * value[1:] < 0)
    crossings = t[at] - value[at] * (t[at + 1] - t[at]) / (value[at + 1] - value[at])
    peaks = [np.max(np.abs(part)) for part in np.split(value, at + 1)[1:-1]]
    decrement = np.log(peaks[0] / peaks[-1]) / (len(peaks) - 1)
    period = 2.0 * float(crossings[-1] - crossings[0]) / (len(crossings) - 1)
    return period, float(decrement / np.hypot(np.pi, decrement))


def jensen(ratio: float) -> tuple[float, float, float, float]:
    """Response of the box in head seas, and the damping that it supposes.

    Source: Jensen, Mansour, Olsen, Estimation of ship motions using closed-form expressions,
    Ocean Engineering 31 (2004) 61-85; without speed ahead.

    Args:
        ratio: wavelength over length.

    Returns:
        Heave [m/m] and pitch [rad/m] per wave amplitude, damping in heave [N s/m] and
        pitch [N m s].
    """
    b, k = _BARGE, 2 * np.pi / (ratio * _BARGE.length)
    smith = np.exp(-k * b.draft)
    A = 2.0 * np.sin(0.5 * k * b.breadth) * smith
    loss = A * A / (k * b.breadth)
    f = smith * np.hypot(1.0 - k * b.draft, loss)
    eta = 1.0 / np.hypot(1.0 - 2.0 * k * b.draft, loss)
    half = 0.5 * k * b.length
    heave = eta * f * abs(np.sin(half)) / half
    pitch = eta * f * 6.0 / (half**2 * b.length) * abs(np.sin(half) - half * np.cos(half))
    damping = b.density * GRAVITY * b.length * A * A / (k * np.sqrt(GRAVITY * k))
    return float(heave), float(pitch), float(damping), float(damping * b.length**2 / 12.0)


def rao_check() -> Check:
    """Heave and pitch of the box in regular head waves against Jensen's closed forms."""
    ratios = np.array([2.0, 3.0, 5.0, 10.0])
    measured = np.array([_ride(ratio) for ratio in ratios])
    wanted = np.array([jensen(ratio)[:2] for ratio in ratios])
    fine = np.linspace(1.5, 12.0, 400)
    curves = np.array([jensen(ratio)[:2] for ratio in fine])
    panels, figures = [], []
    for column, (name, unit) in enumerate((("heave", "m/m"), ("pitch", "rad/m"))):
        panel = Panel(name, "wavelength / length", f"{name} per wave amplitude [{unit}]")
        panel.measured = [Curve("simulator", ratios, measured[:, column], dots=True)]
        panel.reference = [Curve("Jensen et al. 2004", fine, curves[:, column])]
        panel.bands = [(fine, 0.95 * curves[:, column], 1.05 * curves[:, column])]
        panels.append(panel)
        for i, ratio in enumerate(ratios):
            what = f"{name} at {ratio:g} lengths"
            value, reference = measured[i, column], wanted[i, column]
            figures.append(Figure(what, value, reference, 0.05 * reference, unit))
    return Check("The box in regular head waves: response within 5 %", panels, figures)


def _ride(ratio: float, per_period: int = 200, periods: int = 40) -> tuple[float, float]:
    """Amplitudes of heave [m/m] and pitch [rad/m] per wave amplitude once they are steady."""
    k = 2 * np.pi / (ratio * _BARGE.length)
    omega, amplitude = np.sqrt(GRAVITY * k), 0.01 / k
    z_cg = -0.5 * _BARGE.draft
    vessel = _BARGE.vessel(z_cg)
    _, _, heave, pitch = jensen(ratio)
    vessel["linear_damping"] = [0.05 * _BARGE.mass, 1e3, heave, 1e3, pitch, 1e3]
    period = 2 * np.pi / omega
    # Steps are whole nanoseconds, so that samples and waves part by less than 1e-5 of a period.
    sea = (
        f"<waves><spectrum>regular</spectrum><amplitude>{amplitude!r}</amplitude>"
        f"<period>{period!r}</period><direction>{np.pi!r}</direction>"
        f"<ramp_time>{4 * period!r}</ramp_time></waves>"
    )
    trial = Trial(vessel, step_s=round(period / per_period, 9), sea=sea)
    trial.world.step((periods - 10) * per_period)
    motion = trial.run(10 * period, every=4)
    phase = np.exp(-1j * omega * motion.t[:-1])
    pitches = motion.rpy[:-1, 1]
    z = motion.position[:-1, 2] + z_cg * np.cos(pitches) * np.cos(motion.rpy[:-1, 0])
    return (
        float(2 * abs(np.mean(z * phase)) / amplitude),
        float(2 * abs(np.mean(pitches * phase)) / amplitude),
    )


def spectral_density(name: str, omega: Array, height: float, period: float) -> Array:
    """Energy density of the elevation [m^2 s], scaled to m0 = height^2 / 16.

    Source: Pierson and Moskowitz 1964; Hasselmann et al. 1973 (JONSWAP, gamma 3.3).

    Args:
        name: pierson_moskowitz or jonswap.
        omega: angular frequencies [rad/s], evenly spaced, shape (n,).
        height: significant height [m].
        period: of the peak [s].
    """
    peak = 2 * np.pi / period
    density = omega**-5.0 * np.exp(-1.25 * (peak / omega) ** 4)
    if name == "jonswap":
        width = np.where(omega <= peak, 0.07, 0.09)
        density = density * 3.3 ** np.exp(-0.5 * ((omega / peak - 1) / width) ** 2)
    return density * (height**2 / 16 / (np.sum(density) * (omega[1] - omega[0])))


def spectrum_check() -> Check:
    """Significant height and spectrum of an hour of an irregular sea."""
    from scipy.signal import welch

    height, period, rate = 0.8, 5.0, 2.0
    t = np.arange(0.0, _HOUR_S, 1.0 / rate)
    omega = np.linspace(0.3, 6.0, 2000)
    panels, figures = [], []
    for name in ("pierson_moskowitz", "jonswap"):
        eta = _elevation(name, height, period, t)
        frequency, density = welch(eta, rate, nperseg=512)
        wanted = spectral_density(name, omega, height, period)
        panel = Panel(name, "ω [rad/s]", "S [m² s]")
        shown = frequency * 2 * np.pi < 4.0
        panel.measured = [
            Curve("simulator, 1 h", frequency[shown] * 2 * np.pi, density[shown] / (2 * np.pi))
        ]
        panel.reference = [Curve("commanded", omega[omega < 4], wanted[omega < 4])]
        panels.append(panel)
        of_all = 4.0 * float(np.std(eta))
        figures.append(Figure(f"{name}: significant height", of_all, height, 0.03 * height, "m"))
        for low, high in ((0.8, 1.1), (1.1, 1.5), (1.5, 2.2)):
            figures.append(_band_figure(name, (low, high), eta, rate, (omega, wanted, period)))
    return Check(
        "An hour of linear waves, 200 components: significant height within 3 %", panels, figures
    )


def _band_figure(
    name: str,
    band: tuple[float, float],
    eta: Array,
    rate: float,
    wanted: tuple[Array, Array, float],
) -> Figure:
    """Share of the energy between two multiples of the peak's frequency."""
    omega, density, period = wanted
    peak = 2 * np.pi / period
    power = np.abs(np.fft.rfft(eta - np.mean(eta))) ** 2
    frequency = np.fft.rfftfreq(len(eta), 1.0 / rate) * 2 * np.pi
    inside = (frequency >= band[0] * peak) & (frequency < band[1] * peak)
    legal = (omega >= band[0] * peak) & (omega < band[1] * peak)
    share = float(np.sum(power[inside]) / np.sum(power))
    expected = float(np.sum(density[legal]) / np.sum(density))
    what = f"{name}: energy between {band[0]:g} and {band[1]:g} of the peak"
    return Figure(what, share, expected, 0.02)


def _elevation(name: str, height: float, period: float, t: Array) -> Array:
    """Of the surface at one place over time [m]."""
    sea = (
        f"<waves><spectrum>{name}</spectrum><significant_height>{height!r}</significant_height>"
        f"<peak_period>{period!r}</peak_period><components>200</components></waves>"
    )
    trial = Trial(_BARGE.vessel(), sea=sea)
    return trial.world.sea_elevation(np.tile([12.0, -3.0], (len(t), 1)), t)
