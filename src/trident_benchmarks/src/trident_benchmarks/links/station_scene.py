# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Coasts with a mast on land and a boat at sea, which a UAV connects."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from trident_fleet.core.station.fence import Fence
from trident_worldgen.coast import CoastConfig, coast, coast_ground
from trident_worldgen.terrain import Terrain

import trident_sim

Array = npt.NDArray[np.float64]

UAV, LINKS = "uav1", ("usv1", "shore")
HOME = (5.0, 27.0, 1.6)  # on the quay
MARGIN_M = 1.0
FENCE = Fence(np.array([[-31.0, -51.0], [51.0, -51.0], [51.0, 31.0], [-31.0, 31.0]]), 17.0, 27.0)
GRID_M = 2.0
_AIR = '<plugin name="air" filename="libtrident_radio_medium.so"/></world>'
_RADIO = """<plugin name="radio" filename="libtrident_radio.so"><tx_power>10</tx_power>
<height>0</height></plugin>"""
_STANDING = f"""<sdf version="1.6"><model name="radio"><link name="base"><gravity>0</gravity>
</link>{_RADIO}</model></sdf>"""
_BOAT_M, _MAST_M = 2.0, 4.0  # antennas above water and ground


@dataclass(frozen=True)
class StationScene:
    """A coast, and where the robots stand that are to be connected.

    Attributes:
        seed: of the coast, of the places and of the shadows.
        places: of the antennas, p_world [m], in the order of LINKS.
    """

    seed: int
    places: tuple[tuple[float, float, float], ...]


def station_scene(seed: int) -> StationScene:
    """A scene of a seed: the boat anywhere on the sea before the coast, the mast near the shore."""
    ground = coast_ground(CoastConfig(seed=seed))
    random = np.random.default_rng([seed, 0xBA5E])
    x, y = _place_at_sea(ground, random)
    boat = (float(x), float(y), _BOAT_M)
    x, y = _place_on_shore(ground, random)
    return StationScene(seed, (boat, (float(x), float(y), ground.height(x, y) + _MAST_M)))


def _place_at_sea(ground: Terrain, random: np.random.Generator) -> tuple[float, float]:
    while True:
        x, y = random.uniform(-70.0, 90.0), random.uniform(-100.0, -10.0)
        # The moles are no ground; between them, and around them, is water.
        is_clear = y < -37.0 or 2.0 < x < 58.0 or x < -14.0 or x > 74.0
        if ground.height(x, y) < -1.0 and is_clear:
            return x, y


def _place_on_shore(ground: Terrain, random: np.random.Generator) -> tuple[float, float]:
    while True:
        x, y = random.uniform(-60.0, 90.0), random.uniform(35.0, 75.0)
        is_in_shed = -13.0 < x < 13.0 and y < 47.0
        if 0.5 < ground.height(x, y) < 4.0 and not is_in_shed:
            return x, y


def _world(scene: StationScene) -> trident_sim.World:
    with tempfile.TemporaryDirectory() as folder:
        for name, content in coast(CoastConfig(seed=scene.seed)).items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
        file = Path(folder) / "coast.world"
        file.write_text(file.read_text(encoding="utf-8").replace("</world>", _AIR), "utf-8")
        world = trident_sim.World(file, seed=scene.seed)
    for name, place in zip(LINKS, scene.places, strict=True):
        world.spawn(name, sdf=_STANDING, pose=place)
    return world


def world_with_uav(scene: StationScene) -> trident_sim.World:
    """With a firefly under its controller on the quay, its antenna at its middle."""
    world = _world(scene)
    urdf = trident_sim.multirotor(UAV, "firefly")
    radio = f"<gazebo>{_RADIO}</gazebo></robot>"
    world.spawn(UAV, urdf=urdf.replace("</robot>", radio), pose=HOME)
    return world


def snr_of(world: trident_sim.World) -> dict[str, float]:
    """SNR of the UAV's links, by the other robot [dB]."""
    return {link.destination: link.snr for link in world.radio.links(UAV)}


def grid_of(fence: Fence) -> Array:
    """Places 2 m apart in a fence, without its margin [m], shape (N, 3)."""
    low = np.array([*fence.corners.min(axis=0), fence.lowest_m]) + MARGIN_M
    high = np.array([*fence.corners.max(axis=0), fence.highest_m]) - MARGIN_M
    axes = [np.arange(a, b + 1e-6, GRID_M) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    return np.asarray(grid[fence.clearance(grid) >= MARGIN_M - 1e-6])


def best_of_grid(scene: StationScene, grid: Array) -> tuple[float, Array, float]:
    """The worst link at the best place of a grid, by an antenna that is put at each of them.

    Returns:
        Its SNR [dB], the place [m, world], and the SNR between the two robots themselves [dB].
    """
    world = _world(scene)
    probe = world.spawn(UAV, sdf=_STANDING, pose=tuple(grid[0]))
    direct_db = next(
        link.snr for link in world.radio.links(LINKS[0]) if link.destination == LINKS[1]
    )
    worst = np.empty(len(grid))
    for index, place in enumerate(grid.tolist()):
        probe.set_pose(place)
        worst[index] = min(snr_of(world).values())
    best = int(worst.argmax())
    return float(worst[best]), grid[best], direct_db
