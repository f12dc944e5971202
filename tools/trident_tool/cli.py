# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The subcommands of ./trident."""

from __future__ import annotations

import argparse
import difflib
import errno
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from trident_tool.building import build, is_built, make_configured
from trident_tool.clients import add_setup_command, provide_clients
from trident_tool.evaluation import add_evaluation_commands
from trident_tool.formation import add_formation_commands
from trident_tool.links import add_links_command
from trident_tool.lint import CHECKS, run_checks
from trident_tool.mavlink.command import add_mavlink_command
from trident_tool.modbus import add_modbus_command
from trident_tool.navigation import add_navigation_commands
from trident_tool.needed_packages import targets_of_launch
from trident_tool.nmea import add_nmea_command
from trident_tool.provision import provision
from trident_tool.running import run_launch_file
from trident_tool.sanitizing import SANITIZERS, run_sanitized
from trident_tool.shell import shell
from trident_tool.tasks import add_task_command
from trident_tool.testing import run_tests
from trident_tool.view.recording import Recording
from trident_tool.view.screenshot import Size
from trident_tool.view.viewing import ViewOptions, view
from trident_tool.workspace import Runner, TridentError, Workspace, say
from trident_tool.worlds import add_world_commands

Handler = Callable[[Workspace, Runner, argparse.Namespace], int]

_EPILOG = """\
Every command installs and builds what is missing first; what is done is not done again.
  ./trident run multi_uav_simulation.launch   six fireflies fly a formation; see out/latest
  ./trident run multi_uav_simulation.launch uavs:=4 real_time_factor:=1
  ./trident test -k fleet                     the tests whose names match
"""


COMMANDS = (
    "setup",
    "build",
    "test",
    "lint",
    "run",
    "formation",
    "formation-launch",
    "bench",
    "report",
    "evaluate",
    "slam",
    "view",
    "links",
    "task",
    "mission",
    "nmea",
    "latency",
    "modbus",
    "posegraph",
    "sweep",
    "mavlink",
    "worldmap",
    "worldgen",
    "plan",
    "lattice",
    "shell",
    "help",
)


class _Parser(argparse.ArgumentParser):
    """Reports a wrong command line in one line and exits with 2."""

    def error(self, message: str) -> None:  # type: ignore[override]
        self.exit(2, f"{self.prog}: {message} (see ./trident help)\n")


