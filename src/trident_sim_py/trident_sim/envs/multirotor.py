# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A multirotor of RotorS as an agent: its description, its actions, how it begins."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np

from trident_sim._core import AgentSpec
from trident_sim.description import multirotor
from trident_sim.envs.options import Randomization
from trident_sim.world import World

ACTIONS = ("rotors", "rates", "velocity")
WORLD = "package://rotors_gazebo/worlds/basic.world"

_RATES_RAD_S = (4.0, 4.0, 2.0)
_SPEEDS = (2.0, 2.0, 1.5, 1.5)  # along x, y, z [m/s], and yaw rate [rad/s]
_SPIN_UP_STEPS = 200


@dataclass(frozen=True)
class Rotors:
    """Of a vehicle.

    Attributes:
        count: how many.
        constant: thrust over the square of the speed [N s^2].
        fastest: [rad/s].
    """

    count: int
    constant: float
    fastest: float

    def hover_speed(self, weight_n: float) -> float:
        """At which they carry a weight [rad/s]."""
        return math.sqrt(weight_n / (self.count * self.constant))


@functools.lru_cache
def described(name: str, vehicle: str, controlled: bool) -> str:
    """URDF of a vehicle; xacro takes longer than all else."""
    return multirotor(name, vehicle, controlled=controlled)


@functools.lru_cache
def rotors_of(vehicle: str) -> Rotors:
    """What the motors of a vehicle are, by its description."""
    tree = ElementTree.fromstring(described("uav", vehicle, False))
    motors = [one for one in tree.iter("plugin") if one.find("motorNumber") is not None]
    constant = float(motors[0].findtext("motorConstant", "0"))
    return Rotors(len(motors), constant, float(motors[0].findtext("maxRotVelocity", "0")))


def add_multirotor(
    world: World, name: str, vehicle: str, actions: str, place: tuple[float, float, float]
) -> None:
    """Put one into the world, its controller with it where actions need it."""
    world.spawn(name, urdf=described(name, vehicle, actions != "rotors"), pose=place)


def spin_up(world: World, names: list[str], vehicle: str, actions: str) -> None:
    """Let rotors come up to the speed of a hover."""
    for name in names:
        model, rotors = world.model(name), rotors_of(vehicle)
        if actions == "rotors":
            speed = rotors.hover_speed(model.mass * _gravity(world))
            world.ports[f"{name}/command/motor_speed"].write(np.full(rotors.count, speed))
        else:
            x, y, z = model.position
            world.ports[f"{name}/command/trajectory"].write([[x, y, z + 1.0]])
    world.step(_SPIN_UP_STEPS)


def multirotor_agent(
    world: World, name: str, vehicle: str, actions: str, blocks: tuple[str, ...]
) -> AgentSpec:
    """The agent that a vehicle is. An action of zeros is one for hovering.

    `rotors`: speed of each, from as much below the hover's as the fastest is above it. `rates`:
    about the body's axes, and thrust from none to twice the weight. `velocity`: in the world, and
    yaw rate.
    """
    weight_n, rotors = world.model(name).mass * _gravity(world), rotors_of(vehicle)
    port = "command/trajectory"
    if actions == "rotors":
        hover = rotors.hover_speed(weight_n)
        middle = [hover] * rotors.count
        reach, port = [rotors.fastest - hover] * rotors.count, "command/motor_speed"
    elif actions == "rates":
        middle, reach = [0.0, 0.0, 0.0, weight_n], [*_RATES_RAD_S, weight_n]
    else:
        middle, reach = [0.0] * 4, [*_SPEEDS]
    return AgentSpec(name, actions, [f"{name}/{port}"], middle, reach, [*blocks])


def randomize(world: World, name: str, choice: Randomization, random: np.random.Generator) -> None:
    """Draw mass and wind of an episode."""
    if choice.mass != (1.0, 1.0):
        world.model(name).scale_mass(random.uniform(*choice.mass))
    if choice.wind > 0.0:
        speed, side = choice.wind * math.sqrt(random.random()), random.uniform(-math.pi, math.pi)
        wind = (speed * math.cos(side), speed * math.sin(side), 0.0)
        world.ports[f"{name}/wind_speed"].write(wind)


def _gravity(world: World) -> float:
    return float(np.linalg.norm(world.gravity))
