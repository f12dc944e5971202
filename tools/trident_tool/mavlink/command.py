# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``mavlink`` subcommand: its options, and what runs for each action."""

from __future__ import annotations

import argparse
import contextlib
import math
import socket
from collections.abc import Callable
from pathlib import Path

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.formation import Handler
from trident_tool.mavlink.address import Address
from trident_tool.mavlink.replay import read_log, replay
from trident_tool.mavlink.watch import watch
from trident_tool.workspace import Runner, TridentError, Workspace, say

_PROGRAMS = "lib/trident_bridges"


def add_mavlink_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``mavlink`` to the command line."""
    sub = add("mavlink", _cmd_mavlink, "which vehicles speak MAVLink, what they say, logs again")
    sub.add_argument("action", nargs="?", choices=["list", "watch", "replay", "parameters"])
    sub.add_argument(
        "subject",
        nargs="?",
        metavar="FILE.tlog|WHOSE",
        help="replay: the log; parameters: of which vehicles, px4 or ardupilot, or e.g. px4/uav, "
        "ardupilot/usv; default: all that differ",
    )
    sub.add_argument(
        "--parameters", nargs="?", const="", metavar="WHOSE", help="as the action parameters"
    )
    sub.add_argument(
        "--vehicles", type=Path, metavar="FILE", help="list: default config/bridges/vehicles.yaml"
    )
    sub.add_argument(
        "--at",
        metavar="KIND:HOST:PORT",
        help="watch: default tcp:127.0.0.1:14445, the router; a UDP port is listened at. replay: "
        "where to, default udp:127.0.0.1:14550",
    )
    sub.add_argument("--allow-remote", action="store_true", help="the host may be another computer")
    sub.add_argument(
        "--speed", type=float, default=1.0, metavar="X", help="replay: of real time; 0: no waiting"
    )
    sub.add_argument(
        "--tables", type=int, default=0, metavar="N", help="watch: one a second; default: endless"
    )


def _cmd_mavlink(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if (options.action is None) == (options.parameters is None):
        raise TridentError(
            "mavlink: legal: one of list, watch, replay FILE.tlog, parameters [WHOSE]"
        )
    if options.action in (None, "parameters"):
        whose = options.subject if options.parameters is None else options.parameters
        return _parameters(workspace, runner, whose or "")
    if (options.action == "replay") != (options.subject is not None):
        raise TridentError("mavlink: FILE.tlog is named with replay, and with replay alone")
    if options.action == "list":
        return _list(workspace, runner, options)
    if options.action == "watch":
        return _watch(workspace, runner, options)
    return _replay(options)


def _list(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    default = workspace.root / "config" / "bridges" / "vehicles.yaml"
    program = workspace.devel / _PROGRAMS / "mavlink_vehicles"
    build(workspace, runner, ["mavlink_vehicles"])
    env = None if runner.dry_run else ros_environment(workspace)
    return runner.run([program, options.vehicles or default], env=env)


def _parameters(workspace: Workspace, runner: Runner, whose: str) -> int:
    program = workspace.devel / _PROGRAMS / "mavlink_parameters"
    build(workspace, runner, ["mavlink_parameters"])
    env = None if runner.dry_run else ros_environment(workspace)
    return runner.run([program, *(word for word in whose.split("/") if word)], env=env)


def _watch(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    address = Address.parse(options.at or "tcp:127.0.0.1:14445", allow_remote=options.allow_remote)
    program = workspace.devel / _PROGRAMS / "mavlink_decode"
    build(workspace, runner, ["mavlink_decode"])
    if runner.dry_run:
        return runner.run([program])
    return watch(program, ros_environment(workspace), address, options.tables)


def _replay(options: argparse.Namespace) -> int:
    if not 0.0 <= options.speed < math.inf:
        raise TridentError(f"mavlink replay: --speed {options.speed}, legal: >= 0")
    address = Address.parse(options.at or "udp:127.0.0.1:14550", allow_remote=options.allow_remote)
    log = read_log(Path(options.subject))
    with address.connected() as link:
        count = replay(log, lambda packet: _send(link, packet), options.speed or math.inf)
    say(f"sent {count} packets to {address}")
    return 0


def _send(link: socket.socket, packet: bytes) -> None:
    """Sends a packet; a UDP port at which nobody listens yet refuses it, which is no error."""
    with contextlib.suppress(ConnectionRefusedError):
        link.sendall(packet)
