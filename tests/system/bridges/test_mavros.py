# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Two mavros and a ground station lead simulated vehicles, judged by the truth."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
import rospy
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from mavros_msgs.msg import CommandCode, State, StatusText, Waypoint, WaypointList
from mavros_msgs.srv import CommandBool, SetMode, WaypointPull, WaypointPush
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from sensor_msgs.msg import Imu
from trident.testing import Launch, Recorder, eventually
from trident.testing.mavlink_vehicles import write_fleet
from trident_base.ports import free_port

#: Ten times real time is what a client of Python at 20 Hz of the wall keeps up with.
LAUNCH = """<launch>
  <include file="$(find trident_bringup)/launch/mavlink_fleet.launch">
    <arg name="vehicles" value="{vehicles}"/>
    <arg name="real_time_factor" value="10"/>
  </include>
  <group ns="uav1">
    <include file="$(find mavros)/launch/px4.launch">
      <arg name="fcu_url" value="udp://:{own}@localhost:{far}"/>
      <arg name="gcs_url" value="udp://:{to_station}@localhost:{station}"/>
    </include>
  </group>
  <group ns="usv1">
    <include file="$(find mavros)/launch/apm.launch">
      <arg name="fcu_url" value="tcp://localhost:{router}"/>
      <arg name="tgt_system" value="3"/>
    </include>
  </group>
</launch>
"""
TURNED = math.pi / 2  # nose to the north
NEAR_M, NEAR_M_S, NEAR_RAD = 0.3, 0.3, 0.1
STEADY = 25  # messages, of one simulated second


class Mavros:
    """One node: what it publishes, and its services."""

    def __init__(self, namespace: str) -> None:
        self.name = f"/{namespace}/mavros"
        self._recorders: dict[str, Recorder] = {}
        self.states = self.hear("state", State)
        self.texts = self.hear("statustext/recv", StatusText)

    def hear(self, topic: str, kind: Any) -> Recorder:
        """What comes from now on, of a topic below the node."""
        self._recorders[topic] = Recorder(f"{self.name}/{topic}", kind).connected()
        return self._recorders[topic]

    def newest(self, topic: str) -> Any:
        """The last message of a topic that is heard."""
        return self._recorders[topic].received()[-1]

    def call(self, name: str, kind: Any, **request: Any) -> Any:
        """The answer of a service."""
        rospy.wait_for_service(f"{self.name}/{name}", 30.0)
        return rospy.ServiceProxy(f"{self.name}/{name}", kind)(**request)

    def connected(self) -> Mavros:
        """Return when its vehicle is there."""
        eventually(lambda: self.newest("state").connected, f"the vehicle of {self.name}")
        return self

    def close(self) -> None:
        """Unsubscribe."""
        for recorder in self._recorders.values():
            recorder.close()


@contextmanager
def mavros(namespace: str) -> Iterator[Mavros]:
    """Connected; its topics end with the block."""
    node = Mavros(namespace)
    try:
        yield node.connected()
    finally:
        node.close()


@contextmanager
def setpoints(node: Mavros, topic: str, message: Any) -> Iterator[None]:
    """The message, as it is then, 20 times a second of the wall, as PX4's example sends it."""
    publisher = rospy.Publisher(f"{node.name}/{topic}", type(message), queue_size=10)
    timer = rospy.Timer(rospy.Duration.from_sec(0.05), lambda _event: publisher.publish(message))
    try:
        yield
    finally:
        timer.shutdown()
        timer.join()
        publisher.unregister()


