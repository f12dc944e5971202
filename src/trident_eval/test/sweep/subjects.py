# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Functions that the tests sweep: well behaved ones, and each kind of failure."""

from __future__ import annotations

import ctypes
import os
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

Parameters = Mapping[str, Any]


def score(parameters: Parameters, seed: int, folder: Path) -> dict[str, float]:
    """Counts its calls in a file next to the sweep, and gives a number that is known."""
    with (folder.parent.parent / "calls.txt").open("a") as calls:
        calls.write(f"{parameters['gain']} {parameters['mode']} {seed}\n")
    time.sleep(parameters["sleep_s"])
    return {"score": parameters["gain"] + (parameters["mode"] == "joint") + 0.01 * (seed % 3)}


def odd(parameters: Parameters, seed: int, folder: Path) -> Any:
    """One thing after the other, by name."""
    return _ODD[parameters["how"]](folder)


def _hang(folder: Path) -> Any:
    if os.fork() == 0:  # what it has started hangs, too
        (folder / "child").write_text(str(os.getpid()))
    while True:
        time.sleep(1.0)


def _write(folder: Path) -> Any:
    print("a word")
    (folder / "note.txt").write_text("kept")
    return {"score": 1.0}


def _fill(folder: Path) -> Any:
    return {"score": float(len(bytearray(4 << 30)))}


def _crash(folder: Path) -> Any:
    ctypes.string_at(0)


def _raise(folder: Path) -> Any:
    raise RuntimeError("no luck\nsecond line")


def _die_once(folder: Path) -> Any:
    mark = folder.parent.parent / "died"
    if not mark.exists():
        mark.touch()
        os.kill(os.getpid(), 9)
    return {"score": 3.0}


_ODD = {
    "hang": _hang,
    "write": _write,
    "fill": _fill,
    "crash": _crash,
    "raise": _raise,
    "die_once": _die_once,
    "die": lambda folder: os.kill(os.getpid(), 9),
    "exit": lambda folder: os._exit(3),
    "sys_exit": lambda folder: exit(5),
    "nothing": lambda folder: None,
    "missing": lambda folder: {"other": 1.0},
    "nan": lambda folder: {"score": float("nan")},
    "text": lambda folder: {"score": "high"},
}
