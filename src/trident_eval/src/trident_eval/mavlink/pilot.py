# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How one vehicle is led through its errand, as a generator: each `yield` waits for messages."""

from __future__ import annotations

import math
from collections.abc import Callable

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from trident_eval.mavlink.errands import Errand, ErrandRecord
from trident_eval.mavlink.protocols import ErrandError, Item, Steps, command, download, upload, wait
from trident_eval.mavlink.station import Station, Vehicle

_EARTH_RADIUS_M = 6_378_137.0  # WGS84
# Of simulated time.
_PREPARE_S, _ARM_S, _TAKE_OFF_S, _MISSION_S, _RETURN_S = 60.0, 20.0, 300.0, 600.0, 300.0
_STANDS_M_S = 0.3
_HOME_RADIUS_M = 6.0
# Main and sub mode: PX4's AUTO LOITER, Copter's LOITER, Rover's HOLD.
_PX4_HOLD, _COPTER_HOLD, _ROVER_HOLD = (4, 3), (5, 0), (4, 0)
#: Streams that nobody here reads.
_UNREAD = (
    mavlink.MAVLINK_MSG_ID_ATTITUDE,
    mavlink.MAVLINK_MSG_ID_ATTITUDE_QUATERNION,
    mavlink.MAVLINK_MSG_ID_VFR_HUD,
    mavlink.MAVLINK_MSG_ID_ALTITUDE,
    mavlink.MAVLINK_MSG_ID_GPS_RAW_INT,
)


class Pilot:
    """One vehicle and its errand.

    Attributes:
        errand: what it is to do.
        record: what has become of it so far.
        vehicle: what it has said.
    """

    def __init__(self, station: Station, errand: Errand) -> None:
        """Nothing is sent yet."""
        self.errand = errand
        self.record = ErrandRecord()
        self.vehicle: Vehicle = station.vehicle(errand.system)
        self._station = station
        self._steps = self._run()
        self.is_done = False

    def advance(self) -> None:
        """Do what can be done now; what goes wrong ends the errand and is in the record."""
        if self.is_done:
            return
        try:
            next(self._steps)
        except StopIteration:
            self.is_done = True
        except ErrandError as error:
            self.record.problem = str(error)
            self.is_done = True
        self.record.reached = sorted(set(self.vehicle.reached))
        self.record.refusals = self.vehicle.refusals
        self.record.texts = self.vehicle.texts
        self.record.armed = self.record.armed or self.vehicle.is_armed

    def _run(self) -> Steps:
        yield from self._prepare()
        items = self._mission()
        yield from upload(self._station, self.vehicle, items)
        self.record.uploaded = len(items)
        yield from self._compare(items)
        yield from self._do(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1.0)
        yield from self._wait(lambda: self.vehicle.is_armed, _ARM_S, "arming")
        if self.errand.take_off:
            yield from self._take_off()
        yield from self._do(mavlink.MAV_CMD_MISSION_START)
        last = len(items) - 1
        yield from self._wait(
            lambda: last in self.vehicle.reached, _MISSION_S, f"item {last} of the mission"
        )
        yield from self._end()
        self.record.ended = True

    def _wait(self, condition: Callable[[], bool], limit_s: float, what: str) -> Steps:
        return wait(condition, self.vehicle, limit_s, what)

    def _do(self, number: int, *params: float) -> Steps:
        result = yield from command(self._station, self.vehicle, number, *params)
        if result != mavlink.MAV_RESULT_ACCEPTED:
            said = f": {self.vehicle.texts[-1]}" if self.vehicle.texts else ""
            raise ErrandError(f"command {number}: MAV_RESULT {result}{said}")

    def _prepare(self) -> Steps:
        known = ("HEARTBEAT", "LOCAL_POSITION_NED", "GLOBAL_POSITION_INT", "SYS_STATUS")
        yield from self._wait(
            lambda: all(kind in self.vehicle.newest for kind in known), _PREPARE_S, "telemetry"
        )
        for message in _UNREAD:
            yield from self._do(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, message, -1.0)
        yield from self._wait(lambda: self.vehicle.can_arm, _PREPARE_S, "checks before arming")
        self.record.start = list(self.vehicle.position or ())

    def _mission(self) -> list[Item]:
        """Items at the errand's places; ArduPilot's lists have home before them."""
        place = self.vehicle.newest["GLOBAL_POSITION_INT"]
        latitude, longitude = place.lat / 1e7, place.lon / 1e7
        yaw = math.pi / 2 - math.radians(place.hdg / 100.0)
        items = []
        if not self._is_px4:
            items.append(Item(mavlink.MAV_CMD_NAV_WAYPOINT, latitude, longitude, 0.0))
        for ahead, left, up in self.errand.places:
            east = ahead * math.cos(yaw) - left * math.sin(yaw)
            north = ahead * math.sin(yaw) + left * math.cos(yaw)
            x, y, z = self.record.start
            self.record.places.append([x + east, y + north, z + up])
            meridian_m = _EARTH_RADIUS_M * math.cos(math.radians(latitude))
            items.append(
                Item(
                    mavlink.MAV_CMD_NAV_WAYPOINT,
                    latitude + math.degrees(north / _EARTH_RADIUS_M),
                    longitude + math.degrees(east / meridian_m),
                    up,
                    self.errand.radius,
                )
            )
        return items

    @property
    def _is_px4(self) -> bool:
        return bool(self.vehicle.newest["HEARTBEAT"].autopilot == mavlink.MAV_AUTOPILOT_PX4)

    def _compare(self, items: list[Item]) -> Steps:
        got = yield from download(self._station, self.vehicle)
        first = 0 if self._is_px4 else 1  # home is the vehicle's own
        sent = [item.numbers() for item in items[first:]]
        back = [(item.command, item.x, item.y, item.z) for item in got[first:]]
        self.record.downloaded_equal = len(got) == len(items) and sent == back

    def _take_off(self) -> Steps:
        height = self.errand.take_off
        altitude = self.vehicle.newest["GLOBAL_POSITION_INT"].alt / 1e3 if self._is_px4 else 0.0
        params = (0.0, 0.0, 0.0, math.nan, math.nan, math.nan, altitude + height)
        yield from self._do(mavlink.MAV_CMD_NAV_TAKEOFF, *params)
        yield from self._wait(
            lambda: self._height() > height - 0.5, _TAKE_OFF_S, f"take-off to {height:g} m"
        )

    def _height(self) -> float:
        return float(self.vehicle.newest["GLOBAL_POSITION_INT"].relative_alt) / 1e3

    def _end(self) -> Steps:
        if self.errand.end != "hold":
            yield from self._do(mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH)
        if self.errand.end == "land":
            yield from self._wait(
                lambda: self.vehicle.is_landed and not self.vehicle.is_armed, _RETURN_S, "landing"
            )
            return
        if self.errand.end == "return":
            yield from self._wait(
                lambda: self._home_distance() < _HOME_RADIUS_M, _RETURN_S, "the return home"
            )
        main, sub = self._hold_mode()
        yield from self._do(mavlink.MAV_CMD_DO_SET_MODE, 1.0, main, sub)
        yield from self._wait(lambda: self.vehicle.speed < _STANDS_M_S, _RETURN_S, "holding")

    def _hold_mode(self) -> tuple[int, int]:
        if self._is_px4:
            return _PX4_HOLD
        return _COPTER_HOLD if self.errand.kind == "uav" else _ROVER_HOLD

    def _home_distance(self) -> float:
        here, home = self.vehicle.position, self.record.start
        return math.dist(here[:2], home[:2]) if here else math.inf
