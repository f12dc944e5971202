# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Moored buoys, and the courses that they mark."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from trident_worldgen.checks import require, require_seed
from trident_worldgen.sdf import Color, Files, StaticModel, world_text

_BED = Color((0.1, 0.25, 0.35))
_VESSEL = "package://trident_bringup/config/vessels/channel_buoy.yaml"
_HULL_KG = 413.485  # that and the rest of the inertial: as the vessel's file has it
_FASTENED_M = 0.5  # below the middle of the hull
_SLACK = 1.15  # length of a mooring per depth


@dataclass(frozen=True)
class Buoy:
    """A buoy of 1 m diameter on a mooring.

    Attributes:
        name: of its model.
        x: of its anchor [m, world].
        y: of its anchor [m, world].
        depth: of the ground below the still water [m].
        color: red, green, blue, each 0 to 1.
        swing: how far from above its anchor it gets at most [m]; None: by a usual mooring.
    """

    name: str
    x: float
    y: float
    depth: float
    color: Color
    swing: float | None = None

    def _mooring_m(self) -> float:
        """Length of its mooring."""
        if self.swing is None:
            return _SLACK * self.depth
        return math.hypot(self.depth - _FASTENED_M, self.swing)

    def text(self) -> str:
        """As a model of a world."""
        look = self.color.text()
        return f"""
    <model name="{self.name}">
      <pose>{self.x:g} {self.y:g} 0 0 0 0</pose>
      <link name="hull">
        <inertial>
          <pose>0 0 -0.3 0 0 0</pose>
          <mass>{_HULL_KG}</mass>
          <inertia><ixx>75.5</ixx><iyy>75.5</iyy><izz>51.7</izz></inertia>
        </inertial>
        <collision name="float">
          <geometry><cylinder><radius>0.5</radius><length>1</length></cylinder></geometry>
        </collision>
        <visual name="float_visual">
          <geometry><cylinder><radius>0.5</radius><length>1</length></cylinder></geometry>{look}
        </visual>
        <collision name="mast">
          <pose>0 0 1.2 0 0 0</pose>
          <geometry><cylinder><radius>0.12</radius><length>1.4</length></cylinder></geometry>
        </collision>
        <visual name="mast_visual">
          <pose>0 0 1.2 0 0 0</pose>
          <geometry><cylinder><radius>0.12</radius><length>1.4</length></cylinder></geometry>{look}
        </visual>
        <visual name="topmark_visual">
          <pose>0 0 2.1 0 0 0</pose>
          <geometry><sphere><radius>0.3</radius></sphere></geometry>{look}
        </visual>
      </link>
      <plugin name="mooring" filename="libtrident_mooring.so">
        <bodyName>hull</bodyName>
        <xyzOffset>0 0 {-_FASTENED_M:g}</xyzOffset>
        <anchor>{self.x:g} {self.y:g} {-self.depth:g}</anchor>
        <length>{self._mooring_m():g}</length>
      </plugin>
      <plugin name="vessel" filename="libtrident_vessel.so">
        <vessel>{_VESSEL}</vessel>
        <bodyName>hull</bodyName>
      </plugin>
    </model>"""


def sea_text(environment: str) -> str:
    """The plugin of a world's sea, of a file of config/environments."""
    return f"""
    <plugin name="sea" filename="libtrident_sea.so">
      <environment>package://trident_bringup/config/environments/{environment}.yaml</environment>
    </plugin>"""


def place_text(latitude_deg: float, longitude_deg: float) -> str:
    """Where a world's origin is on the earth; x points east."""
    return f"""
    <spherical_coordinates>
      <surface_model>EARTH_WGS84</surface_model>
      <latitude_deg>{latitude_deg:g}</latitude_deg>
      <longitude_deg>{longitude_deg:g}</longitude_deg>
      <elevation>0</elevation>
      <heading_deg>0</heading_deg>
    </spherical_coordinates>"""


@dataclass(frozen=True)
class RegattaConfig:
    """Sizes of a course of buoys [m].

    Attributes:
        seed: decides by how much the marks lie off their places.
        leg: from the start to the windward mark.
        gate: width of the start and of the gate.
        depth: of the water.
    """

    seed: int = 1
    leg: float = 60.0
    gate: float = 12.0
    depth: float = 12.0

    def validate(self) -> None:
        """Raises Error naming the field, its value and what is legal."""
        require_seed(self.seed)
        require("leg", self.leg, 20.0, 1000.0)
        require("gate", self.gate, 4.0, 0.5 * self.leg)
        require("depth", self.depth, 2.0, 100.0)


def course_of(config: RegattaConfig) -> list[Buoy]:
    """The marks in the order in which they are passed: start, windward, wing, gate, finish.

    Waves and wind come from the east: the first leg leads against them.
    """
    leg, half = config.leg, config.gate / 2
    red, green, yellow = RED, GREEN, YELLOW
    marks: Sequence[tuple[str, float, float, Color]] = (
        ("start_port", 0.0, half, red),
        ("start_starboard", 0.0, -half, green),
        ("windward", leg, 0.0, yellow),
        ("wing", 0.5 * leg, 0.5 * leg, yellow),
        ("gate_port", -0.2 * leg, -half, red),
        ("gate_starboard", -0.2 * leg, half, green),
        ("reach", 0.4 * leg, -0.4 * leg, yellow),
    )
    # A mark lies where its anchor was dropped, within 2 % of the leg; a turn per mark by the seed.
    turn = (config.seed * 2.399963) % (2.0 * math.pi)
    buoys = []
    for index, (name, x, y, color) in enumerate(marks):
        off = 0.02 * leg if color is yellow else 0.0
        angle = turn + 2.0 * index
        x, y = x + off * math.cos(angle), y + off * math.sin(angle)
        buoys.append(Buoy(name, round(x, 2), round(y, 2), config.depth, color))
    return buoys


def regatta(config: RegattaConfig | None = None) -> Files:
    """`regatta.world`: open water with a course of moored buoys.

    Raises:
        Error: an illegal configuration.
    """
    config = config or RegattaConfig()
    config.validate()
    bed = StaticModel("sea_floor")
    side = 6.0 * config.leg
    bed.box("bed", (side, side, 1.0), (0.0, 0.0, -config.depth - 0.5), _BED)
    more = "".join(buoy.text() for buoy in course_of(config))
    more += sea_text("sea_state_2") + place_text(63.4389, 10.399)
    comment = (
        f"A course of moored buoys, its first leg {config.leg:g} m. "
        f"Made by ./trident worldgen regatta, seed {config.seed}"
    )
    text = world_text(
        comment, [bed], name="regatta", ground=False, step_s=0.004, gravity=9.81, sky=SKY, more=more
    )
    return {"regatta.world": text}


RED = Color((0.75, 0.08, 0.06))
SKY = (0.62, 0.76, 0.9)
GREEN = Color((0.05, 0.5, 0.15))
YELLOW = Color((0.95, 0.8, 0.1))
