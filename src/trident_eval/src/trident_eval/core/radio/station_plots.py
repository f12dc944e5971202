# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a base station of the air: its path, how good its links were, what crossed."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.plots import color, saved_figures
from trident_eval.core.radio.link_plots import snr_of
from trident_eval.core.radio.link_trial import LinkTrial, Station, crossed
from trident_eval.core.radio.links import LinkLog
from trident_eval.core.tracks import Array, Tracks

_SPAN_S = 5.0
_BANDS = {"survey": "#E8F1FA", "refine": "#FBF1DC", "hold": "#E4F3EA", "follow": "#F6E7F0"}


def draw_stations(
    tracks: Tracks, log: LinkLog, stations: list[Station], title: str, folder: Path
) -> list[Path]:
    """Draw base_station_<vehicle>.png of each: plan view, SNR over time, what crossed.

    Args:
        tracks: where everything was.
        log: of the run's links.
        stations: their records.
        title: of the run.
        folder: where the files go; must exist.

    Returns:
        The files.
    """
    drawings = {
        f"base_station_{station.vehicle}.png": lambda station=station: _draw(
            tracks, log, station, title
        )
        for station in stations
        if station.vehicle in tracks.names
    }
    return saved_figures(drawings, folder)


def _draw(tracks: Tracks, log: LinkLog, station: Station, title: str) -> Any:
    from matplotlib.figure import Figure

    links = station.record["links"]
    worst = np.min([_snr(log, station.vehicle, name) for name in links], axis=0)
    figure = Figure(figsize=(12.5, 6.6), layout="constrained")
    figure.suptitle(f"{title}: base station {station.vehicle}")
    plan, over_time = figure.subplots(1, 2, width_ratios=(1.0, 1.5), squeeze=True)
    over_time.remove()
    right = plan.get_subplotspec().get_gridspec()[0, 1].subgridspec(2, 1, height_ratios=(1.6, 1.0))
    snr, share = figure.add_subplot(right[0]), figure.add_subplot(right[1])
    _draw_plan(figure, plan, tracks, log.time, worst, station)
    _draw_snr(snr, log, station)
    _draw_share(share, log, station)
    for axes in (snr, share):
        _draw_phases(axes, station, float(log.time[-1]), has_names=axes is snr)
        axes.set_xlim(log.time[0], log.time[-1])
    return figure


def _snr(log: LinkLog, one: str, other: str) -> Array:
    """Of a pair [dB], shape (M,); of one that does not hear each other NaN."""
    return snr_of(log, (min(one, other), max(one, other)))


def _draw_plan(
    figure: Any, plan: Any, tracks: Tracks, time: Array, worst: Array, station: Station
) -> None:
    record = station.record
    corners = np.array([*record["fence"], record["fence"][0]])
    plan.plot(*corners.T, color="#555555", linewidth=1.0, linestyle=(0, (4, 3)), label="fence")
    for index, name in enumerate(record["links"]):
        if name in tracks.names:
            x, y, _ = tracks.select([name]).position[:, 0].T
            plan.plot(x, y, color=color(index), linewidth=1.6, label=name)
        elif name in record["places"]:
            plan.plot(*record["places"][name][:2], "^", color=color(index), label=name)
    track = tracks.select([station.vehicle]).position[:, 0]
    x, y, z = (np.interp(time, tracks.time, track[:, axis]) for axis in range(3))
    is_up = z >= record["lowest_m"]
    dots = plan.scatter(x[is_up], y[is_up], c=worst[is_up], s=14, cmap="viridis", zorder=3)
    figure.colorbar(dots, ax=plan, label="worst link there [dB]", location="bottom", shrink=0.8)
    plan.plot(x[-1], y[-1], "*", color="#B00020", markersize=13, label="at the end", zorder=4)
    plan.set(xlabel="x east [m]", ylabel="y north [m]", aspect="equal", title="plan view")
    plan.legend(fontsize=8, loc="upper left")


def _draw_snr(axes: Any, log: LinkLog, station: Station) -> None:
    links = station.record["links"]
    for index, name in enumerate(links):
        label = f"{station.vehicle} - {name}"
        axes.plot(log.time, _snr(log, station.vehicle, name), color=color(index), label=label)
    for one, other in pairwise(links):
        label = f"{one} - {other}, directly"
        axes.plot(log.time, _snr(log, one, other), color="#555555", linewidth=1.0, label=label)
    axes.set(ylabel="SNR [dB]", title="links; a gap: out of reach")
    low, high = axes.get_ylim()
    axes.set_ylim(low - 0.2 * (high - low), high)
    axes.legend(fontsize=8, loc="lower right", ncols=3)


def _draw_share(axes: Any, log: LinkLog, station: Station) -> None:
    """Between the robots that it connects, in spans of time."""
    edges = np.arange(log.time[0], log.time[-1] + _SPAN_S, _SPAN_S)
    for index, pair in enumerate(pairwise(station.record["links"])):
        trial = LinkTrial(*pair, from_s=0.0, direct_limit=0.0, relayed_limit=0.0)
        shares = [crossed(log, trial, a, b).share for a, b in pairwise(edges)]
        values = [np.nan if share is None else 100.0 * share for share in shares]
        axes.stairs(values, edges, color=color(index), label=f"{pair[0]} -> {pair[1]}")
    axes.set(xlabel="simulated time [s]", ylabel="delivered [%]", ylim=(-3.0, 106.0))
    axes.set_title(f"messages that crossed by rules, in {_SPAN_S:g} s")
    axes.legend(fontsize=8, loc="lower right")


def _draw_phases(axes: Any, station: Station, end_s: float, has_names: bool) -> None:
    phases = station.record["phases"]
    ends = [phase["time_s"] for phase in phases[1:]] + [end_s]
    for phase, end in zip(phases, ends, strict=True):
        if phase["phase"] in _BANDS:
            axes.axvspan(phase["time_s"], end, color=_BANDS[phase["phase"]], zorder=0)
            middle = 0.5 * (phase["time_s"] + end)
            if has_names and end - phase["time_s"] > 0.05 * end_s:
                axes.annotate(
                    phase["phase"],
                    (middle, 0.98),
                    xycoords=("data", "axes fraction"),
                    ha="center",
                    va="top",
                    fontsize=8,
                    color="#555555",
                )
