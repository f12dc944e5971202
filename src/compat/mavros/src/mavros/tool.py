# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the command-line tools share: the node they talk to, and how they end."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from typing import Any

import rospy
from mavros_msgs.msg import State

import mavros

_LIMIT_S = 30.0

Handler = Callable[[argparse.Namespace], None]


class ToolError(Exception):
    """What ends a tool with one line."""


def call(name: str, service: Any, **request: Any) -> Any:
    """The answer of a service of the node.

    Args:
        name: below the node's name.
        service: its type.
        request: its fields.

    Raises:
        ToolError: the node does not answer.
    """
    topic = mavros.get_topic(name)
    try:
        rospy.wait_for_service(topic, _LIMIT_S)
        return rospy.ServiceProxy(topic, service)(**request)
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise ToolError(f"{topic}: {error}") from error


def require(is_good: bool, text: str) -> None:
    """End the tool where the vehicle has refused; the node's log has its reason.

    Args:
        is_good: the answer's success.
        text: what was asked for.
    """
    if not is_good:
        raise ToolError(f"{text}: refused, see the log of {mavros.get_namespace()}")


def wait_for_vehicle() -> None:
    """Return when the node has a vehicle."""
    topic = mavros.get_topic("state")
    while not rospy.is_shutdown():
        if rospy.wait_for_message(topic, State).connected:
            return


def make_parser(description: str) -> argparse.ArgumentParser:
    """A parser with the arguments of all tools.

    Args:
        description: of the tool.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument(
        "-n", "--mavros-ns", default=mavros.DEFAULT_NAMESPACE, help="name of mavros_node"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="print what is done")
    parser.add_argument("--wait", action="store_true", help="wait until a vehicle is connected")
    return parser


def add_command(commands: Any, name: str, text: str, handler: Handler) -> argparse.ArgumentParser:
    """A sub-command.

    Args:
        commands: what `add_subparsers` has returned.
        name: of the sub-command.
        text: its help.
        handler: what it does.
    """
    parser: argparse.ArgumentParser = commands.add_parser(name, help=text)
    parser.set_defaults(handler=handler)
    return parser


def run(parser: argparse.ArgumentParser, argv: Sequence[str] | None = None) -> int:
    """Read the arguments and do what they say.

    Args:
        parser: of the tool.
        argv: arguments; None: those of the process.

    Returns:
        Exit code.
    """
    words = rospy.myargv(sys.argv)[1:] if argv is None else list(argv)
    arguments = parser.parse_args(words)
    mavros.set_namespace(arguments.mavros_ns)
    rospy.init_node(parser.prog.replace(".", "_"), anonymous=True, disable_signals=True)
    try:
        if arguments.wait:
            wait_for_vehicle()
        arguments.handler(arguments)
    except (ToolError, ValueError, OSError) as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    return 0
