# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Comparisons of a sweep: two values of a parameter, paired by seed and by all other parameters."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import Comparison
from trident_eval.core.sweep.statistics import Difference, difference, holm


@dataclass(frozen=True)
class Compared:
    """What a comparison has found.

    Attributes:
        comparison: which one.
        difference: first - second; None where there is no pair.
        unpaired: runs of one side whose partner has failed or is not there.
    """

    comparison: Comparison
    difference: Difference | None
    unpaired: int


def compare(comparisons: Iterable[Comparison], rows: Sequence[RunRow]) -> list[Compared]:
    """All comparisons, with p values adjusted for their number."""
    found = [_compare(comparison, rows) for comparison in comparisons]
    p_values = [float("nan") if one.difference is None else one.difference.p_value for one in found]
    return [
        one
        if one.difference is None
        else dataclasses.replace(one, difference=dataclasses.replace(one.difference, holm_p=p))
        for one, p in zip(found, holm(p_values), strict=True)
    ]


def _compare(comparison: Comparison, rows: Sequence[RunRow]) -> Compared:
    first = _side(comparison, comparison.first, rows)
    second = _side(comparison, comparison.second, rows)
    pairs = [(first[partner], second[partner]) for partner in first if partner in second]
    unpaired = len(first) + len(second) - 2 * len(pairs)
    if not pairs:
        return Compared(comparison, None, unpaired)
    ours, theirs = zip(*pairs, strict=True)
    return Compared(comparison, difference(ours, theirs), unpaired)


def _side(comparison: Comparison, value: object, rows: Sequence[RunRow]) -> dict[str, float]:
    """The metric of the runs with a value, by what they share with their partners."""
    return {
        _partner(row, comparison.parameter): row.metrics[comparison.metric]
        for row in rows
        if row.status == DONE and row.parameters.get(comparison.parameter) == value
    }


def _partner(row: RunRow, parameter: str) -> str:
    others = {name: value for name, value in row.parameters.items() if name != parameter}
    return json.dumps([others, row.seed], sort_keys=True)
