# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Flies a formation, or one vehicle of it: enrol, plan, feed set-points, record."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import rospy

from trident_fleet.core.errors import FormationError
from trident_fleet.core.record import Origin, refusal_record, write_record
from trident_fleet.core.settings import FleetSettings, Vehicle
from trident_fleet.nodes.flights import FlightContext, FlightMaker
from trident_fleet.nodes.setpoint_topic import SetpointTopic
from trident_fleet.nodes.world_link import SimulatorClient

_WATCH_S = 0.2


class FormationRunner:
    """One process' share of a formation flight; starts over when the world's time is reset."""

    def __init__(
        self,
        settings: FleetSettings,
        vehicles: list[Vehicle],
        fed: list[Vehicle],
        make: FlightMaker,
        out_dir: Path | None,
    ) -> None:
        """Advertise the set-point topics.

        Args:
            settings: of the formation.
            vehicles: the whole formation.
            fed: the vehicles that this process commands.
            make: plans a flight.
            out_dir: where the records go; None: nowhere.
        """
        self._make = make
        self._wake = threading.Event()
        self._context = FlightContext(
            settings=settings,
            vehicles=vehicles,
            fed=fed,
            topics=[SetpointTopic(vehicle.prefix, settings.lookahead + 2) for vehicle in fed],
            link=SimulatorClient(vehicles, fed, settings),
            record=lambda record: keep_record(record, out_dir),
            restart=self._wake.set,
        )
        rospy.on_shutdown(self._wake.set)

    def run(self) -> None:
        """Fly until the node is shut down.

        Raises:
            FormationError: the formation cannot be flown.
        """
        while not rospy.is_shutdown() and self._context.link.wait_for_simulator():
            self._wake.clear()
            # The shutdown that was just cleared with it: is_shutdown() knows of it only later.
            if rospy.core.is_shutdown_requested():
                return
            self._fly_once()

    def _fly_once(self) -> None:
        """One flight, until the world's time is reset or the node is shut down."""
        context = self._context
        # Before it enrols: a world that waits for all sources stands at time zero until then, so
        # that the vehicles are found where they were spawned, however long that took.
        spawned = context.link.wait_for_spawn()
        if spawned is None:
            return
        start_ns = context.link.enroll() if context.link.is_lockstep else self._next_period_ns()
        # A node that is started again finds its enrolment as old as its first life.
        start_ns = max(start_ns, self._period_from(spawned.stamp_ns))
        self._prepare_topics()
        flight = self._make(context, spawned.position, start_ns)
        subscribers = flight.begin()
        while not self._wake.wait(_WATCH_S):
            flight.watch()
        for subscriber in subscribers:
            subscriber.unregister()

    def _prepare_topics(self) -> None:
        context = self._context
        for topic in context.topics:
            topic.forget()
            self._wait_for_controller(topic)
            if context.settings.guard:
                topic.guard()

    def _wait_for_controller(self, topic: SetpointTopic) -> None:
        context = self._context
        while not topic.wait_for_controller(context.settings.connect_wait_s):
            if rospy.is_shutdown():
                return
            rospy.logwarn("%s: no controller listens yet", topic.topic)
            # In lockstep the world stands meanwhile, so that there is no hurry; a controller
            # of another name, or within the simulator, is heard of as a listener.
            if topic.has_listener or not context.link.is_lockstep:
                return

    def _next_period_ns(self) -> int:
        """Without lockstep: the first whole period from now on."""
        first: list[int] = []
        clock = self._context.link.on_clock(first.append)
        while not first and not rospy.is_shutdown() and not self._wake.wait(0.02):
            pass
        clock.unregister()
        return self._period_from(first[-1] + 1) if first else 0

    def _period_from(self, time_ns: int) -> int:
        period_ns = self._context.settings.feed.period_ns
        return -(-time_ns // period_ns) * period_ns


def refuse(
    error: FormationError, settings: FleetSettings, fed: list[Vehicle], out_dir: Path | None
) -> None:
    """Say why these vehicles do not fly: in their records, and to a world that waits for them."""
    origin = Origin(settings.source, [vehicle.name for vehicle in fed])
    for index in range(len(fed)):
        keep_record(refusal_record(error, index, origin), out_dir)
    link = SimulatorClient(fed, fed, settings)
    if link.wait_for_simulator():
        link.withdraw()


def keep_record(record: dict[str, Any], out_dir: Path | None) -> None:
    """Write a record, if there is a folder for it."""
    if out_dir:
        try:
            write_record(out_dir, record)
        except FormationError as error:
            # The flight is worth more than its record.
            rospy.logerr("%s", error)
