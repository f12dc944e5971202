# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from pathlib import Path

import pytest
from trident_tool.view.fixed_frame import (
    Transforms,
    may_be_missing,
    parents_in,
    root_in_place_of_odometry,
)

ROBOT = Path(__file__).parents[2] / "config" / "rviz" / "robot.rviz"
ECHO = """transforms:
  -
    header:
      seq: 0
      stamp:
        secs: 0
        nsecs: 0
      frame_id: "{parent}"
    child_frame_id: "{child}"
    transform:
      translation:
        x: 0.0
---
"""


def echoed(*edges: tuple[str, str]) -> str:
    return "".join(ECHO.format(parent=parent, child=child) for parent, child in edges)


def test_only_odometry_may_be_missing(tmp_path: Path) -> None:
    assert may_be_missing(ROBOT)
    other = tmp_path / "world.rviz"
    other.write_text(ROBOT.read_text("utf-8").replace("Fixed Frame: odom", "Fixed Frame: world"))
    assert not may_be_missing(other)
    assert not may_be_missing(None)


def test_transforms_are_read_as_they_are_echoed() -> None:
    text = echoed(("base_link", "laser"), ("/base_footprint", "/base_link"))
    assert parents_in(text) == {"laser": "base_link", "base_link": "base_footprint"}


@pytest.mark.parametrize(
    ("parents", "root"),
    [
        ({}, None),
        ({"base_link": "odom"}, None),
        ({"odom": "map"}, None),
        ({"a": "base", "b": "a", "d": "c"}, "base"),
    ],
)
def test_the_root_of_the_most_frames_takes_the_place(
    parents: dict[str, str], root: str | None
) -> None:
    assert root_in_place_of_odometry(parents) == root


def test_a_ring_of_frames_has_an_end() -> None:
    assert root_in_place_of_odometry({"a": "b", "b": "a"}) in ("a", "b")


def test_odometry_that_comes_is_not_waited_for(tmp_path: Path) -> None:
    file = tmp_path / "tf"
    file.write_text(echoed(("odom", "base"), ("base", "laser")))
    assert Transforms((file,)).root_in_place_of_odometry(limit_s=1e9) is None
    file.write_text(echoed(("base", "laser")))
    assert Transforms((file,)).root_in_place_of_odometry(limit_s=0.0) == "base"
