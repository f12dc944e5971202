# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest
from trident_nav.core.errors import NavError
from trident_nav.core.joystick import Joystick, JoystickConfig
from trident_nav.core.velocity import STOP, Velocity

CONFIG = JoystickConfig(enable_button=4, enable_turbo_button=5, scale_linear_turbo=1.5)


def test_nothing_moves_while_no_button_is_held() -> None:
    joystick = Joystick(CONFIG)
    assert joystick.command([1.0, 1.0], [0] * 6) is None
    assert joystick.command([1.0, 1.0], []) is None


def test_axes_are_scaled_and_letting_go_stops_once() -> None:
    joystick = Joystick(CONFIG)
    assert joystick.command([0.5, -1.0], [0, 0, 0, 0, 1, 0]) == Velocity(-0.5, 0.25)
    assert joystick.command([0.5, -1.0], [0] * 6) == STOP
    assert joystick.command([0.5, -1.0], [0] * 6) is None


def test_the_turbo_button_is_enough() -> None:
    assert Joystick(CONFIG).command([0.0, 1.0], [0, 0, 0, 0, 0, 1]) == Velocity(1.5, 0.0)


def test_axes_that_are_not_there_or_not_finite_are_at_rest() -> None:
    held = [0, 0, 0, 0, 1]
    assert Joystick(CONFIG).command([], held) == Velocity(0.0, 0.0)
    assert Joystick(CONFIG).command([math.nan, math.inf], held) == Velocity(0.0, 0.0)


@pytest.mark.parametrize(
    ("config", "what"),
    [
        (JoystickConfig(axis_linear=-1), "axis_linear: -1, legal: 0 or more"),
        (JoystickConfig(enable_turbo_button=-2), "enable_turbo_button: -2, legal: -1 or more"),
        (JoystickConfig(scale_angular=math.inf), "scale_angular: inf, legal: finite"),
    ],
)
def test_bad_configurations_are_refused(config: JoystickConfig, what: str) -> None:
    with pytest.raises(NavError, match=what):
        Joystick(config)
