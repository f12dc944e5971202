# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A ground station's link to all vehicles, and what each of them has said last."""

from __future__ import annotations

import socket
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink

SYSTEM, COMPONENT = 255, 190
_HEARTBEAT_S = 1.0
_CONNECT_S = 0.2
_REFUSED = (
    mavlink.MAV_RESULT_DENIED,
    mavlink.MAV_RESULT_UNSUPPORTED,
    mavlink.MAV_RESULT_FAILED,
    mavlink.MAV_RESULT_TEMPORARILY_REJECTED,
)


@dataclass
class Vehicle:
    """What one vehicle has said.

    Attributes:
        system: its id.
        newest: the last message of each type.
        counts: how many came of each type.
        reached: items of its mission, as it reported them.
        texts: of STATUSTEXT.
        refusals: of commands and missions.
    """

    system: int
    newest: dict[str, Any] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    reached: list[int] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    refusals: int = 0

    def take(self, message: Any) -> None:
        """Remember a message."""
        kind = message.get_type()
        self.newest[kind] = message
        self.counts[kind] = self.counts.get(kind, 0) + 1
        if kind == "MISSION_ITEM_REACHED":
            self.reached.append(int(message.seq))
        elif kind == "STATUSTEXT":
            self.texts.append(str(message.text))
        elif kind == "COMMAND_ACK":
            self.refusals += message.result in _REFUSED
        elif kind == "MISSION_ACK":
            self.refusals += message.type != mavlink.MAV_MISSION_ACCEPTED

    def count(self, kind: str) -> int:
        """How many messages of a type have come."""
        return self.counts.get(kind, 0)

    @property
    def time_s(self) -> float:
        """Simulated time, by its newest message that has one [s]."""
        known = (self.newest.get(kind) for kind in ("GLOBAL_POSITION_INT", "SYSTEM_TIME"))
        return max((message.time_boot_ms / 1e3 for message in known if message), default=0.0)

    @property
    def is_armed(self) -> bool:
        """By its heartbeat."""
        heartbeat = self.newest.get("HEARTBEAT")
        return bool(heartbeat and heartbeat.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED)

    @property
    def is_landed(self) -> bool:
        """As it says."""
        state = self.newest.get("EXTENDED_SYS_STATE")
        return bool(state and state.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND)

    @property
    def can_arm(self) -> bool:
        """Whether its checks before arming are passed."""
        status = self.newest.get("SYS_STATUS")
        needed = mavlink.MAV_SYS_STATUS_PREARM_CHECK
        return bool(status and status.onboard_control_sensors_health & needed)

    @property
    def position(self) -> tuple[float, float, float] | None:
        """East, north, up of the world's origin [m]."""
        local = self.newest.get("LOCAL_POSITION_NED")
        return (local.y, local.x, -local.z) if local else None

    @property
    def speed(self) -> float:
        """Over ground [m/s]."""
        local = self.newest.get("LOCAL_POSITION_NED")
        return float((local.vx**2 + local.vy**2) ** 0.5) if local else 0.0


class Station:
    """One connection, that carries all vehicles."""

    def __init__(self, host: str, port: int, connect_s: float = 60.0) -> None:
        """Connect, as soon as somebody listens.

        Raises:
            TimeoutError: nobody does within `connect_s`.
        """
        _await_listener(host, port, connect_s)
        self._link = mavutil.mavlink_connection(
            f"tcp:{host}:{port}", source_system=SYSTEM, source_component=COMPONENT
        )
        self.vehicles: dict[int, Vehicle] = {}
        self._heartbeat_s = 0.0

    @property
    def send(self) -> Any:
        """Pymavlink's encoder: its methods `..._send` send."""
        return self._link.mav

    def vehicle(self, system: int) -> Vehicle:
        """What is known of a vehicle; nothing at first."""
        return self.vehicles.setdefault(system, Vehicle(system))

    def poll(self, handle: Callable[[int, Any], None], wait_s: float = 0.02) -> None:
        """Take what has come: `handle(system, message)` for each, after at most `wait_s`."""
        now_s = time.monotonic()
        if now_s - self._heartbeat_s >= _HEARTBEAT_S:
            self._heartbeat_s = now_s
            self.send.heartbeat_send(
                mavlink.MAV_TYPE_GCS, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, mavlink.MAV_STATE_ACTIVE
            )
        message = self._link.recv_match(blocking=True, timeout=wait_s)
        while message is not None:
            system = int(message.get_srcSystem())
            if message.get_type() != "BAD_DATA" and system != SYSTEM:
                self.vehicle(system).take(message)
                handle(system, message)
            message = self._link.recv_msg()

    def close(self) -> None:
        """End the connection."""
        self._link.close()


def _await_listener(host: str, port: int, limit_s: float) -> None:
    end_s = time.monotonic() + limit_s
    while True:
        try:
            socket.create_connection((host, port), timeout=1.0).close()
        except OSError as error:
            if time.monotonic() > end_s:
                raise TimeoutError(f"{host}:{port}: {error} for {limit_s:g} s") from error
            time.sleep(_CONNECT_S)
        else:
            return
