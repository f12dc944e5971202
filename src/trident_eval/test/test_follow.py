# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Verdicts of followers, by the records of a leader-follower node."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from runs import NAMES, SPAWN, STATE_PERIOD_S, SUMMARY, Run
from trident_eval.core.flight_records import Command, Refusal, read_command
from trident_eval.core.scene import formation_scene
from trident_eval.core.tracks import read_states
from trident_eval.core.verdict import Verdict, judge
from trident_fleet.core.follow.follow_config import FollowConfig
from trident_fleet.core.follow.follow_record import FollowLog
from trident_fleet.core.follow.followers import Followers
from trident_fleet.core.follow.leader import LeaderState
from trident_fleet.core.quintic import Array
from trident_fleet.core.record import write_record

PERIOD_NS = 100_000_000
START_NS = 300_000_000
WEDGE = np.array([[-1.5, 1.5, 0.0], [-1.5, -1.5, 0.0]])


def leader_at(elapsed_ns: int) -> LeaderState:
    """Around a circle of 5 m, looking ahead."""
    angle = 0.2 * elapsed_ns / 1e9
    c, s = math.cos(angle), math.sin(angle)
    position = np.array([5.0 * s, 5.0 * (1.0 - c), 1.5])
    vectors = np.array([[c, s, 0.0], [-0.2 * s, 0.2 * c, 0.0]])
    return LeaderState(elapsed_ns, position, vectors[0], vectors[1], angle, 0.2)


@dataclass
class Following:
    """A leader and two followers; what belongs to it can be changed before it is written."""

    run: Run
    followers: Followers
    log: FollowLog

    @property
    def counted(self) -> Array:
        """Instants since all have joined."""
        assert self.followers.joined_s is not None
        return self.run.time >= START_NS / 1e9 + self.followers.joined_s

    def verdict(self) -> Verdict:
        self.run.write()
        folder = self.run.folder
        return judge(read_states(folder / "states.csv"), read_command(folder), SUMMARY)


@pytest.fixture
def following(tmp_path: Path) -> Following:
    followers = Followers(SPAWN[1:], FollowConfig(WEDGE))
    log = FollowLog(NAMES[0], NAMES[1:], START_NS)
    for period in range(2, 400):
        elapsed_ns = (period - 1) * PERIOD_NS
        log.add(followers, leader_at(elapsed_ns))
        followers.step(leader_at(elapsed_ns), elapsed_ns, period * PERIOD_NS)
    for record in log.records({}):
        write_record(tmp_path, record)
    own = {
        "vehicle": NAMES[0],
        "vehicles": NAMES[:1],
        "mode": "time",
        "rows": [],
        "error": "its own",
    }
    (tmp_path / f"formation_{NAMES[0]}.json").write_text(json.dumps(own))
    time = START_NS / 1e9 + STATE_PERIOD_S * np.arange(797)
    states = []
    for elapsed_s in time - START_NS / 1e9:
        leader = leader_at(round(elapsed_s * 1e9))
        states.append(np.concatenate([leader.position[None], followers.ideal(leader).position[0]]))
    return Following(Run(tmp_path, np.empty(0), time, np.array(states)), followers, log)


def test_followers_in_their_places_pass_by_the_leader_that_was_measured(
    following: Following,
) -> None:
    verdict = following.verdict()
    assert verdict.reasons == []
    numbers = verdict.to_json()
    assert numbers["mode"] == "follow"
    assert numbers["vehicles"] == NAMES
    assert numbers["rows_flown"] == numbers["rows"] > 20
    assert numbers["tracking_rms_m"] < 0.005
    assert numbers["min_separation_m"] == pytest.approx(1.5 * math.sqrt(2.0), abs=1e-3)


def test_what_was_before_all_had_joined_does_not_count(following: Following) -> None:
    following.run.position[~following.counted, 1:] += [0.0, 0.0, 3.0]
    assert following.verdict().reasons == []


def test_a_follower_that_lags_fails(following: Following) -> None:
    following.run.position[following.counted, 2] -= [0.25, 0.0, 0.0]
    verdict = following.verdict()
    assert any("formation RMS" in reason for reason in verdict.reasons)
    assert any("rows flown" in reason for reason in verdict.reasons)


def test_followers_that_never_joined_are_reported(following: Following, tmp_path: Path) -> None:
    for record in FollowLog(NAMES[0], NAMES[1:], START_NS, error="no path").records({}):
        write_record(tmp_path, record)
    assert isinstance(read_command(tmp_path), Refusal)
    assert following.verdict().reasons == ["no path"]


def test_the_picture_shows_the_places(following: Following) -> None:
    following.run.write()
    command = read_command(following.run.folder)
    assert isinstance(command, Command)
    scene = formation_scene("run", read_states(following.run.folder / "states.csv"), command)
    error = scene.tracking_error()
    assert error is not None
    assert scene.counted_s is not None
    assert error[following.counted].max() < 0.01
