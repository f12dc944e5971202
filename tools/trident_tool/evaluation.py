# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Commands of the evaluation package, with the options that the package itself parses.

The options are loaded from its source, so that help and wrong options need no build.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from trident_tool.formation import Handler
from trident_tool.modules import run_module
from trident_tool.workspace import Runner, TridentError, Workspace

_OPTIONS = "src/trident_eval/src/trident_eval/options.py"
_WHAT_IS_MEASURED = "what"


def _load_options() -> Any:
    """The package's module of options."""
    path = Workspace(Path(__file__).resolve().parents[2]).root / _OPTIONS
    spec = importlib.util.spec_from_file_location("trident_eval_options", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        spec.loader.exec_module(module)
    finally:
        sys.dont_write_bytecode = writes
    return module


def add_evaluation_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds the package's commands, and ``bench`` with a subparser for each benchmark."""
    options = _load_options()
    for command in options.COMMANDS:
        sub = add(command.name, _cmd_report if command.name == "report" else _run, command.help)
        _set_up(sub, command)
    bench = add("bench", _run, "measure; each benchmark has options of its own: bench sim -h")
    kinds = bench.add_subparsers(dest=_WHAT_IS_MEASURED, metavar="BENCHMARK", required=True)
    for command in options.BENCHMARKS:
        sub = kinds.add_parser(command.name, help=command.help, description=command.help)
        # It may stand before the benchmark's name: its absence here says nothing.
        sub.add_argument(
            "--dry-run",
            action="store_true",
            default=argparse.SUPPRESS,
            help="print what would be done, and do nothing",
        )
        _set_up(sub, command)


def _set_up(parser: argparse.ArgumentParser, command: Any) -> None:
    command.add_options(parser)
    if command.passes_on:
        parser.epilog = "Other options go to the program that does the work."
    parser.set_defaults(call=command.call, passes_on=command.passes_on)


def words_of(options: argparse.Namespace, argv: Sequence[str]) -> list[str]:
    """The words of a command line behind the command's name, as the module is to get them."""
    names = 2 if options.name == "bench" else 1
    return [word for word in argv if word != "--dry-run"][names:]


def _run(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    module, *before = options.call
    return run_module(workspace, runner, module, [*before, *words_of(options, options.argv)])


def _cmd_report(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if not runner.dry_run and not options.source.exists():
        raise TridentError(f"{options.source} does not exist: report needs a run folder or a bag")
    return _run(workspace, runner, options)
