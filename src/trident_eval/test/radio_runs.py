# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What radios leave in the folder of a run."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

HEADER = (
    "t,source,destination,distance,snr_db,mcs,delivered,lost,expired,refused,line_of_sight,relayed,"
    "offered"
)


def entry(rule: str, source: str, destination: str, **more: Any) -> dict[str, Any]:
    """An entry of `relay` as the simulator writes it; one of 60 messages of which all arrived."""
    counts = {"offered": 60, "thinned": 0, "superseded": 0, "expired": 0, "refused": 0}
    counts |= {"delivered": 60, "doubles": 0, "datagrams": 61, "resent": 1}
    named = {"rule": rule, "reliable": True, "deadline_s": 30.0}
    named |= {"source": source, "destination": destination}
    delays = {"first_s": 0.5, "delay_mean_s": 0.0012, "delay_max_s": 0.004}
    return named | delays | counts | more


def call_entry(rule: str, caller: str, server: str, **more: Any) -> dict[str, Any]:
    """An entry of `calls` as the simulator writes it; one of 4 calls that were all answered."""
    counts = {"called": 4, "answered": 4, "failed": 0, "refused": 0, "expired": 0, "aborted": 0}
    named = {"rule": rule, "deadline_s": 5.0, "caller": caller, "server": server}
    return named | {"delay_mean_s": 0.0032, "delay_max_s": 0.0041} | counts | more


def add_relay(folder: Path, entries: list[Any]) -> None:
    """Put entries into a run.json, which may be there already."""
    path = folder / "run.json"
    run = json.loads(path.read_text()) if path.is_file() else {}
    path.write_text(json.dumps(run | {"relay": entries}))


def write_links(folder: Path, lines: Iterable[str]) -> Path:
    """A links.csv of these lines below its header."""
    path = folder / "links.csv"
    path.write_text("\n".join([HEADER, *lines]) + "\n")
    return path


def three_radios(seconds: float = 20.0) -> list[str]:
    """Lines of three radios: a UAV leaves a station; a USV near it hears nothing at last."""
    lines = []
    for tick in range(1, round(2 * seconds) + 1):
        t = 0.5 * tick
        for source, destination, snr in [
            ("gcs", "uav1", 45.0 - 2.1 * t),
            ("gcs", "usv1", 18.0 if t < 15.0 else float("-inf")),
            ("uav1", "usv1", 10.0),
        ]:
            delivered = round(5 * t) if snr > 1.0 else round(5 * 15.0)
            counts = f"{delivered},{tick},0,0" if source == "gcs" else "0,0,0,0"
            lines.append(f"{t:.9g},{source},{destination},{8 * t:.9g},{snr:.9g},3,{counts},1,0,0")
            back = f"{t:.9g},{destination},{source},{8 * t:.9g},{snr:.9g},3,0,0,0,0,1,0,0"
            lines.append(back)
    return lines
