# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a base station of the air was worth: messages that crossed before it was up, and after."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np
from trident_base.station_record import NOT_UP, STANDS, STATION_PATTERN

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.radio.links import LinkLog, read_links
from trident_eval.core.rows import Row
from trident_eval.core.verdict import Verdict

PARAMETER = "link_trial"
#: From when a base station is in its fence until routes lead over it [s].
SETTLING_S = 3.0


@dataclass(frozen=True)
class LinkTrial:
    """What a run is held against (parameter /link_trial).

    Attributes:
        source: robot that sends.
        destination: robot that is to receive.
        from_s: simulated time from which messages count [s].
        direct_limit: share that may cross without a base station, 0 to 1.
        relayed_limit: share that has to cross with one, 0 to 1.
    """

    source: str
    destination: str
    from_s: float
    direct_limit: float
    relayed_limit: float


@dataclass(frozen=True)
class Station:
    """A base station's record.

    Attributes:
        vehicle: name of the UAV.
        record: keys of `trident_base.station_record.StationRecord`.
    """

    vehicle: str
    record: dict[str, Any]

    @property
    def up_s(self) -> float | None:
        """When it was in its fence first, simulated time [s]; None: never."""
        return self._first_s(NOT_UP)

    @property
    def take_off_s(self) -> float | None:
        """When it left the ground, simulated time [s]; None: never."""
        return self._first_s(STANDS)

    def _first_s(self, but: tuple[str, ...]) -> float | None:
        """Begin of the first phase that is absent of these."""
        for phase in self.record["phases"]:
            if phase["phase"] not in but:
                return float(phase["time_s"])
        return None


@dataclass(frozen=True)
class Share:
    """Messages in a span of time.

    Attributes:
        begin_s: of the span, simulated time [s].
        end_s: of the span [s].
        offered: messages to send.
        delivered: messages that arrived.
    """

    begin_s: float
    end_s: float
    offered: int
    delivered: int

    @property
    def share(self) -> float | None:
        """Delivered by offered; None: nothing was offered."""
        return min(self.delivered / self.offered, 1.0) if self.offered else None


def read_trial(folder: Path) -> LinkTrial | None:
    """That of a run; None: it is not held against anything.

    Raises:
        EvalError: one that is not what the launch file makes.
    """
    parameters = read_object(folder / "params.json").get("parameters") or {}
    given = parameters.get(PARAMETER)
    if given is None:
        return None
    where = f"{folder}/params.json: /{PARAMETER}"
    names = [field.name for field in fields(LinkTrial)]
    if not isinstance(given, dict) or set(given) != set(names):
        raise EvalError(f"{where}: {given!r}; legal: a map of {', '.join(names)}")
    numbers = _numbers_of(given, names[2:], where)
    return LinkTrial(str(given["source"]), str(given["destination"]), **numbers)


def _numbers_of(given: dict[str, Any], names: list[str], where: str) -> dict[str, float]:
    try:
        return {name: float(given[name]) for name in names}
    except (TypeError, ValueError) as error:
        raise EvalError(f"{where}: {error}; legal: numbers for {', '.join(names)}") from error


def read_stations(folder: Path) -> list[Station]:
    """Records of a run's base stations, by name.

    Raises:
        EvalError: a file that is not a record.
    """
    stations = []
    for path in sorted(folder.glob(STATION_PATTERN)):
        try:
            record = json.loads(path.read_text(encoding="utf-8"))
            station = Station(str(record["vehicle"]), record)
            _ = station.up_s
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise EvalError(f"{path}: {error}; legal: the record of a base station") from error
        stations.append(station)
    return stations


def crossed(log: LinkLog, trial: LinkTrial, begin_s: float, end_s: float) -> Share:
    """What crossed in a span: counts at its end less those at its begin."""
    pair = (trial.source, trial.destination)
    if pair not in log.pairs:
        return Share(begin_s, end_s, 0, 0)
    column = log.pairs.index(pair)
    rows = np.searchsorted(log.time, [begin_s, end_s], side="right") - 1
    counts = np.nan_to_num(np.stack([log.offered[:, column], log.relayed[:, column]]))
    before = counts[:, rows[0]] if rows[0] >= 0 else np.zeros(2)
    offered, delivered = np.maximum(counts[:, max(rows[1], 0)] - before, 0.0)
    return Share(begin_s, end_s, round(float(offered)), round(float(delivered)))


