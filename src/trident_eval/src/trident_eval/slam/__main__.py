# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: judge trajectories and maps, run a log through SLAM."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_eval.core.exit_codes import exit_code_of
from trident_eval.options import add_evaluate, add_slam
from trident_eval.slam import evaluation, offline

DONE, UNUSABLE = 0, 2


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand.

    Returns:
        0: done; 2: something that cannot be read, or run.
    """
    parser = _parser()
    options, rest = parser.parse_known_args(arguments)
    options.rest = rest
    if rest and options.run is not _slam:
        parser.error(f"unknown option {rest[0]}")
    try:
        return int(options.run(options))
    except EvalError as error:
        print(f"trident: {error}", file=sys.stderr)
        return UNUSABLE
    except BrokenPipeError:
        raise
    except OSError as error:  # a full disk does not say which file it was
        where = _place_of(error, options)
        print(f"trident: {where}: {error.strerror}", file=sys.stderr)
        return UNUSABLE


def _place_of(error: OSError, options: argparse.Namespace) -> Path | str:
    return error.filename or getattr(options, "out", None) or "what was to be written"


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="trident", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    judge = commands.add_parser("evaluate", help="judge a trajectory and a map")
    add_evaluate(judge)
    judge.set_defaults(run=_evaluate)
    slam = commands.add_parser("slam", help="run a CARMEN log or a rosbag through SLAM")
    add_slam(slam)
    slam.set_defaults(run=_slam)
    return parser


def _slam(options: argparse.Namespace) -> int:
    out = options.out or Path(options.log.name.split(".")[0] + "_slam")
    run = offline.Run(options.log, options.method, out, options.config, tuple(options.rest))
    timing = offline.run_log(run)
    print(f"{timing['scans']} scans, {timing['cpu_s']:.2f} CPU s, {timing['peak_rss_mb']:.0f} MB")
    calibration = offline.calibration_text(timing)
    if calibration:
        print(calibration)
    if options.method == offline.LANDMARK_METHOD:
        map_file = None
        print(f"associations as in the log: {timing['association_share']:.1%}")
    else:
        map_file = _drawn(out / "map.yaml")
    paths = {"final": out / "trajectory.tum", "causal": out / "causal.tum"}
    task = evaluation.Task(paths, options.relations, options.truth, map=map_file)
    found = evaluation.evaluate(task)
    print(evaluation.table(found.summary()), flush=True)
    evaluation.write(found, out, str(options.log), draw=not options.no_pictures)
    print(out)
    return DONE


def _drawn(map_file: Path) -> Path | None:
    """The map, once it is drawn; None if it is too large for that."""
    if offline.is_drawable(map_file):
        offline.write_png(map_file)
        return map_file
    width, height = offline.map_size(map_file)
    print(
        f"{map_file}: {width} x {height} cells: too many to be drawn and judged, at most"
        f" {offline.MAX_CELLS}; the map is there",
        file=sys.stderr,
    )
    return None


def _trajectories_in(folder: Path) -> dict[str, Path]:
    names = {"final": "trajectory.tum", "causal": "causal.tum"}
    paths = {name: folder / file for name, file in names.items() if (folder / file).is_file()}
    if not paths:
        raise EvalError(f"{folder}: has no trajectory.tum; legal: what `./trident slam` writes")
    return paths


def _map_in(folder: Path) -> Path | None:
    map_file = folder / "map.yaml"
    return map_file if map_file.is_file() else None


def _evaluate(options: argparse.Namespace) -> int:
    source: Path = options.source
    if source.is_dir():
        paths, map_file = _trajectories_in(source), options.map or _map_in(source)
        folder = options.out or source
    else:
        paths, map_file = {source.stem: source}, options.map
        folder = options.out or source.with_name(source.stem + "_evaluation")
    task = evaluation.Task(
        paths, options.relations, options.truth, options.align, map_file, options.true_map
    )
    found = evaluation.evaluate(task)
    print(evaluation.table(found.summary()), flush=True)
    for path in evaluation.write(found, folder, str(source), draw=not options.no_pictures):
        print(path)
    return DONE


if __name__ == "__main__":
    sys.exit(exit_code_of(main))
