# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Robots of a search and rescue on topics: each is commanded a period ahead, once a period.

Exactly one stamped message a period goes to a robot's controller: the world counts it when the
controller confirms it, and two on different topics might overtake one another.
"""

from __future__ import annotations

import math
import struct
import threading
import warnings
from typing import Any, Protocol

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped, Twist, TwistStamped
from nav_msgs.msg import Path
from std_msgs.msg import Header
from trajectory_msgs.msg import MultiDOFJointTrajectory

from trident_fleet.core.encoding import NS_PER_S, encode_message, encode_points
from trident_fleet.core.missions.guidance import (
    AirLimits,
    AirReference,
    GroundLimits,
    Unstick,
    allowed_speed,
    wheels_velocity,
)
from trident_fleet.core.missions.guided import GuidedVehicle
from trident_fleet.core.missions.kinds import Kind
from trident_fleet.core.missions.scene import Place
from trident_fleet.core.quintic import Array, Motion
from trident_fleet.nodes.world_link import foreign_problem
from trident_ros import Refusals

# Of a vessel, which goes wide where it turns fast: braking, and from where on it turns.
_BRAKE_M_S2, _TURN_M, _SLOWEST_M_S = 0.2, 5.0, 0.7
_STATION_M = 12.0  # from here on a vessel goes to a place as to a station


class TeamRobot(Protocol):
    """What the team's node does with a robot."""

    name: str
    vehicle: GuidedVehicle

    @property
    def is_connected(self) -> bool:
        """Whether its controller listens."""
        ...

    def command(self, stamp_ns: int, alive: bool, in_air: bool) -> None:
        """Say what holds for the period that begins then [ns]."""
        ...

    def repeat(self) -> None:
        """Say the newest again: what got lost while all connected."""
        ...


class _Topics:
    """Publishers in one robot's namespace, and what was sent last."""

    def __init__(self, name: str, kinds: dict[str, type[Any]]) -> None:
        with warnings.catch_warnings():
            # Without a queue, messages go out in the calling thread and in order.
            warnings.simplefilter("ignore")
            self._publishers = {
                topic: rospy.Publisher(f"/{name}/{topic}", kind, tcp_nodelay=True, queue_size=None)
                for topic, kind in kinds.items()
            }
        self._last: list[tuple[str, Any]] = []

    @property
    def is_connected(self) -> bool:
        return all(one.get_num_connections() > 0 for one in self._publishers.values())

    def send(self, topic: str, message: Any) -> None:
        self._last = [*self._last[-2:], (topic, message)]
        self._publish(topic, message)

    def repeat(self) -> None:
        for topic, message in self._last:
            self._publish(topic, message)

    def _publish(self, topic: str, message: Any) -> None:
        try:
            self._publishers[topic].publish(message)
        except rospy.ROSException:
            # Topics close when rospy begins to shut down.
            if not rospy.core.is_shutdown_requested():
                raise


def _header(stamp_ns: int, frame: str = "world") -> Header:
    return Header(stamp=rospy.Time(*divmod(stamp_ns, NS_PER_S)), frame_id=frame)


class AirRobot:
    """A multirotor below a Lee controller; one that died falls."""

    def __init__(
        self,
        name: str,
        vehicle: GuidedVehicle,
        kind: Kind,
        start: Array,
        yaw_rad: float,
        period_ns: int,
    ) -> None:
        """Advertise.

        Args:
            name: of it.
            vehicle: of it.
            kind: of it.
            start: where it stands, p_common [m], shape (3,).
            yaw_rad: its heading, which it keeps.
            period_ns: of set-points [ns].
        """
        self.name, self.vehicle = name, vehicle
        self._height_m, self._yaw_rad = kind.sensor.height_m, yaw_rad
        self._reference = AirReference(start, AirLimits(speed_m_s=kind.speed_m_s))
        step_ns = round(AirReference.STEP_S * NS_PER_S)
        self._offsets = np.arange(0, period_ns, step_ns, dtype=np.int64)
        kinds = {"command/trajectory": MultiDOFJointTrajectory, "command/stop": Header}
        self._topics = _Topics(name, kinds)

    @property
    def is_connected(self) -> bool:
        """Whether its controller listens."""
        return self._topics.is_connected

    def command(self, stamp_ns: int, alive: bool, in_air: bool) -> None:
        """Set-points of a period."""
        if not alive:
            self._topics.send("command/stop", _header(stamp_ns))
            return
        line, count = self.vehicle.line, len(self._offsets)
        points = self._reference.advance(line, self._height_m, not in_air, count)
        motion = Motion(*(values[:, None] for values in points))
        raw = rospy.AnyMsg()
        raw._buff = encode_message(stamp_ns, encode_points(motion, 0, self._yaw_rad, self._offsets))
        self._topics.send("command/trajectory", raw)

    def repeat(self) -> None:
        """Say the newest again."""
        self._topics.repeat()


