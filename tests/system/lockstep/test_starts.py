# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident run` of launch files that do not say what is waited for: time zero waits for all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from trident_eval.core.tracks import read_states
from trident_runs import Trident

# A robot with wheels, one with rotors and no controller: none of them is in lockstep.
MIXED = """\
<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/>
  </include>
  <include file="$(find trident_bringup)/launch/robot/ground_robot.launch"/>
  <group ns="firefly">
    <include file="$(find rotors_gazebo)/launch/spawn_mav.launch">
      <arg name="y" value="3"/>
    </include>
  </group>
</launch>
"""
NO_MODEL = """\
<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="gui" value="false"/>
  </include>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -file /nowhere.urdf -model a"/>
</launch>
"""


@pytest.fixture(autouse=True)
def _ends_after_five_seconds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(os.environ, "TRIDENT_END_TIME", "5")


def present_from_the_beginning(trident: Trident, *words: object) -> list[str]:
    outcome = trident("run", *words)
    assert outcome.passed["sim_s"] == pytest.approx(5.0)
    assert outcome.folder is not None
    tracks = read_states(outcome.folder / "states.csv")
    assert tracks.time[0] == pytest.approx(0.05)
    is_there = (tracks.position[0] == tracks.position[0]).all(axis=1)
    return [name for name, there in zip(tracks.names, is_there, strict=True) if there]


def test_nine_vehicles_and_their_controllers_are_there_at_time_zero(trident: Trident) -> None:
    words = ("rotors_gazebo", "firefly_swarm_hovering_example.launch", "gui:=false")
    assert present_from_the_beginning(trident, *words) == [f"firefly{n}" for n in range(1, 10)]


def test_models_of_any_kind_are_waited_for(trident: Trident, tmp_path: Path) -> None:
    path = tmp_path / "mixed.launch"
    path.write_text(MIXED, "utf-8")
    assert present_from_the_beginning(trident, path) == ["firefly", "my_nav_robot"]


def test_a_model_that_cannot_come_ends_the_run(trident: Trident, tmp_path: Path) -> None:
    path = tmp_path / "none.launch"
    path.write_text(NO_MODEL, "utf-8")
    outcome = trident("run", path)
    assert outcome.code == 1
    assert "/spawn has died with exit code 1: model a is not in the world" in outcome.output
