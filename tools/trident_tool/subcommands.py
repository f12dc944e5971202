# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Commands of commands: ``./trident bench NAME``, ``./trident modbus check``."""

from __future__ import annotations

import argparse
from typing import Any


def add_subcommand(kinds: Any, name: str, text: str) -> argparse.ArgumentParser:
    """A parser among those of a command, with the option that all have.

    Args:
        kinds: what the command's ``add_subparsers`` gave.
        name: of the subcommand.
        text: what it does, for the list and its own help.
    """
    sub: argparse.ArgumentParser = kinds.add_parser(name, help=text, description=text)
    # It may stand before the subcommand's name: its absence here says nothing.
    sub.add_argument(
        "--dry-run",
        action="store_true",
        default=argparse.SUPPRESS,
        help="print what would be done, and do nothing",
    )
    return sub
