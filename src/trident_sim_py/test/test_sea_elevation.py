# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import numpy as np
import pytest

import trident_sim

WORLD = """<sdf version="1.6"><world name="basin">
<plugin name="sea" filename="libtrident_sea.so"><waves><spectrum>regular</spectrum>
<amplitude>0.2</amplitude><period>4</period></waves><water_level>0.5</water_level></plugin>
</world></sdf>"""


def test_sea_elevation_is_the_wave_at_any_time() -> None:
    world = trident_sim.World(WORLD)
    t, x = np.linspace(0.0, 9.0, 40), np.linspace(-20.0, 20.0, 40)
    omega = 2 * np.pi / 4
    wave = 0.5 + 0.2 * np.cos(omega**2 / 9.81 * x - omega * t)
    z = world.sea_elevation(np.column_stack([x, np.full(40, 7.0)]), t)
    assert z == pytest.approx(wave, abs=1e-9)
    assert world.time == 0.0


def test_world_without_a_sea_is_flat_water_at_zero() -> None:
    world = trident_sim.World('<sdf version="1.6"><world name="dry"/></sdf>')
    assert world.sea_elevation([[1.0, 2.0]], [3.0]) == pytest.approx([0.0])


@pytest.mark.parametrize(
    ("places", "times", "text"),
    [
        ([[1.0, 2.0, 3.0]], [0.0], r"places has shape \(1, 3\), legal: \(1, 2\)"),
        ([[1.0, 2.0]], [0.0, 1.0], r"places has shape \(1, 2\), legal: \(2, 2\)"),
        ([[1.0, float("nan")]], [0.0], "places"),
    ],
)
def test_bad_places_are_refused(places: list[list[float]], times: list[float], text: str) -> None:
    with pytest.raises(trident_sim.Error, match=text):
        trident_sim.World(WORLD).sea_elevation(places, times)


def test_freefloating_fluid_is_still_water_at_its_surface() -> None:
    plugin = '<plugin name="fluid" filename="libfreefloating_gazebo_fluid.so">{}</plugin>'
    surface = "<descriptionParam>robot_description</descriptionParam><surface>0 0 0.5</surface>"
    text = '<sdf version="1.6"><world name="pool">' + plugin.format(surface) + "</world></sdf>"
    with pytest.warns(trident_sim.SimulationWarning, match="<buoyancy> of links has no effect"):
        world = trident_sim.World(text)
    assert world.sea_elevation([[1.0, 2.0]], [3.0]) == pytest.approx([0.5])
