# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""From the axes and buttons of a joystick to velocities, as teleop_twist_joy does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from trident_nav.core.errors import NavError
from trident_nav.core.velocity import STOP, Velocity


@dataclass(frozen=True)
class JoystickConfig:
    """Which axis does what.

    Attributes:
        axis_linear: index of the axis for driving.
        axis_angular: index of the axis for turning.
        scale_linear: velocity at full deflection [m/s].
        scale_angular: rate at full deflection [rad/s].
        enable_button: index of the button that has to be held.
        enable_turbo_button: index of the one for `scale_linear_turbo`; -1: none.
        scale_linear_turbo: velocity at full deflection with that one [m/s].
    """

    axis_linear: int = 1
    axis_angular: int = 0
    scale_linear: float = 0.5
    scale_angular: float = 0.5
    enable_button: int = 0
    enable_turbo_button: int = -1
    scale_linear_turbo: float = 1.0

    def validate(self) -> None:
        """Raises NavError."""
        for name in ("axis_linear", "axis_angular", "enable_button"):
            if getattr(self, name) < 0:
                raise NavError(f"{name}: {getattr(self, name)}, legal: 0 or more")
        if self.enable_turbo_button < -1:
            raise NavError(f"enable_turbo_button: {self.enable_turbo_button}, legal: -1 or more")
        for name in ("scale_linear", "scale_angular", "scale_linear_turbo"):
            if not math.isfinite(getattr(self, name)):
                raise NavError(f"{name}: {getattr(self, name)}, legal: finite")


class Joystick:
    """Commands while a button is held, and one stop when it is let go."""

    def __init__(self, config: JoystickConfig) -> None:
        """Nothing is held.

        Raises:
            NavError: an illegal configuration.
        """
        config.validate()
        self._config = config
        self._was_held = False

    def command(self, axes: Sequence[float], buttons: Sequence[int]) -> Velocity | None:
        """What to command now; None: nothing, as neither button is held.

        An axis that the joystick does not have is at rest, a button is not held; so is an axis
        whose value is not finite.
        """
        config = self._config
        turbo = _at(buttons, config.enable_turbo_button)
        is_held = bool(turbo or _at(buttons, config.enable_button))
        was_held, self._was_held = self._was_held, is_held
        if not is_held:
            return STOP if was_held else None
        scale = config.scale_linear_turbo if turbo else config.scale_linear
        turn = config.scale_angular * _at(axes, config.axis_angular)
        return Velocity(scale * _at(axes, config.axis_linear), turn)


def _at(values: Sequence[float], index: int) -> float:
    if not 0 <= index < len(values) or not math.isfinite(values[index]):
        return 0.0
    return float(values[index])
