# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whether platforms of any kind have reached the places of their missions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.errors import EvalError
from trident_eval.core.metrics import lengths
from trident_eval.core.provenance import read_object
from trident_eval.core.rows import Row, value_text
from trident_eval.core.tracks import Array, Tracks
from trident_eval.core.verdict import Verdict, run_numbers, take_over

_AXES = {"uav": 3, "ugv": 2, "usv": 2}


@dataclass(frozen=True)
class Mission:
    """What one platform was to do.

    Attributes:
        name: of its model.
        kind: `uav`, `ugv` or `usv`.
        start: where it starts [m, world], shape (3,).
        places: to be reached one after the other [m, world], shape (n, d); d is 2 but for a UAV: 3.
        reach_m: a place is reached this near.
        limit_m: of the tracking error; NaN: it has none.
    """

    name: str
    kind: str
    start: Array
    places: Array
    reach_m: float
    limit_m: float

    @property
    def path(self) -> Array:
        """From the start through all places [m, world], shape (n + 1, d)."""
        return np.concatenate([self.start[None, : self.places.shape[1]], self.places])


@dataclass(frozen=True)
class Outcome:
    """What became of a mission.

    Attributes:
        mission: which.
        reached: how many of its places were reached, in their order.
        done_s: when the last of all was reached; None: it was not.
        error: distance to the leg that was to be followed until then [m], shape (m,).
        time: of these [s], shape (m,).
    """

    mission: Mission
    reached: int
    done_s: float | None
    error: Array
    time: Array

    @property
    def rms_m(self) -> float | None:
        """Root mean square of the error."""
        return float(np.sqrt((self.error**2).mean())) if len(self.error) else None


def read_missions(folder: Path) -> list[Mission]:
    """Those of a run: every namespace with a `mission` of places in its params.json, by name.

    Raises:
        EvalError: one that is not what platforms.launch makes.
    """
    return [
        _mission(f"{folder}/params.json: /{name}/mission", name, values)
        for name, values in _platforms(folder)
        if _has_places(values["mission"])
    ]


def read_piloted(folder: Path) -> list[str]:
    """Platforms of a run that somebody from outside commands, by name."""
    return [name for name, values in _platforms(folder) if not _has_places(values["mission"])]


def _platforms(folder: Path) -> list[tuple[str, dict[str, Any]]]:
    parameters = read_object(folder / "params.json").get("parameters") or {}
    return [
        (name, values)
        for name, values in sorted(parameters.items())
        if isinstance(values, dict) and isinstance(values.get("mission"), dict)
    ]


def _has_places(mission: dict[str, Any]) -> bool:
    """A platform of another pilot than a mission's file has its kind and its start alone."""
    return not mission.keys() <= {"kind", "start"}


def _mission(where: str, name: str, values: dict[str, Any]) -> Mission:
    given = values["mission"]
    try:
        if given["kind"] not in _AXES:
            raise ValueError(f"kind '{given['kind']}'")
        axes = _AXES[given["kind"]]
        x, y, z, yaw = (float(value) for value in given["start"])
        ahead = np.zeros((len(given["waypoints"]), 3))
        for index, place in enumerate(given["waypoints"]):
            ahead[index, :axes] = place[:axes]
        c, s = math.cos(yaw), math.sin(yaw)
        places = np.array([x, y, z]) + ahead @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
        return Mission(
            name,
            given["kind"],
            np.array([x, y, z]),
            places[:, :axes],
            float(given["reach"]),
            float(given["tracking_limit"]),
        )
    except (KeyError, TypeError, ValueError) as error:
        raise EvalError(
            f"{where}: {type(error).__name__}: {error}; legal: kind uav, ugv or usv, start "
            "[x, y, z, yaw], waypoints, reach, tracking_limit"
        ) from error


