# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Maps that are cut above the ground."""

from __future__ import annotations

from pathlib import Path

import pytest
from conftest import WORLD
from trident_sim.occupancy import FREE, OCCUPIED, MapConfig
from trident_sim.terrain_map import map_above_ground

import trident_sim
from trident_sim import worldmap

FOREST = Path(__file__).resolve().parents[3] / "worlds" / "forest.world"


def test_a_wall_on_a_plane_is_the_same_above_the_ground() -> None:
    world = trident_sim.World(WORLD)
    shapes = {
        "plane": ("<plane><normal>0 0 1</normal><size>9 9</size></plane>", "0 0 3"),
        "wall": ("<box><size>0.2 2 1</size></box>", "1 0 3.5"),
        "lamp": ("<box><size>0.2 0.2 0.2</size></box>", "-1 0 5"),
    }
    text = "".join(
        f'<collision name="{name}"><pose>{pose} 0 0 0</pose><geometry>{geometry}</geometry>'
        "</collision>"
        for name, (geometry, pose) in shapes.items()
    )
    world.spawn(
        sdf='<sdf version="1.6"><model name="yard"><static>1</static><link name="link">'
        f"{text}</link></model></sdf>"
    )
    grid = map_above_ground(world, MapConfig(resolution=0.1, reach=3.0))
    assert grid.at(1.0, 0.5) == OCCUPIED
    assert grid.at(-1.0, 0.0) == FREE, "the lamp is higher"
    assert grid.at(1.25, 0.05) == FREE
    lamp = map_above_ground(world, MapConfig(resolution=0.1, reach=3.0, heights=(2.0,)))
    assert lamp.at(-1.0, 0.0) == OCCUPIED
    assert lamp.at(1.0, 0.5) == FREE
    with pytest.raises(trident_sim.Error, match=r"start: \(1, 0\) m is within an obstacle"):
        map_above_ground(world, MapConfig(start=(1.0, 0.0), reach=3.0))


def test_where_there_is_no_ground_there_is_no_map() -> None:
    with pytest.raises(trident_sim.Error, match="no ground within 5 m of the start"):
        map_above_ground(trident_sim.World(WORLD), MapConfig(reach=5.0))


def test_command_line_of_a_terrain(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "forest.pgm"
    words = [str(FOREST), "--above-ground", "--resolution", "0.2", "--out", str(out)]
    assert worldmap.main(words) == 0
    assert "m^2 free" in capsys.readouterr().out
    assert out.is_file()
    assert worldmap.main([*words[:1], "--out", str(out)]) == 2, "z = 0.2 is within a hill"
    assert "within an obstacle" in capsys.readouterr().err
