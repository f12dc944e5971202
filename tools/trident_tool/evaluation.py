# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Commands of trident_eval, and of trident_benchmarks: with the options that they parse themselves.

The options are loaded from their sources, so that help and wrong options need no build.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from trident_tool.building import is_built
from trident_tool.formation import Handler
from trident_tool.links import run_at_master
from trident_tool.modules import run_module
from trident_tool.subcommands import add_subcommand
from trident_tool.workspace import Runner, TridentError, Workspace

_OPTIONS = "src/trident_eval/src/trident_eval/options.py"
_BENCHMARKS = "src/trident_benchmarks/src"
_ROOT = Path(__file__).resolve().parents[2]
_WHAT_IS_MEASURED = "what"


def _load_options() -> Any:
    """The module of trident_eval's options."""
    spec = importlib.util.spec_from_file_location("trident_eval_options", _ROOT / _OPTIONS)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _add_benchmarks(kinds: Any) -> None:
    """A subparser for each benchmark of the registry, by the benchmark's own file."""
    sources = str(_ROOT / _BENCHMARKS)
    sys.path.insert(0, sources)
    try:
        registry = importlib.import_module("trident_benchmarks.registry")
        for benchmark in registry.BENCHMARKS:
            sub = add_subcommand(kinds, benchmark.name, benchmark.help)
            benchmark.load().add_options(sub)
            sub.set_defaults(call=("trident_benchmarks", benchmark.name), passes_on=False)
    finally:
        sys.path.remove(sources)


@contextmanager
def _without_bytecode() -> Iterator[None]:
    """Nothing is written next to the sources that are imported."""
    writes, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    try:
        yield
    finally:
        sys.dont_write_bytecode = writes


def add_evaluation_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    """Adds the packages' commands; ``bench`` has a subparser for each benchmark."""
    with _without_bytecode():
        _add_commands(add)


def _add_commands(add: Callable[[str, Handler, str], argparse.ArgumentParser]) -> None:
    options = _load_options()
    for command in options.COMMANDS:
        sub = add(command.name, _HANDLERS.get(command.name, _run), command.help)
        _set_up(sub, command)
    bench = add("bench", _run, "measure; each benchmark has options of its own: bench sim -h")
    kinds = bench.add_subparsers(dest=_WHAT_IS_MEASURED, metavar="BENCHMARK", required=True)
    _add_benchmarks(kinds)


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


def _cmd_latency(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    if runner.dry_run:
        return _run(workspace, runner, options)
    module, *before = options.call
    return run_at_master(workspace, runner, module, [*before, *words_of(options, options.argv)])


def _cmd_sweep(workspace: Workspace, runner: Runner, options: argparse.Namespace) -> int:
    """A dry run shows which runs there are; runs of launch files call the program that this is."""
    if not runner.dry_run:
        os.environ["TRIDENT_PROGRAM"] = str(workspace.root / "trident")
        return _run(workspace, runner, options)
    if not is_built(workspace):
        return _run(workspace, runner, options)
    module, *before = options.call
    words = [*before, *words_of(options, options.argv), "--plan"]
    return run_module(workspace, Runner(), module, words)


_HANDLERS: dict[str, Handler] = {
    "report": _cmd_report,
    "latency": _cmd_latency,
    "sweep": _cmd_sweep,
}
