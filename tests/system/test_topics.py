# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Names, types, stamps, frames and order of the topics that the server publishes."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import pairwise

import pytest
import rospy
import tf2_ros
from gazebo_msgs.msg import LinkStates, ModelState, ModelStates
from geometry_msgs.msg import PoseStamped, Twist, Vector3
from harness import (
    Gazebo,
    Recorder,
    Ros,
    box_sdf,
    eventually,
    logged_problems,
    pilot_of,
    pose,
    recorder,
    vehicle_urdf,
)
from mav_msgs.msg import Actuators
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float32
from tcpros import RawSubscriber
from tf2_msgs.msg import TFMessage

from trident_msgs.msg import FleetState

DT = 0.01
FIREFLY_SIGNS = (1, -1, 1, -1, 1, -1)  # + is counter-clockwise
ODOMETRY_GROUP = {
    "odometry": "nav_msgs/Odometry",
    "pose": "geometry_msgs/Pose",
    "pose_with_covariance": "geometry_msgs/PoseWithCovarianceStamped",
    "position": "geometry_msgs/PointStamped",
    "transform": "geometry_msgs/TransformStamped",
}
PER_VEHICLE = {
    **{f"odometry_sensor1/{name}": kind for name, kind in ODOMETRY_GROUP.items()},
    **{f"ground_truth/{name}": kind for name, kind in ODOMETRY_GROUP.items()},
    "ground_truth/imu": "sensor_msgs/Imu",
    "imu": "sensor_msgs/Imu",
    "gazebo/command/motor_speed": "mav_msgs/Actuators",
    "motor_speed": "mav_msgs/Actuators",
    **{f"motor_speed/{index}": "std_msgs/Float32" for index in range(6)},
    "joint_states": "sensor_msgs/JointState",
}


@pytest.fixture
def listen(gazebo: Gazebo) -> Iterator[Callable[..., Recorder]]:
    """Recorders that end with the test."""
    with ExitStack() as stack:
        yield lambda topic, kind: stack.enter_context(recorder(topic, kind, queue_size=10000))


