# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""QGroundControl's questions in its order: each is answered within 1 s, none is asked again."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from fleet import standing_still, start_fleet
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from trident.patience import Patience
from trident.testing import Ros, eventually
from trident.testing.mavlink_vehicles import entry

ANSWER_S = 1.0
# Not in pymavlink's dialect: https://mavlink.io/en/messages/common.html.
PROTOCOL_VERSION, COMPONENT_INFORMATION, COMPONENT_METADATA, AVAILABLE_MODES = 300, 395, 397, 435
FTP_OPEN, FTP_LIST, FTP_NAK = 4, 3, 129
FTP_FILE_NOT_FOUND = 10
LATITUDE, LONGITUDE = 634389000, 103990000  # of the origin [1e-7 deg]
LISTS = {
    mavlink.MAV_MISSION_TYPE_MISSION: [
        (mavlink.MAV_CMD_NAV_WAYPOINT, [0.0] * 4, 10.0),
        (mavlink.MAV_CMD_NAV_WAYPOINT, [0.0] * 4, 12.0),
    ],
    mavlink.MAV_MISSION_TYPE_FENCE: [
        (mavlink.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, [200.0, 0.0, 0.0, 0.0], 0.0),
    ],
    mavlink.MAV_MISSION_TYPE_RALLY: [(mavlink.MAV_CMD_NAV_RALLY_POINT, [0.0] * 4, 15.0)],
}
Match = Callable[[Any], bool]


class GroundStation:
    """QGroundControl as far as it asks.

    Attributes:
        slowest_s: the longest wait for an answer [s].
    """

    def __init__(self, link: Any, system: int) -> None:
        self.link, self.mav, self.system = link, link.mav, system
        self.slowest_s = 0.0

    def hear(self, types: list[str], matches: Match = lambda _: True) -> Any:
        """The next message of the vehicle that matches, within the time."""
        patience, begin = Patience(), time.monotonic()
        while patience.spent_s() < ANSWER_S:
            message = self.link.recv_match(type=types, blocking=True, timeout=0.1)
            if message is None or message.get_srcSystem() != self.system or not matches(message):
                continue
            self.slowest_s = max(self.slowest_s, time.monotonic() - begin)
            return message
        pytest.fail(f"system {self.system}: no {' or '.join(types)} within {ANSWER_S:g} s")

    def command(self, number: int, *params: float) -> int:
        """Result of a COMMAND_LONG."""
        padded = [*params, *[0.0] * (7 - len(params))]
        self.mav.command_long_send(self.system, 1, number, 0, *padded)
        return int(self.hear(["COMMAND_ACK"], lambda ack: ack.command == number).result)

    def request(self, message_id: int) -> int:
        """Result of a request for a message."""
        return self.command(mavlink.MAV_CMD_REQUEST_MESSAGE, float(message_id))

    def demand(self, message_id: int, name: str) -> Any:
        """The message itself, which comes before or after its acknowledgement."""
        number = mavlink.MAV_CMD_REQUEST_MESSAGE
        self.mav.command_long_send(self.system, 1, number, 0, float(message_id), 0, 0, 0, 0, 0, 0)
        got: dict[str, Any] = {}
        while set(got) != {"COMMAND_ACK", name}:
            message = self.hear(["COMMAND_ACK", name])
            got[message.get_type()] = message
        assert got["COMMAND_ACK"].result == mavlink.MAV_RESULT_ACCEPTED
        return got[name]

    def parameters(self) -> dict[str, float]:
        """All of them, none twice asked for."""
        self.mav.param_request_list_send(self.system, 1)
        values: dict[str, float] = {}
        while True:
            message = self.hear(["PARAM_VALUE"])
            values[message.param_id] = message.param_value
            if len(values) == message.param_count:
                return values

    def download(self, kind: int) -> list[Any]:
        """A list of items."""
        of_kind: Match = lambda message: message.mission_type == kind  # noqa: E731
        self.mav.mission_request_list_send(self.system, 1, kind)
        count = self.hear(["MISSION_COUNT"], of_kind).count
        items = []
        for index in range(count):
            self.mav.mission_request_int_send(self.system, 1, index, kind)
            items.append(self.hear(["MISSION_ITEM_INT"], lambda m, i=index: m.seq == i))
        self.mav.mission_ack_send(self.system, 1, mavlink.MAV_MISSION_ACCEPTED, kind)
        return items

    def upload(self, kind: int, items: list[tuple[int, list[float], float]]) -> int:
        """Result of the upload of a list."""
        self.mav.mission_count_send(self.system, 1, len(items), kind)
        wanted = 0
        while True:
            message = self.hear(["MISSION_REQUEST_INT", "MISSION_REQUEST", "MISSION_ACK"])
            if message.get_type() == "MISSION_ACK":
                assert wanted == len(items)
                return int(message.type)
            assert message.seq == wanted, "none is asked for twice"
            number, params, height = items[message.seq]
            frame = mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT
            place = (LATITUDE + 900 * message.seq, LONGITUDE, height)
            self.mav.mission_item_int_send(
                self.system, 1, message.seq, frame, number, 0, 1, *params, *place, kind
            )
            wanted += 1

    def open_file(self, opcode: int, path: str) -> tuple[int, int]:
        """Opcode and error of the answer to a request for a file or folder."""
        name = path.encode()
        payload = bytes([0, 0, 0, opcode, len(name), 0, 0, 0, 0, 0, 0, 0]) + name
        self.mav.file_transfer_protocol_send(0, self.system, 1, list(payload.ljust(251, b"\0")))
        answer = self.hear(["FILE_TRANSFER_PROTOCOL"]).payload
        assert answer[5] == opcode
        return answer[3], answer[12]


