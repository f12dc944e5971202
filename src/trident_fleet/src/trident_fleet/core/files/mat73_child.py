# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Reads an HDF5 file in a process of its own; see `mat73`. Usage: mat73_child.py FILE VARIABLE.

Writes a line of JSON, {"variables": [{"name", "kind", "shape"}, ...]} or {"error": text}, and then
the values of VARIABLE, float64, in C order of MATLAB's shape.
"""

from __future__ import annotations

import json
import resource
import sys
from typing import Any

import numpy as np
import numpy.typing as npt

_NUMERIC = {"double", "single"} | {f"{u}int{bits}" for u in ("", "u") for bits in (8, 16, 32, 64)}
_HIDDEN = "#"  # MATLAB keeps what cells and objects refer to in groups like #refs#
_MAX_NUMBERS = 1 << 25
_MAX_MEMORY_BYTES = 1 << 31
_MAX_CPU_S = 20


def read(file: Any, wanted: str) -> tuple[list[dict[str, Any]], bytes]:
    """Describe all variables of an open file; bytes of `wanted`, if it is a numeric matrix."""
    found, data = [], b""
    for name in _names(file):
        item, values = file[name], None
        kind = _kind(item)
        if name == wanted and kind in _NUMERIC:
            values = _values(item)
            data = values.tobytes()
        found.append(
            {"name": name, "kind": kind, "shape": None if values is None else values.shape}
        )
    return found, data


def _names(file: Any) -> list[str]:
    """All variables; a name that is no UTF-8 comes as bytes."""
    return sorted(str(name) for name in file if not str(name).startswith(_HIDDEN))


def _named_class(item: Any) -> Any:
    """What MATLAB has written as the class of a variable, None: nothing."""
    attribute = item.attrs.get("MATLAB_class")
    return attribute.decode("latin-1") if isinstance(attribute, bytes) else attribute


def _kind(item: Any) -> str:
    """MATLAB class of a variable; for one that MATLAB has not written, the one like it."""
    name = _named_class(item)
    if "MATLAB_sparse" in item.attrs:
        return "sparse"
    if not hasattr(item, "size"):
        return "struct"
    if item.dtype.fields:
        return f"complex {name or 'double'}"
    alike = {"float64": "double", "float32": "single"}
    return str(name or alike.get(item.dtype.name, item.dtype.name))


def _values(item: Any) -> npt.NDArray[np.float64]:
    if item.attrs.get("MATLAB_empty", 0):
        # The dataset of a matrix without elements holds its dimensions instead.
        sizes = [int(size) for size in item[()].ravel()]
        if not 2 <= len(sizes) <= 8 or 0 not in sizes:
            raise ValueError(f"an empty matrix of dimensions {sizes[:8]}")
        return np.zeros(sizes)
    if int(item.size) > _MAX_NUMBERS:
        raise ValueError(f"a matrix of {item.size} numbers, more than {_MAX_NUMBERS}")
    return np.asarray(item[()], dtype=np.float64).T


def main() -> None:
    """Read the file named on the command line."""
    resource.setrlimit(resource.RLIMIT_CPU, (_MAX_CPU_S, _MAX_CPU_S + 1))
    resource.setrlimit(resource.RLIMIT_AS, (_MAX_MEMORY_BYTES, _MAX_MEMORY_BYTES))
    path, wanted = sys.argv[1:]
    answer: dict[str, Any]
    data = b""
    try:
        import h5py

        with h5py.File(path, "r") as file:
            variables, data = read(file, wanted)
        answer = {"variables": variables}
    except ImportError:
        answer = {"error": "HDF5, which needs the Debian package python3-h5py"}
    except Exception as error:
        # A damaged file may make h5py raise anything.
        text = str(error.args[0] if error.args else type(error).__name__)
        answer = {"error": "HDF5: " + text.strip().split("\n")[0]}
    sys.stdout.buffer.write(json.dumps(answer).encode() + b"\n" + data)


if __name__ == "__main__":
    main()