class Station:
    """A ground station behind the node's gcs_url."""

    def __init__(self, port: int) -> None:
        self.link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255)

    def expect(self, kind: str, ask: Callable[[], None] = lambda: None, **fields: int) -> Any:
        """A message of a type and with these fields; asked for again until it comes.

        What has come while nobody listened has filled the socket: newer packets are lost until it
        is read.
        """
        found: list[Any] = []

        def comes() -> bool:
            ask()
            message = self.link.recv_match(type=kind, blocking=True, timeout=0.2)
            while message is not None and not found:
                if all(getattr(message, name) == value for name, value in fields.items()):
                    found.append(message)
                message = self.link.recv_match(type=kind)
            return bool(found)

        eventually(comes, kind)
        return found[0]

    def clear_mission(self, system: int) -> None:
        """As QGroundControl does it."""

        def ask() -> None:
            self.link.mav.mission_clear_all_send(system, 1, mavlink.MAV_MISSION_TYPE_MISSION)

        answer = self.expect("MISSION_ACK", ask, target_system=255)
        assert answer.type == mavlink.MAV_MISSION_ACCEPTED

    def close(self) -> None:
        """End the link."""
        self.link.close()


def yaw_of(q: Any) -> float:
    """Counterclockwise from east [rad]."""
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y**2 + q.z**2))


def is_steady(recorder: Recorder, condition: Callable[[Any], bool]) -> bool:
    """Whether it has held for a second."""
    newest = recorder.messages[-STEADY:]
    return len(newest) == STEADY and all(condition(message) for message in newest)


def assert_near(found: Any, expected: tuple[float, float, float], limit: float) -> None:
    """Each component is."""
    values = (found.x, found.y, found.z)
    assert values == pytest.approx(expected, abs=limit)


@pytest.fixture
def fleet(launch: Callable[..., Launch], tmp_path: Path) -> Iterator[tuple[Launch, Station]]:
    """Three vehicles, two mavros, and a station at the first of them."""
    vehicles = write_fleet(tmp_path, uav1="px4")
    station_port = free_port()
    text = LAUNCH.format(
        vehicles=vehicles.path,
        own=vehicles.port("uav1", "offboard_remote"),
        far=vehicles.port("uav1", "offboard"),
        to_station=free_port(),
        station=station_port,
        router=vehicles.router,
    )
    file = tmp_path / "fleet.launch"
    file.write_text(text, encoding="utf-8")
    station = Station(station_port)
    run = launch(str(file))
    run.ready()
    yield run, station
    station.close()


def refused_with_the_reason(uav: Mavros) -> None:
    """OFFBOARD wants set-points first; the vehicle's text says so."""
    assert not uav.call("set_mode", SetMode, custom_mode="OFFBOARD").mode_sent
    eventually(
        lambda: any("OFFBOARD" in m.text and "set-point" in m.text for m in uav.texts.messages),
        "the reason",
    )


def flies_offboard(uav: Mavros, run: Launch) -> None:
    """Two meters up and one to the east with the nose to the north, then by velocity."""
    poses = uav.hear("local_position/pose", PoseStamped)
    x0, y0, z0 = run.position("uav1")
    assert_near(poses.received()[-1].pose.position, (x0, y0, z0), NEAR_M)
    assert poses.messages[-1].header.frame_id == "uav1/map"
    target = PoseStamped()
    target.pose.position.x, target.pose.position.y, target.pose.position.z = x0 + 1, y0, z0 + 2
    target.pose.orientation.z = target.pose.orientation.w = math.sqrt(0.5)

    def is_there(message: PoseStamped) -> bool:
        at = message.pose
        distance = math.dist((at.position.x, at.position.y, at.position.z), (x0 + 1, y0, z0 + 2))
        return distance < NEAR_M / 2 and abs(yaw_of(at.orientation) - TURNED) < NEAR_RAD / 2

    with setpoints(uav, "setpoint_position/local", target):
        eventually(
            lambda: bool(uav.call("set_mode", SetMode, custom_mode="OFFBOARD").mode_sent),
            "OFFBOARD",
        )
        assert uav.call("cmd/arming", CommandBool, value=True).success
        eventually(lambda: is_steady(poses, is_there), "the set-point")
        assert uav.newest("state").mode == "OFFBOARD"
        assert run.position("uav1") == pytest.approx((x0 + 1, y0, z0 + 2), abs=NEAR_M)
        q = run.state("uav1").orientation
        assert 2.0 * math.atan2(q[2], q[3]) == pytest.approx(TURNED, abs=NEAR_RAD)
        imu = uav.hear("imu/data", Imu).received(20)[-1]
        assert yaw_of(imu.orientation) == pytest.approx(TURNED, abs=NEAR_RAD)
        assert_near(imu.linear_acceleration, (0.0, 0.0, 9.8), 1.0)