def ask_who_it_is(station: GroundStation) -> None:
    """The first questions, before anything is shown."""
    version = station.demand(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION, "AUTOPILOT_VERSION")
    for bit in ("MISSION_INT", "COMMAND_INT", "MISSION_FENCE", "MISSION_RALLY", "MAVLINK2"):
        assert version.capabilities & getattr(mavlink, f"MAV_PROTOCOL_CAPABILITY_{bit}"), bit
    assert station.request(PROTOCOL_VERSION) == mavlink.MAV_RESULT_ACCEPTED
    unsupported = (
        AVAILABLE_MODES,
        COMPONENT_METADATA,
        COMPONENT_INFORMATION,
        mavlink.MAVLINK_MSG_ID_CAMERA_INFORMATION,
        mavlink.MAVLINK_MSG_ID_GIMBAL_MANAGER_INFORMATION,
    )
    for message_id in unsupported:
        assert station.request(message_id) == mavlink.MAV_RESULT_UNSUPPORTED, message_id


def ask_for_files_and_logs(station: GroundStation) -> None:
    """Its list is empty."""
    missing = (FTP_NAK, FTP_FILE_NOT_FOUND)
    assert station.open_file(FTP_OPEN, "@PARAM/param.pck?withdefaults=1") == missing
    assert station.open_file(FTP_OPEN, "/etc/extras/component_general.json.xz") == missing
    assert station.open_file(FTP_LIST, "/") == missing
    station.mav.log_request_list_send(station.system, 1, 0, 0xFFFF)
    assert station.hear(["LOG_ENTRY"]).num_logs == 0


def ask_for_parameters(station: GroundStation) -> None:
    """All, one of them, a change of it and back."""
    values = station.parameters()
    assert len(values) > 20
    name = next(
        one for one in ("RTL_RETURN_ALT", "FS_GCS_TIMEOUT", "FENCE_RADIUS") if one in values
    )
    of_name: Match = lambda message: message.param_id == name  # noqa: E731
    for value in (values[name] + 1.0, values[name]):
        kind = mavlink.MAV_PARAM_TYPE_REAL32
        station.mav.param_set_send(station.system, 1, name.encode(), value, kind)
        assert station.hear(["PARAM_VALUE"], of_name).param_value == value
    station.mav.param_request_read_send(station.system, 1, name.encode(), -1)
    assert station.hear(["PARAM_VALUE"], of_name).param_value == values[name]


def exchange_lists(station: GroundStation, begins_with_home: bool) -> None:
    """Each list is empty, is filled, comes back, and is emptied."""
    for kind, items in LISTS.items():
        assert station.download(kind) == []
        # Item 0 of a mission of ArduPilot is home.
        is_led = begins_with_home and kind == mavlink.MAV_MISSION_TYPE_MISSION
        sent = [items[0], *items] if is_led else items
        assert station.upload(kind, sent) == mavlink.MAV_MISSION_ACCEPTED
        back = station.download(kind)
        assert [item.command for item in back] == [item[0] for item in sent]
        assert [item.z for item in back][is_led:] == [item[2] for item in items]
        station.mav.mission_clear_all_send(station.system, 1, kind)
        assert station.hear(["MISSION_ACK"]).type == mavlink.MAV_MISSION_ACCEPTED
        assert len(station.download(kind)) <= is_led


def ask_for_home(station: GroundStation) -> None:
    """By the old command and by the new one."""
    station.command(mavlink.MAV_CMD_GET_HOME_POSITION)
    home = station.demand(mavlink.MAVLINK_MSG_ID_HOME_POSITION, "HOME_POSITION")
    assert abs(home.latitude - LATITUDE) < 10
    assert abs(home.longitude - LONGITUDE) < 10


@pytest.fixture
def ground_link(ros: Ros, tmp_path: Path) -> Iterator[Any]:
    """The UDP port that two vehicles send to, as QGroundControl opens it."""
    drone = entry("uav1", "quadrotor", autopilot="px4")
    _, fleet = start_fleet(ros, tmp_path, drone, entry("usv1", "boat"))
    link = mavutil.mavlink_connection(f"udpin:127.0.0.1:{fleet.ground_station}", source_system=255)
    with standing_still("/uav1/odometry_sensor1/odometry", "/usv1/odometry"):
        try:
            yield link
        finally:
            link.close()


def test_every_question_of_a_ground_station_is_answered_at_once(ground_link: Any) -> None:
    heard: set[int] = set()

    def both_are_there() -> bool:
        beat = ground_link.recv_match(type="HEARTBEAT", blocking=True, timeout=0.1)
        if beat is not None:
            heard.add(beat.get_srcSystem())
        return heard == {1, 2}

    eventually(both_are_there, "heartbeats of both")
    for system in (1, 2):
        station = GroundStation(ground_link, system)
        ask_who_it_is(station)
        ask_for_parameters(station)
        exchange_lists(station, begins_with_home=system == 2)
        ask_for_home(station)
        ask_for_files_and_logs(station)
        assert station.slowest_s < ANSWER_S
