# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Calls of `./trident`, and what they leave behind."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness import LIMIT_S, REPO
from trident.testing import output_of


@dataclass
class Outcome:
    """What one call of ./trident left behind."""

    code: int
    output: str
    folder: Path | None

    @property
    def verdict(self) -> dict[str, Any]:
        assert self.folder is not None, self.output
        result: dict[str, Any] = json.loads((self.folder / "verdict.json").read_text("utf-8"))
        return result

    @property
    def passed(self) -> dict[str, Any]:
        assert self.code == 0, self.output
        assert self.verdict["pass"], self.verdict
        return self.verdict


class Trident:
    """Calls ./trident, and takes its run folders away afterwards."""

    def __init__(self) -> None:
        self.latest = REPO / "out" / "latest"
        self.before = os.readlink(self.latest) if self.latest.is_symlink() else None
        self.folders: list[Path] = []

    def __call__(self, *words: object, limit_s: float = 4 * LIMIT_S) -> Outcome:
        command = [str(REPO / "trident"), *(str(word) for word in words)]
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        output = output_of(process, limit_s)
        found = re.search(r"^trident: \S+ -> (out/\S+)$", output, re.MULTILINE)
        folder = REPO / found[1] if found else None
        if folder is not None:
            self.folders.append(folder)
        log = folder / "roslaunch.log" if folder else None
        if log is not None and log.is_file():
            output += log.read_text(encoding="utf-8", errors="replace")
        return Outcome(process.returncode, output, folder)

    def clean(self) -> None:
        ours = self.latest.is_symlink() and os.readlink(self.latest) in {
            folder.name for folder in self.folders
        }
        for folder in self.folders:
            shutil.rmtree(folder, ignore_errors=True)
        if ours:
            self.latest.unlink()
            if self.before is not None and (REPO / "out" / self.before).is_dir():
                self.latest.symlink_to(self.before)
