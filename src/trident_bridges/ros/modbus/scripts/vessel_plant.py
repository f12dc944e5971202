#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a PLC of a vessel has wires to, besides its propellers: a battery, and pontoons that leak.

Subscribes thrusters/left_thrust, thrusters/right_thrust (std_msgs/Float32 [N]), bilge/port_pump,
bilge/starboard_pump (std_msgs/Bool). Publishes battery (sensor_msgs/BatteryState), and for each
pontoon bilge/SIDE_level (std_msgs/Float64 [m]) and bilge/SIDE_leak (std_msgs/Bool), at 10 Hz of
simulated time. Parameters: ~port_leak, ~starboard_leak [m/s], how fast water rises in a pontoon;
~capacity [Wh], ~charge at the start, of full. Its figures are round ones, of no real boat.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from functools import partial

import rospy
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Bool, Float32, Float64

RATE_HZ = 10.0
SIDES = ("port", "starboard")
PROPELLERS = ("left", "right")
PUMP_M_S = 0.01  # how fast a pump lowers the water
LEAK_LEVEL_M = 0.005  # at which the sensor is wet
BASE_LOAD_W = 40.0
MOST_THRUST_N = 1000.0  # of a propeller, of either sign
FULL_V, EMPTY_V, RESISTANCE_OHM = 29.0, 22.0, 0.02
# Power of an ideal propeller grows with the 3/2 power of its thrust (momentum theory).
WATT_PER_N15 = 0.4


@dataclass
class Plant:
    """State of battery and bilge.

    Attributes:
        capacity_wh: of the battery.
        charge: of full, 0 to 1.
        leak_m_s: how fast water rises, by side.
        thrust_n: of each propeller.
        pump: whether it runs, by side.
        level_m: of the water, by side.
        current_a: out of the battery.
    """

    capacity_wh: float = 1000.0
    charge: float = 0.9
    leak_m_s: dict[str, float] = field(default_factory=lambda: dict.fromkeys(SIDES, 0.0))
    thrust_n: dict[str, float] = field(default_factory=lambda: dict.fromkeys(PROPELLERS, 0.0))
    pump: dict[str, bool] = field(default_factory=lambda: dict.fromkeys(SIDES, False))
    level_m: dict[str, float] = field(default_factory=lambda: dict.fromkeys(SIDES, 0.0))
    current_a: float = 0.0

    def advance(self, duration_s: float) -> None:
        """Lets so much time pass."""
        power_w = BASE_LOAD_W
        power_w += WATT_PER_N15 * sum(abs(thrust) ** 1.5 for thrust in self.thrust_n.values())
        self.current_a = power_w / self.voltage if self.charge > 0.0 else 0.0
        spent_wh = self.current_a * self.voltage * duration_s / 3600.0
        self.charge = max(0.0, self.charge - spent_wh / self.capacity_wh)
        for side in SIDES:
            rise = self.leak_m_s[side] - (PUMP_M_S if self.pump[side] else 0.0)
            self.level_m[side] = max(0.0, self.level_m[side] + rise * duration_s)

    @property
    def voltage(self) -> float:
        """Of the battery, with what its resistance takes [V]."""
        return EMPTY_V + (FULL_V - EMPTY_V) * self.charge - RESISTANCE_OHM * self.current_a

    def is_wet(self, side: str) -> bool:
        """Whether a pontoon's leak sensor is in water."""
        return self.level_m[side] >= LEAK_LEVEL_M


class PlantNode:
    """The plant on its topics."""

    def __init__(self, plant: Plant) -> None:
        self._plant = plant
        self._last_s = rospy.get_time()
        self._battery = rospy.Publisher("battery", BatteryState, queue_size=5)
        self._levels = {
            side: rospy.Publisher(f"bilge/{side}_level", Float64, queue_size=5) for side in SIDES
        }
        self._leaks = {
            side: rospy.Publisher(f"bilge/{side}_leak", Bool, queue_size=5) for side in SIDES
        }
        for name in PROPELLERS:
            rospy.Subscriber(f"thrusters/{name}_thrust", Float32, partial(self._on_thrust, name))
        for side in SIDES:
            rospy.Subscriber(f"bilge/{side}_pump", Bool, partial(self._on_pump, side))

    def _on_thrust(self, name: str, message: Float32) -> None:
        if abs(message.data) <= MOST_THRUST_N:  # false of NaN
            self._plant.thrust_n[name] = message.data
            return
        rospy.logwarn_throttle(
            5.0,
            f"thrusters/{name}_thrust is {message.data:g} N, legal: up to {MOST_THRUST_N:g} N; "
            "the last one stays",
        )

    def _on_pump(self, side: str, message: Bool) -> None:
        self._plant.pump[side] = message.data

    def step(self, _event: object) -> None:
        """Advances to now, and publishes."""
        now = rospy.Time.now()
        self._plant.advance(max(0.0, now.to_sec() - self._last_s))
        self._last_s = now.to_sec()
        battery = BatteryState(voltage=self._plant.voltage, current=-self._plant.current_a)
        battery.header.stamp = now
        battery.percentage = self._plant.charge
        battery.present = True
        self._battery.publish(battery)
        for side in SIDES:
            self._levels[side].publish(Float64(self._plant.level_m[side]))
            self._leaks[side].publish(Bool(self._plant.is_wet(side)))


def main() -> int:
    """Runs the node; an exit code."""
    rospy.init_node("vessel_plant")
    plant = Plant(
        capacity_wh=float(rospy.get_param("~capacity", 1000.0)),
        charge=float(rospy.get_param("~charge", 0.9)),
        leak_m_s={side: float(rospy.get_param(f"~{side}_leak", 0.0)) for side in SIDES},
    )
    if plant.capacity_wh <= 0.0 or not 0.0 <= plant.charge <= 1.0:
        rospy.logfatal("~capacity must be > 0, ~charge in [0, 1]")
        return 1
    node = PlantNode(plant)
    rospy.Timer(rospy.Duration(1.0 / RATE_HZ), node.step, reset=True)
    rospy.spin()
    return 0


if __name__ == "__main__":
    sys.exit(main())
