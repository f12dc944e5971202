# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of radio links: how well robots heard each other, and what arrived."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.plots import MANY, color, dashes, saved_figures
from trident_eval.core.radio.links import LinkLog
from trident_eval.core.tracks import Array

# SNR at which 1 in 10 frames of 1500 bytes is lost, and the dashes of its line.
_NEEDED_DB = {
    "MCS 7": (19.65, (0, (7, 3))),
    "MCS 0": (0.94, (0, (2, 2))),
}
# Further below what MCS 0 needs it makes no difference [dB].
_LOWEST_DB = -30.0
# Messages come once a second and seldomer, too.
_WINDOW_S = 2.0


def draw_links(log: LinkLog, title: str, folder: Path) -> list[Path]:
    """Draw links.png: the SNR of each pair with traffic, and what each robot received.

    Args:
        log: of the run.
        title: of the run.
        folder: where the file goes; must exist.

    Returns:
        The file; nothing if there was no traffic.
    """
    return saved_figures({"links.png": lambda: _draw(log, title)}, folder)


def busy_pairs(log: LinkLog) -> list[tuple[str, str]]:
    """Pairs of radios between which there was traffic in either direction, both in order."""
    counts = np.nan_to_num(log.delivered + log.lost + log.expired + log.refused + log.relayed)
    has_traffic = (counts > 0.0).any(axis=0)
    busy = [pair for pair, is_busy in zip(log.pairs, has_traffic, strict=True) if is_busy]
    return sorted({(min(pair), max(pair)) for pair in busy})


def snr_of(log: LinkLog, pair: tuple[str, str]) -> Array:
    """SNR of a pair [dB], shape (M,): in the order of its names, or in the other one.

    NaN where they did not hear each other, and where one of them was not there.
    """
    snr = np.full(len(log.time), np.nan)
    for link in (pair[::-1], pair):
        if link in log.pairs:
            values = log.snr_db[:, log.pairs.index(link)]
            snr = np.where(np.isfinite(values), values, snr)
    return snr


def received_rate(log: LinkLog, destination: str) -> Array:
    """Messages that a radio received from all others [1/s], shape (M,), each over _WINDOW_S before.

    Those that crossed by rules; in a run without rules, those that came over links.
    """
    columns = [index for index, pair in enumerate(log.pairs) if pair[1] == destination]
    is_by_rules = bool(np.nan_to_num(log.relayed).any())
    counts = np.nan_to_num((log.relayed if is_by_rules else log.delivered)[:, columns])
    gained = np.diff(counts, axis=0)
    # Radios that were reset count from zero.
    gained = np.where(gained < 0.0, counts[1:], gained).sum(axis=1)
    total = np.concatenate([[0.0], np.cumsum(gained)])
    first = np.searchsorted(log.time, log.time - _WINDOW_S - 1e-9)
    seconds = log.time - log.time[first]
    rate = (total - total[first]) / np.where(seconds > 0.0, seconds, np.inf)
    return np.asarray(rate)


def _draw(log: LinkLog, title: str) -> Any:
    pairs = busy_pairs(log)
    if not pairs or len(log.time) < 2:
        return None
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.5, 6.4), layout="constrained")
    figure.suptitle(f"{title}: radio links")
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=(1.4, 1.0))
    _draw_snr(above, log, pairs)
    _draw_received(below, log, pairs)
    below.set(xlabel="simulated time [s]", xlim=(log.time[0], log.time[-1]))
    return figure


def _draw_snr(axes: Any, log: LinkLog, pairs: list[tuple[str, str]]) -> None:
    for index, pair in enumerate(pairs):
        label = _label(pairs, " - ".join(pair))
        axes.plot(log.time, snr_of(log, pair), label=label, **_line(index))
    for mode, (needed_db, style) in _NEEDED_DB.items():
        label = f"{mode} needs {needed_db:g} dB"
        axes.axhline(needed_db, color="#333333", linewidth=1.0, linestyle=style, label=label)
    axes.set(ylabel="SNR [dB]", title="signal over noise of each pair; a gap: out of reach")
    axes.set_ylim(bottom=max(axes.get_ylim()[0], _LOWEST_DB))
    _legend(axes)


def _draw_received(axes: Any, log: LinkLog, pairs: list[tuple[str, str]]) -> None:
    names = sorted({name for pair in pairs for name in pair})
    # Robots that receive as much lie on each other: the wider lines below are seen all the same.
    widths = np.linspace(3.2, 1.2, len(names))
    for index, name in enumerate(names):
        look = {"linewidth": widths[index]} | _line(index)
        axes.plot(log.time, received_rate(log, name), label=_label(names, f"to {name}"), **look)
    title = f"messages from all others, mean of {_WINDOW_S:g} s"
    axes.set(ylabel="delivered [1/s]", title=title)
    axes.set_ylim(bottom=0.0)
    _legend(axes)


def _line(index: int) -> dict[str, Any]:
    return {"color": color(index), "linestyle": dashes(index)}


def _label(shown: list[Any], text: str) -> str:
    """What a legend says of a line; nothing where there are too many for one."""
    return text if len(shown) <= MANY else "_nolegend_"


def _legend(axes: Any) -> None:
    """To the right of the lines, so that it covers none of them."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=9)
