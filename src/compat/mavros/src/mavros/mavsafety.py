# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""mavsafety: arm, disarm, kill."""

from __future__ import annotations

import argparse

from mavros_msgs.srv import CommandBool, CommandLong

from mavros.tool import add_command, call, make_parser, require, run

_ARM_DISARM, _FORCED = 400, 21196.0  # MAV_CMD_COMPONENT_ARM_DISARM and its param2


def _arm(is_armed: bool) -> None:
    answer = call("cmd/arming", CommandBool, value=is_armed)
    require(answer.success, "arming" if is_armed else "disarming")


def _kill(_arguments: argparse.Namespace) -> None:
    answer = call("cmd/command", CommandLong, command=_ARM_DISARM, param2=_FORCED)
    require(answer.success, "kill")


def main() -> int:
    """Run the tool."""
    parser = make_parser("Arms and disarms a vehicle.")
    commands = parser.add_subparsers(dest="command", required=True)
    add_command(commands, "arm", "arm the motors", lambda _: _arm(True))
    add_command(commands, "disarm", "disarm the motors", lambda _: _arm(False))
    add_command(commands, "kill", "stop the motors at once, also in the air", _kill)
    return run(parser)
