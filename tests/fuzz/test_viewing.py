# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes that show what there is, under hostile messages."""

from __future__ import annotations

from collections.abc import Callable
from itertools import count
from pathlib import Path

import pytest
import rospy
from gazebo_msgs.msg import ModelStates
from geometry_msgs.msg import Point, Pose, Quaternion, Twist
from hostile import (
    MESSAGES,
    Asked,
    endures,
    messages,
    odometry,
    started,
    withstands,
)
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Image
from trident.testing import Gazebo, Ros, box_sdf, eventually, program, recorder
from trident.testing.fuzz import Target
from visualization_msgs.msg import MarkerArray

from trident_msgs.msg import FleetState, LinkStatus, LinkStatusArray

#: Messages after which a world that works alongside a node is stepped.
BATCH = 20


def fleet() -> FleetState:
    """Of two vehicles, now."""
    turn = Quaternion(0.0, 0.0, 0.0, 1.0)
    message = FleetState(name=["UAV1", "UAV2"])
    message.header.frame_id, message.header.stamp = "world", rospy.Time.now()
    message.pose = [Pose(Point(float(i), 0.0, 1.0), turn) for i in range(2)]
    message.twist = [Twist(), Twist()]
    return message


@pytest.mark.fuzzes("trident_viewer/fleet_markers.py")
def test_fleet_markers(ros: Ros) -> None:
    command = [program("trident_viewer", "fleet_markers.py"), "__name:=markers"]
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


def link() -> LinkStatusArray:
    """Between two vehicles."""
    return LinkStatusArray(links=[LinkStatus(source="UAV1", destination="UAV2", up=True)])


@pytest.mark.fuzzes("trident_viewer/link_markers.py")
def test_link_markers(ros: Ros) -> None:
    command = [program("trident_viewer", "link_markers.py"), "__name:=link_markers"]
    process = started(ros, "/link_markers", command)
    places = rospy.Publisher("/gazebo/model_states", ModelStates, queue_size=10)
    links = rospy.Publisher("/radio/links", LinkStatusArray, queue_size=10)
    poses = ModelStates(name=fleet().name, pose=fleet().pose)
    with recorder("/link_markers", MarkerArray) as markers:

        def still_shows() -> None:
            shown = len(markers.messages)

            def is_shown() -> bool:
                places.publish(poses)
                links.publish(link())
                newest = markers.messages[-1].markers if len(markers.messages) > shown else []
                return "UAV1 - UAV2" in {marker.ns for marker in newest}

            eventually(is_shown, "the link")

        examples = {"/gazebo/model_states": poses, "/radio/links": link()}
        withstands(process, "/link_markers", still_shows, examples)
    places.unregister()
    links.unregister()


def is_heard(target: Target, kind: type, count: int) -> bool:
    """Whether a node listens to so many topics of a kind."""
    return list(target.subscriptions().values()).count(kind) >= count


def hears_its_camera(target: Target) -> bool:
    """Whether a viewer has done with cameras that look for a place."""
    return any(topic.startswith("/observer_") for topic in target.subscriptions())


def film(ros: Ros, step: Callable[[], None], out: Path) -> None:
    """Films box, while hostile pictures come in addition to the simulator's."""
    words = ["--out", str(out), "--follow", "box", "--seconds", "1000", "--size", "64x48"]
    process = started(
        ros, "/observer", [program("trident_viewer", "observer.py"), "__name:=observer", *words]
    )
    listened = Target("/observer")
    eventually(lambda: is_heard(listened, Image, 1), "its subscription")
    endures(listened, MESSAGES, step)
    process.stop()
    assert "Traceback" not in process.log, process.log[-3000:]


@pytest.mark.fuzzes("trident_viewer/observer.py")
def test_the_observer_films_on(ros: Ros, tmp_path: Path) -> None:
    world = Gazebo(ros).ready()
    world.spawn("box", box_sdf("box"))
    times = count(1)
    out = tmp_path / "film.mp4"
    film(ros, lambda: world.step_to(0.05 * next(times)) and None, out)
    assert out.stat().st_size > 1000


@pytest.mark.fuzzes("trident_viewer/overview.py")
def test_the_overview_shows_on(ros: Ros) -> None:
    """Strange depths while it looks for its place, and strange pictures when it has found it."""
    world = Gazebo(ros).ready()
    world.spawn("box", box_sdf("box"))
    command = [program("trident_viewer", "overview.py"), "--stream", "--size", "64x48"]
    process = started(ros, "/overview", [*command, "__name:=overview"])
    target = Target("/overview")
    eventually(lambda: is_heard(target, Image, 12), "cameras that look for a place")
    endures(target, messages(10) // 2)

    def step() -> None:
        world.step()

    def looks() -> bool:
        step()
        return hears_its_camera(target)

    eventually(looks, "its camera")
    endures(target, messages(10) // 2, step)
    with recorder("/overview/image_raw", Image) as pictures:

        def shows() -> bool:
            step()
            return len(pictures.messages) > 2

        eventually(shows, "pictures")
        assert {(picture.width, picture.height) for picture in pictures.messages} == {(64, 48)}
    process.stop()
    assert "Traceback" not in process.log, process.log[-3000:]


@pytest.mark.fuzzes("trident_benchmarks/slam_tour.py")
def test_a_slam_tour_waits_on(ros: Ros, tmp_path: Path) -> None:
    """There is no simulator: it answers odometry, and waits for its robot and for its map."""
    parameters = {"start": [0.0, 0.0, 0.0], "waypoints": [[1.0, 0.0]], "lidar_height": 0.2}
    ros.set_param("/tour", {**parameters, "world": "none", "out_dir": str(tmp_path / "tour")})
    process = started(ros, "/tour", [program("trident_benchmarks", "slam_tour.py"), "__name:=tour"])
    target = Target("/tour")
    eventually(lambda: is_heard(target, Odometry, 1), "its subscriptions")
    asked = Asked("/ground_truth/odom", odometry, "/cmd_vel", Twist)
    asked.is_answered()
    endures(target, messages(10), asked.send)
    asked.close()
    process.eventually_logs("process[robot_state_publisher")  # its child takes an interrupt
    assert process.stop(limit_s=60.0) == 1, process.log[-3000:]  # its tour is not done
    own = process.log.split("Traceback")
    assert len(own) == 1, own[1][:3000]
