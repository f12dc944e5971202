# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``modbus`` subcommand: maps are checked and printed, devices watched."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.formation import Handler, option_words
from trident_tool.subcommands import add_subcommand
from trident_tool.workspace import Runner, Workspace

_TOOL = Path("lib/trident_bridges/modbus_tool")
_DEFAULT_MAP = Path("config/bridges/otter_plc.yaml")


def add_modbus_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``modbus`` with its own subcommands to the command line."""
    modbus = add("modbus", _cmd_modbus, "check and print maps of Modbus registers, watch a device")
    kinds = modbus.add_subparsers(dest="modbus_command", metavar="COMMAND", required=True)

    sub = add_subcommand(kinds, "check", "print all that is wrong with maps, with file and line")
    sub.add_argument("maps", nargs="+", type=Path, metavar="MAP.yaml", help="of config/bridges")

    sub = add_subcommand(kinds, "print", "print the values of a map by table and address")
    sub.add_argument("maps", nargs=1, type=Path, metavar="MAP.yaml", help="of config/bridges")

    sub = add_subcommand(
        kinds, "watch", "print the values of a device as they change; nothing is written"
    )
    sub.add_argument("where", metavar="HOST:PORT", help="or a serial device, /dev/ttyUSB0")
    sub.add_argument("--map", type=Path, metavar="MAP.yaml", help="default: that of the Otter")
    sub.add_argument("--unit", type=int, metavar="N", help="default: the map's")
    sub.add_argument("--seconds", type=float, metavar="S", help="default: until Ctrl-C")
    sub.add_argument("--once", action="store_true", help="until each value was read once")
    sub.add_argument(
        "--allow-remote", action="store_true", help="HOST may be another machine than this one"
    )


def _words(workspace: Workspace, options: argparse.Namespace) -> list[str]:
    if options.modbus_command != "watch":
        return [str(path) for path in options.maps]
    words = [options.where, str(options.map or workspace.root / _DEFAULT_MAP)]
    words += option_words(options, ("unit", "seconds"))
    if options.once:
        words.append("--once")
    if options.allow_remote:
        words.append("--allow-remote")
    return words


def _cmd_modbus(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    build(workspace, runner, [_TOOL.name])
    command = [workspace.devel / _TOOL, options.modbus_command, *_words(workspace, options)]
    env = None if runner.dry_run else ros_environment(workspace)
    return runner.run(command, env=env)
