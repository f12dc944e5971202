#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the COLLADA meshes of this package from a few numbers per vehicle.

Run without arguments it rewrites ../meshes; the meshes are for the eye only, collisions are
primitives in the xacro files. Lengths in metres, x forward, z up, origin at base_link.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

Vector = tuple[float, float, float]
Color = tuple[float, float, float]

DARK: Color = (0.12, 0.12, 0.13)
GRAY: Color = (0.45, 0.46, 0.48)
ORANGE: Color = (0.85, 0.36, 0.08)
BLUE: Color = (0.10, 0.32, 0.70)


@dataclass(frozen=True)
class Part:
    """A convex or prismatic solid of one color: vertices and counter-clockwise triangles."""

    color: Color
    vertices: tuple[Vector, ...]
    triangles: tuple[tuple[int, int, int], ...]


def prism(color: Color, rings: Sequence[Sequence[Vector]]) -> Part:
    """Skin over equally long rings of points, closed at both ends; rings wind about the axis."""
    n = len(rings[0])
    triangles = []
    for k in range(len(rings) - 1):
        for i in range(n):
            a, b = k * n + i, k * n + (i + 1) % n
            triangles += [(a, b, b + n), (a, b + n, a + n)]
    last = (len(rings) - 1) * n
    for i in range(1, n - 1):
        triangles += [(0, i + 1, i), (last, last + i, last + i + 1)]
    return Part(color, tuple(p for ring in rings for p in ring), tuple(triangles))


