# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Films (MP4) of pictures that come one by one, in simulated time."""

from __future__ import annotations

import contextlib
import math
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import IO

import numpy as np
import numpy.typing as npt
from trident_eval.core.errors import EvalError

Pixels = npt.NDArray[np.uint8]
FPS_RANGE = (1.0, 240.0)


@dataclass
class Pace:
    """Which frames of a film a picture fills, so that the film runs in simulated time.

    Attributes:
        fps: frames per second of simulated time.
        written: frames that are filled.
    """

    fps: float
    written: int = 0
    _origin_s: float | None = None
    _last_s: float = 0.0

    def frames_until(self, stamp_s: float) -> int:
        """How many frames a picture of a simulated time [s] adds to the film.

        Returns:
            0: its frame is there already; 1: it follows; more: pictures are missing between, whose
            frames show what came before.
        """
        if self._origin_s is None:
            self._origin_s = stamp_s
        elif stamp_s < self._last_s:  # the world was reset: the film continues
            self._origin_s = stamp_s - self.written / self.fps
        self._last_s = stamp_s
        due = round((stamp_s - self._origin_s) * self.fps) + 1 - self.written
        added = max(0, due)
        self.written += added
        return added


class Film:
    """An MP4 file (H.264) that grows by a picture at a time; complete when it is left."""

    def __init__(
        self, path: Path, width: int, height: int, fps: float, length_s: float = math.inf
    ) -> None:
        """Nothing is written yet.

        Args:
            path: the file.
            width: of a picture [pixels].
            height: of a picture [pixels].
            fps: frames per second of simulated time.
            length_s: it takes no more than this, in simulated time [s]; at least a frame.

        Raises:
            EvalError: a size or rate that a film cannot have; there is no ffmpeg.
        """
        for name, value in (("width", width), ("height", height)):
            if value % 2:
                raise EvalError(f"--size: {name} {value} pixels, legal for a film: an even number")
        if not FPS_RANGE[0] <= fps <= FPS_RANGE[1]:
            raise EvalError(f"--fps {fps:g}, legal: {FPS_RANGE[0]:g} to {FPS_RANGE[1]:g}")
        program = shutil.which("ffmpeg")
        if program is None:
            raise EvalError(
                f"{path}: films need ffmpeg, which is not installed "
                "(./trident setup, or apt-get install ffmpeg)"
            )
        self._program = program
        self._path = path
        self._shape = (height, width, 3)
        self._pace = Pace(fps)
        self._frames = 0
        self._most = max(1.0, round(length_s * fps)) if math.isfinite(length_s) else math.inf
        self._last: bytes = b""
        self._errors: IO[bytes] | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self.missing = 0

    @property
    def seconds(self) -> float:
        """How long it is by now."""
        return self._frames / self._pace.fps

    @property
    def is_full(self) -> bool:
        """Whether it is as long as it may become."""
        return self._frames >= self._most

    def __enter__(self) -> Film:
        """Start the encoder."""
        self._errors = tempfile.TemporaryFile()
        height, width, _ = self._shape
        source = ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{width}x{height}"]
        source += ["-r", f"{self._pace.fps:g}", "-i", "-"]
        coding = ["-c:v", "libx264", "-preset", "veryfast", "-crf", "20", "-pix_fmt", "yuv420p"]
        coding += ["-movflags", "+faststart"]
        self._process = subprocess.Popen(
            [self._program, "-loglevel", "error", "-y", *source, *coding, str(self._path)],
            stdin=subprocess.PIPE,
            stderr=self._errors,
            start_new_session=True,  # Ctrl-C ends the film, it does not break it off
        )
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Finish the file.

        Raises:
            EvalError: the encoder failed; contains what it printed.
        """
        assert self._process is not None
        assert self._process.stdin is not None
        assert self._errors is not None
        with contextlib.suppress(BrokenPipeError):  # its exit code says more
            self._process.stdin.close()
        code = self._process.wait()
        with self._errors:
            self._errors.seek(0)
            text = self._errors.read().decode(errors="replace").strip()
        if code != 0:
            raise EvalError(f"{self._path}: ffmpeg ended with exit code {code}: {text}") from error

    def add(self, pixels: Pixels, stamp_s: float) -> None:
        """Show a picture, shape (height, width, 3), from its simulated time [s] on.

        What is due after the film's end is left out.

        Raises:
            EvalError: it is of another size; the encoder ended.
        """
        if pixels.shape != self._shape:
            raise EvalError(f"picture of shape {pixels.shape}, legal: {self._shape}")
        frames = self._pace.frames_until(stamp_s)
        if frames == 0:
            return
        picture = pixels.tobytes()
        for frame in range(frames):
            if self.is_full:
                return
            is_missing = frame < frames - 1
            self._write(self._last if is_missing else picture)
            self.missing += is_missing
            self._frames += 1
        self._last = picture

    def _write(self, picture: bytes) -> None:
        assert self._process is not None
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(picture)
        except BrokenPipeError as error:
            raise EvalError(f"{self._path}: ffmpeg has ended") from error
