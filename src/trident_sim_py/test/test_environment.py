# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Sea and wind of a world, changed and read in-process."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

import trident_sim

OCEAN = "package://trident_bringup/worlds/ocean.world"
PLACES = np.array([[0.0, 0.0], [7.0, -3.0], [100.0, 20.0]])
TIMES = np.array([20.0, 21.0, 25.0])


def test_waves_are_changed_by_a_part_of_their_description() -> None:
    world = trident_sim.World(OCEAN, seed=3)
    state = world.ports["environment/state"]
    state.subscribe()
    before = world.sea_elevation(PLACES, TIMES)
    world.ports["environment/waves"].write("significant_height: 0.6")
    world.step()
    assert world.sea_elevation(PLACES, TIMES) == pytest.approx(2.0 * before, abs=1e-9)
    assert yaml.safe_load(state.value.yaml)["waves"]["significant_height"] == 0.6
    world.reset()
    assert world.sea_elevation(PLACES, TIMES) == pytest.approx(before, abs=1e-12)


def test_what_is_not_legal_is_a_message_and_changes_nothing() -> None:
    world = trident_sim.World(OCEAN, seed=3)
    before = world.sea_elevation(PLACES, TIMES)
    world.ports["environment/waves"].write("significant_height: -0.6")
    with pytest.warns(trident_sim.SimulationWarning, match=r"-0\.6 .* \[0, 30\] m"):
        world.step()
    assert np.array_equal(world.sea_elevation(PLACES, TIMES), before)