def _cmd_build(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if not build(workspace, runner, options.targets, options.jobs):
        say("the build is up to date")
    return 0


def _cmd_test(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if options.sanitize:
        return run_sanitized(workspace, runner, options.sanitize)
    provide_clients(workspace, runner)
    return run_tests(workspace, runner, options.pattern, options.jobs, options.rest)


def _cmd_run(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if runner.dry_run or is_built(workspace):
        build(workspace, runner)
    else:
        make_configured(workspace, runner)
        build(workspace, runner, targets_of_launch(workspace, options.words))
    return run_launch_file(workspace, runner, options.words)


def _cmd_view(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    build(workspace, runner)
    view_options = ViewOptions(
        tuple(options.words),
        options.config,
        options.screenshot,
        options.at,
        options.live,
        options.size,
        Recording(options.film, options.follow, options.rerun, options.out, options.seconds),
    )
    return view(workspace, runner, view_options)


def _cmd_shell(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    build(workspace, runner)
    return shell(workspace, runner, options.command)


def _cmd_lint(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if not options.checks or "clang-tidy" in options.checks:
        build(workspace, runner)
    return run_checks(workspace, runner, options.checks, options.fix)


def make_parser() -> argparse.ArgumentParser:
    """The command line: one subparser per subcommand, each with its handler as ``handler``."""
    common = _Parser(add_help=False)
    common.add_argument(
        "--dry-run", action="store_true", help="print what would be done, and do nothing"
    )
    parser = _Parser(
        prog="trident",
        description="Air, land and sea robots in one ROS 1 workspace.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    commands = parser.add_subparsers(dest="name", metavar="COMMAND", parser_class=_Parser)

    def add(name: str, handler: Handler, text: str) -> argparse.ArgumentParser:
        sub = commands.add_parser(name, help=text, description=text, parents=[common])
        sub.set_defaults(handler=handler)
        return sub

    _add_workspace_commands(add)
    _add_running_commands(add)
    add_formation_commands(add)
    add_evaluation_commands(add)
    add_world_commands(add)
    add_navigation_commands(add)
    add_mavlink_command(add)
    commands.add_parser("help", help="show this text")
    return parser


def _add_workspace_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    add_setup_command(add)

    sub = add("build", _cmd_build, "configure and build the workspace")
    sub.add_argument(
        "targets", nargs="*", metavar="TARGET", help="default: everything but the tests"
    )
    sub.add_argument("-j", "--jobs", type=int, help="parallel compilers")

    sub = add("test", _cmd_test, "build and run the tests; what is not known is handed to ctest")
    sub.add_argument("-k", dest="pattern", metavar="REGEX", help="only tests whose names match")
    sub.add_argument("-j", "--jobs", type=int, help="tests at a time")
    sub.add_argument(
        "--sanitize",
        nargs="?",
        const="address",
        choices=tuple(SANITIZERS),
        help="the cores' unit tests instead, built with a sanitizer; default: address",
    )

    sub = add("lint", _cmd_lint, "run the static checks alone")
    sub.add_argument(
        "checks", nargs="*", metavar="CHECK", help=f"of {', '.join(CHECKS)}; default: all"
    )
    sub.add_argument("--fix", action="store_true", help="fix the layout and what ruff can fix")


def _add_running_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    sub = add("run", _cmd_run, "run a launch file to its end, as fast as possible, and judge it")
    sub.add_argument(
        "words",
        nargs="+",
        metavar="[PACKAGE] FILE.launch [name:=value …]",
        help="a file of launch/, a path, or package and file; real_time_factor:=1: in real time; "
        "strict:=true: refuse what is odd in worlds and models",
    )

    _add_view(add)
    add_links_command(add)
    add_task_command(add)
    add_nmea_command(add)
    add_modbus_command(add)

    sub = add("shell", _cmd_shell, "a shell in which the workspace is sourced")
    sub.add_argument("-c", dest="command", metavar="COMMAND", help="run this instead")


def _add_view(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    sub = add("view", _cmd_view, "look at the run in progress, a bag, a world or a launch")
    sub.add_argument(
        "words",
        nargs="*",
        metavar="BAG | WORLD | [PACKAGE] FILE.launch [name:=value …]",
        help="default: the run in progress",
    )
    sub.add_argument("--config", metavar="NAME", help="a configuration of config/rviz")
    sub.add_argument(
        "--screenshot", type=Path, metavar="FILE.png", help="off-screen, into a picture"
    )
    sub.add_argument(
        "--at", type=float, metavar="SECONDS", help="hold a launch at this simulated time"
    )
    sub.add_argument(
        "--live",
        type=float,
        default=0.0,
        metavar="SECONDS",
        help="with --at: rviz sees so much of the time before; sensors need it",
    )
    sub.add_argument(
        "--size", type=_size, metavar="WxH", help="of the picture; 1600x1000, a film 960x600"
    )
    sub.add_argument("--film", type=Path, metavar="FILE.mp4", help="a film instead of rviz")
    sub.add_argument("--follow", metavar="MODEL", help="with --film: the camera goes with a model")
    sub.add_argument("--rerun", action="store_true", help="the rerun viewer instead of rviz")
    sub.add_argument("--out", type=Path, metavar="FILE.rrd", help="with --rerun: record, too")
    sub.add_argument(
        "--seconds", type=float, metavar="S", help="of simulated time, for --film and --rerun"
    )


def _size(text: str) -> Size:
    try:
        return Size.parse(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from error


def _check_command(parser: argparse.ArgumentParser, argv: Sequence[str]) -> None:
    """Exits with a hint if the first word is neither an option nor a command."""
    first = argv[0] if argv else "help"
    if first.startswith("-") or first in COMMANDS:
        return
    close = difflib.get_close_matches(first, COMMANDS, n=1)
    hint = f"did you mean {close[0]!r}?" if close else f"there are {', '.join(COMMANDS)}"
    parser.exit(2, f"trident: there is no command {first!r}; {hint}\n")


def parse_command_line(argv: Sequence[str]) -> argparse.Namespace:
    """Options of a command line; what test hands to ctest is in ``rest``.

    Exits with 0 for help and with 2 for a wrong command line.
    """
    parser = make_parser()
    if list(argv[:1]) == ["--dry-run"]:
        argv = [*argv[1:], *argv[:1]]  # it may stand before the command, too
    _check_command(parser, argv)
    options, rest = parser.parse_known_args(argv)
    if options.name in (None, "help"):
        parser.print_help()
        parser.exit(0)
    passes_on = options.name == "test" or getattr(options, "passes_on", False)
    if rest and not passes_on:
        parser.error(f"{options.name}: unknown option {rest[0]!r}")
    options.rest, options.argv = rest, list(argv)
    return options


def main(argv: Sequence[str]) -> int:
    """Runs one subcommand and returns the exit code of the process."""
    options = parse_command_line(argv)
    workspace = Workspace.of_this_file()
    runner = Runner(dry_run=options.dry_run)
    try:
        provision(workspace, runner)
        handler: Handler = options.handler
        return handler(workspace, runner, options)
    except TridentError as error:
        print(f"trident: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("trident: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        problem = _disk_problem(error)
        if problem is None:
            raise
        print(f"trident: {problem}", file=sys.stderr)
        return 1


def _disk_problem(error: OSError) -> str | None:
    """What is wrong with a file or the disk (full, may not be written); None: it is neither."""
    if error.filename is not None:
        return f"{error.filename}: {error.strerror}"
    return error.strerror if error.errno == errno.ENOSPC else None
