# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What roslaunch's output reports."""

from __future__ import annotations

import pytest
from trident_benchmarks.sim.launch_log import interpolate, node_pids, run_folder, spawn_times
from trident_eval.core.errors import EvalError

_LOG = (
    "\x1b[1mprocess[master]: started with pid [11]\x1b[0m\n"
    "\x1b[1mprocess[rosout-1]: started with pid [12]\x1b[0m\n"
    "\x1b[1mprocess[gazebo-2]: started with pid [13]\x1b[0m\n"
    "\x1b[1mprocess[UAV1/spawn_UAV1-3]: started with pid [14]\x1b[0m\n"
    "\x1b[0m[ INFO] [1795248787.5, 0.010]: SpawnModel: Successfully spawned entity\x1b[0m\n"
    "\x1b[0m[ INFO] [1795248786.25]: SpawnModel: Successfully spawned entity\x1b[0m\n"
    "\x1b[0m[ERROR] [1795248788.25]: SpawnModel: model UAV2 exists\x1b[0m\n"
)


def test_spawn_times_are_wall_times_in_order():
    assert spawn_times(_LOG) == [1795248786.25, 1795248787.5]


def test_nodes_are_all_but_the_master_and_rosout():
    assert node_pids(_LOG) == {"gazebo": 13, "UAV1/spawn_UAV1": 14}


def test_the_folder_is_found_once_it_is_said():
    assert run_folder("trident: building\n") is None
    output = "trident: building\ntrident: a.launch -> out/1-a\ntrident: to look inside …\n"
    assert run_folder(output) == "out/1-a"


@pytest.mark.parametrize(
    ("at", "value"), [(0.0, 5.0), (1.0, 5.0), (1.5, 6.0), (2.0, 7.0), (3.0, 8.0), (9.0, 9.0)]
)
def test_values_between_samples_are_on_the_line(at, value):
    assert interpolate([(1.0, 5.0), (2.0, 7.0), (4.0, 9.0)], at) == pytest.approx(value)


def test_without_samples_there_is_no_value():
    with pytest.raises(EvalError, match="no CPU times"):
        interpolate([], 1.0)
