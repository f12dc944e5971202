# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the links' benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from trident_benchmarks.links.benchmark import SUITES
from trident_benchmarks.links.goodput import CASES, FULL_AMPDU, goodput_line, goodput_row
from trident_benchmarks.links.ns3 import Ns3, ns3_peer
from trident_benchmarks.links.per import per_line, per_rows
from trident_benchmarks.links.radios import circle, goodput, radio_world, saturating
from trident_benchmarks.links.silence import silence_line, silence_row
from trident_benchmarks.links.station import station_line, station_row
from trident_benchmarks.results import (
    check_folder,
    keep_rows,
    limits_code,
    new_document,
    say,
)

ADAPTIVE_LIMIT = 0.92  # of the best fixed rate
_COASTS = 30


class Load(NamedTuple):
    """Robots that send regularly.

    Attributes:
        name: of the row.
        robots: besides the one that receives.
        rules: messages of 100 bytes that each sends at a time.
        rate: at which [Hz].
        speed: of the robots [m/s].
        is_to_all: whether they are broadcasts.
        limit: CPU time [s] per simulated second.
    """

    name: str
    robots: int
    rules: int
    rate: int
    speed: float
    is_to_all: bool
    limit: float


LOADS = (
    Load("7 robots, 700 messages/s, standing", 7, 10, 10, 0.0, False, 0.006),
    Load("7 robots, 700 messages/s, 3 m/s", 7, 10, 10, 3.0, False, 0.02),
    Load("50 robots, 250 broadcasts/s, 3 m/s", 50, 1, 5, 3.0, True, 0.15),
)


def adaptive_row(distance: float, is_quick: bool) -> dict[str, Any]:
    """The adaptive rate next to the best fixed one, at a distance [m]."""
    places = {"sink": (0.0, 0.0), "source": (distance, 0.0)}

    def reach(mcs: int | str, seconds: float) -> float:
        return goodput(
            radio_world(places, saturating(mcs, 20, FULL_AMPDU)), ["source"], 1472, seconds
        )

    fixed = [reach(mcs, 0.25 if is_quick else 0.5) for mcs in range(9)]
    adaptive = reach("adaptive", 1.0 if is_quick else 3.0)
    best = max(fixed)
    return {
        "suite": "adaptive",
        "distance_m": distance,
        "fixed_mbit_s": fixed,
        "mbit_s": adaptive,
        "share": adaptive / best if best else None,
        "limit": ADAPTIVE_LIMIT,
        "passed": best == 0.0 or adaptive >= ADAPTIVE_LIMIT * best,
    }


def _cpu_s(load: Load, seconds: float, sends: bool) -> tuple[float, int, int]:
    """CPU time, and messages that were sent and that arrived."""
    places = circle(load.robots, 30.0)
    world = radio_world(places, {"tx_power": 20}, shadowing=3.0)
    robots = [name for name in places if name != "sink"]
    for name in robots:
        x, y = places[name]
        world.models[name].set_velocity((load.speed * -y / 30.0, load.speed * x / 30.0, 0.0))
    data, destination = bytes(100), "all" if load.is_to_all else "sink"
    period = round(1.0 / (load.rate * world.dt))
    sent = received = 0
    begin = time.process_time()
    for step in range(round(seconds / world.dt)):
        for i, name in enumerate(robots):
            if sends and (step + i) % period == 0:
                for _ in range(load.rules):
                    world.radio.send(name, destination, data)
                    sent += 1
        world.step()
        received += len(world.radio.receive("sink"))
    return time.process_time() - begin, sent, received


def load_row(load: Load, seconds: float) -> dict[str, Any]:
    """What radios cost: CPU time less that of the same robots when they are silent."""
    silent, _, _ = _cpu_s(load, seconds, sends=False)
    busy, sent, received = _cpu_s(load, seconds, sends=True)
    cost = (busy - silent) / seconds
    return {
        "suite": "cost",
        "load": load.name,
        "cpu_s_per_s": cost,
        "sent": sent,
        "received": received,
        "limit": load.limit,
        "passed": cost <= load.limit,
    }


