# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node link_markers: radio links as one topic of markers for rviz, lines colored by their SNR.

Subscribes to /radio/links and /gazebo/model_states while somebody listens to what it publishes:
/link_markers (visualization_msgs/MarkerArray, at most 10 Hz of wall time) in the frame `world`. A
line goes from model to model of the radios' names; where the two directions differ, the worse one
counts.
"""

from __future__ import annotations

import math
import threading
from typing import Any

import rospy
from gazebo_msgs.msg import ModelStates
from geometry_msgs.msg import Point
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from trident_msgs.msg import LinkStatusArray
from trident_ros import Refusals, init_node, point_problem, quoted

_PERIOD_S = 0.1
_WIDTH_M, _DOWN_WIDTH_M = 0.15, 0.05
_LABEL_HEIGHT_M = 1.5
_ABOVE_M = 1.0  # of a label over its line
# Of signal to noise: the slowest mode of 802.11ac hardly arrives, and the fastest surely does.
WORST_DB, BEST_DB = 0.0, 30.0
_DOWN = ColorRGBA(0.45, 0.45, 0.45, 0.6)
_INK = ColorRGBA(0.1, 0.1, 0.1, 1.0)
_MOST_LINKS = 10_000


def snr_color(snr_db: float) -> Any:
    """From red over yellow to green."""
    share = min(max((snr_db - WORST_DB) / (BEST_DB - WORST_DB), 0.0), 1.0)
    return ColorRGBA(min(2.0 - 2.0 * share, 0.85), min(2.0 * share, 0.65), 0.0, 1.0)


def links_problem(message: Any) -> str:
    """What is wrong with a trident_msgs/LinkStatusArray, or ""."""
    if len(message.links) > _MOST_LINKS:
        return f"{len(message.links)} links, legal: up to {_MOST_LINKS}"
    for link in message.links:
        if math.isnan(link.snr_db):
            return f"snr_db of {quoted(link.source)} to {quoted(link.destination)} is nan"
    return ""


def places_problem(message: Any) -> str:
    """What is wrong with a gazebo_msgs/ModelStates, or ""."""
    if len(message.name) != len(message.pose):
        return f"{len(message.name)} names and {len(message.pose)} poses, legal: equally many"
    for name, pose in zip(message.name, message.pose, strict=True):
        problem = point_problem("position", pose.position)
        if problem:
            return f"{quoted(name)}: {problem}"
    return ""


class LinkMarkers:
    """Collects links and places, and makes markers of the newest ones."""

    def __init__(self) -> None:
        """Nothing is known yet."""
        self._lock = threading.Lock()
        self._links: list[Any] = []
        self._places: dict[str, Any] = {}
        self._is_new = False

    def add_links(self, message: Any) -> None:
        """Take a trident_msgs/LinkStatusArray without a problem."""
        with self._lock:
            self._links, self._is_new = list(message.links), True

    def add_places(self, message: Any) -> None:
        """Take a gazebo_msgs/ModelStates without a problem."""
        with self._lock:
            self._places = {
                name: pose.position for name, pose in zip(message.name, message.pose, strict=True)
            }

    def unplaced(self) -> list[str]:
        """Radios of which no model has the name, sorted."""
        with self._lock:
            names = {name for link in self._links for name in (link.source, link.destination)}
            return sorted(names - set(self._places)) if self._places else []

    def markers(self) -> Any:
        """MarkerArray of the newest links; None if there is nothing new."""
        with self._lock:
            if not self._is_new or not self._places:
                return None
            links, places, self._is_new = self._links, dict(self._places), False
        found = [Marker(action=Marker.DELETEALL)]
        for (a, b), link in sorted(_worse_directions(links).items()):
            if a in places and b in places:
                found += _line(f"{a} - {b}", link, places[a], places[b])
        return MarkerArray(found)


def _worse_directions(links: list[Any]) -> dict[tuple[str, str], Any]:
    """By pair, in the order of the names, the direction that is worse."""
    worse: dict[tuple[str, str], Any] = {}
    for link in links:
        pair = (min(link.source, link.destination), max(link.source, link.destination))
        known = worse.get(pair)
        if known is None or (link.up, link.snr_db) < (known.up, known.snr_db):
            worse[pair] = link
    return worse


def _line(name: str, link: Any, a: Any, b: Any) -> list[Any]:
    """A line, and what it says; a link that is down is thin, gray and silent."""
    header = Header(frame_id="world")
    line = Marker(header=header, ns=name, id=0, type=Marker.LINE_STRIP, points=[a, b])
    line.pose.orientation.w = 1.0
    line.scale.x = _WIDTH_M if link.up else _DOWN_WIDTH_M
    line.color = snr_color(link.snr_db) if link.up else _DOWN
    if not link.up:
        return [line]
    label = Marker(header=header, ns=name, id=1, type=Marker.TEXT_VIEW_FACING)
    middle = Point(*(0.5 * p + 0.5 * q for p, q in ((a.x, b.x), (a.y, b.y), (a.z, b.z))))
    middle.z += _ABOVE_M
    label.pose.position, label.pose.orientation.w = middle, 1.0
    label.scale.z, label.color, label.text = _LABEL_HEIGHT_M, _INK, f"{link.snr_db:.0f} dB"
    return [line, label]


class _Inputs:
    """Subscriptions that are there while somebody wants them."""

    def __init__(self, links: LinkMarkers) -> None:
        self._links, self._refusals = links, Refusals()
        self._subscribers: list[Any] = []

    def want(self, is_wanted: bool) -> None:
        if is_wanted and not self._subscribers:
            self._subscribers = [
                rospy.Subscriber("/radio/links", LinkStatusArray, self._on_links, queue_size=1),
                rospy.Subscriber(
                    "/gazebo/model_states", ModelStates, self._on_places, queue_size=1
                ),
            ]
        elif not is_wanted:
            while self._subscribers:
                self._subscribers.pop().unregister()

    def _on_links(self, message: Any) -> None:
        problem = links_problem(message)
        if problem:
            self._refusals.note("links refused", f"/radio/links refused: {problem}")
        else:
            self._links.add_links(message)

    def _on_places(self, message: Any) -> None:
        problem = places_problem(message)
        if problem:
            self._refusals.note("places refused", f"/gazebo/model_states refused: {problem}")
        else:
            self._links.add_places(message)


def main() -> int:
    """Run until ROS ends."""
    init_node("link_markers", anonymous=True)
    links = LinkMarkers()
    inputs = _Inputs(links)
    publisher = rospy.Publisher("/link_markers", MarkerArray, queue_size=1, latch=True)
    named: set[str] = set()
    while not rospy.is_shutdown():
        inputs.want(publisher.get_num_connections() > 0)
        markers = links.markers()
        if markers is not None:
            publisher.publish(markers)
            for name in set(links.unplaced()) - named:
                named.add(name)
                rospy.logwarn("radio %s is not drawn: no model has its name", quoted(name))
        rospy.rostime.wallsleep(_PERIOD_S)  # the simulated clock may stand
    return 0
