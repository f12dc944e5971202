# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that command a fleet, under hostile messages while the simulator stands."""

from __future__ import annotations

from hostile import MESSAGES, SEED
from trident.testing import Launch, Ros
from trident.testing.fuzz import Campaign, CampaignOptions, Target

LEADER = "/UAV1/odometry_sensor1/odometry"


def withstands(run: Launch, node: str) -> None:
    """It lives, commands nothing that is no number, and says what it refuses.

    Who takes the simulator's place, or the leader's, is obeyed: where it flies is not asked.
    """
    # Each may have it command minutes of a flight: a thirtieth of what other nodes get.
    count = max(MESSAGES // 30, 100)
    settings = CampaignOptions(messages=count, seed=SEED, batch=20, words=("UAV1", "UAV2"))
    found = Campaign(Target(node), settings).run()
    print(node, found.text())
    assert not found.problems, found.text()
    assert sum(found.sent.values()) == count
    for name, log in run.logs():
        # rospy itself logs one where a topic is given up while it is being connected.
        own = [line for line in log.splitlines() if "[rospy.internal]" not in line]
        assert not any("Traceback" in line for line in own), f"{name}: {log[:5000]}"
    assert not run.died()


def test_a_formation_node(ros: Ros) -> None:
    file = "multi_uav_simulation.launch"
    with Launch(ros, "trident_bringup", file, uavs=2, mode="gate", paused=True) as run:
        run.ready()
        run.step_to(1.0)
        withstands(run, "/UAV1/formation_node")


def test_a_follower(ros: Ros) -> None:
    file = "leader_follower.launch"
    with Launch(ros, "trident_bringup", file, uavs=2, leader_topic=LEADER, paused=True) as run:
        run.ready()
        run.step_to(1.0)
        withstands(run, "/leader_follower")
