# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the sensors' benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.results import (
    FAILED,
    check_folder,
    errors_code,
    measure_case,
    measure_cases,
    new_document,
    say,
    write_document,
)
from trident_benchmarks.sensors import ray_sensors
from trident_benchmarks.sim import coast
from trident_benchmarks.sim.rows import caption

_TOGETHER = coast.CASES[0]


def measure(options: argparse.Namespace) -> int:
    """All rows that were asked for; the exit code."""
    cases = _cases(options.mode)
    check_folder(options.out)
    document = new_document() | {"gazebo": ray_sensors.GAZEBO, "rows": []}
    measure_cases(ray_sensors, cases, options, document)
    together = _measure_together(options, document)
    if options.out:
        say(f"written: {options.out}")
    else:
        _print(document, together)
    if together and not coast.is_sound(together):
        return FAILED
    return errors_code(document)


def _print(document: dict[str, Any], together: dict[str, Any] | None) -> None:
    print(ray_sensors.markdown_table(document["rows"]))
    if together:
        print(f"\n{coast.markdown_table([together])}")
    print(f"\n{caption(document)}")


def _cases(modes: Sequence[str]) -> list[ray_sensors.Case]:
    """Those of the given modes; of none: all."""
    known = [*(case.name for case in ray_sensors.CASES), _TOGETHER.name]
    if unknown := sorted(set(modes) - set(known)):
        raise EvalError(f"mode {unknown[0]!r} is unknown; legal: {', '.join(known)}")
    return [case for case in ray_sensors.CASES if not modes or case.name in modes]


def _measure_together(options: argparse.Namespace, document: dict[str, Any]) -> dict[str, Any]:
    """The three domains with all their sensors, as `cross_domain`; empty if not asked for."""
    if options.mode and _TOGETHER.name not in options.mode:
        return {}
    row = measure_case(coast, _TOGETHER, options)
    say(coast.line(row))
    document["cross_domain"] = row
    document |= coast.headline([row])
    write_document(options.out, document | ray_sensors.headline(document["rows"]))
    return row
