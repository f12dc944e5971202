# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Maps of worlds: what is where, down to the cell."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import yaml
from conftest import WORLD
from trident_sim.occupancy import (
    FREE,
    OCCUPIED,
    UNKNOWN,
    MapConfig,
    OccupancyMap,
    occupancy_map,
)

import trident_sim
from trident_sim import worldmap

CELL_M = 0.05


def shape(geometry: str, pose: str, name: str) -> str:
    return (
        f'<collision name="{name}"><pose>{pose} 0 0 0</pose>'
        f"<geometry>{geometry}</geometry></collision>"
    )


def box(size: str, pose: str, name: str) -> str:
    return shape(f"<box><size>{size}</size></box>", pose, name)


def world_of(*shapes: str) -> trident_sim.World:
    world = trident_sim.World(WORLD)
    world.spawn(
        sdf='<sdf version="1.6"><model name="things"><static>1</static><link name="link">'
        f"{''.join(shapes)}</link></model></sdf>"
    )
    return world


@pytest.fixture
def yard() -> trident_sim.World:
    """4 m x 3 m between walls of 0.1 m, with a pillar and a table whose top is at 0.7 m."""
    return world_of(
        box("4.2 0.1 1", "0 1.55 0.5", "north"),
        box("4.2 0.1 1", "0 -1.55 0.5", "south"),
        box("0.1 3 1", "2.05 0 0.5", "east"),
        box("0.1 3 1", "-2.05 0 0.5", "west"),
        shape("<cylinder><radius>0.3</radius><length>2</length></cylinder>", "1 0.5 1", "pillar"),
        box("0.6 0.4 0.05", "-1 -0.8 0.725", "table"),
    )


def test_areas_are_those_of_the_shapes(yard: trident_sim.World) -> None:
    result = occupancy_map(yard)
    count = {value: np.count_nonzero(result.cells == value) for value in (FREE, OCCUPIED)}
    pillar = np.pi * 0.3**2 / CELL_M**2
    walls = (4.2 * 3.2 - 4.0 * 3.0) / CELL_M**2
    # Cells that the pillar touches count as a whole: up to one per cell of its circumference.
    around = 2 * np.pi * 0.3 / CELL_M
    assert walls + pillar <= count[OCCUPIED] <= walls + pillar + around
    assert count[FREE] + count[OCCUPIED] == round(4.2 * 3.2 / CELL_M**2)


def test_walls_are_as_thick_as_they_are(yard: trident_sim.World) -> None:
    result = occupancy_map(yard)
    for x, value in [(1.99, FREE), (2.01, OCCUPIED), (2.09, OCCUPIED), (2.11, UNKNOWN)]:
        assert result.at(x, 0.0) == value, x
        assert result.at(-x, 0.0) == value, -x
    for y, value in [(1.49, FREE), (1.51, OCCUPIED), (1.59, OCCUPIED), (1.61, UNKNOWN)]:
        assert result.at(0.0, y) == value, y
        assert result.at(0.0, -y) == value, -y
    assert result.at(1.0, 0.5) == OCCUPIED, "solid within"
    assert result.at(100.0, 0.0) == UNKNOWN


def test_heights_decide_what_is_an_obstacle(yard: trident_sim.World) -> None:
    assert occupancy_map(yard).at(-1.0, -0.8) == FREE
    both = occupancy_map(yard, MapConfig(heights=(0.2, 0.725)))
    assert both.at(-1.0, -0.8) == OCCUPIED
    assert both.at(1.0, 0.5) == OCCUPIED


def test_only_what_can_be_reached_is_free(yard: trident_sim.World) -> None:
    outside = occupancy_map(yard, MapConfig(start=(3.0, 0.0)))
    assert outside.at(3.0, 0.0) == FREE
    assert outside.at(0.0, 0.0) == UNKNOWN
    assert outside.at(2.05, 0.0) == OCCUPIED


def test_far_walls_are_solid() -> None:
    places = np.linspace(20.0, 95.0, 50)
    walls = [box("0.15 3 1", f"{x} 0 0.5", f"wall{i}") for i, x in enumerate(places)]
    result = occupancy_map(world_of(*walls))
    values = {result.at(x + dx, y) for x in places for dx in (-0.05, 0.0, 0.05) for y in (-1, 0, 1)}
    assert values == {OCCUPIED}


@pytest.mark.parametrize("x", [2.0, 2.5, 3.0, 4.0])
def test_shapes_with_coincident_faces_are_one(x: float) -> None:
    world = world_of(box("2 2 1", "2 0 0.5", "a"), box("2 2 1", f"{x} 0 0.5", "b"))
    result = occupancy_map(world)
    assert np.count_nonzero(result.cells == OCCUPIED) == round((x - 2 + 2) * 2 / CELL_M**2)
    assert not np.any(result.cells == UNKNOWN)


