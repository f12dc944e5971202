# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Command line: judge trajectories and maps, run a log through SLAM, measure SLAM."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from trident_eval.core.errors import EvalError
from trident_eval.slam import evaluation

DONE, UNUSABLE = 0, 2


def main(arguments: list[str] | None = None) -> int:
    """Run a subcommand.

    Returns:
        0: done; 2: something that cannot be read, or run.
    """
    options = _parser().parse_args(arguments)
    try:
        return int(options.run(options))
    except EvalError as error:
        print(f"trident: {error}", file=sys.stderr)
        return UNUSABLE


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="trident", description=__doc__)
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    judge = commands.add_parser("evaluate", help="judge a trajectory and a map")
    judge.add_argument("source", type=Path, help="folder of `./trident slam`, or a TUM trajectory")
    judge.add_argument("--relations", type=Path, metavar="FILE.relations")
    judge.add_argument("--truth", type=Path, metavar="FILE.tum", help="the true trajectory")
    judge.add_argument("--align", choices=["SE2", "SE3", "none"], default="SE2")
    judge.add_argument("--map", type=Path, metavar="FILE.yaml")
    judge.add_argument("--true-map", type=Path, metavar="FILE.yaml")
    judge.add_argument("--out", type=Path, metavar="DIR", help="default: beside the trajectory")
    judge.add_argument("--no-pictures", action="store_true", help="only evaluation.json")
    judge.set_defaults(run=_evaluate)
    return parser


def _evaluate(options: argparse.Namespace) -> int:
    source: Path = options.source
    if source.is_dir():
        names = {"final": "trajectory.tum", "causal": "causal.tum"}
        paths = {name: source / file for name, file in names.items() if (source / file).is_file()}
        if not paths:
            raise EvalError(f"{source}: has no trajectory.tum; legal: what `./trident slam` writes")
        map_file = options.map or (source / "map.yaml")
        map_file = map_file if options.map or map_file.is_file() else None
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
    sys.exit(main())
