# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Footprint and limits of a robot, from its file in config/nav/robots."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
import yaml
from trident_eval.core.errors import EvalError


class RobotLimits:
    """What a judge of drives needs to know of a robot."""

    def __init__(self, file: Path) -> None:
        """Read a file of config/nav/robots.

        Raises:
            EvalError: footprint or limits are missing.
        """
        tree = yaml.safe_load(file.read_text(encoding="utf-8"))
        limits = next((v for v in tree.values() if isinstance(v, dict) and "max_vel_x" in v), None)
        if limits is None:
            raise EvalError(f"{file}: max_vel_x is missing, legal: in the map of a local planner")
        self.speed = float(limits["max_vel_x"])
        self.turning_rate = float(limits["max_vel_theta"])
        #: It turns on the spot, and does not move sideways.
        self.drives_straight = not (limits.get("min_turning_radius") or limits.get("max_vel_y"))
        self.tolerance_m = float(limits.get("xy_goal_tolerance", 0.1))
        self.tolerance_rad = float(limits.get("yaw_goal_tolerance", 0.1))
        costmap = tree.get("local_costmap", {})
        self.corners = _corners(costmap, file)
        self.inscribed_m, self.circumscribed_m = _radii(costmap, self.corners)


def _corners(costmap: dict[str, object], file: Path) -> npt.NDArray[np.float64]:
    """Of the footprint, shape (n, 2) [m]; of the square around a circle."""
    if "robot_radius" in costmap:
        radius = float(str(costmap["robot_radius"]))
        return radius * np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    if "footprint" not in costmap:
        raise EvalError(f"{file}: local_costmap has neither footprint nor robot_radius")
    return np.array(costmap["footprint"], dtype=float)


def _radii(costmap: dict[str, object], corners: npt.NDArray[np.float64]) -> tuple[float, float]:
    if "robot_radius" in costmap:
        radius = float(str(costmap["robot_radius"]))
        return radius, radius
    following = np.roll(corners, -1, axis=0)
    edges = following - corners
    along = np.clip(-np.sum(corners * edges, axis=1) / np.sum(edges**2, axis=1), 0.0, 1.0)
    nearest = np.linalg.norm(corners + along[:, None] * edges, axis=1)
    return float(nearest.min()), float(np.linalg.norm(corners, axis=1).max())
