# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A picture of a program that needs a display, without one."""

from __future__ import annotations

import contextlib
import os
import re
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from trident_tool.processes import started
from trident_tool.supervisor import end_with_parent
from trident_tool.view.framebuffer import Image, read_xwd, write_png
from trident_tool.workspace import TridentError

_POLL_S = 0.5
# Of a ProgressClock, so that a picture on a busy machine is of as much as on an idle one.
_SETTLED_S = 2.0  # without a change before a picture is kept
_MIN_S = 8.0  # rviz paints an empty scene first and adds displays as their messages come
_TIMEOUT_S = 60.0
_LARGEST = 8192


class ViewerEndedError(TridentError):
    """The program ended before there was a picture."""

    def __init__(self, code: int) -> None:
        """Of a program that ended with this code, below zero: by a signal."""
        super().__init__(f"rviz ended with exit code {code}")
        self.is_crash = code < 0


@dataclass(frozen=True)
class Size:
    """Of a picture [pixel]."""

    width: int = 1600
    height: int = 1000

    @staticmethod
    def parse(text: str) -> Size:
        """The size that a text like 1200x750 means.

        Raises:
            ValueError: it means none.
        """
        found = re.fullmatch(r"(\d+)x(\d+)", text)
        if found is None or not all(100 <= int(side) <= _LARGEST for side in found.groups()):
            raise ValueError(f"{text!r}; legal: WIDTHxHEIGHT, each 100 to {_LARGEST}")
        return Size(int(found[1]), int(found[2]))


class ProgressClock:
    """The time for which a program could run: without that in which it waited for a core.

    Where Linux does not count the waiting (/proc/PID/schedstat) it is the wall's.
    """

    def __init__(self, pid: int, monotonic: Callable[[], float] = time.monotonic) -> None:
        """Begins at zero; the program is the process with this id, and all below it."""
        self._pid, self._monotonic = pid, monotonic
        self._last_s, self._now_s = monotonic(), 0.0
        self._waited = waited_s(pid)

    def now_s(self) -> float:
        """How far it is [s]. Of several processes the one counts that waited most."""
        wall_s, waited = self._monotonic(), waited_s(self._pid)
        longest = max((waited[pid] - self._waited.get(pid, 0.0) for pid in waited), default=0.0)
        self._now_s += max(wall_s - self._last_s - longest, 0.0)
        self._last_s, self._waited = wall_s, waited
        return self._now_s


def waited_s(pid: int) -> dict[int, float]:
    """How long a process and those below it have waited for a core so far [s], by their ids."""
    found, ahead = {}, [pid]
    while ahead:
        one = Path("/proc") / str(ahead.pop())
        with contextlib.suppress(OSError, IndexError, ValueError):  # it may end at any time
            found[int(one.name)] = int((one / "schedstat").read_text().split()[1]) / 1e9
        with contextlib.suppress(OSError):
            ahead += map(int, (one / "task" / one.name / "children").read_text().split())
    return found


@contextlib.contextmanager
def _virtual_screen(folder: Path, size: Size) -> Iterator[tuple[str, Path]]:
    """An X server without a display; gives its name and the file that holds its picture.

    Raises:
        TridentError: Xvfb did not start.
    """
    read_end, write_end = os.pipe()
    screen = f"{size.width}x{size.height}x24"
    command = ["Xvfb", "-displayfd", str(write_end), "-screen", "0", screen, "-fbdir", str(folder)]
    process = subprocess.Popen(
        [*command, "-nolisten", "tcp", "-nocursor"],
        pass_fds=[write_end],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=end_with_parent,
    )
    os.close(write_end)
    try:
        with os.fdopen(read_end) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise TridentError("Xvfb did not start")
        yield f":{number}", folder / "Xvfb_screen0"
    finally:
        process.terminate()
        process.wait()


def _wait_for_picture(
    screen: Path, viewer: subprocess.Popen[bytes], is_ready: Callable[[], bool]
) -> Image:
    """The picture of ``screen`` once all is ready, it shows something and has stopped changing.

    Raises:
        TridentError: the program ended, or the screen stayed blank.
    """
    clock = ProgressClock(viewer.pid)
    last, equal_since_s = read_xwd(screen.read_bytes()), 0.0
    while (now_s := clock.now_s()) < _TIMEOUT_S:
        if viewer.poll() is not None:
            raise ViewerEndedError(viewer.returncode)
        time.sleep(_POLL_S)
        picture = read_xwd(screen.read_bytes())
        if picture != last or not is_ready():
            last, equal_since_s = picture, clock.now_s()
        is_settled = now_s - equal_since_s >= _SETTLED_S
        if now_s >= _MIN_S and is_settled and not picture.is_blank():
            return picture
    if last.is_blank():
        raise TridentError(f"the screen was still blank after {_TIMEOUT_S:.0f} s")
    return last  # a moving scene never settles; what it shows now is as good as later


def resized(configuration: str, size: Size) -> str:
    """An rviz configuration with a window of this size: there is no window manager to decide."""
    head = configuration.partition("Window Geometry:")[0]
    return f"{head}Window Geometry:\n  Height: {size.height}\n  Width: {size.width}\n"


def screenshot(
    command: Sequence[str],
    env: Mapping[str, str],
    target: Path,
    size: Size,
    is_ready: Callable[[], bool] = lambda: True,
    tries: int = 1,
) -> None:
    """Runs a program on a screen of its own until its picture stands still, and keeps that.

    Args:
        command: the program.
        env: its environment.
        target: where the picture goes.
        size: of the screen.
        is_ready: whether what it shows has been sent.
        tries: how often it is started; rviz' heap gets corrupted now and then.

    Raises:
        TridentError: there is no picture.
    """
    for left in reversed(range(tries)):
        try:
            write_png(_picture(command, env, size, is_ready), target)
            return
        except ViewerEndedError as error:
            if not (error.is_crash and left):
                raise


def _picture(
    command: Sequence[str], env: Mapping[str, str], size: Size, is_ready: Callable[[], bool]
) -> Image:
    """Of the program, without what is around it.

    Raises:
        TridentError: the program shows nothing, or ends.
    """
    with (
        tempfile.TemporaryDirectory(prefix="trident-view-") as folder,
        _virtual_screen(Path(folder), size) as (display, screen),
    ):
        # Software rendering: the same picture on every machine.
        changes = {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1", "QT_X11_NO_MITSHM": "1"}
        changes.setdefault("XDG_RUNTIME_DIR", env.get("XDG_RUNTIME_DIR", folder))
        with started(command, {**env, **changes}) as viewer:
            return _wait_for_picture(screen, viewer, is_ready).cropped()
