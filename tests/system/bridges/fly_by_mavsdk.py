# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Flies a simulated iris by MAVSDK: telemetry, take-off, a mission, a fence, set-points, landing.

Run by the Python of .venv-clients. Its argument is where MAVSDK finds the vehicle, such as
udpin://127.0.0.1:14540. Prints each step as it is done; ends with code 1 at the first that is not.
"""

from __future__ import annotations

import math
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

from mavsdk import ComponentType, Configuration, Mavsdk, log_subscribe
from mavsdk.plugins.action import Action, ActionError
from mavsdk.plugins.geofence import Circle, FenceType, Geofence, GeofenceData, Point, Polygon
from mavsdk.plugins.mission import Mission, MissionItem, MissionPlan
from mavsdk.plugins.offboard import Offboard, OffboardError, PositionNedYaw, VelocityNedYaw
from mavsdk.plugins.telemetry import FixType, FlightMode, LandedState, Telemetry

LIMIT_S = 40.0
METERS_PER_DEGREE = 111_195.0  # of latitude, on a sphere
HEIGHT_M = 4.0
#: Set by whatever the vehicle says.
NEWS = threading.Event()


def until(condition: Callable[[], bool], what: str) -> None:
    """Waits for a condition; names it when it holds, and when it does not."""
    end = time.monotonic() + LIMIT_S
    NEWS.clear()
    while not condition():
        # Not under a lock: a condition may ask the client, whose threads call back.
        if not NEWS.wait(end - time.monotonic()):
            sys.exit(f"not within {LIMIT_S:g} s: {what}")
        NEWS.clear()
    print(f"done: {what}", flush=True)


def refused(call: Callable[[], object], kind: type[Exception]) -> str:
    """What the client raises."""
    try:
        call()
    except kind as error:
        return str(error)
    sys.exit(f"{call} was not refused")


def content(thing: object) -> dict[str, str]:
    """Of an item or corner, with places as MAVLink carries them."""
    return {
        name: f"{value:.7f}" if name.endswith("tude_deg") else str(value)
        for name, value in vars(thing).items()
    }


class Pilot:
    """The vehicle, by the plugins of MAVSDK.

    Attributes:
        heard: the newest of each subscription of telemetry, by its name.
        texts: what the vehicle has said.
    """

    def __init__(self, url: str) -> None:
        log_subscribe(lambda *_: True)  # ours is what is printed
        kind = ComponentType.GROUND_STATION
        self.mavsdk = Mavsdk(Configuration.create_with_component_type(kind))
        assert self.mavsdk.add_any_connection(url) == 0, url
        system = self.mavsdk.first_autopilot(LIMIT_S)
        if system is None:
            sys.exit(f"no autopilot at {url}")
        self.telemetry = Telemetry(system)
        self.action = Action(system)
        self.mission = Mission(system)
        self.geofence = Geofence(system)
        self.offboard = Offboard(system)
        self.heard: dict[str, Any] = {}
        self.texts: list[str] = []
        self.telemetry.subscribe_status_text(self._note_text)

    def _note_text(self, text: Any, *_: object) -> None:
        self.texts.append(text.text)
        NEWS.set()

    def listen(self, *names: str) -> None:
        """Until each of these subscriptions has heard something."""
        for name in names:

            def hear(value: object, *_: object, name: str = name) -> None:
                self.heard[name] = value
                NEWS.set()

            getattr(self.telemetry, f"subscribe_{name}")(hear)
        for name in names:
            until(lambda name=name: name in self.heard, f"telemetry: {name}")  # type: ignore[misc]

    def place(self, north_m: float, east_m: float) -> tuple[float, float]:
        """Latitude and longitude of a place around home [deg]."""
        home = self.heard["home"]
        across = METERS_PER_DEGREE * math.cos(math.radians(home.latitude_deg))
        return home.latitude_deg + north_m / METERS_PER_DEGREE, home.longitude_deg + east_m / across

    def distance(self, north_m: float, east_m: float, height_m: float) -> float:
        """From a place around home [m]."""
        home, now = self.heard["home"], self.heard["position_velocity_ned"].position
        return math.dist(
            (now.north_m - home.local_north_m, now.east_m - home.local_east_m),
            (north_m, east_m),
        ) + abs(home.local_down_m - now.down_m - height_m)

    def velocity_error(self, north: float, east: float) -> float:
        """[m/s]."""
        velocity = self.heard["position_velocity_ned"].velocity
        return math.dist((velocity.north_m_s, velocity.east_m_s), (north, east))


def read_telemetry(pilot: Pilot) -> None:
    """Everything that a program asks before it flies."""
    pilot.listen(
        "home", "position", "position_velocity_ned", "attitude_euler", "battery", "gps_info",
        "flight_mode", "landed_state", "imu", "altitude", "heading", "unix_epoch_time", "armed",
    )  # fmt: skip
    until(lambda: pilot.heard["gps_info"].fix_type >= FixType.FIX_3D, "a fix")
    until(lambda: pilot.heard["battery"].voltage_v > 10.0, "a battery")
    until(lambda: pilot.heard["landed_state"] == LandedState.ON_GROUND, "the ground")
    pilot.listen("health_all_ok")
    until(lambda: pilot.heard["health_all_ok"], "all is healthy")
    until(lambda: pilot.telemetry.health().is_armable, "it can be armed")


def take_off_and_land(pilot: Pilot) -> None:
    """With what is refused before."""
    action = pilot.action
    print("take-off disarmed:", refused(action.takeoff, ActionError))
    assert any("must be armed" in text for text in pilot.texts), pilot.texts
    action.set_takeoff_altitude(HEIGHT_M)
    assert action.get_takeoff_altitude() == HEIGHT_M
    action.arm()
    until(lambda: bool(pilot.heard["armed"]), "armed")
    action.takeoff()
    until(lambda: pilot.heard["position"].relative_altitude_m > HEIGHT_M - 0.2, "take-off")
    until(lambda: pilot.heard["flight_mode"] == FlightMode.HOLD, "mode HOLD")
    action.land()
    until(lambda: pilot.heard["landed_state"] == LandedState.ON_GROUND, "landed")
    until(lambda: not pilot.heard["armed"], "disarmed")


def fly_mission(pilot: Pilot) -> None:
    """Three places, one with a picture that nobody takes."""
    places = [(4.0, 0.0, 5.0), (4.0, 5.0, 6.0), (0.0, 5.0, 5.0)]
    items = []
    for north, east, height in places:
        latitude, longitude = pilot.place(north, east)
        items.append(MissionItem(latitude, longitude, height, 3.0, acceptance_radius_m=1.0))
    items[1].camera_action = MissionItem.CameraAction.TAKE_PHOTO
    mission = pilot.mission
    mission.upload_mission(MissionPlan(items))
    back = mission.download_mission().mission_items
    assert list(map(content, back)) == list(map(content, items)), list(map(str, back))
    until(lambda: any("no effect" in text for text in pilot.texts), "a word about the camera")
    pilot.action.arm()
    mission.start_mission()
    until(lambda: mission.mission_progress().current >= 1, "the first item")
    mission.pause_mission()
    until(lambda: pilot.heard["flight_mode"] == FlightMode.HOLD, "paused")
    mission.start_mission()
    until(mission.is_mission_finished, "mission")
    until(lambda: pilot.distance(*places[-1]) < 1.0, "the last place")
    mission.clear_mission()


def fence_in(pilot: Pilot) -> None:
    """A polygon around home, and a circle in it that is not to be entered."""
    corners = [(30, 30), (30, -30), (-30, -30), (-30, 30)]
    polygon = Polygon([Point(*pilot.place(*corner)) for corner in corners], FenceType.INCLUSION)
    circle = Circle(Point(*pilot.place(20.0, 0.0)), 5.0, FenceType.EXCLUSION)
    pilot.geofence.upload_geofence(GeofenceData([polygon], [circle]))
    back = pilot.geofence.download_geofence()
    assert len(back.polygons) == len(back.circles) == 1
    assert list(map(content, back.polygons[0].points)) == list(map(content, polygon.points))
    height = pilot.heard["home"].absolute_altitude_m + 5.0
    for north in (20.0, 40.0):  # in the circle, beyond the polygon
        place = pilot.place(north, 0.0)
        print(refused(lambda p=place: pilot.action.goto_location(*p, height, 0.0), ActionError))  # type: ignore[misc]
    until(lambda: sum("fence" in text for text in pilot.texts) >= 2, "fence")
    pilot.geofence.clear_geofence()


def follow_set_points(pilot: Pilot) -> None:
    """A place, then a velocity, as a companion computer asks for them."""
    home, offboard = pilot.heard["home"], pilot.offboard
    print("without set-points:", refused(offboard.start, OffboardError))
    north, east, down = home.local_north_m, home.local_east_m, home.local_down_m
    offboard.set_position_ned(PositionNedYaw(north + 2.0, east + 3.0, down - 6.0, 90.0))
    offboard.start()
    until(lambda: pilot.heard["flight_mode"] == FlightMode.OFFBOARD, "mode OFFBOARD")
    until(lambda: pilot.distance(2.0, 3.0, 6.0) < 0.2, "offboard place")
    offboard.set_velocity_ned(VelocityNedYaw(-1.0, 0.5, 0.0, 90.0))
    until(lambda: pilot.velocity_error(-1.0, 0.5) < 0.1, "offboard velocity")
    offboard.stop()
    until(lambda: pilot.heard["flight_mode"] == FlightMode.HOLD, "offboard is over")


def return_home(pilot: Pilot) -> None:
    """Back to where it was armed, and down."""
    pilot.action.set_return_to_launch_altitude(7.0)
    pilot.action.return_to_launch()
    until(lambda: not pilot.heard["armed"], "home")


def main() -> None:
    """All of it."""
    pilot = Pilot(sys.argv[1])
    read_telemetry(pilot)
    take_off_and_land(pilot)
    fly_mission(pilot)
    fence_in(pilot)
    follow_set_points(pilot)
    return_home(pilot)
    pilot.mavsdk.destroy()


if __name__ == "__main__":
    main()
