# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the simulator's benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from typing import Any

from trident_eval.core.errors import EvalError

from trident_benchmarks.results import (
    FAILED,
    MEASURED,
    check_folder,
    errors_code,
    measure_cases,
    new_document,
    say,
    write_document,
)
from trident_benchmarks.sim import coast, in_process, launches, lockstep
from trident_benchmarks.sim.rows import (
    Plan,
    caption,
    check_hover,
    failed_row,
    markdown_table,
    number_text,
    plan_rows,
    profile_table,
    same_flight,
    summarize,
)
from trident_benchmarks.sim.vehicle import Setup, prepare


def measure_once(plan: Plan, setup: Setup, profile: bool) -> dict[str, Any]:
    """One run of a row.

    Raises:
        EvalError: it could not be measured.
    """
    modes: dict[str, Callable[[], dict[str, Any]]] = {
        "in_process": lambda: in_process.measure(plan, setup, profile),
        "lockstep_nodelet": lambda: lockstep.measure(plan, setup),
        "lockstep_external": lambda: lockstep.measure(plan, setup),
        "startup": lambda: launches.measure_startup(plan),
        "main_job": lambda: launches.measure_main_job(plan),
        "tutorial_full": lambda: launches.measure_tutorial(plan),
    }
    return modes[plan.mode]()


def measure_row(plan: Plan, setup: Setup, profile: bool, where: str) -> dict[str, Any]:
    """One row: all its runs, with a line about each; a run that fails makes a row that says so."""
    results: list[dict[str, Any]] = []
    load = os.getloadavg()[0]
    for number in range(1, plan.runs + 1):
        begin = time.monotonic()
        try:
            result = measure_once(plan, setup, profile)
            check_hover(result)
        except EvalError as error:
            say(f"{where} {plan.mode} n={plan.n}: {error}")
            return failed_row(plan, str(error).splitlines()[0])
        results.append(result)
        rtf = f"rtf {number_text(result['rtf'])}, " if result.get("rtf") else ""
        say(
            f"{where} {plan.mode} n={plan.n} run {number}/{plan.runs}: {rtf}"
            f"{time.monotonic() - begin:.0f} s"
        )
    return summarize(plan, results) | {"load_average": load}


def measure(options: argparse.Namespace) -> int:
    """All rows that were asked for; the exit code."""
    if options.world == "coast":
        return _coast(options)
    plans = plan_rows(options.quick, options.mode, options.runs)
    check_folder(options.out)
    setup = prepare(options.controller)
    document = new_document() | {
        "controller": str(options.controller or "rotors_control/lee_position_controller_node"),
        "rows": [],
    }
    for number, plan in enumerate(plans, 1):
        row = measure_row(plan, setup, options.profile, f"[{number}/{len(plans)}]")
        document["rows"].append(row)
        write_document(options.out, document)  # what has been measured is kept, whatever comes
    document["same_flight"] = {str(n): same for n, same in same_flight(document["rows"]).items()}
    write_document(options.out, document)
    _show(document, options)
    return errors_code(document)


def _show(document: dict[str, Any], options: argparse.Namespace) -> None:
    if options.out:
        say(f"written: {options.out}")
    if options.markdown or not options.out:
        print_tables(document, options.profile)


def _coast(options: argparse.Namespace) -> int:
    check_folder(options.out)
    document = new_document() | {"rows": []}
    measure_cases(coast, coast.chosen(options.mode), options, document)
    if options.out:
        say(f"written: {options.out}")
    if options.markdown or not options.out:
        print(coast.markdown_table(document["rows"]))
        print(f"\n{caption(document)}")
    return MEASURED if all(coast.is_sound(row) for row in document["rows"]) else FAILED


def print_tables(document: dict[str, Any], profile: bool) -> None:
    """The tables of a document on stdout."""
    print(markdown_table(document["rows"]))
    print(f"\n{caption(document)}")
    for n, same in document.get("same_flight", {}).items():
        ends = "the same state" if same else "DIFFERENT states"
        print(f"\nN = {n}: in-process and lockstep flights end in {ends}, to the bit.")
    if profile:
        print(profile_table(document["rows"]))
