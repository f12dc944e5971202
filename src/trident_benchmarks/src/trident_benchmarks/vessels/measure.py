# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The checks of vessels and sea: measure, compare, draw."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from trident_benchmarks.vessels import control_checks, hull_checks, legacy_check, motion_checks
from trident_benchmarks.vessels.check import Check
from trident_benchmarks.vessels.pictures import draw

CHECKS: dict[str, Callable[[], Check]] = {
    "static": hull_checks.static_check,
    "decay": hull_checks.decay_check,
    "rao": hull_checks.rao_check,
    "spectrum": hull_checks.spectrum_check,
    "speed": motion_checks.speed_check,
    "circle": motion_checks.circle_check,
    "zigzag": motion_checks.zigzag_check,
    "current": motion_checks.current_check,
    "guidance": control_checks.guidance_check,
    "course": control_checks.course_check,
    "station": control_checks.station_check,
    "energy": motion_checks.energy_check,
    "legacy_vrx": legacy_check.legacy_check,
    "random": motion_checks.random_check,
}


def measure(options: argparse.Namespace) -> int:
    """Run checks and draw them.

    Returns:
        0: all are within their tolerances; 1: not.
    """
    passed = True
    for name in _names(options):
        check = CHECKS[name]()
        passed = passed and check.passed
        _show(name, check, options.out)
    return 0 if passed else 1


def _names(options: argparse.Namespace) -> list[str]:
    """Of the checks that are run."""
    names = list(options.only or CHECKS)
    return [name for name in names if name != "random"] if options.quick else names


def _show(name: str, check: Check, folder: Path | None) -> None:
    print(f"{name}: {check.title}")
    for figure in check.figures:
        print(f"  {figure.text()}")
    sys.stdout.flush()
    if folder:
        folder.mkdir(parents=True, exist_ok=True)
        draw(check, folder / f"{name}.png")
