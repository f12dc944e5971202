# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Shows how far a run is, and its nodes' warnings and errors, from the files the run writes."""

from __future__ import annotations

import json
import re
import shutil
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

_ANSI = re.compile(r"\x1b(\[[0-9;?]*[A-Za-z]|\][^\x07]*\x07)")
# roslaunch says "REQUIRED process has died" also of a node that ended well, so that is left out.
_WORTH_SHOWING = re.compile(
    r"\[\s*(WARN|ERROR|FATAL)\s*\]|process has died \[pid|Traceback|RLException|^ERROR"
)
_DIED = re.compile(r"process has died \[pid \d+, exit code (-?\d+)")
_REQUIRED = re.compile(r"REQUIRED process \[([^\]]+)\] has died")

_ERROR_LINE = re.compile(r"\bERROR\b|\bFATAL\b|Error:|Traceback|process has died \[pid")
_MAX_SHOWN = 30  # lines of warnings: a node that warns at every step must not flood the terminal
_QUIET_PERIOD_S = 10.0  # wall time between two lines where the output is not a terminal


def strip_ansi(text: str) -> str:
    """``text`` without terminal colors and titles."""
    return _ANSI.sub("", text)


@dataclass
class Tail:
    """Reads what is appended to a file, whole lines only; the file may appear later."""

    path: Path
    _offset: int = 0

    def lines(self) -> list[str]:
        """Lines completed since the last call."""
        try:
            with self.path.open("rb") as file:
                file.seek(self._offset)
                data = file.read()
        except FileNotFoundError:
            return []
        end = data.rfind(b"\n") + 1
        self._offset += end
        return data[:end].decode("utf-8", "replace").splitlines()


def progress_line(report: dict[str, Any], width: int = 100) -> str:
    """One line of text for a record of progress.jsonl.

    Its keys sim_s, end_s, rtf, vehicles and state are all optional.
    """
    sim_s = float(report.get("sim_s") or 0.0)
    end_s = float(report.get("end_s") or 0.0)
    parts = [_simulated(sim_s, end_s)]
    if report.get("rtf") is not None:
        parts.append(f"x{float(report['rtf']):.1f} real time")
    if report.get("vehicles") is not None:
        parts.append(f"{int(report['vehicles'])} vehicles")
    if report.get("state"):
        parts.append(str(report["state"]))
    return "  ".join(parts)[:width]


def _simulated(sim_s: float, end_s: float) -> str:
    """How far it is, with a bar if the end is known [s]."""
    if end_s <= 0.0:
        return f"{sim_s:.1f} s simulated"
    share = min(1.0, sim_s / end_s)
    filled = round(share * 20)
    bar = f"[{'#' * filled}{'.' * (20 - filled)}]"
    return f"{bar} {share:4.0%}  {sim_s:.1f}/{end_s:.1f} s simulated"


def parse_report(line: str) -> dict[str, Any] | None:
    """A record of progress.jsonl, or None when the line is not one."""
    try:
        report = json.loads(line)
    except ValueError:
        return None
    return report if isinstance(report, dict) else None


def required_node_failed(log: str) -> str | None:
    """Name of the required node whose failure ended a launch, by roslaunch's own output, or None.

    roslaunch exits 0 also when a required node died, so its exit code does not show that.
    """
    found = _REQUIRED.search(log)
    if found is None:
        return None
    died = _DIED.search(log, found.end())
    return found.group(1) if died is not None and int(died.group(1)) != 0 else None


def last_warnings(folder: Path, count: int = 15) -> list[str]:
    """The last error lines of the logs below ``folder``, newest log last, each said once."""
    found: dict[str, str] = {}
    for path in _logs_of_nodes(folder):
        text = strip_ansi(path.read_text(encoding="utf-8", errors="replace")).splitlines()
        bad = [line.strip(" =") for line in text if _ERROR_LINE.search(line)]
        for line in bad[-5:]:
            # A message is in the node's own log and on the console.
            message = re.split(r"\]:? |: ", line)[-1]
            found.setdefault(message, f"{path.name}: {line}")
    return list(found.values())[-count:]


def _logs_of_nodes(folder: Path) -> list[Path]:
    """Logs below ``folder``, newest last, without those of ROS itself."""
    logs = [
        path
        for path in folder.rglob("*.log")
        if not path.is_symlink() and not path.name.startswith(("rosout", "roslaunch-", "master"))
    ]
    return sorted(logs, key=lambda path: path.stat().st_mtime)


@dataclass
class ProgressView:
    """One updating line on a terminal, an occasional line elsewhere; warnings as they come."""

    run_folder: Path
    stream: IO[str] = field(default_factory=lambda: sys.stderr)
    _last_shown: str = ""
    _next_wall_s: float = 0.0
    _warnings: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._progress = Tail(self.run_folder / "progress.jsonl")
        self._log = Tail(self.run_folder / "roslaunch.log")

    def update(self) -> None:
        """Shows what is new since the last call."""
        for line in self._log.lines():
            self._warn(strip_ansi(line).strip())
        reports = [parse_report(line) for line in self._progress.lines()]
        newest = next((report for report in reversed(reports) if report is not None), None)
        if newest is not None:
            self._show(progress_line(newest, self._columns() - 1))

    def _columns(self) -> int:
        """Width of the terminal; of a file, enough for all."""
        return shutil.get_terminal_size().columns if self.stream.isatty() else 200

    def close(self) -> None:
        """Shows the rest and leaves the terminal on a fresh line."""
        self._next_wall_s = 0.0
        self.update()
        if self.stream.isatty() and self._last_shown:
            self.stream.write("\n")
            self.stream.flush()

    def _show(self, line: str) -> None:
        if self.stream.isatty():
            self.stream.write(f"\r\x1b[K{line}")
        elif time.monotonic() >= self._next_wall_s:
            self.stream.write(f"{line}\n")
            self._next_wall_s = time.monotonic() + _QUIET_PERIOD_S
        self._last_shown = line
        self.stream.flush()

    def _warn(self, line: str) -> None:
        if not _WORTH_SHOWING.search(line):
            return
        # The same warning at another time is the same warning.
        key = re.sub(r"\d+(\.\d+)?", "#", line)
        self._warnings[key] = self._warnings.get(key, 0) + 1
        if self._warnings[key] > 1 or len(self._warnings) > _MAX_SHOWN:
            return
        lines = [line]
        if len(self._warnings) == _MAX_SHOWN:
            lines.append(f"more is in {self.run_folder / 'roslaunch.log'}")
        self._write_above_the_bar("".join(f"{line}\n" for line in lines))

    def _write_above_the_bar(self, text: str) -> None:
        clear, bar = ("\r\x1b[K", self._last_shown) if self.stream.isatty() else ("", "")
        self.stream.write(clear + text + bar)
        self.stream.flush()
