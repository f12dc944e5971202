# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What runs are judged by, in addition to the flight itself: one Subject each.

A new one is a module with its functions, and a line in SUBJECTS.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trident_eval.core.bridges.client_flights import (
    client_rows,
    judge_client_flights,
    judge_piloted,
    missions_of,
    read_client_record,
)
from trident_eval.core.bridges.nmea import add_nmea, nmea_rows, read_nmea
from trident_eval.core.bridges.nmea_plots import draw_nmea
from trident_eval.core.bridges.plc import judge_plc, plc_rows, read_plc
from trident_eval.core.bridges.plc_plots import draw_plc
from trident_eval.core.mission_plots import draw_missions
from trident_eval.core.missions import (
    judge_missions,
    mission_rows,
    read_missions,
    read_piloted,
)
from trident_eval.core.provenance import read_object
from trident_eval.core.radio.link_plots import draw_links
from trident_eval.core.radio.link_trial import add_trial, read_stations, trial_rows
from trident_eval.core.radio.links import read_links
from trident_eval.core.radio.radio_verdict import add_links, radio_rows
from trident_eval.core.radio.station_plots import draw_stations
from trident_eval.core.rescue import (
    asked_team,
    draw_rescue,
    judge_rescue,
    read_rescue,
    rescue_rows,
    without_end,
)
from trident_eval.core.rows import Row
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Tracks, read_states
from trident_eval.core.verdict import Verdict


@dataclass(frozen=True)
class Subject:
    """Something that a run can be about.

    Attributes:
        judge: from the tracks and the folder of a run, whom to show and the verdict; None where
            the run is about something else.
        add: puts numbers, and reasons against the run, into its verdict; nothing where its
            folder has nothing of the kind. A file that cannot be read is a reason.
        rows: of a verdict's numbers.
        draw: from the run's folder, its scene (None: nothing is known of vehicles) and where the
            files go, the pictures; nothing where the run has nothing of the kind.
        leads: its pictures come before those of the flight.
    """

    rows: Callable[[dict[str, Any]], list[Row]]
    judge: Callable[[Tracks, Path], tuple[list[str], Verdict] | None] | None = None
    add: Callable[[Verdict, Path], None] | None = None
    draw: Callable[[Path, Scene | None, Path], list[Path]] | None = None
    leads: bool = False


def judge_subject(tracks: Tracks, folder: Path) -> tuple[list[str], Verdict] | None:
    """Whom to show of a run, and its verdict; None where it is about no subject, but the flight."""
    for subject in SUBJECTS:
        if subject.judge and (judged := subject.judge(tracks, folder)):
            return judged
    return None


def has_subject_with_vehicles(folder: Path) -> bool:
    """Whether vehicles were to be in a run, as its files have it, though none was seen."""
    readers = (read_rescue, read_client_record, read_piloted, read_missions, read_plc)
    return any(read(folder) for read in readers)


def add_subjects(verdict: Verdict, folder: Path) -> None:
    """Put what else a run was about into its verdict."""
    for subject in SUBJECTS:
        if subject.add:
            subject.add(verdict, folder)


def draw_subjects(source: Path, scene: Scene | None, folder: Path, leads: bool) -> list[Path]:
    """The pictures of what a run was about, of those that lead the flight's or of the others."""
    return [
        picture
        for subject in SUBJECTS
        if subject.draw and subject.leads == leads
        for picture in subject.draw(source, scene, folder)
    ]


def _run(folder: Path) -> dict[str, Any]:
    return read_object(folder / "run.json")


def _judge_rescue(tracks: Tracks, folder: Path) -> tuple[list[str], Verdict] | None:
    if flown := read_rescue(folder):
        verdict = judge_rescue(flown, _run(folder))
        return verdict.numbers["vehicles"], verdict
    names = asked_team(folder)
    if names is None:
        return None
    there = [name for name in names if name in tracks.names]
    return there, without_end(there, _run(folder))


def _draw_rescue(source: Path, _scene: Scene | None, folder: Path) -> list[Path]:
    flown = read_rescue(source)
    return draw_rescue(flown, folder) if flown else []


def _judge_clients(tracks: Tracks, folder: Path) -> tuple[list[str], Verdict] | None:
    if record := read_client_record(folder):
        return list(record), judge_client_flights(tracks, record, _run(folder))
    if piloted := read_piloted(folder):
        return piloted, judge_piloted(tracks, piloted, _run(folder))
    return None


def _judge_missions(tracks: Tracks, folder: Path) -> tuple[list[str], Verdict] | None:
    missions = read_missions(folder)
    if not missions:
        return None
    return [one.name for one in missions], judge_missions(tracks, missions, _run(folder))


def _judge_plc(tracks: Tracks, folder: Path) -> tuple[list[str], Verdict] | None:
    plc = read_plc(folder)
    return ([plc.vessel], judge_plc(tracks, plc, _run(folder))) if plc else None


def _draw_stations(source: Path, scene: Scene | None, folder: Path) -> list[Path]:
    links = read_links(source)
    if not scene or links is None or not (stations := read_stations(source)):
        return []
    tracks = read_states(source / "states.csv")
    return draw_stations(tracks, links, stations, source.resolve().name, folder)


def _draw_missions(source: Path, scene: Scene | None, folder: Path) -> list[Path]:
    """What platforms were to do, by a client or by the run's files, and did."""
    missions = missions_of(read_client_record(source)) or read_missions(source)
    return draw_missions(scene.tracks, missions, scene.title, folder) if scene and missions else []


def _draw_plc(source: Path, scene: Scene | None, folder: Path) -> list[Path]:
    plc = read_plc(source)
    return draw_plc(scene.tracks, plc, scene.title, folder) if scene and plc else []


def _draw_links(source: Path, _scene: Scene | None, folder: Path) -> list[Path]:
    links = read_links(source)
    return draw_links(links, source.resolve().name, folder) if links else []


def _draw_nmea(source: Path, _scene: Scene | None, folder: Path) -> list[Path]:
    return draw_nmea(read_nmea(source), folder)


#: In the order of their rows and pictures; the first that judges a run does.
SUBJECTS = (
    Subject(rescue_rows, judge=_judge_rescue, draw=_draw_rescue, leads=True),
    Subject(trial_rows, add=add_trial, draw=_draw_stations, leads=True),
    Subject(client_rows, judge=_judge_clients),
    Subject(mission_rows, judge=_judge_missions, draw=_draw_missions, leads=True),
    Subject(plc_rows, judge=_judge_plc, draw=_draw_plc, leads=True),
    Subject(nmea_rows, add=add_nmea, draw=_draw_nmea),
    Subject(radio_rows, add=add_links, draw=_draw_links),
)
