# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavros_node as a process, with a vehicle behind UDP."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import rospy
from geometry_msgs.msg import PoseStamped
from mavros_msgs.msg import (
    CommandCode,
    HomePosition,
    StatusText,
    Waypoint,
    WaypointList,
)
from mavros_msgs.srv import (
    CommandBool,
    CommandLong,
    CommandTOL,
    ParamGet,
    ParamPull,
    ParamSet,
    SetMode,
    StreamRate,
    VehicleInfoGet,
    WaypointClear,
    WaypointPull,
    WaypointPush,
    WaypointSetCurrent,
)
from sensor_msgs.msg import BatteryState, Imu, NavSatFix
from trident.testing import Process, Ros, eventually, package, program, recorder
from vehicle import Vehicle

LATITUDE_DEG, LONGITUDE_DEG, ALTITUDE_M = 47.397742, 8.545594, 488.0


@pytest.fixture
def start(ros: Ros) -> Iterator[Callable[..., Vehicle]]:
    """Starts a vehicle and its node; both end with the test."""
    started: list[Vehicle] = []

    def start_one(**options: Any) -> Vehicle:
        started.append(Vehicle(ros, **options))
        return started[-1].connected()

    yield start_one
    for one in started:
        one.close()


def assert_parameters_are_known(vehicle: Vehicle) -> None:
    """The node knows all that the files of the launch file say."""
    assert "not used" not in vehicle.node.log
    assert "fits no plugin" not in vehicle.node.log


def waypoint(command: int, north_deg: float, height_m: float, **fields: Any) -> Waypoint:
    """An item whose height is above home."""
    return Waypoint(
        frame=Waypoint.FRAME_GLOBAL_REL_ALT,
        command=command,
        autocontinue=True,
        x_lat=LATITUDE_DEG + north_deg,
        y_long=LONGITUDE_DEG,
        z_alt=height_m,
        **fields,
    )


def test_a_px4_vehicle_is_offboard_as_the_example_has_it(start: Callable[..., Vehicle]) -> None:
    vehicle = start()
    assert vehicle.state.mode != ""
    assert not vehicle.state.armed
    target = PoseStamped()
    target.pose.position.z = 1.5
    target.pose.orientation.w = 1.0
    setpoints = rospy.Publisher("/mavros/setpoint_position/local", PoseStamped, queue_size=10)
    timer = rospy.Timer(rospy.Duration.from_sec(0.05), lambda _event: setpoints.publish(target))

    def is_offboard_near(x: float, z: float) -> bool:
        """Ask again, as the example does: on a machine that stands still set-points are missing."""
        if vehicle.state.mode != "OFFBOARD":
            vehicle.call("set_mode", SetMode, custom_mode="OFFBOARD")
        at = poses.messages[-1].pose.position
        return abs(at.x - x) < 0.1 and abs(at.z - z) < 0.1

    with recorder("/mavros/local_position/pose", PoseStamped) as poses:
        eventually(
            lambda: bool(vehicle.call("set_mode", SetMode, custom_mode="OFFBOARD").mode_sent),
            "OFFBOARD",
        )
        assert vehicle.call("cmd/arming", CommandBool, value=True).success
        eventually(lambda: vehicle.state.armed and vehicle.state.mode == "OFFBOARD", "the flight")
        eventually(lambda: is_offboard_near(0.0, 1.5), "a height of 1.5 m")
        target.pose.position.x = 1.0
        eventually(lambda: is_offboard_near(1.0, 1.5), "1 m to the east")
        assert poses.messages[-1].header.frame_id == "map"
        assert vehicle.call("set_mode", SetMode, custom_mode="AUTO.LAND").mode_sent
        forced = vehicle.call("cmd/command", CommandLong, command=400, param1=0.0, param2=21196.0)
        assert forced.success
        eventually(lambda: not vehicle.state.armed, "the end of the flight")
    timer.shutdown()
    timer.join()
    setpoints.unregister()


def test_lists_and_parameters_go_to_the_vehicle_and_come_back(
    start: Callable[..., Vehicle],
) -> None:
    vehicle = start(launch_file="px4.launch")
    assert_parameters_are_known(vehicle)
    pulled = vehicle.call("param/pull", ParamPull, force_pull=True)
    assert pulled.success
    assert pulled.param_received > 40
    assert rospy.get_param("/mavros/param/RTL_RETURN_ALT") == pytest.approx(
        vehicle.call("param/get", ParamGet, param_id="RTL_RETURN_ALT").value.real
    )
    request = ParamSet._request_class(param_id="RTL_RETURN_ALT")
    request.value.real = 21.0
    answer = rospy.ServiceProxy("/mavros/param/set", ParamSet)(request)
    assert answer.success
    assert answer.value.real == 21.0
    assert not vehicle.call("param/get", ParamGet, param_id="NO_SUCH").success

    items = [
        waypoint(CommandCode.NAV_TAKEOFF, 0.0, 5.0, is_current=True),
        waypoint(CommandCode.NAV_WAYPOINT, 1e-4, 6.0),
        waypoint(CommandCode.NAV_WAYPOINT, 2e-4, 7.0, param1=2.0),
    ]
    with recorder("/mavros/mission/waypoints", WaypointList) as lists:
        pushed = vehicle.call("mission/push", WaypointPush, start_index=0, waypoints=items)
        assert (pushed.success, pushed.wp_transfered) == (True, 3)
        assert vehicle.call("mission/pull", WaypointPull).wp_received == 3
        eventually(lambda: len(lists.messages[-1].waypoints) == 3, "the list on its topic")
        came = lists.messages[-1].waypoints[2]
        assert came.x_lat == pytest.approx(items[2].x_lat, abs=1e-7)
        assert (came.z_alt, came.param1) == (7.0, 2.0)
        assert vehicle.call("mission/set_current", WaypointSetCurrent, wp_seq=1).success
        assert vehicle.call("mission/clear", WaypointClear).success
        assert vehicle.call("mission/pull", WaypointPull).wp_received == 0


