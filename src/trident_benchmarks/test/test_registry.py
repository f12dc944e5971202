# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The registry of the benchmarks."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from trident_benchmarks.registry import BENCHMARKS

import trident_benchmarks

SOURCES = Path(trident_benchmarks.__path__[0]).parent
LOAD_ALL = (
    "import argparse; from trident_benchmarks.registry import BENCHMARKS\n"
    "for benchmark in BENCHMARKS: benchmark.load().add_options(argparse.ArgumentParser())\n"
    "foreign = {name.partition('.')[0] for name in sys.modules} - sys.stdlib_module_names\n"
    "print(sorted(foreign - {'__main__'}))"
)


def test_names_are_unique() -> None:
    assert len({benchmark.name for benchmark in BENCHMARKS}) == len(BENCHMARKS)


def test_options_are_known_without_anything_but_the_standard_library() -> None:
    # ./trident shows them before anything is installed or built.
    command = [
        sys.executable,
        "-I",
        "-S",
        "-c",
        f"import sys; sys.path.insert(0, {str(SOURCES)!r});",
    ]
    command[-1] += LOAD_ALL
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout == "['trident_benchmarks']\n"