def judge_trial(
    log: LinkLog, trial: LinkTrial, stations: list[Station]
) -> tuple[dict[str, Any], list[str]]:
    """Numbers of a trial, and the reasons against the run.

    What counts as direct ends when a base station takes off; without one it is all of the run.
    """
    end_s = float(log.time[-1])
    left = [station.take_off_s for station in stations if station.take_off_s is not None]
    direct = crossed(log, trial, trial.from_s, min([*left, end_s]))
    numbers: dict[str, Any] = {
        "source": trial.source,
        "destination": trial.destination,
        "stations": [station.vehicle for station in stations],
        "direct": _numbers(direct, trial.direct_limit),
    }
    reasons = list(_against(trial, "directly", direct, -math.inf, trial.direct_limit))
    if stations:
        relayed = crossed(log, trial, _relayed_from_s(stations, end_s), end_s)
        numbers["relayed"] = _numbers(relayed, trial.relayed_limit)
        over = f"with {stations[0].vehicle} up"
        reasons += _against(trial, over, relayed, trial.relayed_limit, math.inf)
    return numbers, reasons


def _numbers(share: Share, limit: float) -> dict[str, Any]:
    return {
        "from_s": share.begin_s,
        "to_s": share.end_s,
        "offered": share.offered,
        "delivered": share.delivered,
        "share": share.share,
        "limit": limit,
    }


def _against(trial: LinkTrial, how: str, share: Share, least: float, most: float) -> Iterator[str]:
    who = f"{trial.source} -> {trial.destination} {how}"
    if share.share is None:
        yield f"{who}: no message was to cross from {share.begin_s:g} s to {share.end_s:g} s"
    elif share.share < least:
        yield f"{who}: {100.0 * share.share:.1f} % delivered, limit {100.0 * least:g} %"
    elif share.share >= most:
        yield f"{who}: {100.0 * share.share:.1f} % delivered, limit below {100.0 * most:g} %"


def add_trial(verdict: Verdict, folder: Path) -> None:
    """Put a trial of links into a verdict, as `link_trial`; nothing of a run without one.

    Args:
        verdict: of the run, so far.
        folder: of the run.
    """
    try:
        trial = read_trial(folder)
        if trial is None:
            return
        log, stations = read_links(folder), read_stations(folder)
    except EvalError as error:
        verdict.reasons.append(str(error))
        return
    if log is None:
        verdict.reasons.append(f"{trial.source} -> {trial.destination}: no links were recorded")
        return
    verdict.numbers["link_trial"], reasons = judge_trial(log, trial, stations)
    verdict.reasons += reasons


def _relayed_from_s(stations: list[Station], end_s: float) -> float:
    """When the first base station is up and has settled [s]; the end of the run if none is."""
    up = [station.up_s for station in stations if station.up_s is not None]
    return min(up) + SETTLING_S if up else end_s


def trial_rows(verdict: dict[str, Any]) -> list[Row]:
    """What crossed without a base station of the air, and with one."""
    trial: dict[str, Any] = verdict.get("link_trial") or {}
    words = (("direct", "directly"), ("relayed", "with base station"))
    return [_trial_row(trial, key, word) for key, word in words if key in trial]


def _trial_row(trial: dict[str, Any], key: str, word: str) -> Row:
    numbers = trial[key]
    share, limit = numbers["share"], numbers["limit"]
    counts = f"{numbers['delivered']} of {numbers['offered']}"
    value = counts if share is None else f"{100.0 * share:.1f} %, {counts}"
    value += f", {numbers['from_s']:.0f} s to {numbers['to_s']:.0f} s"
    is_above = share is not None and share >= limit
    is_satisfied = share is not None and is_above == (key == "relayed")
    held = "below" if key == "direct" else "at least"
    label = f"{trial['source']} -> {trial['destination']} {word}"
    return Row(label, value, f"{held} {100.0 * limit:g} %", is_satisfied)