def follow(tracks: Tracks, mission: Mission) -> Outcome:
    """Compare where a platform was with its mission."""
    axes = mission.places.shape[1]
    track = tracks.select([mission.name]).position[:, 0, :axes]
    present = np.isfinite(track).all(axis=1)
    track, time = track[present], tracks.time[present]
    path, errors = mission.path, np.full(len(track), np.nan)
    reached, done = 0, None
    for index, place in enumerate(track):
        # Corners are cut: the leg before counts, too.
        legs = range(max(reached - 1, 0), min(reached + 1, len(mission.places)))
        errors[index] = min(_to_leg(place, path[leg], path[leg + 1]) for leg in legs)
        while (
            reached < len(mission.places)
            and float(np.linalg.norm(place - mission.places[reached])) <= mission.reach_m
        ):
            reached += 1
        if reached == len(mission.places):
            done = float(time[index])
            return Outcome(mission, reached, done, errors[: index + 1], time[: index + 1])
    return Outcome(mission, reached, done, errors, time)


def _to_leg(place: Array, begin: Array, end: Array) -> float:
    along = end - begin
    square = float(along @ along)
    share = float((place - begin) @ along) / square if square > 0.0 else 0.0
    return float(np.linalg.norm(place - begin - min(max(share, 0.0), 1.0) * along))


def judge_missions(tracks: Tracks, missions: list[Mission], run: dict[str, Any]) -> Verdict:
    """Judge a run of missions.

    Args:
        tracks: where everything was.
        missions: what was to be done.
        run: the simulator's run.json; may be empty.
    """
    verdict = Verdict(
        {"mode": "missions", "vehicles": [mission.name for mission in missions], "platforms": {}}
    )
    verdict.numbers |= run_numbers(run)
    for mission in missions:
        outcome = follow(tracks, mission)
        verdict.numbers["platforms"][mission.name] = _numbers(outcome, tracks)
        verdict.reasons += _reasons(outcome, tracks)
    take_over(run, verdict)
    return verdict


def _numbers(outcome: Outcome, tracks: Tracks) -> dict[str, Any]:
    mission = outcome.mission
    track = tracks.select([mission.name]).position[:, 0]
    track = track[np.isfinite(track).all(axis=1)]
    return {
        "kind": mission.kind,
        "waypoints": len(mission.places),
        "waypoints_reached": outcome.reached,
        "done_s": outcome.done_s,
        "tracking_rms_m": outcome.rms_m,
        "tracking_max_m": float(outcome.error.max()) if len(outcome.error) else None,
        "tracking_limit_m": mission.limit_m,
        "path_m": float(lengths(np.diff(track, axis=0)).sum()),
    }


def _reasons(outcome: Outcome, tracks: Tracks) -> list[str]:
    mission, reasons = outcome.mission, []
    name = mission.name
    present = np.isfinite(tracks.select([name]).position[:, 0]).all(axis=1)
    if not present.any():
        return [f"{name}: no states"]
    if not present[-1]:
        reasons.append(f"{name}: no finite state after {tracks.time[present][-1]:.2f} s")
    if outcome.reached < len(mission.places):
        reasons.append(f"{name}: {outcome.reached} of {len(mission.places)} waypoints reached")
    rms = outcome.rms_m
    if rms is None or rms > mission.limit_m:
        reasons.append(f"{name}: tracking RMS {rms or math.nan:.3f} m, limit {mission.limit_m:g} m")
    return reasons


def mission_rows(verdict: dict[str, Any]) -> list[Row]:
    """What each platform of a run of missions did."""
    platforms: dict[str, dict[str, Any]] = verdict.get("platforms") or {}
    return [_platform_row(name, numbers) for name, numbers in platforms.items()]


def _platform_row(name: str, numbers: dict[str, Any]) -> Row:
    rms, limit = numbers["tracking_rms_m"], numbers["tracking_limit_m"]
    places = f"{numbers['waypoints_reached']} of {numbers['waypoints']} waypoints"
    done = f" in {numbers['done_s']:.1f} s" if numbers["done_s"] is not None else ""
    is_satisfied = numbers["done_s"] is not None and rms is not None and rms <= limit
    error = "unknown" if rms is None else value_text(rms, "m")
    value = f"{places}{done}, tracking RMS {error}"
    return Row(name, value, f"all, at most {value_text(limit, 'm')}", is_satisfied)
