# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident links`: what the radios of a running simulation carry, and what is read past them."""

from __future__ import annotations

import argparse
import os
import sys
from typing import Any

import rosgraph
import rospy

from trident_msgs.msg import LinkStatusArray
from trident_ros import init_node
from trident_viewer.radio_topics import Graph, aligned, graph_of, topics_text

_LINKS = "/radio/links"
_LINKS_LIMIT_S = 2.0  # of wall time
_HEADER = ["source", "destination", "distance [m]", "SNR [dB]", "MCS", "delivered", "lost"]
_FIRST_NUMBER = 2


def main(arguments: list[str] | None = None) -> int:
    """Print it.

    Returns:
        0: it is printed; 1: no master answers, and this has been reported.
    """
    argparse.ArgumentParser(prog="links", description=__doc__).parse_args(arguments)
    try:
        graph = _graph()
        print(topics_text(graph))
        if _LINKS in graph.publishers:
            init_node("trident_links", anonymous=True)
            print(links_text(_newest_links()))
    except (OSError, rosgraph.MasterException, rospy.ROSException) as error:
        uri = os.environ.get("ROS_MASTER_URI")
        print(f"links: the roscore at {uri} does not answer: {error}", file=sys.stderr)
        return 1
    return 0


def _graph() -> Graph:
    master = rosgraph.Master("/trident_links")
    publishers, readers, services = master.getSystemState()
    return graph_of(publishers, readers, master.getTopicTypes(), services)


def _newest_links() -> Any:
    """A LinkStatusArray; None if none comes within the limit."""
    try:
        return rospy.wait_for_message(_LINKS, LinkStatusArray, _LINKS_LIMIT_S)
    except rospy.ROSException:
        return None


def links_text(message: Any) -> str:
    """A LinkStatusArray as a table."""
    if message is None:
        return f"links: no message on {_LINKS} within {_LINKS_LIMIT_S:g} s; does the world stand?"
    rows = [
        [
            link.source,
            link.destination,
            f"{link.distance:.1f}",
            f"{link.snr_db:.1f}",
            str(link.mcs),
            str(link.delivered),
            str(link.dropped_air),
        ]
        for link in message.links
    ]
    lines = [f"links at t = {message.header.stamp.to_sec():.3f} s:"]
    return "\n".join(lines + aligned([_HEADER, *rows], _FIRST_NUMBER))


if __name__ == "__main__":
    sys.exit(main())
