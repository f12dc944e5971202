# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench table`: the tables of a file that `./trident bench sim` has written."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("source", type=Path, metavar="FILE.json")


def run(options: argparse.Namespace) -> int:
    """Print them."""
    import json

    from trident_eval.core.errors import EvalError

    from trident_benchmarks.results import MEASURED
    from trident_benchmarks.sim.measure import print_tables

    try:
        document = json.loads(options.source.read_text(encoding="utf-8"))
        print_tables(document, profile=True)
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = f"no {error}" if isinstance(error, KeyError) else str(error)
        raise EvalError(
            f"{options.source}: {reason}; legal: a file that --out has written"
        ) from error
    return MEASURED
