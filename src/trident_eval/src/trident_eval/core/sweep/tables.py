# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tables of a sweep: runs.csv, runs.parquet, and what summary.json says of each point."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from trident_eval.core.sweep.axes import names_of
from trident_eval.core.sweep.comparing import Compared, compare
from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import Scenario
from trident_eval.core.sweep.statistics import Difference, Estimate, estimate

# What differs from one run of the same work to the next stands in the last columns.
_TIMES = ("started", "elapsed_s", "cpu_s", "memory_mb", "worker")


def columns(scenario: Scenario, rows: Sequence[RunRow]) -> dict[str, list[Any]]:
    """The table of all runs, column by column.

    Parameters have `parameter.` before their names, metrics `metric.`; of failed runs they are
    empty.
    """
    table = _attributes(rows, ("key", "point", "seed"))
    for name in (*scenario.parameters, *names_of(scenario.axes)):
        table[f"parameter.{name}"] = _of_one_type([row.parameters[name] for row in rows])
    table |= _attributes(rows, ("status", "reason"))
    for metric in scenario.metrics:
        table[f"metric.{metric.name}"] = [row.metrics.get(metric.name) for row in rows]
    return table | _attributes(rows, _TIMES)


def _attributes(rows: Sequence[RunRow], names: Sequence[str]) -> dict[str, list[Any]]:
    return {name: [getattr(row, name) for row in rows] for name in names}


def _of_one_type(values: list[Any]) -> list[Any]:
    """Values as a column of a table holds them: of one scalar type, else as JSON text."""
    types = {type(value) for value in values}
    if any(types <= {one} for one in (bool, int, str)):
        return values
    if types <= {int, float}:
        return [*map(float, values)]
    return [json.dumps(value, sort_keys=True) for value in values]


def csv_text(table: Mapping[str, Sequence[Any]]) -> str:
    """The table as CSV; numbers as Python's shortest text that reads back the same."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(table)
    for line in zip(*table.values(), strict=True):
        writer.writerow("" if value is None else value for value in line)
    return stream.getvalue()


def write_tables(scenario: Scenario, rows: Sequence[RunRow], folder: Path) -> None:
    """Writes runs.csv and runs.parquet."""
    import pyarrow
    import pyarrow.parquet

    table = columns(scenario, rows)
    replace_file(folder / "runs.csv", csv_text(table).encode())
    arrays = {
        name: pyarrow.array(values, pyarrow.float64())
        if name.startswith("metric.")
        else pyarrow.array(values)
        for name, values in table.items()
    }
    buffer = io.BytesIO()
    pyarrow.parquet.write_table(pyarrow.table(arrays), buffer)
    replace_file(folder / "runs.parquet", buffer.getvalue())


def replace_file(path: Path, data: bytes) -> None:
    """Writes a file so that the old one or the new one is there, also if the disk is full."""
    temporary = path.with_suffix(path.suffix + ".part")
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise


def by_point(rows: Sequence[RunRow]) -> dict[int, list[RunRow]]:
    """Rows of each point."""
    points: dict[int, list[RunRow]] = {}
    for row in rows:
        points.setdefault(row.point, []).append(row)
    return dict(sorted(points.items()))


def estimates(rows: Sequence[RunRow], metric: str) -> dict[int, Estimate]:
    """The mean of a metric at each point that has a run that has not failed."""
    values = {
        point: [row.metrics[metric] for row in of_point if row.status == DONE]
        for point, of_point in by_point(rows).items()
    }
    return {point: estimate(numbers) for point, numbers in values.items() if numbers}


def summary(
    scenario: Scenario, rows: Sequence[RunRow], narrowed: Mapping[int, int], code: str, wanted: int
) -> dict[str, Any]:
    """What summary.json holds.

    Args:
        scenario: of the sweep.
        rows: that count.
        narrowed: points that had enough before their last seed.
        code: the version of what was run.
        wanted: how many runs there would be with all seeds.
    """
    return {
        "name": scenario.name,
        "subject": scenario.subject,
        "code": code,
        "runs": {
            "wanted": wanted,
            "counted": len(rows),
            "failed": sum(row.status != DONE for row in rows),
            "points_that_had_enough": len(narrowed),
        },
        "points": _points(scenario, rows),
        "comparisons": [_compared(one) for one in compare(scenario.comparisons, rows)],
    }


def _points(scenario: Scenario, rows: Sequence[RunRow]) -> list[dict[str, Any]]:
    known = {metric.name: estimates(rows, metric.name) for metric in scenario.metrics}
    return [
        {
            "point": point,
            "parameters": dict(of_point[0].parameters),
            "runs": len(of_point),
            "failed": sum(row.status != DONE for row in of_point),
            "metrics": {
                name: _numbers(found[point]) for name, found in known.items() if point in found
            },
        }
        for point, of_point in by_point(rows).items()
    ]


def _numbers(found: Estimate) -> dict[str, float | None]:
    """Finite numbers; null for those that are missing."""
    return {
        "count": found.count,
        "mean": found.mean,
        **{
            name: None if math.isnan(value := getattr(found, name)) else value
            for name in ("spread", "t_low", "t_high", "bootstrap_low", "bootstrap_high")
        },
    }


def _compared(one: Compared) -> dict[str, Any]:
    comparison = one.comparison
    result = {
        "parameter": comparison.parameter,
        "first": comparison.first,
        "second": comparison.second,
        "metric": comparison.metric,
        "unpaired": one.unpaired,
    }
    found: Difference | None = one.difference
    if found is None:
        return {**result, "pairs": 0}
    p_values = {"p": found.p_value, "p_holm": found.holm_p}
    known = {name: None if math.isnan(value) else value for name, value in p_values.items()}
    return {**result, "pairs": found.estimate.count, **_numbers(found.estimate), **known}
