#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Speaks PX4's simulator API as PX4 does, and flies the iris up, holds it and lands it.

It connects to TCP 4560 + instance, takes its time from HIL_SENSOR, and answers each with
HIL_ACTUATOR_CONTROLS of the same time. What it knows of its state it estimates from the sensors.
"""

from __future__ import annotations

import argparse
import math
import signal
import socket
import sys
import time
from typing import Any

from flight import GRAVITY, Flight, State, Vector, conjugate, cross, rotate, turn
from pymavlink.dialects.v20 import common as mavlink

CALIBRATED_S = 1.5
EARTH_RADIUS = 6371000.0


class Estimator:
    """State from HIL_SENSOR and HIL_GPS: complementary filters, biases taken at rest."""

    def __init__(self) -> None:
        self.state = State()
        self.time: float | None = None
        self._rest: list[tuple[Vector, Vector, Vector]] = []
        self._gyro_bias: Vector = (0.0, 0.0, 0.0)
        self._accel_bias: Vector = (0.0, 0.0, 0.0)
        self._ground: float | None = None
        self._origin: tuple[float, float] | None = None
        self._push_bias = [0.0, 0.0]  # north, east, from a wrong attitude [m/s^2]

    def sensor(self, message: Any) -> float:
        """Take a HIL_SENSOR; returns the time since the one before [s]."""
        now = message.time_usec * 1e-6
        dt = 0.0 if self.time is None else now - self.time
        self.time = now
        gyro = (message.xgyro, message.ygyro, message.zgyro)
        accel = (message.xacc, message.yacc, message.zacc)
        mag = (message.xmag, message.ymag, message.zmag)
        if now < CALIBRATED_S:
            self._rest.append((gyro, accel, mag))
            return dt
        if self._rest:
            self._calibrate()
        self._predict(_minus(gyro, self._gyro_bias), _minus(accel, self._accel_bias), dt)
        if message.fields_updated & 0x1C0:
            self._correct_heading(mag)
        if message.fields_updated & 0x1A00:
            self._correct_height(message.pressure_alt)
        return dt

    def _calibrate(self) -> None:
        count = len(self._rest)
        mean = [
            [sum(sample[kind][axis] for sample in self._rest) / count for axis in range(3)]
            for kind in range(3)
        ]
        self._rest.clear()
        self._gyro_bias = (mean[0][0], mean[0][1], mean[0][2])
        self._accel_bias = (mean[1][0], mean[1][1], mean[1][2] + GRAVITY)
        yaw = math.atan2(-mean[2][1], mean[2][0])  # from magnetic north, which counts as north
        self.state.attitude = (math.cos(0.5 * yaw), 0.0, 0.0, math.sin(0.5 * yaw))

    def _predict(self, rate: Vector, force: Vector, dt: float) -> None:
        s = self.state
        down = rotate(conjugate(s.attitude), (0.0, 0.0, 1.0))
        length = math.sqrt(sum(x * x for x in force))
        lean: Vector = (0.0, 0.0, 0.0)
        if 0.8 * GRAVITY < length < 1.2 * GRAVITY:
            lean = cross((-force[0] / length, -force[1] / length, -force[2] / length), down)
        corrected = (rate[0] + 0.02 * lean[0], rate[1] + 0.02 * lean[1], rate[2] + 0.02 * lean[2])
        attitude = turn(s.attitude, corrected, dt)
        push = rotate(attitude, force)
        a = (push[0] - self._push_bias[0], push[1] - self._push_bias[1], push[2] + GRAVITY)
        self.state = State(
            attitude,
            rate,
            _plus(s.position, s.velocity, dt),
            _plus(s.velocity, a, dt),
        )

    def _correct_heading(self, mag: Vector) -> None:
        level = rotate(self.state.attitude, mag)
        error = -math.atan2(level[1], level[0])
        axis = rotate(conjugate(self.state.attitude), (0.0, 0.0, 0.01 * error))
        self.state.attitude = turn(self.state.attitude, axis, 1.0)

    def _correct_height(self, altitude: float) -> None:
        if self._ground is None:
            self._ground = altitude
        s = self.state
        error = -(altitude - self._ground) - s.position[2]
        s.position = (s.position[0], s.position[1], s.position[2] + 0.04 * error)
        s.velocity = (s.velocity[0], s.velocity[1], s.velocity[2] + 0.03 * error)

    def gps(self, message: Any) -> None:
        """Take a HIL_GPS, as if it were of now."""
        if self.time is None or self.time < CALIBRATED_S:
            return
        place = (math.radians(message.lat * 1e-7), math.radians(message.lon * 1e-7))
        if self._origin is None:
            self._origin = place
        north = (place[0] - self._origin[0]) * EARTH_RADIUS
        east = (place[1] - self._origin[1]) * EARTH_RADIUS * math.cos(self._origin[0])
        s = self.state
        p = [s.position[0], s.position[1]]
        v = [s.velocity[0], s.velocity[1]]
        for axis, (at, speed) in enumerate(((north, message.vn), (east, message.ve))):
            error = speed * 0.01 - v[axis]
            p[axis] += 0.15 * (at - p[axis])
            v[axis] += 0.4 * error
            self._push_bias[axis] -= 0.1 * error
        s.position = (p[0], p[1], s.position[2])
        s.velocity = (v[0], v[1], s.velocity[2])


def _minus(a: Vector, b: Vector) -> Vector:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _plus(a: Vector, b: Vector, factor: float) -> Vector:
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def connect(port: int, patience_s: float) -> socket.socket:
    """Connect to the simulator on loopback; raises OSError when it is not there in time."""
    end = time.monotonic() + patience_s
    while True:
        try:
            link = socket.create_connection(("127.0.0.1", port))
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)
        else:
            link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            return link


class Autopilot:
    """One connection: sensors in, controls out."""

    def __init__(self, link: socket.socket, silent_sensors: int, nan_at: int) -> None:
        self._link = link
        self._codec = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        self._codec.robust_parsing = True
        self._estimator = Estimator()
        self._flight = Flight()
        self._silent = silent_sensors
        self._nan_at = nan_at
        self._count = 0

    def run(self) -> None:
        """Answer until the simulator closes the connection."""
        while data := self._link.recv(65536):
            for message in self._codec.parse_buffer(data) or []:
                kind = message.get_type()
                if kind == "HIL_GPS":
                    self._estimator.gps(message)
                elif kind == "HIL_SENSOR":
                    self._answer(message)

    def _answer(self, message: Any) -> None:
        self._count += 1
        dt = self._estimator.sensor(message)
        if self._count <= self._silent:
            return
        t = message.time_usec * 1e-6
        speeds = self._flight.step(t, self._estimator.state, dt)
        controls = [0.0] * 16
        if speeds is not None:
            controls[:4] = [max(0.0, min(1.0, (speed - 100.0) / 1000.0)) for speed in speeds]
        if self._count == self._nan_at:
            controls[0] = math.nan
        mode = 0 if speeds is None else mavlink.MAV_MODE_FLAG_SAFETY_ARMED
        answer = mavlink.MAVLink_hil_actuator_controls_message(message.time_usec, controls, mode, 1)
        self._link.sendall(answer.pack(self._codec))


def main() -> int:
    """Fly; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("-i", "--instance", type=int, default=0, help="port 4560 + instance")
    parser.add_argument("--port", type=int, help="instead of 4560 + instance")
    parser.add_argument("--silent", type=int, default=0, help="sensors without an answer at first")
    parser.add_argument("--nan-at", type=int, default=-1, help="number of an answer with a NaN")
    parser.add_argument("--patience", type=float, default=60.0, help="for a connection [s]")
    options, _ = parser.parse_known_args()
    port = options.port if options.port is not None else 4560 + options.instance
    try:
        Autopilot(connect(port, options.patience), options.silent, options.nan_at).run()
    except OSError as error:
        print(f"px4_stand_in: tcp 127.0.0.1:{port}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # ends without a traceback
    sys.exit(main())