def _adaptive_rows(is_quick: bool) -> Iterator[dict[str, Any]]:
    count = 8 if is_quick else 40
    for i in range(count):
        # From the nearest place that matters to the end of the reach, in equal ratios.
        yield adaptive_row(40.0 * 60.0 ** (i / (count - 1)), is_quick)


def _load_rows(is_quick: bool) -> Iterator[dict[str, Any]]:
    for load in LOADS:
        yield load_row(load, 5.0 if is_quick else 20.0)


def _silence_rows(is_quick: bool) -> Iterator[dict[str, Any]]:
    for vehicles in (1, 6):
        seconds = (60.0 if is_quick else 1200.0) / vehicles
        yield silence_row(vehicles, seconds, 5 if is_quick else 21)


def _station_rows(is_quick: bool) -> Iterator[dict[str, Any]]:
    for seed in range(1, (2 if is_quick else _COASTS) + 1):
        yield station_row(seed)


#: What measures the suites that need no ns-3, in order.
_MAKERS = {
    "adaptive": _adaptive_rows,
    "cost": _load_rows,
    "silence": _silence_rows,
    "station": _station_rows,
}


def _rows(suites: Sequence[str], is_quick: bool) -> Iterator[dict[str, Any]]:
    if "per" in suites or "goodput" in suites:
        with ns3_peer() as peer:
            yield from _peer_rows(peer, suites, is_quick)
    for suite, make in _MAKERS.items():
        if suite in suites:
            yield from make(is_quick)


def _peer_rows(peer: Ns3 | None, suites: Sequence[str], is_quick: bool) -> Iterator[dict[str, Any]]:
    if "per" in suites and peer is not None:
        yield from per_rows(peer, is_quick)
    if "goodput" in suites:
        for case in CASES:
            yield goodput_row(case, peer, 1.0 if is_quick else 5.0)


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    if row["suite"] == "station":
        return station_line(row)
    verdict = "" if row["passed"] else " (limit missed)"
    return _LINES[row["suite"]](row) + verdict


def _adaptive_line(row: dict[str, Any]) -> str:
    share = "-" if row["share"] is None else f"{row['share']:.3f}"
    return f"{row['distance_m']:.0f} m: {row['mbit_s']:.2f} Mbit/s, of the best {share}"


def _load_line(row: dict[str, Any]) -> str:
    return (
        f"{row['load']}: {row['cpu_s_per_s']:.4f} CPU s per simulated s (<= {row['limit']}),"
        f" {row['received']} of {row['sent']} heard by one"
    )


#: A row as one line, but for its verdict.
_LINES = {
    "per": per_line,
    "goodput": goodput_line,
    "adaptive": _adaptive_line,
    "silence": silence_line,
    "cost": _load_line,
}


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    check_folder(options.picture)
    check_folder(options.losses)
    check_folder(options.coast)
    document = new_document() | {"rows": []}
    keep_rows(_rows(options.suite or SUITES, options.quick), line, options.out, document)
    _draw(options, document["rows"])
    return limits_code(document)


def _draw(options: argparse.Namespace, rows: list[dict[str, Any]]) -> None:
    from trident_benchmarks.links.picture import draw_coast, draw_goodput, draw_losses

    _draw_rows(draw_goodput, options.picture, [row for row in rows if row["suite"] == "adaptive"])
    _draw_rows(draw_losses, options.losses, [row for row in rows if row["suite"] == "per"])
    if options.coast:
        draw_coast(options.coast)
        say(f"written: {options.coast}")


def _draw_rows(
    draw: Callable[[Path, Sequence[dict[str, Any]]], None],
    path: Path | None,
    rows: Sequence[dict[str, Any]],
) -> None:
    """Draw rows if somebody wants a picture of them and there are some."""
    if path and rows:
        draw(path, rows)
        say(f"written: {path}")
