# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The demonstration of mavlink_fleet.launch: all vehicles at once, through one connection."""

from __future__ import annotations

import argparse
import json
import sys
import time
from dataclasses import asdict
from pathlib import Path
from typing import Any

from trident_eval.core.bridges.client_flights import RECORD
from trident_eval.core.errors import EvalError
from trident_eval.mavlink.errands import Errand, read_errands
from trident_eval.mavlink.pilot import Pilot
from trident_eval.mavlink.station import Station


def fly(station: Station, errands: list[Errand], limit_s: float) -> list[Pilot]:
    """Lead all vehicles through their errands; returns them when all are done.

    Args:
        station: connected.
        errands: one for each vehicle.
        limit_s: of wall time, after which what is not done is given up.
    """
    pilots = [Pilot(station, errand) for errand in errands]
    by_system = {pilot.errand.system: pilot for pilot in pilots}
    end_s = time.monotonic() + limit_s

    def handle(system: int, _: Any) -> None:
        if system in by_system:
            by_system[system].advance()

    while not all(pilot.is_done for pilot in pilots):
        station.poll(handle)
        for pilot in pilots:
            pilot.advance()
        if time.monotonic() > end_s:
            break
    for pilot in pilots:
        if not pilot.is_done:
            pilot.record.problem = f"not done after {limit_s:g} s of wall time"
    return pilots


def record_of(pilots: list[Pilot]) -> dict[str, Any]:
    """What is written to RECORD."""
    return {
        "vehicles": {
            pilot.errand.vehicle: {
                "kind": pilot.errand.kind,
                "radius": pilot.errand.radius,
                "end": pilot.errand.end,
                "places_wanted": len(pilot.errand.places),
                **asdict(pilot.record),
            }
            for pilot in pilots
        }
    }


def main(arguments: list[str] | None = None) -> int:
    """Run the demonstration; roslaunch's own words are left out.

    Returns:
        Exit code of the process.
    """
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--errands", type=Path, required=True, help="YAML file")
    parser.add_argument("--host", default="127.0.0.1", help="of the router")
    parser.add_argument("--port", type=int, default=14445, help="of the router")
    parser.add_argument("--out", default="", help="folder for the record; empty: none is written")
    parser.add_argument("--limit", type=float, default=900.0, help="of wall time [s]")
    options, _ = parser.parse_known_args(arguments)
    try:
        errands = read_errands(options.errands)
        station = Station(options.host, options.port)
    except (EvalError, TimeoutError) as error:
        print(f"mavlink_demo: {error}", file=sys.stderr)
        return 1
    pilots = fly(station, errands, options.limit)
    station.close()
    text = json.dumps(record_of(pilots), indent=2)
    if options.out:
        (Path(options.out) / RECORD).write_text(text + "\n", encoding="utf-8")
    for pilot in pilots:
        print(f"mavlink_demo: {pilot.errand.vehicle}: {pilot.record.problem or 'done'}", flush=True)
    return 0  # what became of it is judged with the run
