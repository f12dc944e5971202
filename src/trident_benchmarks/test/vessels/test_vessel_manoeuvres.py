# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The Otter on a turning circle and a zig-zag, against scipy's integration of the published model.

Here on the reference's own springs, which leaves nothing but the equation of motion; on its hull,
in a world, it is among the checks of trident_benchmarks.vessels (test_vessel_checks.py).
"""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from trident.testing.programs import package, program
from trident_benchmarks.vessels.otter_reference import (
    DENSITY,
    Otter,
    Track,
    overshoots,
    radius,
    reference,
)


def simulated(
    tmp_path: Path,
    munk: bool,
    left: float,
    right: float,
    duration_s: float,
    zigzag: bool,
) -> Track:
    """The same manoeuvre by the simulator's core, on the reference's springs."""
    vessel = package("trident_sim").parents[1] / "config" / "vessels" / "otter.yaml"
    turn = np.diag([1.0, -1.0, -1.0, 1.0, -1.0, -1.0])
    springs = tmp_path / "springs.txt"
    np.savetxt(springs, turn @ Otter(munk).G @ turn)
    command = [
        program("trident_sim", "vessel_manoeuvre"),
        str(vessel),
        "zigzag" if zigzag else "circle",
        str(left),
        str(right),
        str(duration_s),
        f"munk={int(munk)}",
        f"springs={springs}",
    ]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    rows = np.array(
        [[float(value) for value in line.split(",")] for line in run.stdout.splitlines()]
    )
    return Track(rows[:, 0], rows[:, 1], rows[:, 2], np.unwrap(rows[:, 6]))


@pytest.mark.parametrize("munk", [False, True])
def test_turning_circle_is_the_reference_one(tmp_path: Path, munk: bool) -> None:
    """Radius within 2 %, rate of turn, too."""
    commands = (60.0, 90.0)
    expected = reference(munk, *commands, 80.0, zigzag=False)
    track = simulated(tmp_path, munk, *commands, 80.0, zigzag=False)
    assert radius(track) == pytest.approx(radius(expected), rel=0.02)
    assert track.heading[-1] == pytest.approx(expected.heading[-1], rel=0.02)
    assert expected.heading[-1] > 2 * np.pi


@pytest.mark.parametrize("munk", [False, True])
def test_zigzag_overshoots_as_the_reference(tmp_path: Path, munk: bool) -> None:
    """20/20 zig-zag: each overshoot within 1 degree."""
    commands = (70.0, 95.0)
    expected = overshoots(reference(munk, *commands, 40.0, zigzag=True))
    track = overshoots(simulated(tmp_path, munk, *commands, 40.0, zigzag=True))
    count = min(len(expected), len(track))
    assert count >= 3
    assert np.max(np.abs(expected[:count] - track[:count])) < 1.0
    assert np.max(expected) > 1.0


def test_cross_flow_of_the_reference_is_the_integral() -> None:
    """Gauss' rule of the reference against adaptive quadrature."""
    otter = Otter(munk=False)
    scale = 0.5 * DENSITY * otter.draft * otter.cross_flow
    for v, r in ((0.4, 0.01), (0.2, 0.5), (-0.1, 0.9)):

        def strip(x: float, v: float = v, r: float = r) -> float:
            return abs(v + x * r) * (v + x * r)

        force = quad(strip, -1, 1, points=[float(np.clip(-v / r, -1, 1))])[0]
        assert otter._across(v, r, 0) == pytest.approx(scale * force, rel=1e-6)
