# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds made from a seed: the same again, passable, and those that are shipped are of the kind."""

from __future__ import annotations

import io
import warnings
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage
from trident_sim.occupancy import FREE, OCCUPIED, MapConfig, OccupancyMap, occupancy_map
from trident_worldgen.__main__ import main
from trident_worldgen.office import rooms_of
from trident_worldgen.sdf import write_files

import trident_sim
from trident_worldgen import (
    CoastConfig,
    Files,
    ForestConfig,
    HallConfig,
    OfficeConfig,
    RegattaConfig,
    coast,
    forest,
    hall,
    office,
    regatta,
)

WORLDS = Path(__file__).resolve().parents[3] / "worlds"
ROBOT_RADIUS_M = 0.3


def map_of(files: Files, folder: Path) -> OccupancyMap:
    world = next(path for path in write_files(files, folder) if path.suffix == ".world")
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # a picture that is not found, say
        return occupancy_map(
            trident_sim.World(world, folders=[folder / "models"]), MapConfig(reach=40.0)
        )


def cells_for(grid: OccupancyMap, radius: float) -> np.ndarray:
    """Places that the middle of a robot can reach from (0, 0), shape (rows, columns)."""
    away = ndimage.distance_transform_edt(grid.cells == FREE) * grid.resolution
    labels, _ = ndimage.label(away > radius)
    column, row = (round(-corner / grid.resolution) for corner in grid.origin)
    assert labels[row, column] > 0
    return np.asarray(labels == labels[row, column])


@pytest.mark.parametrize("seed", [1, 2, 3, 44])
def test_a_robot_gets_into_every_room_of_an_office(seed: int, tmp_path: Path) -> None:
    config = OfficeConfig(seed=seed)
    grid = map_of(office(config), tmp_path)
    reached = cells_for(grid, ROBOT_RADIUS_M)
    rooms = rooms_of(config)
    assert len(rooms) >= 20
    for room in rooms:
        (left, right), (low, high) = (
            [round((edge - corner) / grid.resolution) for edge in edges]
            for edges, corner in zip((room.x, room.y), grid.origin, strict=True)
        )
        share = reached[low:high, left:right].mean()
        assert share > 0.15, room


def test_an_office_has_two_loops_and_solid_walls(tmp_path: Path) -> None:
    config = OfficeConfig()
    grid = map_of(office(config), tmp_path)
    assert grid.at(-config.length / 2 - config.wall / 2, 0.0) == OCCUPIED
    assert grid.at(config.length / 2 + config.wall / 2, 3.0) == OCCUPIED
    # The corridors alone: where a robot as wide as 1.6 m fits that starts in the middle.
    wide = cells_for(grid, 0.8)
    assert wide.any()
    holes, count = ndimage.label(ndimage.binary_fill_holes(wide) & ~wide)
    size = np.bincount(holes.ravel())[1:] * grid.resolution**2
    assert count >= 2
    assert np.count_nonzero(size > 50.0) == 2, "the two blocks that one can go around"


def test_a_hall_is_free_in_its_middle(tmp_path: Path) -> None:
    grid = map_of(hall(), tmp_path)
    reached = cells_for(grid, ROBOT_RADIUS_M)
    assert reached.sum() * grid.resolution**2 > 0.8 * 20 * 15
    for x, y in [(0, 0), (1.5, 0), (0, -1.5), (-1.2, 1.2)]:
        assert grid.at(x, y) == FREE
    for x, y in [(5, 3.75), (-5, 3.75), (5, -3.75), (-5, -3.75)]:
        assert grid.at(x, y) == OCCUPIED, "pillars"


@pytest.mark.parametrize(
    ("make", "config"),
    [
        (office, OfficeConfig),
        (hall, HallConfig),
        (forest, ForestConfig),
        (coast, CoastConfig),
        (regatta, RegattaConfig),
    ],
)
def test_a_seed_decides(make: object, config: type) -> None:
    assert make(config(seed=7)) == make(config(seed=7))  # type: ignore[operator]
    assert make(config(seed=7)) != make(config(seed=8))  # type: ignore[operator]


