# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coasts that are searched, and people on them, for `trident_search_v0`."""

from __future__ import annotations

import dataclasses
import functools
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from trident_fleet.core.missions.kinds import MissionConfig, read_mission
from trident_fleet.core.missions.scene import Person, Scene, read_scene
from trident_worldgen.coast import CoastConfig, coast
from trident_worldgen.sdf import write_files

from trident_sim.description import find_resource

_MISSION = "package://trident_bringup/config/missions/search_and_rescue.yaml"


@functools.lru_cache
def mission_config() -> MissionConfig:
    """Numbers of robots, rules and sea, as missions have them."""
    return read_mission(Path(find_resource(_MISSION)))


@functools.lru_cache(maxsize=8)
def coast_scene(seed: int) -> Scene:
    """A coast by its seed; makes it, which takes some seconds."""
    config = CoastConfig(seed=seed, length=400.0, covers=14, casualties=1)
    with TemporaryDirectory(prefix="trident_coast_") as folder:
        write_files(coast(config), Path(folder))
        return read_scene(Path(folder) / "coast.scene.yaml")


def with_people(scene: Scene, count: int, random: np.random.Generator) -> Scene:
    """The same coast with people drawn from the mission's prior, where a rescuer gets to."""
    area, lattice = scene.area, scene.area.lattice
    grid = mission_config().prior.grid(area) * (area.ground | area.water)
    cells = random.choice(grid.size, count, p=grid.ravel() / grid.sum())
    row, column = np.divmod(cells, lattice.columns)
    x, y = lattice.middle(row, column)
    where = np.where(area.land, np.where(area.covered, "cover", "open"), "water")[row, column]
    people = tuple(
        Person(f"casualty_{index}", (float(x[index]), float(y[index])), str(where[index]))
        for index in range(count)
    )
    return dataclasses.replace(scene, people=people)
