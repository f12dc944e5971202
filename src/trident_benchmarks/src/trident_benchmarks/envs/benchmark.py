# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench envs`: how fast environments of learners are, and whether one learns."""

from __future__ import annotations

import argparse
from pathlib import Path


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--quick", action="store_true", help="a tenth of the steps, 15 s to learn")
    parser.add_argument("--out", type=Path, metavar="FILE.json", help="where the rows go")


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.envs.measure import measure

    return measure(options)
