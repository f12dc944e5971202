# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line of the benchmarks."""

from __future__ import annotations

import argparse
import signal
import sys
from pathlib import Path
from types import FrameType

from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of

from trident_benchmarks.registry import BENCHMARKS
from trident_benchmarks.results import UNUSABLE, say


def make_parser() -> argparse.ArgumentParser:
    """The command line: a subcommand for each benchmark."""
    parser = argparse.ArgumentParser(prog="trident bench", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="BENCHMARK")
    for benchmark in BENCHMARKS:
        file = benchmark.load()
        sub = commands.add_parser(benchmark.name, help=benchmark.help, description=benchmark.help)
        file.add_options(sub)
        sub.set_defaults(run=file.run)
    return parser


def _end_on_signal(number: int, frame: FrameType | None) -> None:
    del frame
    raise SystemExit(128 + number)  # so that every `with` ends its processes


def main(arguments: list[str] | None = None) -> int:
    """Runs a benchmark.

    Returns:
        0: measured; 1: a row failed; 2: nothing could be measured; 130: interrupted.
    """
    options = make_parser().parse_args(arguments)
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, _end_on_signal)
    try:
        return int(options.run(options))
    except EvalError as error:
        say(f"trident bench: {error}")
        return UNUSABLE
    except KeyboardInterrupt:
        say("trident bench: interrupted")
        return 130
    except BrokenPipeError:
        raise
    except OSError as error:  # a full disk does not say which file it was
        where = _place_of(error, options)
        say(f"trident bench: {where}: {error.strerror}")
        return UNUSABLE


def _place_of(error: OSError, options: argparse.Namespace) -> Path | str:
    return error.filename or getattr(options, "out", None) or "what was to be written"


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
