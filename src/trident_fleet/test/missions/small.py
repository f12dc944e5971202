# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A small coast, 160 m x 120 m, that a team searches in two minutes."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from trident_fleet.core.missions.kinds import MissionConfig, read_mission
from trident_fleet.core.missions.mission import Mission, Setup
from trident_fleet.core.missions.scene import Person, Scene
from trident_fleet.core.missions.tree_file import read_tree
from trident_fleet.core.missions.vehicle import VehicleMaker, kinematic
from trident_fleet.core.search.area import Lattice, SearchArea

MISSIONS = Path(__file__).resolve().parents[4] / "config" / "missions"


@cache
def scene() -> Scene:
    """Water in the south, level land in the north, a cover, and four people."""
    lattice = Lattice(60, 80, 2.0, (-80.0, -60.0))
    land = np.zeros(lattice.shape, dtype=bool)
    land[30:] = True
    covered = np.zeros_like(land)
    covered[42:51, 10:19] = True
    area = SearchArea(lattice, land, covered, land, ~land, np.where(land, 1.5, -8.0))
    people = (
        Person("casualty_0", (41.0, 31.0), "open"),
        Person("casualty_1", (-51.0, 33.0), "cover"),
        Person("casualty_2", (-41.0, -31.0), "water"),
        Person("casualty_3", (21.0, -21.0), "water"),
    )
    bases = {"air": (1.0, 9.0), "ground": (5.0, 5.0), "water": (3.0, -3.0)}
    return Scene(1, area, bases, ((-51.0, 33.0),), people)


@cache
def config() -> MissionConfig:
    """The shipped numbers, but no more than four minutes."""
    shipped = read_mission(MISSIONS / "search_and_rescue.yaml")
    return replace(shipped, rules=replace(shipped.rules, until_s=240.0))


def mission(setup: Setup, make_vehicle: VehicleMaker = kinematic) -> Mission:
    """A mission on the small coast."""
    tree = read_tree(MISSIONS / "search_and_rescue_tree.yaml")
    return Mission(scene(), config(), tree, setup, make_vehicle)
