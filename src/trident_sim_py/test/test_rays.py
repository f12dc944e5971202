# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Rays cast from Python hit what they should."""

from __future__ import annotations

import numpy as np
import pytest

import trident_sim

BOX = """<sdf version="1.6"><model name="box"><static>1</static><link name="body">
<collision name="hull"><geometry><box><size>2 4 6</size></box></geometry></collision>
<visual name="look"><geometry><sphere><radius>0.5</radius></sphere></geometry></visual>
</link></model></sdf>"""


@pytest.fixture
def world_with_box(world: trident_sim.World) -> trident_sim.World:
    world.spawn("box", sdf=BOX, pose=(10.0, 0.0, 0.0))
    return world


def test_distance_normal_and_name(world_with_box: trident_sim.World) -> None:
    hits = world_with_box.cast_rays(
        [[0, 0, 0], [0, 0, 0], [10, 10, 0]], [[3, 0, 0], [-1, 0, 0], [0, -1, 0]]
    )
    np.testing.assert_allclose(hits.distance, [9.0, np.inf, 8.0], rtol=1e-12)
    np.testing.assert_allclose(hits.normal, [[-1, 0, 0], [0, 0, 0], [0, 1, 0]], atol=1e-12)
    assert hits.shape.tolist() == [0, -1, 0]
    assert hits.shapes == [trident_sim.ShapeName("box", "body", "hull")]


def test_visuals_are_other_shapes(world_with_box: trident_sim.World) -> None:
    hits = world_with_box.cast_rays([[0, 0, 0]], [[1, 0, 0]], visual=True)
    np.testing.assert_allclose(hits.distance, [9.5], rtol=1e-9)
    assert hits.shapes[hits.shape[0]].name == "look"


def test_what_is_too_far_is_not_hit(world_with_box: trident_sim.World) -> None:
    assert world_with_box.cast_rays([[0, 0, 0]], [[1, 0, 0]], max_distance=8.9).shape[0] == -1


def test_no_rays_hit_nothing(world_with_box: trident_sim.World) -> None:
    hits = world_with_box.cast_rays(np.zeros((0, 3)), np.zeros((0, 3)))
    assert hits.distance.shape == (0,)
    assert hits.normal.shape == (0, 3)


@pytest.mark.parametrize(
    ("origins", "directions", "limit", "what"),
    [
        ([[0, 0]], [[1, 0, 0]], 1.0, r"origins has shape \(1, 2\), legal: \(n, 3\)"),
        ([0, 0, 0], [[1, 0, 0]], 1.0, "origins has shape"),
        ([[0, 0, 0]], [[1, 0, 0]] * 2, 1.0, "directions has 2 rows, legal: 1"),
        ([[0, 0, 0]], [[0, 0, 0]], 1.0, r"directions\[0\] has no length"),
        ([[0, 0, np.nan]], [[1, 0, 0]], 1.0, "origins"),
        ([[0, 0, 0]], [[1, 0, 0]], 0.0, "max_distance is 0.0"),
    ],
)
def test_bad_rays_are_refused(
    world_with_box: trident_sim.World, origins: object, directions: object, limit: float, what: str
) -> None:
    with pytest.raises(trident_sim.Error, match=what):
        world_with_box.cast_rays(origins, directions, max_distance=limit)  # type: ignore[arg-type]


def test_rays_see_a_moved_body(world: trident_sim.World) -> None:
    ball = BOX.replace("<static>1</static>", "")
    model = world.spawn("box", sdf=ball, pose=(10.0, 0.0, 0.0))
    world.step(10)
    fallen = -float(model.position[2])
    hits = world.cast_rays([[10, 0, 100]], [[0, 0, -1]])
    np.testing.assert_allclose(hits.distance, [100 - 3 + fallen], rtol=1e-9)


def test_the_world_is_not_changed_by_looking(world_with_box: trident_sim.World) -> None:
    before = world_with_box.state_hash()
    world_with_box.cast_rays([[0, 0, 0]], [[1, 0, 0]])
    assert world_with_box.state_hash() == before
