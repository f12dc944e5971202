# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A coast with something to be found: rescuers get there, and covers hide what lies below them."""

from __future__ import annotations

import functools
import io
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from PIL import Image
from trident_worldgen.__main__ import main
from trident_worldgen.coast import coast_ground
from trident_worldgen.coast_search import BASES, COVER, DRIFT_M_S, GROUND, LAND, WATER
from trident_worldgen.sdf import write_files

import trident_sim
from trident_worldgen import CoastConfig, Files, coast

SEEDS = (1, 7)


@functools.cache
def made(seed: int) -> Files:
    return coast(CoastConfig(seed=seed, length=400.0, covers=14, casualties=12))


def record(seed: int) -> dict[str, Any]:
    return dict(yaml.safe_load(made(seed)["coast.scene.yaml"]))


def cells(seed: int) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(bytes(made(seed)["coast.cells.png"]))))


def flags_at(seed: int, x: float, y: float) -> int:
    return int(cells(seed)[int((150.0 - y) / 2.0), int((x + 200.0) / 2.0)])


@pytest.mark.parametrize("seed", SEEDS)
def test_half_is_land_and_no_hill_is_higher_than_six_meters(seed: int) -> None:
    assert cells(seed).shape == (150, 200)
    assert 0.4 < (cells(seed) & LAND > 0).mean() < 0.6
    ground = coast_ground(CoastConfig(seed=seed, length=400.0, covers=14, casualties=12))
    assert 5.0 < ground.lowest + ground.relief <= 6.01


@pytest.mark.parametrize("seed", SEEDS)
def test_rescuers_reach_the_bases_the_covers_and_the_casualties(seed: int) -> None:
    scene = record(seed)
    assert flags_at(seed, *BASES["ground"]) & GROUND
    assert flags_at(seed, *BASES["water"]) & WATER
    below = cells(seed) & COVER > 0
    assert below.sum() == 14 * 81, "covers do not touch each other"
    assert (cells(seed)[below] & GROUND > 0).mean() > 0.75, "all but where trunks and posts stand"
    kinds = [one["where"] for one in scene["casualties"]]
    assert {kind: kinds.count(kind) for kind in kinds} == {"open": 5, "cover": 2, "water": 5}
    for one in scene["casualties"]:
        flags = flags_at(seed, one["x"], one["y"])
        assert flags & (WATER if one["where"] == "water" else GROUND)
        assert bool(flags & COVER) == (one["where"] == "cover")


@pytest.mark.parametrize("seed", SEEDS)
def test_people_in_the_water_neither_strand_nor_leave(seed: int) -> None:
    for one in record(seed)["casualties"]:
        if one["where"] == "water":
            x, y = one["x"] + 900.0 * DRIFT_M_S[0], one["y"] + 900.0 * DRIFT_M_S[1]
            assert flags_at(seed, x, y) & WATER


def test_slopes_on_which_the_ground_robot_drives_are_below_twelve_degrees() -> None:
    ground = coast_ground(CoastConfig(seed=1, length=400.0, covers=14, casualties=12))
    rows, columns = np.nonzero(cells(1) & GROUND > 0)
    x, y = 2.0 * columns + 1.0 - 200.0, 150.0 - 2.0 * rows - 1.0
    behind = y > 33.0  # what is in front of that stands on the quay
    x, y = x[behind], y[behind]
    along = ground.heights(x + 1.0, y) - ground.heights(x - 1.0, y)
    across = ground.heights(x, y + 1.0) - ground.heights(x, y - 1.0)
    assert np.degrees(np.arctan(np.hypot(along, across) / 2.0)).max() < 12.0


def test_covers_hide_from_above_but_not_from_the_side(tmp_path: Path) -> None:
    write_files(made(1), tmp_path)
    world = trident_sim.World(tmp_path / "coast.world", folders=[tmp_path / "models"])
    random = np.random.default_rng(3)
    for cover in record(1)["covers"]:
        middle = np.array([cover["x"], cover["y"]])
        places = middle + random.uniform(-8.9, 8.9, (20, 2))
        above = np.column_stack([places, np.full(20, 25.0)])
        hits = world.cast_rays(above, np.tile((0.0, 0.0, -1.0), (20, 1)))
        assert {hits.shapes[shape].model for shape in hits.shape} == {"covers"}


def test_a_robot_below_a_roof_sees_out_of_it(tmp_path: Path) -> None:
    write_files(made(1), tmp_path)
    world = trident_sim.World(tmp_path / "coast.world", folders=[tmp_path / "models"])
    ground = coast_ground(CoastConfig(seed=1, length=400.0, covers=14, casualties=12))
    for cover in record(1)["covers"][::2]:
        x, y = cover["x"] + 1.0, cover["y"] + 1.0
        foot = ground.height(x, y)
        up = world.cast_rays([[x, y, foot + 0.5]], [[0.0, 0.0, 1.0]])
        assert 2.0 < up.distance[0] < 8.0, "room for a robot"
        out = world.cast_rays([[x, y, foot + 1.5]] * 2, [[1.0, 0.2, 0.1], [-1.0, 0.2, 0.1]])
        assert out.distance.max() > 9.0


def test_what_has_no_room_is_refused() -> None:
    with pytest.raises(trident_sim.Error, match="covers: 100, there is room for"):
        coast(CoastConfig(covers=100))
    with pytest.raises(trident_sim.Error, match="casualties: -1, legal: 0 to 200"):
        coast(CoastConfig(casualties=-1))


def test_command_line_writes_the_record(tmp_path: Path) -> None:
    words = ["coast", "--seed", "3", "--length", "400", "--covers", "2", "--casualties", "5"]
    assert main([*words, "--out", str(tmp_path)]) == 0
    scene = yaml.safe_load((tmp_path / "coast.scene.yaml").read_text())
    assert len(scene["covers"]) == 2
    assert len(scene["casualties"]) == 5
    assert math.isclose(scene["size"][0], 400.0)
    assert (tmp_path / scene["cells"]).is_file()
    assert (tmp_path / scene["heights"]["file"]).is_file()
