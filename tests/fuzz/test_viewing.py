# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that show what there is, under hostile messages."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from pathlib import Path

import rospy
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from hostile import started, withstands
from sensor_msgs.msg import Image
from trident.testing import Gazebo, Ros, box_sdf, eventually, program, recorder
from trident.testing.fuzz import Campaign, CampaignOptions, Target
from visualization_msgs.msg import MarkerArray

from trident_msgs.msg import FleetState


def fleet() -> FleetState:
    """Of two vehicles, now."""
    turn = Quaternion(0.0, 0.0, 0.0, 1.0)
    message = FleetState(name=["UAV1", "UAV2"])
    message.header.frame_id, message.header.stamp = "world", rospy.Time.now()
    message.pose = [Pose(Point(float(i), 0.0, 1.0), turn) for i in range(2)]
    message.twist = [Twist(), Twist()]
    return message


def test_fleet_markers(ros: Ros) -> None:
    command = [program("trident_eval", "fleet_markers.py"), "__name:=markers"]
    process = started(ros, "/markers", command)
    states = rospy.Publisher("/gazebo/fleet_state", FleetState, queue_size=10, tcp_nodelay=True)

    def still_shows() -> None:
        with recorder("/fleet_markers", MarkerArray) as markers:

            def is_shown() -> bool:
                states.publish(fleet())
                newest = markers.messages[-1].markers if markers.messages else []
                return {marker.ns for marker in newest} >= {"UAV1/name", "UAV2/shape"}

            eventually(is_shown, "both vehicles")

    withstands(process, "/markers", still_shows, {"/gazebo/fleet_state": fleet()})
    states.unregister()


def film(ros: Ros, step: Callable[[], None], out: Path) -> None:
    """Films box, while hostile pictures come beside the simulator's."""
    words = ["--out", str(out), "--follow", "box", "--seconds", "1000", "--size", "64x48"]
    process = started(
        ros, "/observer", [program("trident_eval", "observer.py"), "__name:=observer", *words]
    )
    listened = Target("/observer")
    eventually(lambda: Image in listened.subscriptions().values(), "its subscription")
    found = Campaign(listened, CampaignOptions(messages=1000), None, step).run()
    assert not found.problems, found.text()
    assert sum(found.sent.values()) == 1000
    process.stop()
    assert "Traceback" not in process.log, process.log[-3000:]


def test_the_observer_films_on(ros: Ros, tmp_path: Path) -> None:
    world = Gazebo(ros).ready()
    world.spawn("box", box_sdf("box"))
    times = count(1)
    out = tmp_path / "film.mp4"
    film(ros, lambda: world.step_to(0.05 * next(times)) and None, out)
    assert out.stat().st_size > 1000
