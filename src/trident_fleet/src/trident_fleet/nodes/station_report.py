# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a base station does, in /diagnostics."""

from __future__ import annotations

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from trident_fleet.core.base_station import BaseStation, Phase
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.station.settings import StationSettings
from trident_fleet.core.station.visits import Heard

_EVERY_S = 1.0
_BAD = (Phase.BACK, Phase.RETURN)


class StationReport:
    """Publishes once a second of simulated time."""

    def __init__(self, settings: StationSettings) -> None:
        """To be made after rospy.init_node()."""
        self._links = settings.links
        self._name = f"{rospy.get_name().lstrip('/')}: {settings.vehicle.name}"
        self._next_s = 0.0
        self._publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)

    def publish(self, station: BaseStation, heard: Heard) -> None:
        """Say what it does, if it is time to."""
        if heard.time_s < self._next_s:
            return
        self._next_s = heard.time_s + _EVERY_S
        level = DiagnosticStatus.WARN if station.phase in _BAD else DiagnosticStatus.OK
        text = f"{station.phase.value}: {station.reason}"
        status = DiagnosticStatus(level, self._name, text, "none", self._values(station, heard))
        array = DiagnosticArray(status=[status])
        array.header.stamp = rospy.Time(*divmod(round(heard.time_s * NS_PER_S), NS_PER_S))
        try:
            self._publisher.publish(array)
        except rospy.ROSException:
            # Topics close when rospy begins to shut down.
            if not rospy.core.is_shutdown_requested():
                raise

    def _values(self, station: BaseStation, heard: Heard) -> list[KeyValue]:
        found = station.found_db
        values = {
            **{f"snr {name} [dB]": heard.snr_db.get(name) for name in self._links},
            "best found [dB]": found,
            "silent [s]": station.visits.silent_s(heard.time_s),
            "battery": heard.battery,
        }
        goal = ", ".join(f"{value:.1f}" for value in station.goal)
        pairs = [(key, f"{value:.2f}") for key, value in values.items() if value is not None]
        return [KeyValue(key, value) for key, value in [*pairs, ("goal [m]", goal)]]
