# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The page of a sweep: what was asked, what came out, the worst runs and how to repeat them."""

from __future__ import annotations

import html
import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from trident_eval.core.page import PAGE_STYLE, html_figure, html_table
from trident_eval.core.sweep.comparing import Compared
from trident_eval.core.sweep.plots import point_label
from trident_eval.core.sweep.rows import DONE, RunRow
from trident_eval.core.sweep.scenario import Metric, Scenario
from trident_eval.core.sweep.statistics import Estimate
from trident_eval.core.sweep.tables import estimates

_WORST = 5  # runs of each metric that are listed
_LINES = 500  # points of the table; all are in summary.json
_REASONS = 20


def sweep_page(
    scenario: Scenario,
    rows: Sequence[RunRow],
    compared: Sequence[Compared],
    pictures: Sequence[Path],
    about: str,
    command: str,
) -> str:
    """The report as the text of one HTML file, pictures included.

    Args:
        scenario: of the sweep.
        rows: that count.
        compared: its comparisons.
        pictures: PNG files.
        about: one line below the title.
        command: that repeats the sweep; with `--only KEY` one run.
    """
    parts = [
        "<!doctype html><html lang='en'><meta charset='utf-8'>",
        "<meta name='viewport' content='width=device-width'>",
        f"<title>{html.escape(scenario.name)}</title><style>{PAGE_STYLE}</style>",
        f"<h1>{html.escape(scenario.name)}</h1><p class='about'>{html.escape(about)}</p>",
        *_failures(rows),
        *_points(scenario, rows),
        *_comparisons(compared),
        *map(html_figure, pictures),
        *_worst(scenario, rows, command),
        f"<h2>How to repeat it</h2><pre>{html.escape(command)}</pre>",
    ]
    return "\n".join(parts) + "\n"


def _failures(rows: Sequence[RunRow]) -> Iterable[str]:
    reasons = Counter(row.reason for row in rows if row.status != DONE)
    if reasons:
        yield f"<h2 class='bad'>{reasons.total()} of {len(rows)} runs have failed</h2>"
        yield html_table(
            [(str(count), reason) for reason, count in reasons.most_common(_REASONS)],
            ("runs", "reason"),
        )


def _cells(known: Mapping[str, Mapping[int, Estimate]], point: int) -> list[str]:
    """How many runs a point has, and the mean of each metric."""
    found = [by_point.get(point) for by_point in known.values()]
    count = max(one.count for one in found if one is not None)
    return [str(count), *map(_mean, found)]


def _points(scenario: Scenario, rows: Sequence[RunRow]) -> Iterable[str]:
    known = {metric.name: estimates(rows, metric.name) for metric in scenario.metrics}
    points = scenario.points()
    used = sorted(set().union(*known.values())) if known else []
    header = ["point", "runs"]
    header += [f"{one.name} [{one.unit}]" if one.unit else one.name for one in scenario.metrics]
    lines = [[point_label(scenario, points[one]), *_cells(known, one)] for one in used[:_LINES]]
    yield "<h2>Means and 95 % intervals</h2>"
    yield html_table(lines, header)
    if len(used) > _LINES:
        yield f"<p>The first {_LINES} of {len(used)} points; all are in summary.json.</p>"


def _mean(found: Estimate | None) -> str:
    if found is None:
        return "-"
    if found.count < 2:
        return f"{found.mean:.4g}"
    return f"{found.mean:.4g} ({found.t_low:.4g} to {found.t_high:.4g})"


def _comparisons(compared: Sequence[Compared]) -> Iterable[str]:
    if not compared:
        return
    yield "<h2>Comparisons, paired by seed</h2>"
    header = ("metric", "first", "second", "pairs", "first - second", "bootstrap", "p", "p (Holm)")
    yield html_table([_comparison(one) for one in compared], header)


def _comparison(one: Compared) -> list[str]:
    ask = one.comparison
    sides = [f"{ask.parameter} {ask.first}", f"{ask.parameter} {ask.second}"]
    if one.difference is None:
        return [ask.metric, *sides, "0", "-", "-", "-", "-"]
    found = one.difference.estimate
    has_interval = found.count > 1
    return [
        ask.metric,
        *sides,
        str(found.count) + (f" ({one.unpaired} unpaired)" if one.unpaired else ""),
        _mean(found),
        f"{found.bootstrap_low:.4g} to {found.bootstrap_high:.4g}" if has_interval else "-",
        _p(one.difference.p_value),
        _p(one.difference.holm_p),
    ]


def _p(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.2g}"


def _worst(scenario: Scenario, rows: Sequence[RunRow], command: str) -> Iterable[str]:
    done = [row for row in rows if row.status == DONE]
    if not done:
        return
    points = scenario.points()
    yield "<h2>Worst runs</h2>"
    for metric in scenario.metrics:
        lines = [
            [
                f"{row.metrics[metric.name]:.6g}",
                point_label(scenario, points[row.point]),
                str(row.seed),
                f"{command} --only {row.key[:12]}",
            ]
            for row in _sorted(done, metric)[:_WORST]
        ]
        yield html_table(lines, (metric.name, "point", "seed", "to repeat it"))


def _sorted(rows: Sequence[RunRow], metric: Metric) -> list[RunRow]:
    """The worst first; the farthest from the mean where no direction is better."""
    if metric.better == "neither":
        mean = sum(row.metrics[metric.name] for row in rows) / len(rows)
        return sorted(rows, key=lambda row: -abs(row.metrics[metric.name] - mean))
    sign = 1.0 if metric.better == "higher" else -1.0
    return sorted(rows, key=lambda row: sign * row.metrics[metric.name])
