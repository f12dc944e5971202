# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line of the benchmark."""

from __future__ import annotations

import argparse
import json
import os
import shlex
import signal
import sys
import time
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

from trident_eval.bench import amcl, coast, in_process, launches, lockstep, sensors
from trident_eval.bench.machine import describe_commit, describe_machine
from trident_eval.bench.rows import (
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
from trident_eval.bench.vehicle import Setup, prepare
from trident_eval.core.errors import EvalError
from trident_eval.core.reader import until_unread
from trident_eval.options import BENCHMARKS

MEASURED, FAILED, UNUSABLE = 0, 1, 2
_TOGETHER = coast.CASES[0]


def make_parser() -> argparse.ArgumentParser:
    """The command line."""
    parser = argparse.ArgumentParser(prog="trident bench", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    run = {"sim": _sim, "sensors": _sensors, "amcl": _amcl, "table": _table}
    for command in BENCHMARKS:
        if command.name in run:
            sub = commands.add_parser(command.name, help=command.help)
            command.add_options(sub)
            sub.set_defaults(run=run[command.name])
    return parser


def say(text: str) -> None:
    """One line on stderr: stdout is the result's."""
    print(text, file=sys.stderr, flush=True)


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


def _sim(options: argparse.Namespace) -> int:
    if options.world == "coast":
        return _coast(options)
    plans = plan_rows(options.quick, options.mode, options.runs)
    _check_folder(options.out)
    setup = prepare(options.controller)
    document = _document() | {
        "controller": str(options.controller or "rotors_control/lee_position_controller_node"),
        "rows": [],
    }
    for number, plan in enumerate(plans, 1):
        row = measure_row(plan, setup, options.profile, f"[{number}/{len(plans)}]")
        document["rows"].append(row)
        _write(options.out, document)  # what has been measured is kept, whatever comes
    document["same_flight"] = {str(n): same for n, same in same_flight(document["rows"]).items()}
    _write(options.out, document)
    if options.out:
        say(f"written: {options.out}")
    if options.markdown or not options.out:
        _print_tables(document, options.profile)
    return FAILED if any("error" in row for row in document["rows"]) else MEASURED


def _coast(options: argparse.Namespace) -> int:
    _check_folder(options.out)
    document = _document() | {"rows": []}
    _measure_cases(coast, coast.chosen(options.mode), options, document)
    if options.out:
        say(f"written: {options.out}")
    if options.markdown or not options.out:
        print(coast.markdown_table(document["rows"]))
        print(f"\n{caption(document)}")
    return MEASURED if all(coast.is_sound(row) for row in document["rows"]) else FAILED


def _sensors(options: argparse.Namespace) -> int:
    cases = [case for case in sensors.CASES if not options.mode or case.name in options.mode]
    known = [*(case.name for case in sensors.CASES), _TOGETHER.name]
    if unknown := sorted(set(options.mode) - set(known)):
        raise EvalError(f"mode {unknown[0]!r} is unknown; legal: {', '.join(known)}")
    _check_folder(options.out)
    document = _document() | {"gazebo": sensors.GAZEBO, "rows": []}
    _measure_cases(sensors, cases, options, document)
    together = _measure_together(options, document)
    if options.out:
        say(f"written: {options.out}")
    else:
        print(sensors.markdown_table(document["rows"]))
        if together:
            print(f"\n{coast.markdown_table([together])}")
        print(f"\n{caption(document)}")
    is_sound = not together or coast.is_sound(together)
    failed = any("error" in row for row in document["rows"])
    return FAILED if failed or not is_sound else MEASURED


def _amcl(options: argparse.Namespace) -> int:
    _check_folder(options.out)
    document = _document() | {"updates": amcl.measure_updates(options.quick)}
    kidnaps = amcl.summarize(amcl.measure_kidnaps(options.quick, say))
    _write(options.out, document | {"kidnaps": kidnaps})
    print(amcl.markdown_table(document["updates"], kidnaps))
    print(f"\n{caption(document)}")
    return MEASURED


def _measure_cases(
    bench: ModuleType, cases: Sequence[Any], options: argparse.Namespace, document: dict[str, Any]
) -> None:
    """A row per case of ``coast`` or ``sensors``; what has been measured is kept in any case."""
    for number, case in enumerate(cases, 1):
        row = _measure_case(bench, case, options)
        document["rows"].append(row)
        say(f"[{number}/{len(cases)}] {bench.line(row)}")
        _write(options.out, document | bench.headline(document["rows"]))


def _measure_case(bench: ModuleType, case: Any, options: argparse.Namespace) -> dict[str, Any]:
    """The row of a case; one that says why there is none if it cannot be measured."""
    runs = options.runs or (1 if options.quick else 3)
    row: dict[str, Any]
    try:
        row = bench.measure(case, runs, options.quick)
    except EvalError as error:
        say(str(error))
        row = bench.failed(case, str(error).splitlines()[0])
    return row


def _measure_together(options: argparse.Namespace, document: dict[str, Any]) -> dict[str, Any]:
    """The three domains with all their sensors, as `cross_domain`; empty if not asked for."""
    if options.mode and _TOGETHER.name not in options.mode:
        return {}
    row = _measure_case(coast, _TOGETHER, options)
    say(coast.line(row))
    document["cross_domain"] = row
    document |= coast.headline([row])
    _write(options.out, document | sensors.headline(document["rows"]))
    return row


def _check_folder(out: Path | None) -> None:
    if out and not out.parent.is_dir():
        raise EvalError(f"--out {out}: its folder does not exist")


def _document() -> dict[str, Any]:
    """What was measured, when and on what."""
    return {
        "command": shlex.join(["./trident", "bench", *sys.argv[1:]]),
        "started": datetime.now().astimezone().isoformat(timespec="seconds"),
        "commit": describe_commit(Path(__file__).resolve().parent),
        "machine": describe_machine(),
    }


def _write(path: Path | None, document: dict[str, Any]) -> None:
    if path is None:
        return
    text = json.dumps(document, indent=2, allow_nan=False) + "\n"
    temporary = path.with_name(f".{path.name}.part")
    temporary.write_text(text, encoding="utf-8")
    temporary.replace(path)


def _print_tables(document: dict[str, Any], profile: bool) -> None:
    print(markdown_table(document["rows"]))
    print(f"\n{caption(document)}")
    for n, same in document.get("same_flight", {}).items():
        ends = "the same state" if same else "DIFFERENT states"
        print(f"\nN = {n}: in-process and lockstep flights end in {ends}, to the bit.")
    if profile:
        print(profile_table(document["rows"]))


def _table(options: argparse.Namespace) -> int:
    try:
        document = json.loads(options.source.read_text(encoding="utf-8"))
        _print_tables(document, profile=True)
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = f"no {error}" if isinstance(error, KeyError) else str(error)
        raise EvalError(
            f"{options.source}: {reason}; legal: a file that --out has written"
        ) from error
    return MEASURED


def _end_on_signal(number: int, frame: FrameType | None) -> None:
    del frame
    raise SystemExit(128 + number)  # so that every `with` ends its processes


def main(arguments: list[str] | None = None) -> int:
    """Runs a subcommand.

    Returns:
        0: measured; 1: a row failed; 2: nothing could be measured; 130: interrupted.
    """
    options = make_parser().parse_args(arguments)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _end_on_signal)
    try:
        return int(options.run(options))
    except EvalError as error:
        say(f"trident_eval.bench: {error}")
        return UNUSABLE
    except KeyboardInterrupt:
        say("trident_eval.bench: interrupted")
        return 130


if __name__ == "__main__":
    sys.exit(until_unread(main))
