# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Films and rerun recordings of a simulation: what takes the place of rviz."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trident_tool.view.screenshot import Size
from trident_tool.workspace import TridentError, Workspace

_LATE_S = 60  # a launch takes a while until the model is there


@dataclass(frozen=True)
class Recording:
    """What is made in addition to, or without, a look.

    Attributes:
        film: MP4 file that a camera in the world writes.
        follow: model that the camera goes with; None: it stands.
        rerun: whether the rerun viewer takes the place of rviz.
        out: .rrd file that is recorded for it.
        seconds: of simulated time; None: 10 s of a film, else to the end of the simulation.
    """

    film: Path | None = None
    follow: str | None = None
    rerun: bool = False
    out: Path | None = None
    seconds: float | None = None

    @property
    def is_wanted(self) -> bool:
        """Whether there is anything to be made."""
        return self.rerun or self.film is not None

    def validate(self, has_display: bool) -> None:
        """Raises TridentError for options that do not go together, or a file that cannot be."""
        if self.film is not None and self.rerun:
            raise TridentError("--film and --rerun: one at a time")
        self._check_companions()
        _check_duration(self.seconds)
        _check_file("--film", self.film, ".mp4")
        _check_file("--out", self.out, ".rrd")
        if self.rerun and self.out is None and not has_display:
            raise TridentError("no DISPLAY for the rerun viewer: record with --out FILE.rrd")

    def _check_companions(self) -> None:
        has_film = self.film is not None
        for name, value, is_legal, others in (
            ("--follow", self.follow, has_film, "--film"),
            ("--out", self.out, self.rerun, "--rerun"),
            ("--seconds", self.seconds, self.is_wanted, "--film or --rerun"),
        ):
            if value is not None and not is_legal:
                raise TridentError(f"{name} goes with {others} only")

    def command(self, workspace: Workspace, size: Size | None, env: Mapping[str, str]) -> list[str]:
        """The node that makes it.

        Args:
            workspace: whose it is.
            size: of the film; None: that of the node.
            env: a viewer is opened if it holds a DISPLAY.
        """
        words = [] if self.seconds is None else ["--seconds", f"{self.seconds:g}"]
        if self.film is not None:
            return ["rosrun", "trident_viewer", "observer.py", *words, *self._film_words(size)]
        words += ["--out", str(self.out)] if self.out is not None else []
        words += ["--viewer"] if env.get("DISPLAY") else []
        # Of .venv: rerun is no package of Debian's.
        return [str(workspace.venv_python), "-m", "trident_viewer.to_rerun", *words]

    def _film_words(self, size: Size | None) -> list[str]:
        words = ["--out", str(self.film), "--wait", str(_LATE_S)]
        words += ["--size", f"{size.width}x{size.height}"] if size is not None else []
        words += ["--follow", self.follow] if self.follow is not None else []
        return words


def _check_duration(seconds: float | None) -> None:
    if seconds is not None and not 0.0 < seconds < math.inf:
        raise TridentError(f"--seconds {seconds:g}, legal: more than 0")


def _check_file(option: str, file: Path | None, suffix: str) -> None:
    if file is None:
        return
    if file.suffix != suffix:
        raise TridentError(f"{option} {file}: suffix '{file.suffix}', legal: {suffix}")
    if not file.resolve().parent.is_dir():
        raise TridentError(f"{option} {file}: its folder does not exist")
