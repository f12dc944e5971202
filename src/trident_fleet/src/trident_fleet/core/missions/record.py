# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What robots did in a mission, for verdicts and pictures; as a file, too."""

from __future__ import annotations

import base64
import json
import math
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from trident_fleet.core.missions.mission import Mission
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.missions.setup import Outcome, Setup
from trident_fleet.core.missions.truth import PersonState
from trident_fleet.core.search.area import Array, Mask, SearchError


@dataclass(frozen=True)
class Work:
    """A robot at a task: its kind, from and to when [s]."""

    robot: str
    task_id: str
    kind: str
    begin_s: float
    end_s: float


@dataclass
class Record:
    """What robots did.

    Attributes:
        tracks: places by robot, one a step, p_common [m].
        work: tasks in the order in which they ended.
        coverage: time [s] and share of the cells that were covered, now and then.
        covered: cells that were covered at the end.
    """

    tracks: dict[str, list[Place]] = field(default_factory=dict)
    work: list[Work] = field(default_factory=list)
    coverage: list[tuple[float, float]] = field(default_factory=list)
    covered: Mask | None = None
    _current: dict[str, Work] = field(default_factory=dict)

    def note(self, mission: Mission) -> None:
        """Take in how things stand after a step."""
        for name, crew in mission.crews.items():
            if crew.alive:
                self.tracks.setdefault(name, []).append(crew.vehicle.place)
            held = crew.robot.task() if crew.alive else None
            task = (held.job.task.task_id, held.job.task.kind) if held is not None else None
            self.note_task(name, mission.now_s, task)
        self.coverage.append((mission.now_s, mission.truth.coverage.share()))

    def note_task(self, name: str, now_s: float, task: tuple[str, str] | None) -> None:
        """What a robot is at from now on: name and kind of the task; None: it has none."""
        last = self._current.get(name)
        if last is not None and (task is None or last.task_id != task[0]):
            self.work.append(Work(name, last.task_id, last.kind, last.begin_s, now_s))
            del self._current[name]
        if task is not None and name not in self._current:
            self._current[name] = Work(name, *task, now_s, math.inf)

    def end(self, mission: Mission) -> None:
        """Take in the end."""
        for name in list(self._current):
            self.note_task(name, mission.now_s, None)
        self.covered = mission.truth.coverage.covered()


@dataclass(frozen=True)
class Flown:
    """A mission that has ended, as its file has it.

    Attributes:
        scene_file: record of what was searched.
        setup: team, method, links, seed and faults.
        whole: whether the mission had all the time that its file gives it.
        outcome: how it ended.
        record: what robots did.
        people: what became of those who were to be found.
        places: where they are at the end, p_common [m], shape (N, 2).
    """

    scene_file: Path
    setup: Setup
    whole: bool
    outcome: Outcome
    record: Record
    people: list[PersonState]
    places: Array


def write_flown(path: Path, flown: Flown) -> None:
    """Write the file.

    Raises:
        SearchError: it cannot be written.
    """
    record, covered = flown.record, flown.record.covered
    assert covered is not None
    states = ("name", "domain", "found_s", "confirmed_s", "served_s")
    content = {
        "scene": str(flown.scene_file),
        "setup": asdict(flown.setup),
        "whole": flown.whole,
        "outcome": asdict(flown.outcome),
        "people": [
            {key: getattr(one, key) for key in states} | {"place": place}
            for one, place in zip(flown.people, flown.places.tolist(), strict=True)
        ],
        "work": [asdict(one) for one in record.work],
        "coverage": record.coverage,
        "tracks": record.tracks,
        "shape": list(covered.shape),
        "covered": base64.b64encode(np.packbits(covered).tobytes()).decode(),
    }
    text = json.dumps(content, allow_nan=False)
    try:
        path.write_text(text + "\n", encoding="utf-8")
    except OSError as error:
        raise SearchError(f"{path}: cannot be written: {error.strerror}") from None


def read_flown(path: Path) -> Flown:
    """Read the file.

    Raises:
        SearchError: it cannot be read, or is not what `write_flown` writes.
    """
    try:
        return _flown(json.loads(path.read_text(encoding="utf-8")))
    except OSError as error:
        raise SearchError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise SearchError(
            f"{path}: {type(error).__name__}: {error}; legal: what the node of a search and rescue"
            " writes"
        ) from None


def _setup(content: dict[str, Any]) -> Setup:
    setup = dict(content)
    for key in ("deaths", "silences"):
        setup[key] = tuple(tuple(one) for one in setup[key])
    return Setup(**setup)


def _record(content: dict[str, Any]) -> Record:
    rows, columns = content["shape"]
    bits = np.frombuffer(base64.b64decode(content["covered"]), dtype=np.uint8)
    covered = np.unpackbits(bits, count=rows * columns).astype(bool).reshape(rows, columns)
    return Record(
        {name: [(x, y) for x, y in track] for name, track in content["tracks"].items()},
        [Work(**one) for one in content["work"]],
        [(time_s, share) for time_s, share in content["coverage"]],
        covered,
    )


def _flown(content: dict[str, Any]) -> Flown:
    setup, outcome = _setup(content["setup"]), dict(content["outcome"])
    for key in ("find_s", "curve", "lost"):
        outcome[key] = tuple(outcome[key])
    record = _record(content)
    people = [dict(one) for one in content["people"]]
    places = np.array([one.pop("place") for one in people], dtype=float).reshape(-1, 2)
    return Flown(
        Path(content["scene"]),
        setup,
        bool(content["whole"]),
        Outcome(**outcome),
        record,
        [PersonState(**one) for one in people],
        places,
    )