@pytest.mark.parametrize("make", [office, hall, forest, coast, regatta])
def test_shipped_worlds_are_those_of_seed_1(make: object) -> None:
    for name, content in make().items():  # type: ignore[operator]
        shipped = (WORLDS / name).read_bytes()
        if isinstance(content, bytes):
            # Another version of zlib may pack the same picture in other bytes.
            mine, theirs = (np.asarray(Image.open(io.BytesIO(b))) for b in (content, shipped))
            np.testing.assert_array_equal(mine, theirs, err_msg=name)
        else:
            assert shipped.decode() == content, f"{name}: ./trident worldgen makes another one"
            if not name.endswith(".obj"):
                ElementTree.fromstring(content)  # libsdformat reads what is not XML, others do not


def test_pictures_are_seen_where_they_hang() -> None:
    world = trident_sim.World(WORLDS / "hall.world")
    hits = world.cast_rays([[0.0, 0.0, 1.5]], [[0.0, 1.0, 0.0]], visual=True)
    shape = hits.shapes[hits.shape[0]]
    assert hits.distance[0] <= 7.5
    assert shape.model == "hall"


@pytest.mark.parametrize(
    ("config", "what"),
    [
        (OfficeConfig(seed=-1), "seed: -1, legal: 0 to"),
        (OfficeConfig(length=5.0), "length: 5 m, legal: 27.2 to 200 m"),
        (OfficeConfig(width=float("nan")), "width: nan m"),
        (OfficeConfig(door=0.1), "door: 0.1 m, legal: 0.6 to 2.5 m"),
        (HallConfig(crates=-1), "crates: -1, legal: 0 to 100"),
        (HallConfig(height=1.0), "height: 1 m"),
        (ForestConfig(seed=2**32), "seed: 4.29497e\\+09, legal: 0 to"),
        (ForestConfig(length=9.0), "length: 9 m, legal: 10 to 200 m"),
        (ForestConfig(relief=7.0), "relief: 7 m, legal: 0 to 6 m"),
        (ForestConfig(clearing=0.0), "clearing: 0 m, legal: 1 to 10 m"),
        (ForestConfig(spacing=0.5), "spacing: 0.5 m, legal: 1 to 20 m"),
        (ForestConfig(trees=-1), "trees: -1, legal: 0 to 5000"),
        (CoastConfig(relief=31.0), "relief: 31 m, legal: 0 to 30 m"),
        (CoastConfig(rocks=-1), "rocks: -1, legal: 0 to 1000"),
        (RegattaConfig(leg=10.0), "leg: 10 m, legal: 20 to 1000 m"),
        (RegattaConfig(depth=0.0), "depth: 0 m, legal: 2 to 100 m"),
    ],
)
def test_bad_sizes_are_refused(config: object, what: str) -> None:
    makers = {
        OfficeConfig: office,
        HallConfig: hall,
        ForestConfig: forest,
        CoastConfig: coast,
        RegattaConfig: regatta,
    }
    with pytest.raises(trident_sim.Error, match=what):
        makers[type(config)](config)  # type: ignore[index,operator]


def test_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["office", "--seed", "5", "--length", "30", "--out", str(tmp_path)]
    assert main(words) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "office.world")
    assert main(["hall", "--out", str(tmp_path)]) == 0
    assert "files next to it" in capsys.readouterr().out
    assert main([*words[:4], "3", "--out", str(tmp_path)]) == 2
    assert "length: 3 m, legal" in capsys.readouterr().err
    assert main(["coast", "--length", "200", "--out", str(tmp_path)]) == 2
    assert "length: 200 m, legal: 300 to 800 m" in capsys.readouterr().err
    assert main(["cylinders", "--length", "20", "--out", str(tmp_path)]) == 2
    assert "--length: a cylinders has no such thing" in capsys.readouterr().err
    (tmp_path / "file").write_text("")
    assert main(["office", "--out", str(tmp_path / "file")]) == 2
    assert "cannot be written" in capsys.readouterr().err
