# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A campaign of disturbed runs that can be stopped at any time, and continues where it was."""

from __future__ import annotations

import argparse
import json
import shutil
import signal
import sys
import tempfile
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from trident.testing.schedule.runs import Result, run
from trident.testing.schedule.scenarios import SCENARIOS, SMALL, Scenario
from trident.testing.schedule.stopping import StopPlan


def main(arguments: list[str] | None = None) -> int:
    """Run what is left to do.

    Returns:
        0: all hashes of a scenario are equal, and every run has passed.
    """
    options = _parser().parse_args(arguments)
    scenarios = SMALL if options.small else SCENARIOS
    names = options.scenarios or list(scenarios)
    unknown = [name for name in names if name not in scenarios]
    if unknown:
        print(f"schedule: {unknown[0]}; legal: {', '.join(scenarios)}", file=sys.stderr)
        return 2
    done = _read(options.out)
    try:
        _run_the_rest(names, scenarios, done, options)
    except KeyboardInterrupt:
        print("schedule: stopped; the same call continues", file=sys.stderr)
    return _summary(done)


def _run_the_rest(
    names: list[str],
    scenarios: Mapping[str, Scenario],
    done: list[dict[str, Any]],
    options: argparse.Namespace,
) -> None:
    """Make the runs that are not among those that are done, to which they are added."""
    for name, seed in _plan(names, options.runs, options.first_seed):
        if not _is_done(name, seed, done):
            done.append(_run(name, scenarios[name], seed, _hashes(name, done), options))


def _is_done(name: str, seed: int, done: list[dict[str, Any]]) -> bool:
    return any((one["scenario"], one["seed"]) == (name, seed) for one in done)


def _hashes(name: str, done: list[dict[str, Any]]) -> set[str]:
    """The states in which the runs of a scenario have ended so far."""
    return {one["state_hash"] for one in done if one["scenario"] == name}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="schedule", description=__doc__)
    parser.add_argument("--runs", type=int, default=300, help="disturbed ones in all")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--small", action="store_true", help="few rows, short stops")
    parser.add_argument("--out", type=Path, default=Path("schedule.jsonl"), help="of the results")
    parser.add_argument("--keep", type=Path, help="folder in which runs that are not good stay")
    parser.add_argument("scenarios", nargs="*", metavar="SCENARIO", help=", ".join(SCENARIOS))
    return parser


def _plan(names: list[str], runs: int, first: int) -> list[tuple[str, int]]:
    """Each scenario once undisturbed, then one after the other."""
    disturbed = [(names[index % len(names)], first + index) for index in range(runs)]
    return [(name, 0) for name in names] + disturbed


def _run(
    name: str, scenario: Scenario, seed: int, wanted: set[str], options: argparse.Namespace
) -> dict[str, Any]:
    parent = Path(tempfile.mkdtemp(prefix="trident_schedule_"))
    folder = parent / "run"
    try:
        plan = StopPlan(long_s=(2.5,), long_most=1) if options.small else StopPlan()
        result = run(name, scenario, seed, folder, plan)
        _append(options.out, result.line())
        _print_result(result)
        is_other = bool(wanted) and result.state_hash not in wanted
        if options.keep and (is_other or not (result.passed and result.repeatable)):
            shutil.copytree(folder, options.keep / f"{name}-{seed}", dirs_exist_ok=True)
    finally:
        shutil.rmtree(parent, ignore_errors=True)
    found: dict[str, Any] = json.loads(result.line())
    return found


def _print_result(result: Result) -> None:
    says = "PASS" if result.passed else "FAIL"
    long = [f"{name} {seconds:g} s" for name, seconds in result.stops if seconds >= 1.0]
    print(
        f"{result.scenario} {result.seed}: {result.state_hash[:8] or 'no hash'} {says} "
        f"{result.sim_s:.1f} s in {result.wall_s:.0f} s, {len(result.stops)} stops"
        + (f", of them {', '.join(long)}" if long else ""),
        flush=True,
    )
    for reason in result.reasons:
        print(f"  - {reason}", flush=True)


def _read(path: Path) -> list[dict[str, Any]]:
    if not path.is_file():
        return []
    lines = path.read_text(encoding="utf-8").splitlines()
    return [json.loads(line) for line in lines if line.endswith("}")]  # the last may be torn


def _append(path: Path, line: str) -> None:
    is_torn = path.is_file() and not path.read_bytes().endswith((b"\n",)) and path.stat().st_size
    with path.open("a", encoding="utf-8") as file:
        file.write(("\n" if is_torn else "") + line + "\n")


def _summary(done: list[dict[str, Any]]) -> int:
    is_good = True
    for name in dict.fromkeys(one["scenario"] for one in done):
        runs = [one for one in done if one["scenario"] == name]
        is_good = _report(name, runs) and is_good
    return 0 if is_good else 1


def _report(name: str, runs: list[dict[str, Any]]) -> bool:
    """Print what came of a scenario; whether all runs have passed and ended in one state."""
    hashes = Counter(one["state_hash"] for one in runs)
    bad = [one["seed"] for one in runs if not (one["passed"] and one["repeatable"])]
    print(f"{name}: {len(runs)} runs, hashes {_counted(hashes)}; not good: {bad or 'none'}")
    return not bad and list(hashes) != [""] and len(hashes) == 1


def _counted(hashes: Counter[str]) -> str:
    return ", ".join(f"{key[:8] or 'none'} x {count}" for key, count in hashes.most_common())


if __name__ == "__main__":
    # As Ctrl-C does, so that the present run is ended with all that it has started.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main())
