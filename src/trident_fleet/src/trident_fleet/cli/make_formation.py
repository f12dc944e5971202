# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Writes a position file from patterns, and says how close the vehicles come to each other."""

from __future__ import annotations

import argparse
import itertools
import math
import shlex
import sys
from dataclasses import replace
from pathlib import Path

from trident_fleet.core.choreography import Choreography, Performance, StepResult, perform
from trident_fleet.core.choreography_file import parse_words, read_choreography
from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.position_file import reading_args, write_positions
from trident_fleet.core.separation import min_separation

_YAML = (".yaml", ".yml")
_LAUNCHED_VEHICLES = 6  # by multi_uav_simulation.launch, at most and by default


def main(arguments: list[str] | None = None) -> int:
    """Make a formation.

    Returns:
        0: written; 1: it cannot be flown or written, and the reason is reported.
    """
    options = _parser().parse_args(arguments)
    try:
        choreography = _choreography(options)
        performance = perform(choreography)
        print(_summary(performance))
        for path in options.out:
            write_positions(path, performance.rows, _comments(options, choreography, performance))
            print(f"wrote {path}; {_usage(path, performance)}")
    except FormationError as error:
        print(f"formation: {error}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="formation", description=__doc__)
    parser.add_argument("words", nargs="+", metavar="FILE.yaml | PATTERN [STEP …]")
    parser.add_argument("--uavs", type=int, metavar="N", help="vehicles (a file has its own)")
    parser.add_argument("--spacing", type=float, metavar="M", help="of all patterns [m]")
    parser.add_argument("--min-separation", type=float, metavar="M", help="to be kept [m]")
    parser.add_argument("--out", type=Path, action="append", default=[], metavar="FILE")
    return parser


def _choreography_of_file(words: list[str], options: argparse.Namespace) -> Choreography:
    if len(words) > 1:
        raise FormationError(f"'{words[1]}' after {words[0]}; legal: its steps are in the file")
    if options.spacing is not None:
        raise FormationError("--spacing: not with a file; legal: spacing_m of its patterns")
    return read_choreography(Path(words[0]))


def _choreography(options: argparse.Namespace) -> Choreography:
    words: list[str] = options.words
    if words[0].endswith(_YAML):
        choreography = _choreography_of_file(words, options)
    else:
        spacing_m = 1.5 if options.spacing is None else options.spacing
        choreography = parse_words(words, _LAUNCHED_VEHICLES, spacing_m)
    if options.uavs is not None:
        choreography = replace(choreography, vehicles=options.uavs)
    if options.min_separation is not None:
        choreography = replace(choreography, min_separation_m=options.min_separation)
    return choreography


def _comments(
    options: argparse.Namespace, choreography: Choreography, performance: Performance
) -> list[str]:
    words = shlex.join(Path(word).name for word in options.words)
    rows, vehicles = performance.rows.shape[:2]
    return [
        *_head_of(Path(options.words[0])),
        f"made by: ./trident formation {words}",
        f"{vehicles} vehicles, {rows} rows, metres; vehicles keep"
        f" {choreography.min_separation_m:g} m apart",
    ]


def _head_of(path: Path) -> list[str]:
    """The comment that a YAML file begins with: whose it is goes for what is made of it, too."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.suffix in _YAML else []
    head = itertools.takewhile(lambda line: line.startswith("#"), lines)
    return [line.lstrip("# ") for line in head]


def _summary(performance: Performance) -> str:
    rows, vehicles = performance.rows.shape[:2]
    least = min_separation(performance.rows)
    lines = [f"{vehicles} vehicles, {rows} rows, smallest separation {_in_meters(least)}"]
    return "\n".join(lines + [f"  {_describe(result)}" for result in performance.steps])


def _describe(result: StepResult) -> str:
    first, last = result.rows
    step = result.step
    new = step.pattern.kind if step.pattern else "same shape"
    text = f"{step.where}: {new}, rows {first + 1} to {last + 1}, {_in_meters(result.separation_m)}"
    transition = result.transition
    if transition is None:
        return text
    if len(transition.waves) > 1:
        return f"{text}, in {len(transition.waves)} waves: all at once they would come too close"
    return f"{text}, all at once ({_in_meters(transition.guaranteed_m)} guaranteed)"


def _in_meters(value: float) -> str:
    return f"{value:.3f} m" if math.isfinite(value) else "(one vehicle)"


def _usage(path: Path, performance: Performance) -> str:
    vehicles = performance.rows.shape[1]
    args = reading_args(path, performance.rows)
    if vehicles > _LAUNCHED_VEHICLES:
        layout = f" --layout {args['layout']}" if "layout" in args else ""
        return f"fly it: ./trident formation-launch --uavs {vehicles} --formation {path}{layout}"
    args = {"formation_file": str(path), **args}
    if vehicles < _LAUNCHED_VEHICLES:
        args["uavs"] = str(vehicles)
    words = " ".join(f"{name}:={value}" for name, value in args.items())
    return f"fly it: ./trident run multi_uav_simulation.launch {words}"


if __name__ == "__main__":
    sys.exit(main())
