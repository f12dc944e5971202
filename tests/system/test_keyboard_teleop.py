# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A robot driven from a terminal, which here is a pty."""

from __future__ import annotations

import os
import pty
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from geometry_msgs.msg import Twist
from harness import LIMIT_S, Launch, Ros, eventually, program, recorder

TELEOP = program("teleop_twist_keyboard", "teleop_twist_keyboard.py")


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """Both ends of a pty: where keys are pressed, and what the node reads."""
    ends = pty.openpty()
    yield ends
    for end in ends:
        os.close(end)


def test_keys_drive_the_robot_and_ctrl_c_stops_it(
    ros: Ros, launch: Callable[..., Launch], terminal: tuple[int, int], tmp_path: Path
) -> None:
    run = launch("trident_bringup", "robot_in_room.launch", real_time_factor=None)
    run.spawned("my_nav_robot")
    keys, stdin = terminal
    log_file = tmp_path / "teleop.log"
    with log_file.open("w") as log:
        # No timeout: a key holds until the next one.
        node = ros.start([TELEOP, "_speed:=0.4", "_key_timeout:=0"], stdin=stdin, stdout=log)
    eventually(lambda: "currently" in log_file.read_text(), "the node's help")
    with recorder("/cmd_vel", Twist) as sent:

        def press(key: str) -> None:
            os.write(keys, key.encode())

        def heard(v: float, w: float) -> bool:
            return any((m.linear.x, m.angular.z) == (v, w) for m in sent.messages)

        def is_ahead() -> bool:
            # Again, for the simulator may not have been connected the first time.
            press("i")
            return run.position("my_nav_robot")[0] > 0.3

        eventually(is_ahead, "motion ahead")
        assert heard(0.4, 0.0)
        press("j")
        eventually(lambda: heard(0.0, 1.0), "a turn")
        os.write(keys, b"\x03")
        assert node.wait(LIMIT_S) == 0
        eventually(
            lambda: (sent.messages[-1].linear.x, sent.messages[-1].angular.z) == (0.0, 0.0),
            "a stop",
        )


def test_without_a_terminal_it_says_so(ros: Ros) -> None:
    with Path(os.devnull).open() as nothing:
        code, output = ros.run([TELEOP], stdin=nothing)
    assert code == 1
    assert "standard input is not a terminal" in output
