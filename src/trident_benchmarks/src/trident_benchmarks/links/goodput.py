# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Goodput of radios that always have something to send, next to ns-3's."""

from __future__ import annotations

from typing import Any, NamedTuple

from trident_benchmarks.links.ns3 import Ns3
from trident_benchmarks.links.radios import circle, goodput, radio_world, saturating

GOODPUT_LIMIT, HIDDEN_LIMIT = 0.06, 0.15  # of ns-3's figure
FULL_AMPDU = 65535
_NEAR_M = 10.0
# How long packets wait in ns-3's queues before they expire: by default, and so long that none does.
_USUAL_MS, _LONG_MS = 500, 60_000


class Case(NamedTuple):
    """Stations that send to one sink: ad hoc, table-based errors, saturated UDP.

    Attributes:
        mcs, width, max_ampdu: of all stations; width [MHz], max_ampdu [bytes].
        payload: of a datagram [bytes].
        stations: that send.
        recorded: goodput of an earlier run of ns-3 3.37, in whose queues no packet expired
            [Mbit/s].
        is_hidden: the stations do not hear each other.
    """

    mcs: int
    width: int
    max_ampdu: int
    payload: int
    stations: int
    recorded: float
    is_hidden: bool = False


CASES = (
    Case(7, 20, 0, 1472, 1, 30.77),
    Case(7, 20, 0, 1472, 2, 31.55),
    Case(7, 20, 0, 1472, 5, 30.34),
    Case(7, 20, 0, 1472, 10, 28.64),
    Case(7, 20, FULL_AMPDU, 1472, 1, 59.75),
    Case(7, 20, FULL_AMPDU, 1472, 2, 55.91),
    Case(7, 20, FULL_AMPDU, 1472, 5, 48.50),
    Case(7, 20, FULL_AMPDU, 1472, 10, 42.83),
    Case(0, 20, 0, 1472, 1, 5.58),
    Case(7, 20, 0, 100, 1, 3.73),
    Case(9, 80, FULL_AMPDU, 1472, 1, 323.95),
    Case(7, 20, 0, 1472, 2, 23.14, is_hidden=True),
    Case(7, 20, FULL_AMPDU, 1472, 2, 55.57, is_hidden=True),
)


def ours_mbit_s(case: Case, seconds: float) -> float:
    """What our radios carry, after a second as ns-3's have it, too [Mbit/s]."""
    places = circle(case.stations, _NEAR_M)
    world = radio_world(places, saturating(case.mcs, case.width, case.max_ampdu))
    sources = [name for name in places if name != "sink"]
    if case.is_hidden:
        for i, name in enumerate(sources):
            for other in sources[:i]:
                world.radio.set_outage(name, True, other)
    return goodput(world, sources, case.payload, seconds, warm_up=1.0)


def _theirs_mbit_s(peer: Ns3, case: Case, ours: float, seconds: float, queue_ms: int) -> float:
    return peer.goodput(
        mcs=case.mcs,
        width=case.width,
        max_ampdu=case.max_ampdu,
        payload=case.payload,
        stations=case.stations,
        hidden=int(case.is_hidden),
        seconds=seconds,
        offered=round(1.3 * ours + 1.0, 1),
        queue_ms=queue_ms,
    )


def goodput_row(case: Case, peer: Ns3 | None, seconds: float) -> dict[str, Any]:
    """Ours next to ns-3's in whose queues no packet expires: of this run, else the recorded one."""
    ours = ours_mbit_s(case, seconds)
    theirs, expiring = case.recorded, None
    if peer is not None:
        theirs = _theirs_mbit_s(peer, case, ours, seconds, _LONG_MS)
        expiring = _theirs_mbit_s(peer, case, ours, seconds, _USUAL_MS)
    error = ours / theirs - 1.0
    limit = HIDDEN_LIMIT if case.is_hidden else GOODPUT_LIMIT
    return {
        "suite": "goodput",
        **case._asdict(),
        "peer": "recorded" if peer is None else f"ns-3 3.{peer.version}",
        "ns3_mbit_s": theirs,
        "ns3_expiring_mbit_s": expiring,
        "mbit_s": ours,
        "error": error,
        "limit": limit,
        "passed": abs(error) <= limit,
    }


def goodput_line(row: dict[str, Any]) -> str:
    """A row as one line, without its verdict."""
    hidden = ", hidden from each other" if row["is_hidden"] else ""
    expiring = row["ns3_expiring_mbit_s"]
    usual = "" if expiring is None else f", with packets that expire in its queues {expiring:.2f}"
    return (
        f"MCS {row['mcs']}, {row['width']} MHz, A-MPDU {row['max_ampdu']}, {row['payload']} B,"
        f" {row['stations']} stations{hidden}: {row['mbit_s']:.2f} Mbit/s, {row['peer']}:"
        f" {row['ns3_mbit_s']:.2f} ({100 * row['error']:+.1f} %){usual}"
    )
