# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a search and rescue in the simulator has achieved, by the record that its node leaves."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from trident_fleet.core.errors import FormationError
from trident_fleet.core.missions.setup import MODES, RECORD, names_of

from trident_eval.core.errors import EvalError
from trident_eval.core.provenance import read_object
from trident_eval.core.rows import Row
from trident_eval.core.verdict import Verdict, run_numbers, take_over
from trident_eval.mission.goals import goals_of, missed_goals

if TYPE_CHECKING:
    from trident_fleet.core.missions.record import Flown

MODE = "search and rescue"
MAP, TIMES = "search_map.png", "search_times.png"


def read_rescue(folder: Path) -> Flown | None:
    """The record of a run; None: it has left no record.

    Raises:
        EvalError: it is not what the node writes.
    """
    path = folder / RECORD
    if not path.is_file():
        return None
    # Imported here, as below: it takes a while, and most runs are about something else.
    from trident_fleet.core.missions.record import read_flown

    try:
        return read_flown(path)
    except FormationError as error:
        raise EvalError(str(error)) from None


def asked_team(folder: Path) -> list[str] | None:
    """Robots of a run that was to be a search and rescue; None: it was not."""
    parameters = read_object(folder / "params.json").get("parameters") or {}
    given = parameters.get("search_and_rescue")
    if not isinstance(given, dict):
        return None
    mode = given.get("mode")
    return names_of(mode) if mode in MODES else []


def without_end(names: list[str], run: dict[str, Any]) -> Verdict:
    """The verdict of a mission that left no record.

    Args:
        names: of its robots.
        run: the simulator's run.json; may be empty.
    """
    numbers = {"mode": MODE, "vehicles": names} | run_numbers(run)
    verdict = Verdict(numbers, [f"no {RECORD}: the mission did not come to its end"])
    take_over(run, verdict)
    return verdict


def judge_rescue(flown: Flown, run: dict[str, Any]) -> Verdict:
    """Judge a run.

    Args:
        flown: what its record has.
        run: the simulator's run.json; may be empty.
    """
    setup, outcome = flown.setup, flown.outcome
    goals = goals_of(setup, flown.whole)
    numbers: dict[str, Any] = {
        "mode": MODE,
        "vehicles": names_of(setup.mode),
        "team": setup.mode,
        "method": setup.method,
        "links": setup.links,
        "end_s": outcome.end_s,
        "complete": outcome.complete,
        **{name: getattr(outcome, name) for name in ("coverage", "people", "found", "confirmed")},
        **{name: getattr(outcome, name) for name in ("served", "sectors", "value", "contacts")},
        "value_per_minute": outcome.efficiency,
        "messages": outcome.messages,
        "path_m": outcome.path_m,
        "lost": list(outcome.lost),
        "limits": goals,
    }
    verdict = Verdict(numbers | run_numbers(run), missed_goals(outcome, goals))
    take_over(run, verdict)
    return verdict


def rescue_rows(verdict: dict[str, Any]) -> list[Row]:
    """What a run of a team came to; nothing where it was about something else."""
    if verdict.get("mode") != MODE or "team" not in verdict:
        return []
    rows = [Row("team", f"{verdict['team']}, {verdict['method']}, links: {verdict['links']}")]
    rows.append(Row("mission ended at", f"{verdict['end_s']:.1f} s"))
    rows += _share_rows(verdict)
    rows.append(Row("value per minute", f"{verdict['value_per_minute']:.2f}"))
    rows.append(Row("contacts", str(verdict["contacts"]), "none", not verdict["contacts"]))
    rows.append(Row("messages", str(verdict["messages"])))
    return rows + [Row("lost", text) for text in verdict["lost"]]


def _share_rows(verdict: dict[str, Any]) -> list[Row]:
    """Coverage, and how many people were found and served, with their limits."""
    people, rows = verdict["people"], []
    shown = {
        "coverage": f"{100 * verdict['coverage']:.1f} %",
        "found": f"{verdict['found']} of {people}",
        "served": f"{verdict['served']} of {people}",
    }
    shares = {"coverage": verdict["coverage"]}
    shares |= {name: verdict[name] / max(people, 1) for name in ("found", "served")}
    for name, text in shown.items():
        least = verdict["limits"].get(name)
        limit = "" if least is None else f"at least {100 * least:g} %"
        rows.append(Row(name, text, limit, None if least is None else shares[name] >= least))
    return rows


def draw_rescue(flown: Flown, folder: Path) -> list[Path]:
    """The map with all tracks, and coverage and tasks over time.

    Raises:
        EvalError: the coast's record cannot be read.
    """
    from trident_fleet.core.missions.scene import read_scene

    from trident_eval.mission.pictures import MapEnd, draw_map, draw_times

    try:
        scene = read_scene(flown.scene_file)
    except FormationError as error:
        raise EvalError(str(error)) from None
    draw_map(folder / MAP, flown.record, MapEnd(scene, flown.people, flown.places))
    draw_times(folder / TIMES, flown.record)
    return [folder / MAP, folder / TIMES]
