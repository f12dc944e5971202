#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Puts a robot with an RGB-D camera into a world and writes what it sees, color next to depth.

Without ROS and without a display:

    ./trident shell
    src/trident_sim_py/examples/robot_camera.py --world hall --at -2 0 0.6 --out seen.png
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import matplotlib as mpl
import numpy as np
import numpy.typing as npt
from PIL import Image

import trident_sim

WORLD = "package://trident_bringup/worlds/{}.world"
ROBOT = "package://trident_description/urdf/my_nav_robot.urdf.xacro"
SETTLE_S = 1.0

Colors = npt.NDArray[np.uint8]


def color_depths(depths: npt.NDArray[np.float32], farthest_m: float) -> Colors:
    """Near is bright, nothing is black.

    Args:
        depths: [m], shape (height, width); nan or inf: nothing.
        farthest_m: what is darkest [m].

    Returns:
        Red, green, blue, shape (height, width, 3).
    """
    seen = np.isfinite(depths)
    share = np.clip(np.where(seen, depths, 0.0) / farthest_m, 0.0, 1.0)
    colors = mpl.colormaps["viridis_r"](share)[..., :3]
    return (255.0 * np.where(seen[..., None], colors, 0.0)).astype(np.uint8)


def see(world_name: str, place: tuple[float, float, float]) -> Colors:
    """Color next to depth, shape (height, 2 width, 3).

    Args:
        world_name: of a file in worlds/.
        place: of the robot: x, y [m] and yaw [rad].
    """
    world = trident_sim.World(WORLD.format(world_name))
    x, y, yaw = place
    urdf = trident_sim.expand_xacro(trident_sim.find_resource(ROBOT))
    world.spawn("robot", urdf=urdf, pose=(x, y, 0.01, 0.0, 0.0, yaw))
    color = world.ports["robot/camera/rgb/image_raw"]
    depth = world.ports["robot/camera/depth/image_raw"]
    color.subscribe()
    depth.subscribe()
    world.step(math.ceil(SETTLE_S / world.dt))
    return np.concatenate([color.value.pixels, color_depths(depth.value.pixels, 8.0)], axis=1)


def main() -> None:
    """Write the picture that the arguments ask for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--world", default="room", help="name of a file in worlds/")
    parser.add_argument(
        "--at", nargs=3, type=float, default=(0.0, 0.0, 0.0), metavar=("X", "Y", "YAW")
    )
    parser.add_argument("--out", type=Path, default=Path("seen.png"), help="PNG to write")
    arguments = parser.parse_args()
    Image.fromarray(see(arguments.world, tuple(arguments.at))).save(arguments.out)


if __name__ == "__main__":
    main()
