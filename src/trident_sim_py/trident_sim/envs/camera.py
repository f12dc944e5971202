# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The camera that `render` looks through."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_sim._core import Error
from trident_sim.world import World

_NAME = "onlooker"
_PORT = f"{_NAME}/eye/image_raw"


@dataclass(frozen=True)
class View:
    """Where a camera stands, and what it looks at.

    Attributes:
        eye: p_world [m].
        target: p_world of the middle of the picture [m].
        fov: horizontal [rad].
        width: [pixels].
        height: [pixels].
    """

    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    fov: float = 1.0
    width: int = 320
    height: int = 240

    def pose(self) -> tuple[float, ...]:
        """Of the camera: x y z roll pitch yaw [m, rad]."""
        x, y, z = (b - a for a, b in zip(self.eye, self.target, strict=True))
        return (*self.eye, 0.0, -math.atan2(z, math.hypot(x, y)), math.atan2(y, x))


def add_camera(world: World, view: View) -> None:
    """Put a camera into a world; as long as nobody looks through it, it costs nothing."""
    sdf = f"""<sdf version="1.6"><model name="{_NAME}"><static>true</static><link name="link">
<sensor name="eye" type="camera"><update_rate>0</update_rate><camera>
<horizontal_fov>{view.fov}</horizontal_fov>
<image><width>{view.width}</width><height>{view.height}</height></image></camera>
<plugin name="eye" filename="libtrident_camera.so"/></sensor></link></model></sdf>"""
    world.spawn(_NAME, sdf=sdf, pose=view.pose())


def picture(world: World) -> npt.NDArray[np.uint8]:
    """What the camera sees, shape (height, width, 3); the world is afterwards as it was.

    Raises:
        Error: the world has no such camera.
    """
    if _PORT not in world.ports:
        raise Error(f"render: the world has no port '{_PORT}'")
    snapshot, port = world.save_snapshot(), world.ports[_PORT]
    port.subscribe()
    try:
        world.step()
        return np.asarray(port.value.pixels)
    finally:
        port.unsubscribe()
        world.restore_snapshot(snapshot)