def test_a_room_of_single_faces_is_free_within(tmp_path: Path) -> None:
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    lines = [f"v {x} {y} {z}" for z in (0, 1) for x, y in corners]
    lines += [f"f {i + 1} {(i + 1) % 4 + 1} {(i + 1) % 4 + 5} {i + 5}" for i in range(4)]
    (tmp_path / "room.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
    mesh = shape(f"<mesh><uri>file://{tmp_path}/room.obj</uri></mesh>", "5 0 0", "walls")
    single = shape(f"<mesh><uri>file://{tmp_path}/wall.obj</uri></mesh>", "0 0 0", "wall")
    lines = ["v 3 -2 0", "v 3 2 0", "v 3 2 1", "v 3 -2 1", "f 1 2 3 4"]
    (tmp_path / "wall.obj").write_text("\n".join(lines) + "\n", encoding="utf-8")
    result = occupancy_map(world_of(mesh, single))
    assert result.at(3.0, 1.0) == OCCUPIED
    assert result.at(2.9, 1.0) == FREE
    assert result.at(4.0, 0.5) == OCCUPIED
    assert result.at(3.5, 0.5) == FREE


def test_the_files_are_map_servers(yard: trident_sim.World, tmp_path: Path) -> None:
    result = occupancy_map(yard, MapConfig(resolution=0.1))
    result.save(tmp_path / "yard.pgm")
    facts = yaml.safe_load((tmp_path / "yard.yaml").read_text(encoding="utf-8"))
    assert facts["image"] == "yard.pgm"
    assert facts["resolution"] == 0.1
    assert facts["origin"] == pytest.approx([*result.origin, 0.0])
    head, size, most, pixels = (tmp_path / "yard.pgm").read_bytes().split(b"\n", 3)
    rows, columns = result.cells.shape
    assert (head, size, most) == (b"P5", f"{columns} {rows}".encode(), b"255")
    gray = np.frombuffer(pixels, np.uint8).reshape(rows, columns)[::-1]
    np.testing.assert_array_equal(gray < 100, result.cells == OCCUPIED)
    np.testing.assert_array_equal(gray > 250, result.cells == FREE)
    # As map_server reads it: occupied from 0.65 on, free up to 0.196.
    assert facts["free_thresh"] < (255 - 205) / 255
    assert facts["occupied_thresh"] > (255 - 205) / 255


@pytest.mark.parametrize(
    ("config", "what"),
    [
        (MapConfig(resolution=0.0), "resolution: 0 m, legal: 0.001 to 10 m"),
        (MapConfig(resolution=float("nan")), "resolution: nan m"),
        (MapConfig(heights=()), "heights: none"),
        (MapConfig(heights=(float("inf"),)), "heights: inf m"),
        (MapConfig(heights=(5.0,)), "no obstacle within 100 m of the start at a height of 5 m"),
        (MapConfig(start=(1.0, 0.5)), r"start: \(1, 0.5\) m is within an obstacle"),
        (MapConfig(reach=0.0), "reach: 0 m"),
        (MapConfig(margin=-1.0), "margin: -1 m"),
        (MapConfig(resolution=0.01, margin=100.0), "resolution: 0.01 m makes .* cells"),
    ],
)
def test_what_makes_no_map_is_refused(
    yard: trident_sim.World, config: MapConfig, what: str
) -> None:
    with pytest.raises(trident_sim.Error, match=what):
        occupancy_map(yard, config)


def test_a_map_is_no_picture_of_another_kind(tmp_path: Path) -> None:
    grid = OccupancyMap(np.zeros((2, 2), np.int8), 0.1, (0.0, 0.0))
    with pytest.raises(trident_sim.Error, match=r"suffix is '.png', legal: .pgm"):
        grid.save(tmp_path / "map.png")


def test_command_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "r.pgm"
    assert worldmap.main(["room", "--resolution", "0.1", "--out", str(out)]) == 0
    assert "99." in capsys.readouterr().out, "m^2 free of the 100 m^2 of the room"
    assert out.is_file()
    for words, what in [
        (["no_such_world"], "no_such_world.world"),
        (["room", "--start", "1"], "--start: '1', legal: two numbers"),
        (["hexagon"], "start: (0, 0) m is within an obstacle"),
    ]:
        assert worldmap.main([*words, "--out", str(out)]) == 2
        assert what in capsys.readouterr().err
