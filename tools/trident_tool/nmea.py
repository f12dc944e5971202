# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The ``nmea`` subcommand: recordings of NMEA 0183."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

from trident_tool.building import build
from trident_tool.environment import ros_environment
from trident_tool.formation import Handler
from trident_tool.subcommands import add_subcommand
from trident_tool.workspace import Runner, TridentError, Workspace

_PROGRAM = "nmea_replay"


def add_nmea_command(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds ``nmea`` to the command line."""
    sub = add("nmea", _cmd_nmea, "send a recording of NMEA 0183 again")
    kinds = sub.add_subparsers(dest="what", metavar="WHAT", required=True)
    replay = add_subcommand(kinds, "replay", "send the sentences of a file at the times in them")
    replay.add_argument("file", type=Path, metavar="FILE", help="recording; may hold binary, too")
    replay.add_argument(
        "--to",
        default="tcp-l://:10110",
        metavar="URL",
        help="endpoint: tcp-l://, tcp://, udp://@HOST, serial://, pty://; default: a TCP server",
    )
    replay.add_argument(
        "--speed", default="1", help="2: twice as fast, 0: as fast as it is taken; default: 1"
    )


def _cmd_nmea(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if not runner.dry_run and not options.file.is_file():
        raise TridentError(f"{options.file} does not exist: nmea replay needs a recording")
    build(workspace, runner, [_PROGRAM])
    program = workspace.devel / "lib" / "trident_bridges" / _PROGRAM
    env = None if runner.dry_run else ros_environment(workspace)
    return runner.run([program, str(options.file), options.to, options.speed], env=env)