def cylinder(color: Color, center: Vector, radius: float, height: float, sides: int = 12) -> Part:
    """Upright cylinder."""
    x, y, z = center
    angles = [2 * math.pi * i / sides for i in range(sides)]
    circle = [(x + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]
    return prism(color, [[(u, v, z + s * height / 2) for u, v in circle] for s in (-1, 1)])


def beam(color: Color, start: Vector, end: Vector, width: float, height: float) -> Part:
    """Box of a cross-section along a line that is not vertical."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    length = math.hypot(dx, dy)
    side = (-dy / length * width / 2, dx / length * width / 2)
    corners = [(1, -1), (1, 1), (-1, 1), (-1, -1)]
    rings = [
        [(p[0] + s * side[0], p[1] + s * side[1], p[2] + t * height / 2) for s, t in corners]
        for p in (start, end)
    ]
    return prism(color, rings)


def propeller(turning: int) -> list[Part]:
    """Two twisted blades of radius 1; turning is +1 for counter-clockwise seen from above."""
    parts = [cylinder(DARK, (0.0, 0.0, 0.0), 0.09, 0.12)]
    for heading in (1.0, -1.0):
        rings = []
        for radius, chord, pitch_deg in ((0.08, 0.10, 30.0), (0.35, 0.20, 20.0), (1.0, 0.08, 8.0)):
            pitch = math.radians(pitch_deg) * turning
            ring = []
            for along, up in ((-0.5, -0.08), (0.5, -0.08), (0.5, 0.08), (-0.5, 0.08)):
                y = chord * (along * math.cos(pitch) - up * math.sin(pitch))
                z = chord * (along * math.sin(pitch) + up * math.cos(pitch))
                ring.append((heading * radius, heading * y, z))
            rings.append(ring)
        parts.append(prism(GRAY, rings))
    return parts


def multirotor(
    rotors: Sequence[tuple[float, float]], rotor_z: float, half_height: float, color: Color
) -> list[Part]:
    """Body, an arm and a motor per rotor [m, m], and four feet down to -half_height [m]."""
    parts = [
        cylinder(color, (0.0, 0.0, 0.0), 0.055, 0.05, sides=16),
        cylinder(DARK, (0.0, 0.0, 0.035), 0.035, 0.02, sides=16),
    ]
    for index, (x, y) in enumerate(rotors):
        front = x > 0 and index in (0, len(rotors) - 1)
        parts.append(beam(ORANGE if front else GRAY, (0.0, 0.0, 0.0), (x, y, 0.0), 0.016, 0.012))
        parts.append(cylinder(DARK, (x, y, rotor_z / 2), 0.014, max(rotor_z, 0.01)))
    for x, y in ((0.04, 0.04), (-0.04, 0.04), (-0.04, -0.04), (0.04, -0.04)):
        parts.append(cylinder(DARK, (x, y, -half_height / 2), 0.005, half_height, sides=6))
    return parts


def meshes() -> dict[str, list[Part]]:
    """All meshes by file name."""
    arms = [math.radians(a) for a in (30, 90, 150, 210, 270, 330)]
    firefly = [(0.215 * math.cos(a), 0.215 * math.sin(a)) for a in arms]
    iris = [(0.13, -0.22), (-0.13, 0.2), (-0.13, -0.2), (0.13, 0.22)]
    hummingbird = [(0.17, 0.0), (0.0, 0.17), (-0.17, 0.0), (0.0, -0.17)]
    pelican = [(0.21, 0.0), (0.0, 0.21), (-0.21, 0.0), (0.0, -0.21)]
    ardrone = [(0.12728, -0.12728), (-0.12728, 0.12728), (-0.12728, -0.12728), (0.12728, 0.12728)]
    return {
        "ardrone.dae": multirotor(ardrone, 0.023, 0.08, GRAY),
        "firefly.dae": multirotor(firefly, 0.037, 0.08, BLUE),
        "hummingbird.dae": multirotor(hummingbird, 0.01, 0.06, BLUE),
        "iris.dae": multirotor(iris, 0.023, 0.055, BLUE),
        "pelican.dae": multirotor(pelican, 0.05, 0.1, BLUE),
        "propeller_ccw.dae": propeller(+1),
        "propeller_cw.dae": propeller(-1),
    }


def _geometry(index: int, part: Part) -> str:
    """One <geometry> without normals: viewers shade the faces flat."""
    name = f"part{index}"
    floats = " ".join(f"{round(c, 6) + 0.0:g}" for v in part.vertices for c in v)
    indices = " ".join(str(i) for t in part.triangles for i in t)
    return f"""    <geometry id="{name}">
      <mesh>
        <source id="{name}_p">
          <float_array id="{name}_a" count="{3 * len(part.vertices)}">{floats}</float_array>
          <technique_common>
            <accessor source="#{name}_a" count="{len(part.vertices)}" stride="3">
              <param name="X" type="float"/><param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="{name}_v"><input semantic="POSITION" source="#{name}_p"/></vertices>
        <triangles count="{len(part.triangles)}" material="m">
          <input semantic="VERTEX" source="#{name}_v" offset="0"/>
          <p>{indices}</p>
        </triangles>
      </mesh>
    </geometry>
"""


def _material(index: int, color: Color) -> tuple[str, str]:
    """The <effect> and the <material> of a color."""
    r, g, b = color
    effect = f"""    <effect id="colour{index}_fx">
      <profile_COMMON>
        <technique sid="common">
          <lambert><diffuse><color>{r} {g} {b} 1</color></diffuse></lambert>
        </technique>
      </profile_COMMON>
    </effect>
"""
    material = (
        f'    <material id="colour{index}"><instance_effect url="#colour{index}_fx"/></material>\n'
    )
    return effect, material


def _node(index: int, color_index: int) -> str:
    return f"""      <node id="node{index}">
        <instance_geometry url="#part{index}">
          <bind_material>
            <technique_common>
              <instance_material symbol="m" target="#colour{color_index}"/>
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
"""


def collada(parts: Sequence[Part]) -> str:
    """The parts as a COLLADA 1.4.1 document."""
    colors = sorted({part.color for part in parts})
    materials = [_material(i, color) for i, color in enumerate(colors)]
    return f"""<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-FileCopyrightText: 2026 The Trident authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
<!-- Written by scripts/make_meshes.py. -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset>
    <created>2026-01-01T00:00:00</created><modified>2026-01-01T00:00:00</modified>
    <unit name="meter" meter="1"/>
    <up_axis>Z_UP</up_axis>
  </asset>
  <library_effects>
{"".join(effect for effect, _ in materials)}  </library_effects>
  <library_materials>
{"".join(material for _, material in materials)}  </library_materials>
  <library_geometries>
{"".join(_geometry(i, part) for i, part in enumerate(parts))}  </library_geometries>
  <library_visual_scenes>
    <visual_scene id="scene">
{"".join(_node(i, colors.index(part.color)) for i, part in enumerate(parts))}    </visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>
"""


def main() -> int:
    """Rewrites every mesh and says where."""
    folder = Path(__file__).resolve().parents[1] / "meshes"
    for name, parts in meshes().items():
        (folder / name).write_text(collada(parts), encoding="utf-8")
        print(folder / name)
    return 0


if __name__ == "__main__":
    sys.exit(main())