def test_a_vehicle_has_the_topics_of_rotors(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    gazebo.spawn("UAV2", at=pose(3.0, 0.0, 0.1))
    published = dict(rospy.get_published_topics("/"))
    for vehicle in ("UAV1", "UAV2"):
        for name, kind in PER_VEHICLE.items():
            assert published.get(f"/{vehicle}/{name}") == kind, name
    assert published["/clock"] == "rosgraph_msgs/Clock"
    assert published["/tf"] == "tf2_msgs/TFMessage"
    assert published["/gazebo/model_states"] == "gazebo_msgs/ModelStates"
    assert published["/gazebo/link_states"] == "gazebo_msgs/LinkStates"
    subscribed = dict(ros.master.getSystemState("/system_tests")[2][1])
    assert "/gazebo" in subscribed["/UAV2/command/motor_speed"]
    assert ros.call("rostopic", "type", "/UAV1/imu").strip() == "sensor_msgs/Imu"
    assert "/gazebo" in ros.call("rosnode", "info", "/gazebo")


def test_every_topic_of_a_vehicle_carries_a_message_a_step(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    import roslib.message

    gazebo.spawn("UAV1")
    # Nothing before the first command; what is only looked at keeps to a wall-clock rate.
    others = ("gazebo/command/motor_speed", "joint_states")
    recorders = [
        listen(f"/UAV1/{name}", roslib.message.get_message_class(kind))
        for name, kind in PER_VEHICLE.items()
        if name not in others
    ]
    joints = listen("/UAV1/joint_states", JointState)
    gazebo.step(5)
    eventually(
        lambda: bool(joints.messages) and joints.messages[-1].header.stamp.to_sec() == 0.05,
        "the joints after the last step",
    )
    for each in recorders:
        assert len(each.received(5)) == 5, each.topic


def test_odometry_is_stamped_one_step_late_as_in_rotors(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1", at=pose(z=50.0))
    odometry = listen("/UAV1/odometry_sensor1/odometry", Odometry)
    gazebo.step(3)
    for index, message in enumerate(odometry.received(3)):
        assert message.header.stamp.to_nsec() == (index + 1) * 10_000_000
        # The state of `index` steps, in free fall with semi-implicit steps.
        fallen = 0.5 * 9.8 * DT * DT * index * (index + 1)
        assert 50.0 - message.pose.pose.position.z == pytest.approx(fallen, abs=1e-9)
        assert message.header.frame_id == "world"
        assert message.child_frame_id == "UAV1/odometry_sensor1"


def test_the_twist_of_odometry_is_in_the_bodys_frame(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1", at=pose(z=50.0))
    odometry = listen("/UAV1/odometry_sensor1/odometry", Odometry)
    turned = pose(0.0, 0.0, 50.0, yaw_rad=math.pi / 2.0)
    twist = Twist(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.1))
    gazebo.ask("set_model_state", model_state=ModelState("UAV1", turned, twist, "world"))
    gazebo.step(1)
    got = odometry.received(1)[0].twist.twist
    assert (got.linear.x, got.linear.y) == pytest.approx((0.0, -1.0), abs=1e-9)
    assert got.angular.z == pytest.approx(0.1, abs=1e-9)


def test_model_and_link_states_are_in_the_worlds_frame(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1", at=pose(1.0, 2.0, 50.0, yaw_rad=math.pi / 2.0))
    models = listen("/gazebo/model_states", ModelStates)
    links = listen("/gazebo/link_states", LinkStates)
    twist = Twist(Vector3(1.0, 0.0, 0.0), Vector3())
    at = pose(1.0, 2.0, 50.0, yaw_rad=math.pi / 2.0)
    gazebo.ask("set_model_state", model_state=ModelState("UAV1", at, twist, "world"))
    gazebo.step(1)
    eventually(lambda: bool(models.messages) and bool(links.messages), "both states")
    message = models.messages[-1]
    index = message.name.index("UAV1")
    assert message.twist[index].linear.x == pytest.approx(1.0)
    assert message.pose[index].position.x == pytest.approx(1.0 + DT)
    assert "ground_plane" in message.name
    assert "UAV1::UAV1/base_link" in links.messages[-1].name


@pytest.mark.parametrize("gazebo", [{"wait_for": 1}], indirect=True)
def test_motors_turn_as_their_directions_say(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1")
    gazebo.controller("UAV1")
    speeds = listen("/UAV1/motor_speed", Actuators)
    joints = listen("/UAV1/joint_states", JointState)
    slowed = listen("/UAV1/motor_speed/1", Float32)
    commands = listen("/UAV1/gazebo/command/motor_speed", Actuators)
    with pilot_of("UAV1") as pilot:
        pilot.send("UAV1", 0.0, 0.0, 1.0, 0.01)
        gazebo.step(100)
        eventually(lambda: bool(commands.messages), "a command that went through")
        gazebo.step(890)
        for _ in range(10):  # no faster than a Python node can listen
            now = gazebo.step(1)
            eventually(
                lambda at=now: speeds.messages[-1].header.stamp.to_sec() >= at - 1e-6,
                "the speeds of a step",
            )
    last = speeds.messages[-1]
    assert [math.copysign(1.0, value) for value in last.angular_velocities] == list(FIREFLY_SIGNS)
    assert [abs(value) for value in last.angular_velocities] == pytest.approx([543.3] * 6, abs=1.0)
    # A single motor's topic has the joint's rate, which RotorS slows down by ten.
    assert slowed.messages[-1].data == pytest.approx(last.angular_velocities[1] / 10.0, rel=1e-3)
    names = joints.messages[-1].name
    assert names == [f"UAV1/rotor_{index}_joint" for index in range(6)]
    assert joints.messages[-1].position != joints.messages[-2].position
    assert len(commands.messages[-1].angular_velocities) == 6


def test_an_imu_at_rest_feels_gravity_and_the_noisy_one_has_noise(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1", at=pose(0.0, 0.0, 0.08, yaw_rad=0.5))
    gazebo.step(300)
    noisy = listen("/UAV1/imu", Imu)
    exact = listen("/UAV1/ground_truth/imu", Imu)
    for k in range(40):  # no faster than a Python node can listen
        gazebo.step(5)
        noisy.received(5 * k + 5)
        exact.received(5 * k + 5)
    truth = exact.messages[-1]
    assert truth.linear_acceleration.z == pytest.approx(9.8, abs=0.05)
    assert truth.orientation.z == pytest.approx(math.sin(0.25), abs=1e-3)
    assert truth.header.frame_id.startswith("UAV1/")
    values = [message.linear_acceleration.z for message in noisy.messages]
    assert len(set(values)) == 200
    mean = sum(values) / len(values)
    assert mean == pytest.approx(9.8, abs=1.0)
    spread = math.sqrt(sum((value - mean) ** 2 for value in values) / len(values))
    assert spread == pytest.approx(0.004 / math.sqrt(DT), rel=0.3)
    stamps = [message.header.stamp.to_nsec() for message in noisy.messages]
    assert all(b - a == 10_000_000 for a, b in pairwise(stamps))


def test_tf_joins_the_world_to_each_vehicle(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1", at=pose(1.0, 2.0, 0.08))
    gazebo.spawn("UAV2", at=pose(3.0, 2.0, 0.08))
    tf = listen("/tf", TFMessage)
    gazebo.step(2)

    def edges() -> set[tuple[str, str]]:
        return {
            (transform.header.frame_id, transform.child_frame_id)
            for message in tf.messages
            for transform in message.transforms
        }

    expected = {
        ("world", f"{vehicle}/{frame}")
        for vehicle in ("UAV1", "UAV2")
        for frame in ("odometry_sensor1", "base_link")
    }
    eventually(lambda: expected <= edges(), f"transforms {expected}")


def test_a_step_is_one_message_of_its_time_on_each_topic(ros: Ros, gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    clock = RawSubscriber(ros.master, "/clock", Clock)
    assert clock.next().clock.to_nsec() == 0, "latched, for those who come while time stands"
    odometry = RawSubscriber(ros.master, "/UAV1/odometry_sensor1/odometry", Odometry)
    imu = RawSubscriber(ros.master, "/UAV1/imu", Imu)
    readers = (clock, odometry, imu)
    try:
        for k in range(1, 60):
            gazebo.step(1)
            stamps = [clock.next().clock, odometry.next().header.stamp, imu.next().header.stamp]
            assert [stamp.to_nsec() for stamp in stamps] == [k * 10_000_000] * 3
        assert not any(reader.arrived() for reader in readers)
    finally:
        for reader in readers:
            reader.close()


def test_the_clock_is_slowed_in_simulated_time_when_asked(
    start_gazebo: Callable[..., Gazebo],
) -> None:
    gazebo = start_gazebo(pub_clock_frequency=20.0, max_clock_rate=100000.0)
    with recorder("/clock", Clock, queue_size=10000) as clock:
        gazebo.step(100)
        eventually(lambda: clock.messages[-1].clock.to_sec() == 1.0, "/clock at 1 s")
        assert len(clock.messages) <= 23


def test_a_world_that_stands_still_is_silent(
    ros: Ros, gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1")
    quiet = [
        listen("/gazebo/model_states", ModelStates),
        listen("/gazebo/link_states", LinkStates),
        listen("/UAV1/odometry_sensor1/odometry", Odometry),
        listen("/tf", TFMessage),
    ]
    latched = [listen("/clock", Clock), listen("/gazebo/fleet_state", FleetState)]
    for _ in range(100):
        gazebo.time()
    assert [len(each.messages) for each in quiet] == [0] * len(quiet)
    assert all(len(each.messages) <= 5 for each in latched), [len(e.messages) for e in latched]
    assert latched[0].received(1)[0].clock.to_nsec() == 0


def test_a_command_that_is_not_finite_is_reported_once_and_the_last_one_stays(
    gazebo: Gazebo, listen: Callable[..., Recorder]
) -> None:
    gazebo.spawn("UAV1")
    gazebo.spawn("crate", box_sdf("crate"), pose(5.0, 0.0, 0.1))
    speeds = listen("/UAV1/motor_speed", Actuators)
    publisher = rospy.Publisher("/UAV1/command/motor_speed", Actuators, queue_size=10)
    eventually(lambda: publisher.get_num_connections() > 0, "the server listens to commands")

    def steady(value: float) -> bool:
        gazebo.step(10)
        return bool(speeds.messages) and [
            abs(speed) for speed in speeds.messages[-1].angular_velocities
        ] == pytest.approx([value] * 6, rel=1e-3)

    publisher.publish(Actuators(angular_velocities=[300.0] * 6))
    eventually(lambda: steady(300.0), "the motors follow")
    for bad in (math.nan, math.inf, -math.inf):
        publisher.publish(Actuators(angular_velocities=[300.0, bad, 200.0, 200.0, 200.0, 200.0]))
    eventually(lambda: gazebo.step(1) > 0.0 and "motor command 1 is" in gazebo.log, "the warning")
    assert steady(300.0), "the last good command stays"
    publisher.publish(Actuators(angular_velocities=[250.0] * 6))
    eventually(lambda: steady(250.0), "the next good command acts")
    reported = [line for line in logged_problems(gazebo.log) if "motor command" in line]
    assert len(reported) == 1, reported
    assert "UAV1" in reported[0]
    publisher.unregister()


@pytest.mark.parametrize("gazebo", [{"wait_for": 1}], indirect=True)
def test_a_set_point_that_is_not_finite_is_refused_by_the_controller(gazebo: Gazebo) -> None:
    gazebo.spawn("UAV1")
    controller = gazebo.controller("UAV1")
    with pilot_of("UAV1") as pilot:
        pilot.send("UAV1", 0.0, 0.0, 1.0, 0.01)
        gazebo.step(500)
        message = PoseStamped(pose=pose(math.nan, 0.0, 1.0))
        publisher = rospy.Publisher("/UAV1/command/pose", PoseStamped, queue_size=1)
        pilot.connected("UAV1")
        publisher.publish(message)
        controller.eventually_logs("refused")
        gazebo.step(200)
    assert gazebo.position("UAV1") == pytest.approx((0.0, 0.0, 1.04), abs=0.02)


def test_state_publishers_complete_the_tree_of_two_vehicles(ros: Ros, gazebo: Gazebo) -> None:
    ros.set_param("/use_sim_time", True)
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer)
    positions = {"UAV1": (1.0, 2.0, 0.08), "UAV2": (-3.0, 0.5, 0.08)}
    for name, position in positions.items():
        gazebo.spawn(name, at=pose(*position))
        ros.set_param(f"/{name}/robot_description", vehicle_urdf(name))
        ros.launch(["rosrun", "robot_state_publisher", "robot_state_publisher", f"__ns:=/{name}"])
    gazebo.ask("set_physics_properties", **physics_at_rate(gazebo, 100.0))
    gazebo.ask("unpause_physics")
    rotors = [f"{name}/rotor_{index}" for name in positions for index in range(6)]
    for frame in rotors:
        eventually(
            lambda at=frame: buffer.can_transform("world", at, rospy.Time(0)), f"world -> {frame}"
        )
    arm = 0.215
    for frame in rotors:
        hub = buffer.lookup_transform(frame.split("/")[0] + "/base_link", frame, rospy.Time(0))
        offset = hub.transform.translation
        assert math.hypot(offset.x, offset.y) == pytest.approx(arm, abs=1e-3), frame
        assert offset.z == pytest.approx(0.037, abs=1e-3)
    between = buffer.lookup_transform("UAV1/base_link", "UAV2/base_link", rospy.Time(0))
    assert between.transform.translation.x == pytest.approx(-4.0, abs=0.01)
    assert between.transform.translation.y == pytest.approx(-1.5, abs=0.01)
    listener.unregister()


def physics_at_rate(gazebo: Gazebo, rate_hz: float) -> dict[str, object]:
    """The physics as they are, at another update rate."""
    now = gazebo.ask("get_physics_properties")
    return {
        "time_step": now.time_step,
        "max_update_rate": rate_hz,
        "gravity": now.gravity,
        "ode_config": now.ode_config,
    }
