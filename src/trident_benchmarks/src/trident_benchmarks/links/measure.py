# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the links' benchmark: measured, written, printed."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from trident_benchmarks.links.benchmark import SUITES
from trident_benchmarks.links.radios import circle, goodput, radio_world, saturating
from trident_benchmarks.links.station import station_line, station_row
from trident_benchmarks.results import (
    FAILED,
    MEASURED,
    check_folder,
    new_document,
    say,
    write_document,
)

GOODPUT_LIMIT = 0.06  # of ns-3's figure
ADAPTIVE_LIMIT = 0.92  # of the best fixed rate
_NEAR_M = 10.0
_FULL_AMPDU = 65535
_COASTS = 30


class Reference(NamedTuple):
    """A run of ns-3 3.37: ad hoc, table-based errors, saturated UDP to one sink.

    Attributes:
        mcs, width, max_ampdu: of all stations; width [MHz], max_ampdu [bytes].
        payload: of a datagram [bytes].
        stations: that send.
        mbit_s: goodput.
    """

    mcs: int
    width: int
    max_ampdu: int
    payload: int
    stations: int
    mbit_s: float


NS3_RUNS = (
    Reference(7, 20, 0, 1472, 1, 30.82),
    Reference(7, 20, 0, 1472, 2, 31.46),
    Reference(7, 20, 0, 1472, 5, 28.63),
    Reference(7, 20, 0, 1472, 10, 25.18),
    Reference(7, 20, _FULL_AMPDU, 1472, 1, 59.77),
    Reference(7, 20, _FULL_AMPDU, 1472, 5, 50.75),
    Reference(0, 20, 0, 1472, 1, 5.58),
    Reference(7, 20, 0, 100, 1, 3.71),
    Reference(9, 80, _FULL_AMPDU, 1472, 1, 323.59),
)


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


def goodput_row(reference: Reference, seconds: float) -> dict[str, Any]:
    """Ours next to ns-3's."""
    radio = saturating(reference.mcs, reference.width, reference.max_ampdu)
    places = circle(reference.stations, _NEAR_M)
    world = radio_world(places, radio)
    ours = goodput(world, [name for name in places if name != "sink"], reference.payload, seconds)
    error = ours / reference.mbit_s - 1.0
    return {
        "suite": "goodput",
        **reference._asdict(),
        "ns3_mbit_s": reference.mbit_s,
        "mbit_s": ours,
        "error": error,
        "limit": GOODPUT_LIMIT,
        "passed": abs(error) <= GOODPUT_LIMIT,
    }


def adaptive_row(distance: float, is_quick: bool) -> dict[str, Any]:
    """The adaptive rate next to the best fixed one, at a distance [m]."""
    places = {"sink": (0.0, 0.0), "source": (distance, 0.0)}

    def reach(mcs: int | str, seconds: float) -> float:
        return goodput(
            radio_world(places, saturating(mcs, 20, _FULL_AMPDU)), ["source"], 1472, seconds
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


def _rows(suites: Sequence[str], is_quick: bool) -> Iterator[dict[str, Any]]:
    if "goodput" in suites:
        for reference in NS3_RUNS:
            yield goodput_row(reference, 1.0 if is_quick else 5.0)
    if "adaptive" in suites:
        count = 8 if is_quick else 40
        for i in range(count):
            # From the nearest place that matters to the end of the reach, in equal ratios.
            yield adaptive_row(40.0 * 60.0 ** (i / (count - 1)), is_quick)
    if "cost" in suites:
        for load in LOADS:
            yield load_row(load, 5.0 if is_quick else 20.0)
    if "station" in suites:
        for seed in range(1, (2 if is_quick else _COASTS) + 1):
            yield station_row(seed)


def line(row: dict[str, Any]) -> str:
    """A row as one line."""
    verdict = "" if row["passed"] else " (limit missed)"
    if row["suite"] == "goodput":
        return (
            f"MCS {row['mcs']}, {row['width']} MHz, A-MPDU {row['max_ampdu']}, {row['payload']} B,"
            f" {row['stations']} stations: {row['mbit_s']:.2f} Mbit/s,"
            f" ns-3 {row['ns3_mbit_s']:.2f}, {100 * row['error']:+.1f} %{verdict}"
        )
    if row["suite"] == "adaptive":
        share = "-" if row["share"] is None else f"{row['share']:.3f}"
        return (
            f"{row['distance_m']:.0f} m: {row['mbit_s']:.2f} Mbit/s, of the best {share}{verdict}"
        )
    if row["suite"] == "station":
        return station_line(row)
    return (
        f"{row['load']}: {row['cpu_s_per_s']:.4f} CPU s per simulated s (<= {row['limit']}),"
        f" {row['received']} of {row['sent']} heard by one{verdict}"
    )


def measure(options: argparse.Namespace) -> int:
    """All rows; the exit code."""
    check_folder(options.out)
    check_folder(options.picture)
    check_folder(options.coast)
    document = new_document() | {"rows": []}
    for row in _rows(options.suite or SUITES, options.quick):
        document["rows"].append(row)
        print(line(row), flush=True)
        write_document(options.out, document)
    _draw(options, document["rows"])
    return MEASURED if all(row["passed"] for row in document["rows"]) else FAILED


def _draw(options: argparse.Namespace, rows: list[dict[str, Any]]) -> None:
    from trident_benchmarks.links.picture import draw_coast, draw_goodput

    if options.picture:
        draw_goodput(options.picture, [row for row in rows if row["suite"] == "adaptive"])
        say(f"written: {options.picture}")
    if options.coast:
        draw_coast(options.coast)
        say(f"written: {options.coast}")
