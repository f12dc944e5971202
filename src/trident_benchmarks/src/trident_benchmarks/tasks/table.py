# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The table of OR-tools' values: made once, committed, so that no bench needs OR-tools."""

from __future__ import annotations

import csv
import json
import subprocess
from collections.abc import Sequence
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_fleet.core.tasks.trials.instances import Instance, some_instances

from trident_benchmarks.results import say

INSTANCES = 100
SECONDS = 30.0  # of CPU for each value
FILE = Path(__file__).with_name("ortools.csv")
_COLUMNS = ("name", "objective", "version", "cpu_s", "length_m", "finish_s")

# (instance, objective) -> a row of the table.
Table = dict[tuple[str, str], dict[str, str]]


def read_table(path: Path = FILE) -> Table:
    """The values that are there.

    Raises:
        EvalError: the file is no such table.
    """
    if not path.is_file():
        return {}
    with path.open(encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        if tuple(reader.fieldnames or ()) != _COLUMNS:
            found = ", ".join(reader.fieldnames or ())
            raise EvalError(f"{path}: columns are {found}, legal: {', '.join(_COLUMNS)}")
        return {(row["name"], row["objective"]): row for row in reader}


def write_table(table: Table, path: Path = FILE) -> None:
    """All values, in the order in which they came."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, _COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(table.values())


def lacking(table: Table, objective: str) -> list[Instance]:
    """Instances without a value, or with one that took less time than it should."""
    rows = [(made, table.get((made.name, objective))) for made in some_instances(INSTANCES)]
    return [made for made, row in rows if row is None or float(row["cpu_s"]) < 0.99 * SECONDS]


def refresh(python: str, objectives: Sequence[str], path: Path = FILE) -> None:
    """Let OR-tools compute what the table lacks; each value is kept at once.

    Args:
        python: one that has OR-tools.
        objectives: `sum`, `makespan`.
        path: of the table.

    Raises:
        EvalError: that Python does not work.
    """
    table = read_table(path)
    program = Path(__file__).with_name("ortools_routes.py")
    for objective in objectives:
        for made in lacking(table, objective):
            asked = json.dumps(made.as_numbers() | {"objective": objective})
            try:
                done = subprocess.run(
                    [python, str(program), str(SECONDS)],
                    input=asked,
                    capture_output=True,
                    text=True,
                    check=True,
                )
            except (OSError, subprocess.CalledProcessError) as error:
                text = getattr(error, "stderr", None) or str(error)
                raise EvalError(f"--refresh {python}: {text.strip().splitlines()[-1]}") from None
            row = json.loads(done.stdout)
            table[made.name, objective] = {name: str(row[name]) for name in _COLUMNS}
            write_table(table, path)
            say(f"{made.name} {objective}: {row['length_m']:.1f} m, {row['finish_s']:.1f} s")
