# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The checks of docs/explanation/vessel_checks.md hold, on boats in a world, and are drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.__main__ import main
from trident_benchmarks.vessels.benchmark import VESSEL_CHECKS
from trident_benchmarks.vessels.check import Check, Curve, Figure, Panel
from trident_benchmarks.vessels.hull_checks import period_and_damping
from trident_benchmarks.vessels.measure import CHECKS
from trident_benchmarks.vessels.motion_checks import random_check

PNG = b"\x89PNG"


def test_every_check_can_be_asked_for_by_its_name() -> None:
    assert tuple(CHECKS) == VESSEL_CHECKS


@pytest.mark.parametrize("name", [name for name in CHECKS if name != "random"])
def test_check_holds(name: str) -> None:
    check = CHECKS[name]()
    assert check.figures
    for panel in check.panels:
        assert panel.measured
        for curve in [*panel.measured, *panel.reference]:
            assert np.all(np.isfinite([curve.x, curve.y])), curve.label
    assert not [figure.text() for figure in check.figures if not figure.passed]


def test_random_commands_stay_bounded() -> None:
    """The million steps are those of trident_sim_marine_test and of the command itself."""
    assert random_check(steps=20_000).passed


def test_figure_beyond_its_tolerance_fails_and_says_so() -> None:
    figure = Figure("period", 2.1, 2.0, 0.05, "s")
    assert not figure.passed
    assert figure.text().startswith("FAIL  period: 2.1 s, reference 2 s")
    assert Figure("period", 2.04, 2.0, 0.05).passed
    assert not Figure("not a number", float("nan"), 2.0, 0.05).passed


def test_period_and_damping_are_those_of_a_known_swing() -> None:
    t = np.arange(0.0, 12.0, 0.002)
    swing = np.exp(-0.05 * 3.0 * t) * np.cos(3.0 * np.sqrt(1 - 0.05**2) * t + 0.4)
    period, ratio = period_and_damping(t, swing)
    assert period == pytest.approx(2 * np.pi / (3.0 * np.sqrt(1 - 0.05**2)), rel=1e-4)
    assert ratio == pytest.approx(0.05, rel=1e-3)


def test_command_draws_a_picture_and_fails_with_a_check(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    x = np.linspace(0.0, 1.0, 5)
    panel = Panel("title", "x", "y", [Curve("simulator", x, x)], [Curve("reference", x, x)])
    panel.bands = [(x, x - 0.1, x + 0.1)]
    for passed in (True, False):
        figure = Figure("figure", 1.0, 1.0 if passed else 2.0, 0.5)
        monkeypatch.setitem(CHECKS, "static", lambda figure=figure: Check("t", [panel], [figure]))
        code = main(["vessels", "--only", "static", "--out", str(tmp_path / "pictures")])
        assert code == (0 if passed else 1)
        assert ("FAIL" in capsys.readouterr().out) is not passed
    assert (tmp_path / "pictures" / "static.png").read_bytes().startswith(PNG)
