# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line of the checks: measure, compare, draw."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable

from trident_eval.core.reader import until_unread
from trident_eval.options import add_vessels
from trident_eval.vessels import control_checks, hull_checks, legacy_check, motion_checks
from trident_eval.vessels.check import Check
from trident_eval.vessels.pictures import draw

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


def main(arguments: list[str] | None = None) -> int:
    """Run checks and draw them.

    Returns:
        0: all are within their tolerances; 1: not.
    """
    parser = argparse.ArgumentParser(prog="trident bench vessels", description=__doc__)
    add_vessels(parser)
    options = parser.parse_args(arguments)
    passed = True
    for name in options.only or CHECKS:
        if options.quick and name == "random":
            continue
        check = CHECKS[name]()
        passed = passed and check.passed
        print(f"{name}: {check.title}")
        for figure in check.figures:
            print(f"  {figure.text()}")
        sys.stdout.flush()
        if options.out:
            options.out.mkdir(parents=True, exist_ok=True)
            draw(check, options.out / f"{name}.png")
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(until_unread(main))
