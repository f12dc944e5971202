# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Tight places: what their seeds draw, and one parking."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("trident_sim", reason="trident_sim is not built or sourced")

from trident_benchmarks.nav import tight
from trident_benchmarks.nav.box_robot import BOX, LENGTH_M, WIDTH_M, limits_file
from trident_benchmarks.nav.limits import RobotLimits
from trident_benchmarks.nav.trials import GoalOutcome, Outcome

SCENES = {scene.name: scene for scene in tight.SCENES}


def run_of(seed: int, end: str) -> Outcome:
    return Outcome(seed, end, 10.0 + seed, "text", ("one",), (), 0.1)


def test_doors_are_wider_than_the_box_by_six_centimeters() -> None:
    for seed in range(20):
        boxes = tight.doors(np.random.default_rng(seed)).boxes[4:]
        for below, above in zip(boxes[::2], boxes[1::2], strict=True):
            gap = (above[1] - above[3] / 2) - (below[1] + below[3] / 2)
            assert gap == pytest.approx(WIDTH_M + 0.06)


def test_the_dead_end_has_no_room_to_turn_in() -> None:
    assert math.hypot(LENGTH_M, WIDTH_M) > tight._DEAD_END_M > WIDTH_M


@pytest.mark.parametrize("scene", tight.SCENES, ids=lambda scene: scene.name)
def test_seeds_draw_different_starts_and_equal_ones_the_same(scene: tight.Scene) -> None:
    tasks = [tight.task_of(scene, seed)[0] for seed in (1, 1, 2)]
    assert tasks[0] == tasks[1]
    assert tasks[0].start != tasks[2].start


def test_a_goal_that_the_truth_denies_is_missed(tmp_path: Path) -> None:
    limits = RobotLimits(limits_file(tmp_path))
    near, far = (
        GoalOutcome((0.0, 0.0, 0.0), "reached", "", 9.0, off_m, 0.0, "", 0) for off_m in (0.09, 0.2)
    )
    run = run_of(1, "reached")
    assert tight.judged(replace(run, goals=(near,)), limits).is_success
    assert tight.judged(replace(run, goals=(far,), odometry_error_m=0.15), limits).is_success
    missed = tight.judged(replace(run, goals=(far,)), limits)
    assert (missed.end, missed.text) == ("missed", "off by 0.200 m, 0.000 rad")


def test_a_row_says_how_many_are_needed() -> None:
    runs = [run_of(seed, "reached") for seed in range(49)] + [run_of(49, "collided")]
    row = tight.row_of(SCENES["parallel parking"], runs)
    assert (row["reached"], row["needed"], row["contacts"]) == (49, 49, 1)
    assert row["failures"] == ["seed 49: collided: text"]
    assert tight.row_of(SCENES["doors"], runs)["needed"] == 50
    assert "| parallel parking | ackermann_car | 49 of 50 | 1 | 50 |" in tight.table([row])


@pytest.mark.parametrize("name", ["backwards parking", "dead end"])
def test_it_gets_in_and_out(name: str, tmp_path: Path) -> None:
    options = argparse.Namespace(jobs=1, config=[])
    runs, sceneries = tight.drive_scene(SCENES[name], [1], options, tmp_path)
    assert [run.end for run in runs] == ["reached"], runs[0].text
    x, y, _ = sceneries[0].goal
    assert math.dist(runs[0].track[-1][:2], (x, y)) < 0.2
    assert runs[0].least_speed_m_s < -0.05  # neither is done forward alone


def test_scenes_have_a_picture(tmp_path: Path) -> None:
    from matplotlib.image import imread
    from trident_benchmarks.nav.pictures.tight import draw_scenes

    scenery = SCENES["doors"].draw(np.random.default_rng(1))
    run = Outcome(1, "reached", 9.0, "", (), (scenery.start, scenery.goal), 0.1)
    draw_scenes(tmp_path / "tight.png", [(SCENES["doors"], [scenery], [run])])
    picture = imread(tmp_path / "tight.png")
    assert (picture[..., :3].max(axis=2) < 0.5).sum() > 100  # walls
    assert SCENES["doors"].robot is BOX
