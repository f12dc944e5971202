# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Whether all nodes of a running launch file are up."""

from __future__ import annotations

import re
import time
import xmlrpc.client
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import rosgraph
import rospy

_URIS = "/roslaunch/uris"
_OF_ROSCORE = frozenset({"master", "rosout-1"})
_POLL_S = 0.1
_QUIET_S = 0.7  # a node that is registered continues with its topics and services


def node_of(process: str) -> str:
    """The node of one of roslaunch's processes: "UAV1/controller-3" is /UAV1/controller."""
    return "/" + re.sub(r"-\d+$", "", process)


def missing_nodes(
    count: int, active: Iterable[str], dead: Iterable[str], registered: Iterable[str]
) -> str:
    """What is not up yet of a launch file of so many nodes, in words; "": all is.

    Args:
        count: of the nodes.
        active: names of roslaunch's processes that run.
        dead: of those that have done their work.
        registered: nodes that the master knows.
    """
    running, done = (set(names) - _OF_ROSCORE for names in (active, dead))
    if len(running | done) < count:
        return f"{count - len(running | done)} of {count} nodes are not started"
    silent = sorted({node_of(name) for name in running - done} - set(registered))
    return f"not registered: {', '.join(silent)}" if silent else ""


def wait_for_nodes(count: int, limit_s: float, each_time: Callable[[], None]) -> None:
    """Return when the launch file's nodes are up, and nothing has changed about them for a while.

    Args:
        count: how many nodes the launch file has.
        limit_s: longest wait, in wall-clock time [s].
        each_time: is called at each look.

    Raises:
        rospy.ROSException: they are not; says which.
    """
    master = rosgraph.Master(rospy.get_name())
    give_up = time.monotonic() + limit_s
    last: Any = None
    since = time.monotonic()
    while not rospy.is_shutdown():
        each_time()
        state = master.getSystemState()
        if state != last:
            last, since = state, time.monotonic()
        lacking = missing_nodes(count, *_processes(master), _registered(state))
        if not lacking and time.monotonic() - since >= _QUIET_S:
            return
        if time.monotonic() > give_up:
            raise rospy.ROSException(f"after {limit_s:g} s: {lacking or 'topics come and go'}")
        time.sleep(_POLL_S)


def _registered(state: Sequence[Sequence[tuple[str, list[str]]]]) -> set[str]:
    return {node for kind in state for _, nodes in kind for node in nodes}


def _processes(master: rosgraph.Master) -> tuple[list[str], list[str]]:
    """Names of the processes of every roslaunch on this master: running, and ended."""
    try:
        uris = master.getParam(_URIS)
    except rosgraph.MasterError:
        return [], []
    active: list[str] = []
    dead: list[str] = []
    for uri in uris.values():
        server: Any = xmlrpc.client.ServerProxy(uri)
        try:
            _, _, (running, ended) = server.list_processes()
        except (OSError, xmlrpc.client.Error):
            continue  # it has gone
        active += [name for name, _ in running]
        dead += [name for name, _ in ended]
    return active, dead
