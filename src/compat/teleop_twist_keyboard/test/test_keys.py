# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Keys become velocities."""

from __future__ import annotations

import math

import pytest
from keyboard_teleop.keys import MOVES, Driver, Velocity


@pytest.mark.parametrize(
    ("key", "velocity"),
    [
        ("i", Velocity(x=0.5)),
        (",", Velocity(x=-0.5)),
        ("j", Velocity(yaw=1.0)),
        ("l", Velocity(yaw=-1.0)),
        ("u", Velocity(x=0.5, yaw=1.0)),
        ("o", Velocity(x=0.5, yaw=-1.0)),
        ("m", Velocity(x=-0.5, yaw=-1.0)),
        (".", Velocity(x=-0.5, yaw=1.0)),
        ("J", Velocity(y=0.5)),
        ("t", Velocity(z=0.5)),
    ],
)
def test_a_key_moves(key: str, velocity: Velocity) -> None:
    driver = Driver()
    driver.press(key)
    assert driver.velocity == velocity


@pytest.mark.parametrize("key", ["k", " ", "", "9", "\x1b"])
def test_other_keys_and_none_stop(key: str) -> None:
    driver = Driver()
    driver.press("i")
    driver.press(key)
    assert driver.velocity == Velocity()
    assert not driver.moves


def test_speeds_change_by_a_tenth_and_keep_the_direction() -> None:
    driver = Driver()
    driver.press("u")
    for key, speed, turn in [("q", 0.55, 1.1), ("x", 0.495, 1.1), ("c", 0.495, 0.99)]:
        assert driver.press(key)
        assert (driver.speed, driver.turn) == (pytest.approx(speed), pytest.approx(turn))
    assert driver.velocity == Velocity(x=driver.speed, yaw=driver.turn)


def test_limits_hold() -> None:
    driver = Driver(speed_limit=0.6, turn_limit=1.05)
    for _ in range(5):
        driver.press("q")
    assert (driver.speed, driver.turn) == (0.6, 1.05)


@pytest.mark.parametrize("speed", [0.0, -1.0, math.nan, math.inf])
def test_a_bad_speed_is_named(speed: float) -> None:
    with pytest.raises(ValueError, match=r"~speed is .*, legal: a finite number > 0"):
        Driver(speed=speed)


def test_speeds_cannot_grow_into_what_is_no_number() -> None:
    with pytest.raises(ValueError, match=r"~turn_limit is inf, legal: a finite number > 0"):
        Driver(turn_limit=math.inf)


def test_opposite_keys_are_opposite() -> None:
    for one, other in [("i", ","), ("j", "l"), ("J", "L"), ("U", ">"), ("O", "M"), ("t", "b")]:
        assert MOVES[one] == tuple(-value for value in MOVES[other])
