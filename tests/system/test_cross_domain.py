# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs, UGVs and USVs in one launch move; the world waits for the drivers' Twists, too."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from nav_msgs.msg import Odometry
from trident.testing import Launch, eventually, recorder

END_S = 6.0
WITHOUT_SENSORS = {
    "uav_camera": False,
    "ugv_camera": False,
    **{f"{kind}_lidar": False for kind in ("uav", "ugv", "usv")},
}
TWO_OF_EACH = {f"{kind}s": 2 for kind in ("uav", "ugv", "usv")}


def test_all_move_twice_alike(launch: Callable[..., Launch]) -> None:
    """Two of each: stepped, with a listener, and run to its end by itself."""
    words = ("trident_bringup", "cross_domain.launch")
    args = {**WITHOUT_SENSORS, **TWO_OF_EACH}
    run = launch(*words, paused=True, **args)
    run.ready()
    begin = {name: run.position(name) for name in ("uav2", "ugv1", "usv2")}
    with recorder("/ugv1/odom", Odometry) as odometry:
        assert run.step_to(END_S) == pytest.approx(END_S)
        eventually(lambda: len(odometry.messages) >= 50 * END_S - 1, "every odometry")
    up = run.position("uav2")[2] - begin["uav2"][2]
    east = run.position("ugv1")[0] - begin["ugv1"][0]
    south = begin["usv2"][1] - run.position("usv2")[1]
    assert up > 2.0
    assert south > 1.0, "out of the harbour"
    # 0.8 m/s^2 up to 1.6 m/s, its first answer 30 ms after time zero: as planned, independent of
    # waiting.
    assert east == pytest.approx(6.0 * 1.6 - 1.6**2 / (2 * 0.8), abs=0.15)
    assert {message.header.frame_id for message in odometry.messages} == {"ugv1/odom"}
    assert {message.child_frame_id for message in odometry.messages} == {"ugv1/base_footprint"}
    assert not run.end()

    again = launch(*words, duration=END_S, env={"TRIDENT_END": "1"}, **args)
    assert again.process.wait() == 0, again.log
    assert again.results()["sim_s"] == run.results()["sim_s"] == pytest.approx(END_S)
    assert again.results()["state_hash"] == run.results()["state_hash"]
