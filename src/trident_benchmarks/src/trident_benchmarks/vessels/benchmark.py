# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident bench vessels`: vessels and sea compared with theory and references."""

from __future__ import annotations

import argparse
from pathlib import Path

VESSEL_CHECKS = (
    "static",
    "decay",
    "rao",
    "spectrum",
    "speed",
    "circle",
    "zigzag",
    "current",
    "guidance",
    "course",
    "station",
    "energy",
    "legacy_vrx",
    "random",
)


def add_options(parser: argparse.ArgumentParser) -> None:
    """Its options."""
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the pictures go")
    parser.add_argument("--quick", action="store_true", help="without the million random steps")
    parser.add_argument(
        "--only", action="append", choices=VESSEL_CHECKS, help="this check; may be repeated"
    )


def run(options: argparse.Namespace) -> int:
    """Measure and print; the exit code."""
    from trident_benchmarks.vessels.measure import measure

    return measure(options)
