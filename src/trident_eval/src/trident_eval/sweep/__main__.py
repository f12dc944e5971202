# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: a sweep, or a cluster for sweeps."""

from __future__ import annotations

import argparse
import contextlib
import dataclasses
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path

from trident_fleet.core.errors import FormationError

from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of
from trident_eval.core.sweep.jobs import Job, jobs_of
from trident_eval.core.sweep.rows import all_rows, read_row, row_path
from trident_eval.core.sweep.scenario import Scenario, read_scenario
from trident_eval.options import add_sweep
from trident_eval.sweep.code_version import code_version
from trident_eval.sweep.dask_engine import DaskEngine, end_in_time, start_cluster
from trident_eval.sweep.engine import Engine
from trident_eval.sweep.folder import note_of_change, opened, write_facts
from trident_eval.sweep.local_engine import LocalEngine
from trident_eval.sweep.sweeping import Sweep

DONE, SOME_FAILED, UNUSABLE, INTERRUPTED = 0, 1, 2, 130
_PORT = 8786


def main(arguments: list[str] | None = None) -> int:
    """Runs a sweep.

    Returns:
        0: all runs are there; 1: some have failed; 2: it cannot be done; 130: interrupted.
    """
    parser = argparse.ArgumentParser(prog="trident sweep", description=__doc__)
    add_sweep(parser)
    options = parser.parse_args(arguments)
    try:
        if options.serve:
            return _serve(options)
        if options.scenario is None:
            parser.error("SCENARIO.yaml is missing")
        return _sweep(options)
    except (EvalError, FormationError) as error:
        print(f"trident sweep: {error}", file=sys.stderr)
        return UNUSABLE


def _workers(options: argparse.Namespace) -> int:
    return options.workers or len(os.sched_getaffinity(0))


def _serve(options: argparse.Namespace) -> int:
    cluster = start_cluster(_workers(options), _PORT)
    print(f"scheduler at {cluster.scheduler_address}, {_workers(options)} workers; Ctrl-C ends it")
    print(f"./trident sweep SCENARIO.yaml --engine dask:{cluster.scheduler_address}", flush=True)
    with contextlib.suppress(KeyboardInterrupt):
        signal.pause()
    end_in_time(cluster)
    return DONE


def _import_from(folder: Path) -> None:
    """Functions are looked for in the scenario's folder and here, in all processes to come."""
    places = [str(folder.resolve()), os.getcwd()]
    sys.path[:0] = places
    os.environ["PYTHONPATH"] = os.pathsep.join([*places, os.environ.get("PYTHONPATH", "")])


def _sweep(options: argparse.Namespace) -> int:
    scenario = read_scenario(options.scenario)
    _import_from(options.scenario.parent)
    code = code_version(scenario.subject)
    jobs = jobs_of(scenario, code)
    folder = options.out or Path(f"{scenario.name}_sweep")
    folder = folder.resolve()
    if options.plan:
        return _show_plan(scenario, jobs, folder)
    with opened(folder):
        if note := note_of_change(folder, code, sum(1 for _ in all_rows(folder))):
            print(note, file=sys.stderr)
        facts = {"scenario": str(options.scenario), "subject": scenario.subject, "code": code}
        write_facts(folder, facts)
        if options.only:
            jobs = _chosen(jobs, options.only, folder)
            scenario = dataclasses.replace(scenario, enough=None)
        return _carry_out(options, Sweep(scenario, jobs, folder, code))


def _show_plan(scenario: Scenario, jobs: Sequence[Job], folder: Path) -> int:
    there = sum(read_row(folder, job.key) is not None for job in jobs)
    points = len({job.point for job in jobs})
    print(f"{scenario.subject}: {points} points x {len(scenario.seeds)} seeds = {len(jobs)} runs")
    print(f"{there} are in {folder}, {len(jobs) - there} are to be made")
    for job in jobs[: min(5, points)]:
        print(f"  {job.key[:12]} seed {job.seed} {dict(job.parameters)}")
    return DONE


def _chosen(jobs: Sequence[Job], key: str, folder: Path) -> list[Job]:
    """One job, whose row is made once more."""
    chosen = [job for job in jobs if job.key.startswith(key)]
    if len(chosen) != 1:
        raise EvalError(f"--only {key}: {len(chosen)} runs; legal: the begin of one run's key")
    row_path(folder, chosen[0].key).unlink(missing_ok=True)
    return chosen


def _engine(options: argparse.Namespace, sweep: Sweep) -> Engine:
    subject = sweep.scenario.subject
    if options.engine == "local":
        return LocalEngine(sweep.folder, subject, _workers(options))
    address = options.engine.removeprefix("dask").removeprefix(":")
    return DaskEngine(sweep.folder, subject, _workers(options), address)


def _run(options: argparse.Namespace, sweep: Sweep) -> int:
    """Make the runs that are missing; INTERRUPTED if somebody has stopped it."""
    engine = _engine(options, sweep)
    try:
        sweep.run(engine)
    except KeyboardInterrupt:
        print("interrupted; the same command continues", file=sys.stderr)
        return INTERRUPTED
    finally:
        engine.close()
        sweep.look()
    return DONE


def _write(options: argparse.Namespace, sweep: Sweep) -> None:
    command = f"./trident sweep {options.scenario}"
    if options.out:
        command += f" --out {options.out}"
    try:
        sweep.write(command)
    except OSError as error:
        raise EvalError(f"{sweep.folder}: {error.strerror}; the rows are whole") from error


def _carry_out(options: argparse.Namespace, sweep: Sweep) -> int:
    if sweep.found:
        print(f"{sweep.found} of {sweep.wanted} runs are there already", file=sys.stderr)
    ending = _run(options, sweep) if sweep.missing else DONE
    if options.only:
        return _show_row(sweep)
    _write(options, sweep)
    print(sweep.folder / "report.html")
    if ending == DONE and sweep.failed:
        print(f"{sweep.failed} of {sweep.wanted} runs have failed", file=sys.stderr)
        return SOME_FAILED
    return ending


def _show_row(sweep: Sweep) -> int:
    for row in sweep.rows():
        numbers = ", ".join(f"{name} {value:.6g}" for name, value in row.metrics.items())
        print(f"seed {row.seed}, {dict(row.parameters)}: {numbers or row.reason}")
    return SOME_FAILED if sweep.failed else DONE


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