class SeaRobot:
    """A vessel below its controller, which guides it along paths and keeps stations."""

    def __init__(self, name: str, vehicle: GuidedVehicle, kind: Kind) -> None:
        """Advertise."""
        self.name, self.vehicle, self._speed_m_s = name, vehicle, kind.speed_m_s
        self._said: object = None
        self._topics = _Topics(
            name,
            {
                "command/path": Path,
                "command/pose": PoseStamped,
                "command/cruise": TwistStamped,
                "command/stop": Header,
            },
        )
        self._has_speed = False

    @property
    def is_connected(self) -> bool:
        """Whether its controller listens."""
        return self._topics.is_connected

    def command(self, stamp_ns: int, alive: bool, in_air: bool) -> None:
        """A new path or station, or that the last one still holds."""
        header = _header(stamp_ns, f"{self.name}/odom")
        if not alive:
            self._topics.send("command/stop", header)
            return
        path, motion = list(self.vehicle.path_left), self.vehicle.motion
        is_near = self._is_near_station(path)
        said = ("station", self.vehicle.keeps) if is_near else ("path", self.vehicle.version)
        if said == self._said or not self._has_speed:
            self._send_speed(header, path)
            return
        self._said = said
        if is_near:
            self._topics.send("command/pose", _pose(header, self.vehicle.keeps, motion.yaw_rad))
        else:
            self._topics.send("command/path", _path(header, path))

    def _is_near_station(self, path: list[Place]) -> bool:
        away_m = math.dist(self.vehicle.motion.place, self.vehicle.keeps)
        return len(path) <= 1 and away_m <= _STATION_M

    def _send_speed(self, header: Header, path: list[Place]) -> None:
        """How fast it goes along the path, or to the station where that is empty."""
        self._has_speed = True
        twist = TwistStamped(header=header)
        corners = path or [self.vehicle.keeps]
        place = self.vehicle.motion.place
        allowed_m_s = allowed_speed(place, corners, self._speed_m_s, _BRAKE_M_S2, _TURN_M)
        twist.twist.linear.x = max(allowed_m_s, _SLOWEST_M_S)
        self._topics.send("command/cruise", twist)

    def repeat(self) -> None:
        """Say the newest again."""
        self._topics.repeat()


def _pose(header: Header, place: Place, yaw_rad: float) -> PoseStamped:
    pose = PoseStamped(header=header)
    pose.pose.position.x, pose.pose.position.y = place
    pose.pose.orientation.z, pose.pose.orientation.w = (
        math.sin(yaw_rad / 2.0),
        math.cos(yaw_rad / 2.0),
    )
    return pose


def _path(header: Header, places: list[Place]) -> Path:
    message = Path(header=header)
    message.poses = [_pose(header, place, 0.0) for place in places]
    return message


class GroundRobot:
    """A robot on wheels. The world waits for an answer to each of its odometry's samples.

    The answer is the velocity of the period in which the sample lies, which is known a period
    before: it does not depend on when anything comes.
    """

    def __init__(self, name: str, vehicle: GuidedVehicle, kind: Kind, period_ns: int) -> None:
        """Advertise and subscribe; a velocity holds for a period [ns]."""
        self.name, self.vehicle, self._period_ns = name, vehicle, period_ns
        self._limits, self._unstick = GroundLimits(speed_m_s=kind.speed_m_s), Unstick()
        self._changed = threading.Condition()
        self._twists: list[tuple[int, Twist]] = [(-1, Twist())]
        self._until_ns, self._is_closed = -1, False
        self.waits_for_ns = -1
        self._refusals: Refusals | None = None  # made when there is one
        self._topics = _Topics(name, {"cmd_vel": Twist})
        self._odometry = rospy.Subscriber(
            f"/{name}/odom", rospy.AnyMsg, self._answer, tcp_nodelay=True
        )
        rospy.on_shutdown(self.close)

    @property
    def is_connected(self) -> bool:
        """Whether its wheels listen."""
        return self._topics.is_connected

    def command(self, stamp_ns: int, alive: bool, in_air: bool) -> None:
        """The velocity of a period."""
        twist = Twist()
        if alive:
            motion = self.vehicle.motion
            wanted = wheels_velocity(motion, self.vehicle.line, self._limits)
            twist.linear.x, twist.angular.z = self._unstick.velocity(wanted, motion)
        with self._changed:
            self._twists = [*self._twists[-3:], (stamp_ns, twist)]
            self._until_ns = stamp_ns + self._period_ns
            self._changed.notify_all()

    def wait_for_question(self, stamp_ns: int) -> None:
        """Return when the world waits for an answer at an instant [ns] that has none."""
        with self._changed:
            self._changed.wait_for(lambda: self.waits_for_ns >= stamp_ns or self._is_closed)

    def close(self) -> None:
        """Answer no more."""
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()

    def repeat(self) -> None:
        """An answer is one message: nothing to repeat."""

    def _refuse(self, problem: str) -> None:
        if self._refusals is None:
            self._refusals = Refusals()
        self._refusals.note("odom refused", f"odom of {self.name} refused: {problem}")

    def _answer(self, odometry: rospy.AnyMsg) -> None:
        problem = foreign_problem(odometry)
        if problem:
            self._refuse(problem)
            return
        _, seconds, nanoseconds = struct.unpack_from("<III", odometry._buff)
        stamp_ns = seconds * NS_PER_S + nanoseconds
        with self._changed:
            self.waits_for_ns = stamp_ns
            self._changed.notify_all()
            self._changed.wait_for(lambda: self._until_ns > stamp_ns or self._is_closed)
            if self._is_closed:
                return
            twist = next(one for begin, one in reversed(self._twists) if begin <= stamp_ns)
        self._topics.send("cmd_vel", twist)
