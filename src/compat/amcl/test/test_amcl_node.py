# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node amcl as a process: what it publishes, and what it says about bad input."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseArray, PoseWithCovarianceStamped, TransformStamped
from sensor_msgs.msg import LaserScan
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage
from trident.testing import Ros, eventually, program, recorder

CELL_M = 0.05
TRUTH = (2.0, 1.5, 0.3)
ODOM = (10.0, -4.0, 1.0)  # of the robot, in the odometry's frame


def room() -> npt.NDArray[np.bool_]:
    """Occupied cells of 6 m x 4 m with a cabinet; row 0 at y = 0."""
    occupied = np.zeros((80, 120), bool)
    occupied[[0, -1], :] = occupied[:, [0, -1]] = True
    occupied[50:64, 80:95] = True
    return occupied


def save(folder: Path) -> Path:
    pixels = np.where(room()[::-1], 0, 254).astype(np.uint8)
    (folder / "room.pgm").write_bytes(b"P5 120 80 255\n" + pixels.tobytes())
    (folder / "room.yaml").write_text(
        f"image: room.pgm\nresolution: {CELL_M}\norigin: [0, 0, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n"
    )
    return folder / "room.yaml"


def scan(stamp_s: float) -> LaserScan:
    message = LaserScan(angle_min=-math.pi, angle_increment=math.radians(2), range_max=10.0)
    message.header.stamp = rospy.Time.from_sec(stamp_s)
    message.header.frame_id = "laser"
    occupied = room()
    along = np.arange(0.0, 10.0, 0.01)
    x, y, yaw = TRUTH
    for beam in range(180):
        angle = yaw + message.angle_min + beam * message.angle_increment
        columns = ((x + along * math.cos(angle)) / CELL_M).astype(int).clip(0, 119)
        rows = ((y + along * math.sin(angle)) / CELL_M).astype(int).clip(0, 79)
        message.ranges.append(float(along[np.argmax(occupied[rows, columns])]))
    return message


def transform(
    parent: str, child: str, stamp_s: float, pose: tuple[float, float, float]
) -> TFMessage:
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = parent
    message.header.stamp = rospy.Time.from_sec(stamp_s)
    message.transform.translation.x, message.transform.translation.y = pose[:2]
    message.transform.rotation.z = math.sin(pose[2] / 2)
    message.transform.rotation.w = math.cos(pose[2] / 2)
    return TFMessage([message])


def yaw_of(q: object) -> float:
    return 2.0 * math.atan2(q.z, q.w)  # type: ignore[attr-defined]


class Robot:
    """Stands at TRUTH and publishes what a standing robot does."""

    def __init__(self) -> None:
        options = {"queue_size": 10, "latch": True}
        self.scans = rospy.Publisher("/scan", LaserScan, queue_size=10)
        self.tf = rospy.Publisher("/tf", TFMessage, queue_size=10)
        self.fixed = rospy.Publisher("/tf_static", TFMessage, **options)
        self.fixed.publish(transform("base_link", "laser", 0.0, (0.0, 0.0, 0.0)))
        self.message = scan(0.0)
        self.now_s = 100.0

    def publish(self, stamp_s: float, with_odometry: bool = True) -> None:
        if with_odometry:
            self.tf.publish(transform("odom", "base_link", stamp_s, ODOM))
        self.message.header.stamp = rospy.Time.from_sec(stamp_s)
        self.scans.publish(self.message)

    def close(self) -> None:
        for publisher in (self.scans, self.tf, self.fixed):
            publisher.unregister()


def reports(messages: list[DiagnosticArray], words: str) -> Callable[[], bool]:
    return lambda: any(words in status.message for array in messages for status in array.status)


def test_it_finds_the_robot_and_says_what_is_wrong(ros: Ros, tmp_path: Path) -> None:
    for name, value in {
        "initial_pose_x": TRUTH[0] + 0.2,
        "initial_pose_y": TRUTH[1] - 0.1,
        "initial_pose_a": TRUTH[2],
        "laser_max_beams": 60,
        "transform_tolerance": 0.25,
        "save_pose_rate": 20.0,
        "recovery_alpha_slow": 0.0,
    }.items():
        ros.set_param(f"/amcl/{name}", value)
    ros.launch([program("map_server", "map_server"), save(tmp_path), "__name:=map_server"])
    ros.launch([program("amcl", "amcl")])
    robot = Robot()
    with (
        recorder("/amcl_pose", PoseWithCovarianceStamped) as poses,
        recorder("/particlecloud", PoseArray) as clouds,
        recorder("/tf", TFMessage, queue_size=1000) as transforms,
        recorder("/diagnostics", DiagnosticArray) as diagnostics,
    ):
        rospy.wait_for_service("/request_nomotion_update", 10.0)
        force = rospy.ServiceProxy("/request_nomotion_update", Empty)

        def is_found() -> bool:
            robot.now_s += 0.1
            robot.publish(robot.now_s)
            if not poses.messages:
                return False  # not yet asked for the map
            force()
            place = poses.messages[-1].pose.pose.position
            return math.hypot(place.x - TRUTH[0], place.y - TRUTH[1]) < 0.04

        eventually(is_found, "amcl has found the robot")
        newest = poses.messages[-1]
        assert yaw_of(newest.pose.pose.orientation) == pytest.approx(TRUTH[2], abs=0.05)
        assert 0.0 < newest.pose.covariance[0] < 0.05
        assert len(clouds.messages[-1].poses) >= 100
        own = [t for m in transforms.messages for t in m.transforms if t.header.frame_id == "map"]
        assert own[-1].child_frame_id == "odom"
        late = own[-1].header.stamp.to_sec() - robot.now_s
        assert -0.5 < late <= 0.25 + 1e-6, "0.25 s ahead of a scan of late"
        turned = yaw_of(own[-1].transform.rotation)
        assert turned == pytest.approx(TRUTH[2] - ODOM[2], abs=0.06)
        eventually(
            lambda: abs(rospy.get_param("/amcl/initial_pose_x") - TRUTH[0]) < 0.06, "the pose saved"
        )

        robot.publish(robot.now_s + 2.0, with_odometry=False)
        eventually(
            reports(diagnostics.messages, "odom -> base_link is 2.000 s late for the scan of"),
            "the late transform named",
        )

        def count_of(kind: str) -> str:
            """How often, by the newest diagnostics."""
            for array in reversed(diagnostics.messages):
                for status in array.status:
                    if status.name.endswith(kind):
                        return str(status.values[0].value)
            return "0"

        assert count_of("transform late") == "1", "a scan that waits is counted once"
        robot.publish(5.0)
        eventually(reports(diagnostics.messages, "went back by"), "a warning of the time jump")
        robot.message.ranges = [math.nan] * 180
        robot.now_s = 6.0

        def is_reported() -> bool:
            robot.now_s += 0.1
            robot.publish(robot.now_s)
            force()
            return reports(diagnostics.messages, "no return within its limits")()

        eventually(is_reported, "a warning of the scan without returns")
    robot.close()


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["_min_particles:=50", "_max_particles:=10"], "min_particles: 50, legal: at most"),
        (["_laser_model_type:=beams"], "beam, likelihood_field, likelihood_field_prob"),
        (["_laser_max_beams:=many"], "laser_max_beams"),
    ],
)
def test_a_bad_parameter_is_one_error(ros: Ros, words: list[str], expected: str) -> None:
    process = ros.launch([program("amcl", "amcl"), *words])
    assert process.wait() == 1
    assert expected in process.log
