#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Speaks ArduPilot's JSON interface as ArduPilot's SITL does, and flies the iris up and down.

It sends packets of servo outputs to UDP 9002 + 10 instance, and takes its time and state from the
lines of JSON that come back.
"""

from __future__ import annotations

import argparse
import json
import math
import signal
import socket
import struct
import sys
import time
from typing import Any

from flight import Flight, State

MAGIC = 18458
FULL_SPEED = 1100.0  # of 2000 us [rad/s]
RESENT_AFTER_S = 10.0


class Simulator:
    """The simulator as ArduPilot sees it."""

    def __init__(self, port: int, rate: int, patience_s: float) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.connect(("127.0.0.1", port))
        self._rate = rate
        self._frame = 0
        self._patience_s = patience_s

    def exchange(self, pwm: list[int]) -> dict[str, Any] | None:
        """Send servo outputs, receive the state after the step; None: the simulator has gone."""
        packet = struct.pack("<HHI16H", MAGIC, self._rate, self._frame, *pwm)
        is_first = self._frame == 0
        end = time.monotonic() + self._patience_s
        self._frame += 1
        while True:
            try:
                self._socket.send(packet)
                self._socket.settimeout(0.2 if is_first else RESENT_AFTER_S)
                line = self._socket.recv(65536)
            except (ConnectionRefusedError, TimeoutError):
                if is_first and time.monotonic() < end:
                    time.sleep(0.02)
                    continue
                if not is_first and self._is_there():
                    continue
                return None
            state: dict[str, Any] = json.loads(line)
            return state

    def _is_there(self) -> bool:
        try:
            self._socket.send(b"")
            time.sleep(0.05)
            self._socket.send(b"")
        except ConnectionRefusedError:
            return False
        return True


def fly(simulator: Simulator) -> int:
    """Fly until the simulator has gone; returns the number of its states."""
    flight = Flight()
    pwm = [1000] * 4 + [0] * 12
    before = 0.0
    count = 0
    while (message := simulator.exchange(pwm)) is not None:
        count += 1
        now = message["timestamp"]
        gyro, quaternion = message["imu"]["gyro"], message["quaternion"]
        state = State(
            tuple(quaternion), tuple(gyro), tuple(message["position"]), tuple(message["velocity"])
        )
        speeds = flight.step(now, state, now - before)
        before = now
        pwm[:4] = [1000] * 4
        if speeds is not None:
            parts = [min(1.0, max(0.0, speed / FULL_SPEED)) for speed in speeds]
            pwm[:4] = [1000 + math.floor(1000.0 * part + 0.5) for part in parts]
    return count


def main() -> int:
    """Fly; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-I", "--instance", type=int, default=0, help="port 9002 + 10 instance")
    parser.add_argument("--port", type=int, help="instead of 9002 + 10 instance")
    parser.add_argument("--rate", type=int, default=400, help="frames a second [Hz]")
    parser.add_argument("--patience", type=float, default=60.0, help="for the first answer [s]")
    options, _ = parser.parse_known_args()
    port = options.port if options.port is not None else 9002 + 10 * options.instance
    if fly(Simulator(port, options.rate, options.patience)) == 0:
        print(f"ardupilot_stand_in: udp 127.0.0.1:{port}: no answer", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends without a traceback
    sys.exit(main())
