# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How a run over ROS is judged by the world's states."""

from __future__ import annotations

import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from trident_benchmarks.nav.barn_ros import judge, launch_text, read_poses, touches
from trident_benchmarks.nav.fields import START, Field
from trident_eval.core.errors import EvalError

BOX = np.array([[-0.2, -0.1], [0.2, -0.1], [0.2, 0.1], [-0.2, 0.1]])
HEADER = "t,name,x,y,z,qx,qy,qz,qw\n"


def straight(count: int, length_m: float) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    x, y, yaw = START
    along = np.linspace(0.0, length_m, count)
    return np.column_stack(
        (x + along * math.cos(yaw), y + along * math.sin(yaw), np.full(count, yaw))
    )


def test_a_run_that_comes_near_the_goal_is_reached_and_timed_from_its_first_motion() -> None:
    poses = np.vstack((straight(20, 0.0), straight(100, 9.5)))
    run = judge(Field(1, (), ()), BOX, 0.05 * np.arange(120), poses, 3)
    assert (run.seed, run.end) == (3, "reached")
    moved = 20 + math.floor(0.1 / 9.5 * 99) + 1
    near = 20 + math.floor(9.0 / 9.5 * 99) + 1
    assert run.time_s == pytest.approx(0.05 * (near - moved))


def test_contact_between_two_states_counts() -> None:
    x, y, _ = START
    field = Field(1, ((x + 0.15, y + 2.0, 0.075),), ())
    assert judge(field, BOX, np.arange(3.0), straight(3, 9.5), 1).end == "collided"
    clear = Field(1, ((x + 0.2, y + 2.0, 0.075),), ())
    assert judge(clear, BOX, np.arange(3.0), straight(3, 9.5), 1).end == "reached"


def test_a_footprint_touches_where_its_corner_or_side_does() -> None:
    def hits(x: float, y: float, yaw: float) -> bool:
        field = Field(1, ((1.0, 1.0, 0.1),), ())
        return touches(field, BOX, np.array([[x, y, yaw]])) is not None

    assert hits(0.75, 1.0, 0.0)
    assert not hits(0.69, 1.0, 0.0)
    assert hits(1.0, 0.75, math.pi / 2)
    assert not hits(1.0, 0.75, 0.0)


def test_states_of_one_model_are_read(tmp_path: Path) -> None:
    file = tmp_path / "states.csv"
    half = math.sqrt(0.5)
    file.write_text(f"{HEADER}0,a,1,2,0,0,0,{half},{half}\n0,b,9,9,0,0,0,0,1\n")
    t_s, poses = read_poses(file, "a")
    assert t_s.tolist() == [0.0]
    assert poses[0] == pytest.approx([1.0, 2.0, math.pi / 2])
    with pytest.raises(EvalError, match="no states of c"):
        read_poses(file, "c")
    file.write_text(f"{HEADER}0,a,1,x,0,0,0,0,1\n")
    with pytest.raises(EvalError, match=r"legal: a states\.csv"):
        read_poses(file, "a")


def test_the_launch_file_is_one(tmp_path: Path) -> None:
    text = launch_text(tmp_path / "a.world", tmp_path, [tmp_path / "p.yaml"], 2)
    root = ElementTree.fromstring(text)
    (node,) = root.findall("node")
    assert node.get("type") == "move_base"
    assert [one.get("file") for one in node.findall("rosparam")] == [str(tmp_path / "p.yaml")]