def test_a_refusal_names_rule_value_and_limit(start: Callable[..., Vehicle]) -> None:
    vehicle = start(battery=0.1)
    with recorder("/mavros/statustext/recv", StatusText) as texts:
        answer = vehicle.call("cmd/arming", CommandBool, value=True)
        assert not answer.success
        assert answer.result == 1  # MAV_RESULT_TEMPORARILY_REJECTED
        eventually(
            lambda: any("battery: 10 %, limit 20 %" in text.text for text in texts.messages),
            "the reason",
        )
    eventually(
        lambda: "command 400 refused: Arming denied: battery: 10 %" in vehicle.node.log,
        "the reason in the log",
    )
    assert not vehicle.call("set_mode", SetMode, custom_mode="OFBOARD").mode_sent
    eventually(lambda: "mode 'OFBOARD' is unknown, legal: MANUAL" in vehicle.node.log, "the names")


def test_an_ardupilot_copter_takes_off_in_guided_mode(start: Callable[..., Vehicle]) -> None:
    vehicle = start(kind="ardupilot", launch_file="apm.launch")
    assert_parameters_are_known(vehicle)
    info = vehicle.call("vehicle_info_get", VehicleInfoGet).vehicles[0]
    assert (info.autopilot, info.sysid) == (3, 1)
    vehicle.call("set_stream_rate", StreamRate, stream_id=0, message_rate=10, on_off=True)
    assert vehicle.call("set_mode", SetMode, custom_mode="GUIDED").mode_sent
    assert vehicle.call("cmd/arming", CommandBool, value=True).success
    assert vehicle.call("cmd/takeoff", CommandTOL, altitude=2.0).success
    with (
        recorder("/mavros/global_position/global", NavSatFix) as fixes,
        recorder("/mavros/imu/data", Imu) as imus,
        recorder("/mavros/battery", BatteryState) as batteries,
        recorder("/mavros/home_position/home", HomePosition) as homes,
    ):
        eventually(
            lambda: bool(fixes.messages) and fixes.messages[-1].altitude > ALTITUDE_M + 1.8,
            "a height of 2 m",
        )
        assert fixes.messages[-1].latitude == pytest.approx(LATITUDE_DEG, abs=1e-5)
        assert imus.received()[-1].orientation.w != 0.0
        assert batteries.received()[-1].percentage == pytest.approx(0.9, abs=0.02)
        assert homes.received()[-1].geo.longitude == pytest.approx(LONGITUDE_DEG, abs=1e-5)


def test_the_tools_load_and_dump_missions_and_parameters(
    start: Callable[..., Vehicle], ros: Ros, tmp_path: Path
) -> None:
    start()
    mission = tmp_path / "mission.txt"
    mission.write_text(
        "QGC WPL 110\n"
        f"0\t1\t3\t22\t0\t0\t0\t0\t{LATITUDE_DEG}\t{LONGITUDE_DEG}\t5\t1\n"
        f"1\t0\t3\t16\t0\t0\t0\t0\t{LATITUDE_DEG + 1e-4}\t{LONGITUDE_DEG}\t6\t1\n"
    )

    def started(name: str, *words: str) -> Process:
        return ros.launch([str(package("mavros") / "scripts" / name), *words])

    def log_of(process: Process) -> str:
        assert process.wait() == 0, process.log
        return str(process.log)

    copy = tmp_path / "copy.txt"
    load = started("mavwp", "load", str(mission))
    change = started("mavparam", "set", "RTL_RETURN_ALT", "12.5")
    mode = started("mavsys", "mode", "-c", "POSCTL")
    assert "12.5" in log_of(change)
    assert "Mode changed." in log_of(mode)
    assert "Waypoints transferred: 2" in log_of(load)
    dump = started("mavwp", "dump", str(copy))
    log_of(started("mavsafety", "arm"))
    log_of(started("mavcmd", "long", "400", "0", "21196", "0", "0", "0", "0", "0"))
    assert "Waypoints received: 2" in log_of(dump)
    assert len(copy.read_text().splitlines()) == 3


def test_a_wrong_parameter_ends_the_node_with_its_name(ros: Ros) -> None:
    ros.set_param("/mavros/fcu_url", "udp://:99999@")
    process = ros.launch([program("mavros", "mavros_node"), "__name:=mavros"])
    assert process.wait() == 1
    assert "99999" in process.log
