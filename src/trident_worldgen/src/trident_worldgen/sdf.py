# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""SDF text of static shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from trident_sim import Error

LICENCE = (
    "<!-- SPDX-FileCopyrightText: 2026 The Trident authors -->\n"
    "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
)
_GAZEBO_MATERIALS = "file://media/materials/scripts/gazebo.material"

_GROUND_PLANE = """    <include>
      <uri>model://ground_plane</uri>
    </include>
"""

Point = tuple[float, float, float]
Files = dict[str, str | bytes]
"""Contents by path, relative to the folder that they are written to."""


@dataclass(frozen=True)
class Material:
    """One of Gazebo's materials, by name."""

    name: str

    def text(self) -> str:
        """As an element of a visual."""
        script = f"<uri>{_GAZEBO_MATERIALS}</uri><name>{self.name}</name>"
        return f"<material><script>{script}</script></material>"


@dataclass(frozen=True)
class Picture:
    """A picture on each face of a box, and the color where pictures are not shown."""

    uri: str
    color: tuple[float, float, float]

    def text(self) -> str:
        """As an element of a visual."""
        color = f"{_numbers(self.color)} 1"
        return (
            f"<material><ambient>{color}</ambient><diffuse>{color}</diffuse>"
            f"<pbr><metal><albedo_map>{self.uri}</albedo_map></metal></pbr></material>"
        )


@dataclass(frozen=True)
class Color:
    """Red, green, blue, each 0 to 1."""

    rgb: tuple[float, float, float]

    def text(self) -> str:
        """As an element of a visual."""
        color = f"{_numbers(self.rgb)} 1"
        return f"<material><ambient>{color}</ambient><diffuse>{color}</diffuse></material>"


Appearance = Material | Picture | Color


@dataclass
class StaticModel:
    """Shapes that never move, seen and touched alike."""

    name: str
    parts: list[str] = field(default_factory=list)

    def box(
        self,
        name: str,
        size: Point,
        center: Point,
        material: Appearance,
        *,
        yaw: float = 0.0,
        solid: bool = True,
    ) -> None:
        """Add a box: size and center [m], yaw [rad]; one that is not solid is only seen."""
        geometry = f"<box><size>{_numbers(size)}</size></box>"
        self._add(name, geometry, center, yaw, material, solid)

    def cylinder(
        self, name: str, radius: float, length: float, center: Point, material: Appearance
    ) -> None:
        """Add an upright cylinder: radius, length and center [m]."""
        geometry = (
            f"<cylinder><radius>{_number(radius)}</radius>"
            f"<length>{_number(length)}</length></cylinder>"
        )
        self._add(name, geometry, center, 0.0, material, True)

    def sphere(self, name: str, radius: float, center: Point, material: Appearance) -> None:
        """Add a sphere: radius and center [m]."""
        geometry = f"<sphere><radius>{_number(radius)}</radius></sphere>"
        self._add(name, geometry, center, 0.0, material, True)

    def mesh(
        self,
        name: str,
        uri: str,
        scale: Point,
        origin: Point,
        material: Appearance,
        *,
        yaw: float = 0.0,
    ) -> None:
        """Add a mesh by its file: scale, where its origin is [m], and yaw [rad]."""
        geometry = f"<mesh><uri>{uri}</uri><scale>{_numbers(scale)}</scale></mesh>"
        self._add(name, geometry, origin, yaw, material, True)

    def heightmap(self, name: str, uri: str, size: Point, pos: Point, material: Appearance) -> None:
        """Add a terrain from a picture: extent along x and y, height of its brightest pixel [m].

        Args:
            name: of the collision and, with "_visual", of the visual.
            uri: of the picture.
            size: extent [m].
            pos: of the middle of the terrain, at the height of black [m].
            material: how it looks.
        """
        geometry = (
            f"<heightmap><uri>{uri}</uri><size>{_numbers(size)}</size>"
            f"<pos>{_numbers(pos)}</pos></heightmap>"
        )
        self._add(name, geometry, (0.0, 0.0, 0.0), 0.0, material, True)

    def _add(
        self,
        name: str,
        geometry: str,
        center: Point,
        yaw: float,
        material: Appearance,
        solid: bool,
    ) -> None:
        pose = f"<pose>{_numbers(center)} 0 0 {_number(yaw)}</pose>"
        shape = f"{pose}<geometry>{geometry}</geometry>"
        if solid:
            self.parts.append(f'        <collision name="{name}">{shape}</collision>')
        self.parts.append(f'        <visual name="{name}_visual">{shape}{material.text()}</visual>')

    def text(self) -> str:
        """As an element of a world."""
        return "\n".join(
            [
                f'    <model name="{self.name}">',
                "      <static>true</static>",
                '      <link name="link">',
                *self.parts,
                "      </link>",
                "    </model>",
            ]
        )


def world_text(
    comment: str,
    models: Sequence[StaticModel],
    *,
    name: str = "default",
    ground: bool = True,
    step_s: float = 0.001,
    gravity: float = 9.8,
    sky: tuple[float, float, float] = (0.7, 0.7, 0.7),
    more: str = "",
) -> str:
    """A world under the sun.

    Args:
        comment: what it is.
        models: that never move.
        name: of the world.
        ground: whether there is a ground plane.
        step_s: of physics, as many a second as make real time [s].
        gravity: downwards [m/s^2].
        sky: red, green, blue of the background.
        more: elements of the world.
    """
    body = "\n".join(model.text() for model in models) + more
    plane = _GROUND_PLANE if ground else ""
    return f"""<?xml version="1.0"?>
{LICENCE}<!-- {comment} -->
<sdf version="1.6">
  <world name="{name}">
{plane}    <include>
      <uri>model://sun</uri>
    </include>
    <physics type="ode">
      <max_step_size>{_number(step_s)}</max_step_size>
      <real_time_factor>1</real_time_factor>
      <real_time_update_rate>{_number(1.0 / step_s)}</real_time_update_rate>
      <gravity>0 0 {_number(-gravity)}</gravity>
    </physics>
    <scene>
      <ambient>0.4 0.4 0.4 1</ambient>
      <background>{_numbers(sky)} 1</background>
      <shadows>true</shadows>
    </scene>
{body}
  </world>
</sdf>
"""


def write_files(files: Files, folder: Path) -> list[Path]:
    """Write them below a folder, which is made.

    Raises:
        Error: one cannot be written.
    """
    written = []
    for name, content in sorted(files.items()):
        path = folder / name
        data = content if isinstance(content, bytes) else content.encode()
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        except OSError as error:
            raise Error(f"{path}: cannot be written: {error.strerror}") from error
        written.append(path)
    return written


def _number(value: float) -> str:
    return f"{round(value, 4) + 0.0:g}"


def _numbers(values: Sequence[float]) -> str:
    return " ".join(_number(value) for value in values)