def moves_east(uav: Mavros, run: Launch) -> None:
    """East is to the right of a nose to the north: signs of world and body."""
    world = uav.hear("local_position/velocity_local", TwistStamped)
    body = uav.hear("local_position/velocity_body", TwistStamped)
    command = Twist()
    command.linear.x = 2.0

    def is_fast(message: TwistStamped) -> bool:
        return bool(abs(message.twist.linear.x - 2.0) < NEAR_M_S)

    with setpoints(uav, "setpoint_velocity/cmd_vel_unstamped", command):
        eventually(lambda: is_steady(world, is_fast), "2 m/s to the east")
        truth = run.state("uav1").linear_velocity.tolist()
        assert truth == pytest.approx((2.0, 0.0, 0.0), abs=2 * NEAR_M_S)
        assert_near(body.messages[-1].twist.linear, (0.0, -2.0, 0.0), 2 * NEAR_M_S)
    assert uav.call("set_mode", SetMode, custom_mode="AUTO.LOITER").mode_sent


def mission_of(count: int) -> list[Waypoint]:
    """Places next to where the UAV starts."""
    return [
        Waypoint(
            frame=Waypoint.FRAME_GLOBAL_REL_ALT,
            command=CommandCode.NAV_WAYPOINT,
            is_current=i == 0,
            autocontinue=True,
            param1=float(i % 3),
            x_lat=63.4394 + i * 1e-5,
            y_long=10.3992 - i * 1e-5,
            z_alt=5.0 + i,
        )
        for i in range(count)
    ]


def missions_come_back(uav: Mavros, station: Station) -> None:
    """20 items up and down; what the ground station changes is known, too."""
    items = mission_of(20)
    lists = uav.hear("mission/waypoints", WaypointList)
    pushed = uav.call("mission/push", WaypointPush, start_index=0, waypoints=items)
    assert (pushed.success, pushed.wp_transfered) == (True, 20)
    pulled = uav.call("mission/pull", WaypointPull)
    assert (pulled.success, pulled.wp_received) == (True, 20)
    eventually(lambda: len(lists.messages[-1].waypoints) == 20, "the list on its topic")
    for sent, came in zip(items, lists.messages[-1].waypoints, strict=True):
        assert came.x_lat == pytest.approx(sent.x_lat, abs=1e-7)
        assert came.y_long == pytest.approx(sent.y_long, abs=1e-7)
        assert (came.command, came.frame) == (sent.command, sent.frame)
        assert (came.z_alt, came.param1) == (sent.z_alt, sent.param1)
    station.expect("HEARTBEAT", type=mavlink.MAV_TYPE_QUADROTOR)
    station.clear_mission(1)
    eventually(lambda: not lists.messages[-1].waypoints, "the list without the cleared items")


def boat_obeys(usv: Mavros) -> None:
    """The other node commands its own vehicle alone, though all are at its port."""
    assert usv.call("set_mode", SetMode, custom_mode="GUIDED").mode_sent
    assert usv.call("cmd/arming", CommandBool, value=True).success
    eventually(
        lambda: usv.newest("state").mode == "GUIDED" and usv.newest("state").armed, "the boat"
    )


def test_two_mavros_and_a_station_lead_a_fleet(fleet: tuple[Launch, Station]) -> None:
    run, station = fleet
    with mavros("uav1") as uav, mavros("usv1") as usv:
        refused_with_the_reason(uav)
        flies_offboard(uav, run)
        boat_obeys(usv)
        moves_east(uav, run)
        missions_come_back(uav, station)
        eventually(lambda: uav.newest("state").mode == "AUTO.LOITER", "the mode that was set")
        assert usv.newest("state").mode == "GUIDED"
