# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""UAV, UGV and USV in one launch get under way; the world waits for the driver's Twists, too."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from nav_msgs.msg import Odometry
from trident.testing import Launch, eventually, recorder

END_S = 6.0


def test_all_three_get_under_way(launch: Callable[..., Launch]) -> None:
    sensors = {f"{kind}_lidar": False for kind in ("uav", "ugv", "usv")}
    run = launch(
        "trident_bringup",
        "cross_domain.launch",
        paused=True,
        uav_camera=False,
        ugv_camera=False,
        **sensors,
    )
    run.ready()
    begin = {name: run.position(name) for name in ("uav1", "ugv1", "usv1")}
    with recorder("/ugv1/odom", Odometry) as odometry:
        assert run.step_to(END_S) == pytest.approx(END_S)
        eventually(lambda: len(odometry.messages) >= 50 * END_S - 1, "every odometry")
    up = run.position("uav1")[2] - begin["uav1"][2]
    east = run.position("ugv1")[0] - begin["ugv1"][0]
    south = begin["usv1"][1] - run.position("usv1")[1]
    assert up > 2.0
    assert south > 1.0, "out of the harbour"
    # 0.8 m/s^2 up to 1.6 m/s, its first answer 30 ms after time zero: as planned, whoever waited.
    assert east == pytest.approx(6.0 * 1.6 - 1.6**2 / (2 * 0.8), abs=0.15)
    assert {message.header.frame_id for message in odometry.messages} == {"ugv1/odom"}
    assert {message.child_frame_id for message in odometry.messages} == {"ugv1/base_footprint"}
