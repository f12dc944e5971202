# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Commands and missions as generators: each `yield` waits for more messages of the vehicle."""

from __future__ import annotations

import time
from collections.abc import Callable, Generator
from dataclasses import dataclass
from typing import Any, TypeVar

from pymavlink.dialects.v20 import ardupilotmega as mavlink

from trident_eval.mavlink.station import Station, Vehicle

Steps = Generator[None, None, None]
_Result = TypeVar("_Result")
Work = Generator[None, None, _Result]
_ASK_AGAIN_S = 1.0  # of wall time, as all here: an answer takes that of two processes
_ATTEMPTS = 10
_AUTOPILOT = 1


class ErrandError(Exception):
    """A vehicle does not do what it should; the text says what was waited for."""


@dataclass(frozen=True)
class Item:
    """One item of a mission: a command, its first parameters and a place above home."""

    command: int
    latitude: float
    longitude: float
    height: float
    radius: float = 0.0

    def numbers(self) -> tuple[int, int, int, float]:
        """What must come back as it was sent: command, latitude, longitude [1e-7 deg], height."""
        return self.command, round(1e7 * self.latitude), round(1e7 * self.longitude), self.height


def wait(condition: Callable[[], bool], vehicle: Vehicle, limit_s: float, what: str) -> Steps:
    """Until something is so.

    Raises:
        ErrandError: it was not within `limit_s` of simulated time.
    """
    begin_s = vehicle.time_s
    while not condition():
        if vehicle.time_s - begin_s > limit_s:
            raise ErrandError(f"{what}: not within {limit_s:g} s of simulated time")
        yield


def _ask(send: Callable[[int], None], is_answered: Callable[[], bool], what: str) -> Steps:
    """Send until there is an answer."""
    for attempt in range(_ATTEMPTS):
        send(attempt)
        until_s = time.monotonic() + _ASK_AGAIN_S
        while time.monotonic() < until_s:
            if is_answered():
                return
            yield
    raise ErrandError(f"{what}: no answer to {_ATTEMPTS} attempts")


def command(station: Station, vehicle: Vehicle, number: int, *params: float) -> Work[int]:
    """COMMAND_LONG; returns its MAV_RESULT."""
    values = [*params, *[0.0] * (7 - len(params))]
    seen = vehicle.count("COMMAND_ACK")

    def is_answered() -> bool:
        ack = vehicle.newest.get("COMMAND_ACK")
        if ack is None or vehicle.count("COMMAND_ACK") == seen:
            return False
        in_progress = ack.result == mavlink.MAV_RESULT_IN_PROGRESS
        return bool(ack.command == number and not in_progress)

    def send(attempt: int) -> None:
        station.send.command_long_send(vehicle.system, _AUTOPILOT, number, attempt, *values)

    yield from _ask(send, is_answered, f"command {number}")
    return int(vehicle.newest["COMMAND_ACK"].result)


def upload(station: Station, vehicle: Vehicle, items: list[Item]) -> Steps:
    """A mission.

    Raises:
        ErrandError: the vehicle refuses it, or does not answer.
    """
    begun, acks = vehicle.count("MISSION_REQUEST_INT"), vehicle.count("MISSION_ACK")

    def send_count(_: int) -> None:
        station.send.mission_count_send(vehicle.system, _AUTOPILOT, len(items), 0)

    yield from _ask(
        send_count, lambda: vehicle.count("MISSION_REQUEST_INT") > begun, "mission upload"
    )
    answered = begun
    until_s = time.monotonic() + _ATTEMPTS * _ASK_AGAIN_S
    while vehicle.count("MISSION_ACK") == acks:
        if vehicle.count("MISSION_REQUEST_INT") > answered:
            answered = vehicle.count("MISSION_REQUEST_INT")
            _send_item(station, vehicle, items, int(vehicle.newest["MISSION_REQUEST_INT"].seq))
        if time.monotonic() > until_s:
            raise ErrandError("mission upload: no MISSION_ACK")
        yield
    result = vehicle.newest["MISSION_ACK"].type
    if result != mavlink.MAV_MISSION_ACCEPTED:
        raise ErrandError(f"mission upload: MISSION_ACK {result}")


def _send_item(station: Station, vehicle: Vehicle, items: list[Item], index: int) -> None:
    if index >= len(items):
        return
    item = items[index]
    number, x, y, z = item.numbers()
    frame = mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT
    station.send.mission_item_int_send(
        vehicle.system, _AUTOPILOT, index, frame, number, 0, 1, 0, item.radius, 0, 0, x, y, z
    )


def download(station: Station, vehicle: Vehicle) -> Work[list[Any]]:
    """The vehicle's mission, as MISSION_ITEM_INT."""
    counts = vehicle.count("MISSION_COUNT")
    yield from _ask(
        lambda _: station.send.mission_request_list_send(vehicle.system, _AUTOPILOT),
        lambda: vehicle.count("MISSION_COUNT") > counts,
        "mission download",
    )
    items: list[Any] = []
    for index in range(vehicle.newest["MISSION_COUNT"].count):
        got = vehicle.count("MISSION_ITEM_INT")

        def send(_: int, index: int = index) -> None:
            station.send.mission_request_int_send(vehicle.system, _AUTOPILOT, index)

        def is_there(index: int = index, got: int = got) -> bool:
            is_new = vehicle.count("MISSION_ITEM_INT") > got
            return is_new and vehicle.newest["MISSION_ITEM_INT"].seq == index

        yield from _ask(send, is_there, f"mission download: item {index}")
        items.append(vehicle.newest["MISSION_ITEM_INT"])
    station.send.mission_ack_send(vehicle.system, _AUTOPILOT, mavlink.MAV_MISSION_ACCEPTED)
    return items
