# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""ns-3 as a peer: our program for it, built where its headers are, and what it says."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import numpy.typing as npt
from trident_eval.core.errors import EvalError
from trident_eval.ros_paths import package_folder

from trident_benchmarks.results import say

HEADER = Path("/usr/include/ns3/core-module.h")
_LIBRARIES = ("core", "network", "wifi", "propagation", "mobility", "internet", "applications")
_MISSING = (
    "libns3-dev is not installed, so that nothing is compared with ns-3 in this run; goodput is"
    " compared with recorded runs. apt-get install libns3-dev"
)

Curve = npt.NDArray[np.float64]


class Ns3:
    """The built program.

    Attributes:
        version: of the library, as its file says.
    """

    def __init__(self, program: Path) -> None:
        self._program = program
        self.version = _version()

    def losses(self, width: int) -> dict[tuple[int, int], Curve]:
        """Loss of frames by the table-based model.

        Args:
            width: of the channel [MHz].

        Returns:
            By MCS and bytes: rows of the ratio of signal to noise [dB] and the loss.
        """
        curves: dict[tuple[int, int], list[tuple[float, float]]] = {}
        for text in self._run("--task=per", f"--width={width}").splitlines():
            mcs, size, snr_db, loss = text.split()
            curves.setdefault((int(mcs), int(size)), []).append((float(snr_db), float(loss)))
        return {key: np.array(rows) for key, rows in curves.items()}

    def goodput(self, **options: float) -> float:
        """Payload at the sink [Mbit/s].

        Args:
            options: of the program, by name.
        """
        return float(self._run(*(f"--{key}={value}" for key, value in options.items())))

    def _run(self, *arguments: str) -> str:
        done = subprocess.run(
            [str(self._program), *arguments], capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            raise EvalError(f"ns3_peer {' '.join(arguments)}: {done.stderr.strip()[-300:]}")
        return done.stdout


def _version() -> str:
    for file in sorted(Path("/usr/lib").glob("*/libns3-core.so")):
        return file.resolve().name.rpartition(".so.")[2]
    return "unknown"


def build(folder: Path) -> Path:
    """Compile our program for ns-3.

    Raises:
        EvalError: it does not compile, with the compiler's first error.
    """
    source = package_folder("trident_benchmarks") / "ns3" / "ns3_peer.cpp"
    program = folder / "ns3_peer"
    libraries = [f"-lns3-{name}" for name in _LIBRARIES]
    command = ["c++", "-std=c++17", "-O2", str(source), "-o", str(program), *libraries]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        errors = [text for text in done.stderr.splitlines() if "error" in text]
        raise EvalError(f"{source.name} does not compile: {(errors or ['?'])[0]}")
    return program


@contextmanager
def ns3_peer() -> Iterator[Ns3 | None]:
    """The peer; None, and a line that says so, where ns-3 is not installed."""
    if not HEADER.is_file() or shutil.which("c++") is None:
        say(_MISSING)
        yield None
        return
    with tempfile.TemporaryDirectory() as folder:
        peer = Ns3(build(Path(folder)))
        say(f"peer: ns-3 3.{peer.version}")
        yield peer
