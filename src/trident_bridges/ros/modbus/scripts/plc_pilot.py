#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Drives a vessel through its PLC's registers by a plan, and records both ends for the verdict.

Runs in the namespace of a modbus_client_node. Parameters: ~plan, a list of [time, left, right]:
from that simulated time on the shaft speeds are commanded at 10 Hz [s, rad/s]; a last entry of
[time] is where it falls silent. ~lights [s], when they are switched on; ~vessel, the namespace of
the vessel; ~map, that of the PLC, which says what speeds are legal, and after which silence they
are made safe; ~out_dir, without which nothing is written. Writes plc.csv (t, end, what, value) and
plc.json.
"""

from __future__ import annotations

import csv
import json
import sys
from functools import partial
from pathlib import Path
from typing import Any, TextIO

import rospy
import yaml
from std_msgs.msg import Bool, Float32

RATE_HZ = 10.0
PROPELLERS = ("left", "right")


def check_plan(plan: Any) -> list[list[float]]:
    """The plan as numbers.

    Raises:
        ValueError: it is not one.
    """
    try:
        rows = [[float(value) for value in row] for row in plan]
    except (TypeError, ValueError) as error:
        raise ValueError(f"~plan is {plan!r}, legal: a list of [time, left, right]") from error
    if not _are_whole([len(row) for row in rows]):
        raise ValueError(f"~plan is {plan!r}, legal: [time, left, right], at last [time]")
    times = [row[0] for row in rows]
    if times != sorted(times):
        raise ValueError(f"~plan is {plan!r}, legal: times that grow")
    return rows


def _are_whole(sizes: list[int]) -> bool:
    """Whether rows of these lengths have what they must, of which the last one may be a time."""
    return bool(sizes) and all(size == 3 for size in sizes[:-1]) and sizes[-1] in (1, 3)


def rules_of(path: str) -> tuple[list[float], float]:
    """Legal speeds [rad/s], and the silence after which a map's PLC makes them safe [s].

    Raises:
        ValueError: the map has no such commands.
    """
    try:
        registers = yaml.safe_load(Path(path).read_text(encoding="utf-8"))["registers"]
        by_topic = {register.get("topic"): register for register in registers}
        speed = by_topic[f"thrusters/{PROPELLERS[0]}_thrust_cmd"]
        return [float(speed["min"]), float(speed["max"])], float(speed["timeout"])
    except (OSError, KeyError, TypeError, ValueError, AttributeError, yaml.YAMLError) as error:
        raise ValueError(f"~map {path}: {error!r}; legal: one with limits and a timeout") from error


def command_at(plan: list[list[float]], time_s: float) -> list[float] | None:
    """Speeds of both propellers at a time; None: silence."""
    row = None
    for candidate in plan:
        if candidate[0] <= time_s:
            row = candidate
    return row[1:] if row is not None and len(row) == 3 else None


class Pilot:
    """Publishes the plan's commands, and writes down what is said at both ends."""

    def __init__(self, plan: list[list[float]], lights_s: float, vessel: str, log: TextIO) -> None:
        self._plan, self._lights_s = plan, lights_s
        self._rows = csv.writer(log)
        self._rows.writerow(["t", "end", "what", "value"])
        self._log = log
        self._speeds = [
            rospy.Publisher(f"thrusters/{name}_thrust_cmd", Float32, queue_size=5)
            for name in PROPELLERS
        ]
        self._lights = rospy.Publisher("lights", Bool, queue_size=5, latch=True)
        self._are_lights_on = False
        for name in PROPELLERS:
            for end, space in (("vessel", f"/{vessel}/"), ("client", "")):
                topic = f"{space}thrusters/{name}_thrust"
                self._listen(end, f"{name}_thrust", topic, Float32)
            command = f"/{vessel}/thrusters/{name}_thrust_cmd"
            self._listen("vessel", f"{name}_command", command, Float32)
        self._listen("vessel", "lights", f"/{vessel}/lights", Bool)
        self._listen("client", "lights", "lights/state", Bool)

    def _listen(self, end: str, what: str, topic: str, kind: Any) -> None:
        rospy.Subscriber(topic, kind, partial(self._on_message, end, what), queue_size=100)

    def _on_message(self, end: str, what: str, message: Any) -> None:
        self.write(end, what, float(message.data))

    def write(self, end: str, what: str, value: float) -> None:
        """One row, whole when the run ends."""
        self._rows.writerow([f"{rospy.get_time():.4f}", end, what, f"{value:.9g}"])
        self._log.flush()

    def step(self, _event: object) -> None:
        """Says what the plan says now."""
        now_s = rospy.get_time()
        speeds = command_at(self._plan, now_s)
        for name, publisher, speed in zip(PROPELLERS, self._speeds, speeds or (), strict=False):
            publisher.publish(Float32(speed))
            self.write("pilot", f"{name}_command", speed)
        if now_s >= self._lights_s and not self._are_lights_on:
            self._are_lights_on = True
            self._lights.publish(Bool(True))
            self.write("pilot", "lights", 1.0)


def main() -> int:
    """Runs the node until the run ends; an exit code."""
    rospy.init_node("plc_pilot")
    folder = str(rospy.get_param("~out_dir", ""))
    try:
        plan = check_plan(rospy.get_param("~plan"))
        limits, timeout_s = rules_of(str(rospy.get_param("~map")))
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 1
    about = {
        "vessel": str(rospy.get_param("~vessel")),
        "timeout": timeout_s,
        "limits": limits,
        "plan": plan,
    }
    path = Path(folder) / "plc.csv" if folder else Path("/dev/null")
    if folder:
        path.with_suffix(".json").write_text(json.dumps(about), encoding="utf-8")
    with path.open("w", encoding="utf-8", newline="") as log:
        lights_s = float(rospy.get_param("~lights", 1.0))
        pilot = Pilot(plan, lights_s, str(about["vessel"]), log)
        rospy.Timer(rospy.Duration(1.0 / RATE_HZ), pilot.step, reset=True)
        rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
