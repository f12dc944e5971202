# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the master knows of a topic."""

from __future__ import annotations

import xmlrpc.client
from typing import Any, NamedTuple

import rosgraph
import roslib.message

from trident_eval.core.errors import EvalError

_CALLER = "/trident_latency"


class Topic(NamedTuple):
    """A topic as the master knows it.

    Attributes:
        name: resolved.
        type: of its messages; "": unknown.
        publishers: nodes.
        has_header: whether its messages begin with a header.
        is_simulated: whether /use_sim_time is set.
    """

    name: str
    type: str
    publishers: list[str]
    has_header: bool
    is_simulated: bool


def look_up(name: str) -> Topic:
    """Asks the master of the environment.

    Raises:
        EvalError: it does not answer, or the message type is not built here.
    """
    resolved = rosgraph.names.resolve_name(name, "/")
    master = rosgraph.Master(_CALLER)
    try:
        publishers, _, _ = master.getSystemState()
        types = dict(master.getTopicTypes())
        is_simulated = bool(master.hasParam("/use_sim_time") and master.getParam("/use_sim_time"))
    except (OSError, xmlrpc.client.Error, rosgraph.MasterException) as error:
        raise EvalError(f"no roscore answers at {rosgraph.get_master_uri()}") from error
    known = types.get(resolved, "")
    known = "" if known == "*" else known
    return Topic(
        resolved,
        known,
        [node for topic, nodes in publishers if topic == resolved for node in nodes],
        _has_header(known),
        is_simulated,
    )


def _has_header(type_name: str) -> bool:
    if not type_name:
        return False
    message: Any = roslib.message.get_message_class(type_name)
    if message is None:
        raise EvalError(f"messages of {type_name} are not built in this workspace")
    return bool(message._slot_types) and message._slot_types[0] == "std_msgs/Header"
