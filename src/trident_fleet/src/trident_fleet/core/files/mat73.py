# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""MATLAB v7.3 MAT-files (HDF5 behind a 512-byte MATLAB header): what `mat5` is for v5 to v7.

Source: MathWorks, `save`, version 7.3. A variable is a dataset of the root group with an attribute
`MATLAB_class`; HDF5 counts dimensions in C order, MATLAB in Fortran order, so a matrix lies there
transposed.

The HDF5 library crashes or hangs on some damaged files, so it runs in a process of its own.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

from trident_fleet.core.files.mat5 import MatError, Variable

MAGIC = b"MATLAB 7.3 MAT-file"
HDF5_MAGIC = b"\x89HDF\r\n\x1a\n"

_CHILD = Path(__file__).with_name("mat73_child.py")
_LIMIT_S = 300.0  # of wall time, on a loaded machine; the child has its own limit of CPU time


def read_variables(path: Path, wanted: str) -> list[Variable]:
    """Read a file.

    Args:
        path: the file.
        wanted: the variable whose values are read; the others have None as values.

    Returns:
        All variables; `wanted` with values in MATLAB's shape if it is a full, real, numeric matrix.

    Raises:
        MatError: no HDF5 file, a damaged one, or too large a matrix.
    """
    answer, _, data = _ask_child(path, wanted).partition(b"\n")
    content = json.loads(answer)
    if "error" in content:
        raise MatError(content["error"])
    variables = []
    for item in content["variables"]:
        shape = item["shape"]
        values = None if shape is None else np.frombuffer(data, dtype=np.float64).reshape(shape)
        variables.append(Variable(item["name"], item["kind"], values))
    return variables


def _run_child(path: Path, wanted: str) -> subprocess.CompletedProcess[bytes]:
    command = [sys.executable or "/usr/bin/python3", "-I", str(_CHILD), str(path.resolve()), wanted]
    try:
        return subprocess.run(command, capture_output=True, timeout=_LIMIT_S, check=False)
    except subprocess.TimeoutExpired as error:
        raise MatError(f"HDF5: the library had not read it after {_LIMIT_S:g} s") from error


def _ask_child(path: Path, wanted: str) -> bytes:
    done = _run_child(path, wanted)
    if done.returncode == -signal.SIGXCPU:
        raise MatError("HDF5: the library had not read it after 20 s of CPU time")
    if done.returncode < 0:
        raise MatError(f"HDF5: the library crashed on it ({signal.strsignal(-done.returncode)})")
    if done.returncode:
        lines = done.stderr.decode(errors="replace").strip().splitlines() or ["no reason given"]
        raise MatError(f"HDF5: {lines[-1]}")
    return done.stdout
