# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Runs a log or a bag through a SLAM method, with a progress bar."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import deque
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import program

#: The only one whose logs hold landmarks, not scans.
LANDMARK_METHOD = "ekf_slam"
BAG_MAGIC = b"#ROSBAG"
_PROGRESS = re.compile(r"\s*(\d+) % (\d+) scans")
_BAR = 30
_PGM = re.compile(rb"P5\s+(?:#[^\n]*\n\s*)*(\d+)\s+(\d+)\s+\d+\s")
_PGM_HEAD = 4096
#: Of a map that is drawn and judged: 350 m by 350 m at 5 cm. Each takes some ten bytes then.
MAX_CELLS = 50_000_000
_ERROR = re.compile(r"(slam_offline(_bag)?|landmark_offline): ")  # an error begins with it
_SHOWN_LINES = 5
_CHOSEN = "scans: "  # what the line begins with that names the topics of a bag


@dataclass(frozen=True)
class Run:
    """What to run.

    Attributes:
        log: a CARMEN log or a rosbag.
        method: name of the SLAM method.
        out: folder of the results.
        config: YAML of the method, or None for its defaults.
        words: options of the log's reader, as they are handed to the program.
    """

    log: Path
    method: str
    out: Path
    config: Path | None = None
    words: tuple[str, ...] = ()


def is_bag(path: Path) -> bool:
    """Whether a file is a rosbag, by its first bytes.

    Raises:
        EvalError: it cannot be read.
    """
    if path.is_char_device() or path.is_block_device():
        raise EvalError(f"{path}: a device; legal: a CARMEN log or a rosbag")
    try:
        with path.open("rb") as file:
            return file.read(len(BAG_MAGIC)) == BAG_MAGIC
    except OSError as error:
        raise EvalError(f"{path}: {error.strerror}; legal: a CARMEN log or a rosbag") from error


def command(run: Run) -> list[str]:
    """The program and its words."""
    if run.method == LANDMARK_METHOD:
        words = [program("trident_slam", "landmark_offline"), str(run.log)]
    else:
        name = "slam_offline_bag" if is_bag(run.log) else "slam_offline"
        words = [program("trident_slam", name), str(run.log), "--method", run.method]
    words += ["--config", str(run.config)] if run.config else []
    return [*words, "--out", str(run.out), *run.words]


def run_log(run: Run, show: bool = True) -> dict[str, Any]:
    """Run a log to its end.

    Args:
        run: what to run.
        show: a progress bar and warnings on stderr.

    Returns:
        What timing.json holds: method, scans, problems, cpu_s, peak_rss_mb.

    Raises:
        EvalError: the program failed; the message holds its last lines.
    """
    with subprocess.Popen(
        command(run),
        stderr=subprocess.PIPE,
        stdout=subprocess.DEVNULL,
        text=True,
        errors="replace",  # it shows what is wrong with a binary file
    ) as process:
        assert process.stderr is not None
        said = _follow(process.stderr, show)
    if process.returncode != 0:
        raise EvalError("\n".join(said) or f"{run.log}: slam_offline ended with no word")
    try:
        timing = json.loads((run.out / "timing.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise EvalError(f"{run.out}/timing.json: {error}") from error
    return dict(timing)


def calibration_text(timing: dict[str, Any]) -> str | None:
    """What the method found out about odometry and the laser's place; None without a word of it."""
    found = timing.get("odometry_calibration")
    if not found:
        return None
    known = [
        f"{name} {entry['value']:.4f} ± {entry['sigma']:.4f}"
        for name, entry in found.items()
        if entry["is_observed"]
    ]
    unknown = [name for name, entry in found.items() if not entry["is_observed"]]
    parts = [", ".join(known)] if known else []
    parts += ["not observable: " + ", ".join(unknown)] if unknown else []
    return "odometry: " + "; ".join(parts)


def _follow(stream: IO[str], show: bool) -> list[str]:
    said: deque[str] = deque(maxlen=_SHOWN_LINES)
    shown = _Shown()
    for line in stream:
        found = _PROGRESS.match(line)
        # What was chosen is no reason for a failure.
        if found is None and not line.startswith(_CHOSEN):
            said.append(line.rstrip())
        if show:
            shown.take(line, found)
    shown.end()
    return [_ERROR.sub("", line, count=1) if _ERROR.match(line) else line for line in said]


class _Shown:
    """What is shown of a program's lines, below which there may be a bar of its progress."""

    def __init__(self) -> None:
        self._has_bar = False

    def take(self, line: str, progress: re.Match[str] | None) -> None:
        """Show a line, unless it is an error, which the caller says; or the progress that it is."""
        if progress is None and not _ERROR.match(line):
            print(("\n" if self._has_bar else "") + line.rstrip(), file=sys.stderr)
            self._has_bar = False
        elif progress is not None and sys.stderr.isatty():
            print(bar(int(progress[1]), int(progress[2])), end="", file=sys.stderr, flush=True)
            self._has_bar = True

    def end(self) -> None:
        """Leave the bar."""
        if self._has_bar:
            print(file=sys.stderr)


def bar(percent: int, scans: int) -> str:
    """One line that overwrites the last one."""
    full = _BAR * min(percent, 100) // 100
    return f"\r\x1b[K[{'#' * full}{'.' * (_BAR - full)}] {percent:3d} %  {scans} scans"


def map_size(map_yaml: Path) -> tuple[int, int]:
    """Width and height of the map next to a YAML file [cells].

    Raises:
        EvalError: it does not exist, or has no cell.
    """
    file = map_yaml.with_suffix(".pgm")
    try:
        with file.open("rb") as stream:
            head = stream.read(_PGM_HEAD)
    except OSError as error:
        raise EvalError(f"{file}: {error.strerror}; legal: a map") from error
    found = _PGM.match(head)
    if found is None:
        raise EvalError(f"{file}: no PGM image; legal: as slam_offline writes")
    width, height = int(found[1]), int(found[2])
    if width * height == 0:
        raise EvalError(
            f"{file}: the map is empty: no scan has a return within the sensor's range; see the"
            " warnings"
        )
    return width, height


def is_drawable(map_yaml: Path) -> bool:
    """Whether the map is small enough to be drawn and judged; errors as `map_size`."""
    width, height = map_size(map_yaml)
    return width * height <= MAX_CELLS


def write_png(map_yaml: Path) -> Path:
    """Write map.png next to map.pgm and return its path."""
    from PIL import Image

    target = map_yaml.with_suffix(".png")
    with Image.open(map_yaml.with_suffix(".pgm")) as image:
        image.save(target)
    return target
