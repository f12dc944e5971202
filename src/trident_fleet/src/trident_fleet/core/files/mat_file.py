# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Positions from MATLAB .mat files (v5 to v7.3): one numeric variable, `vehicle_pos`."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files import mat5, mat73
from trident_fleet.core.files.bounded_file import read_bounded
from trident_fleet.core.files.mat5 import MatError, Variable
from trident_fleet.core.files.vehicle_count import infer_vehicles

VARIABLE = "vehicle_pos"
LAYOUTS_2D = ("TNx3", "3xTN")
LAYOUTS_3D = ("3xNxT", "3xTxN", "Nx3xT", "Tx3xN", "NxTx3", "TxNx3")
LAYOUTS = LAYOUTS_2D + LAYOUTS_3D

_HDF5_HEADS = (mat73.MAGIC, mat73.HDF5_MAGIC)


@dataclass(frozen=True)
class LayoutRequest:
    """What the caller knows about the matrix.

    Attributes:
        layout: one of `LAYOUTS`, or "" to infer it from the shape. T steps, N vehicles, 3 axes; TN
            means interleaved vehicle by vehicle.
        vehicles_in_file: N, or 0 to take it from the shape or from the rows' continuity.
        uavs: how many fly; decides about N where rows leave it open. 0: not known.
    """

    layout: str = ""
    vehicles_in_file: int = 0
    uavs: int = 0


def is_mat_file(path: Path, head: bytes) -> bool:
    """Whether `head`, the file's first bytes, or the suffix of a binary file say .mat."""
    if head.startswith((mat5.MAGIC, *_HDF5_HEADS)):
        return True
    return path.suffix.lower() == ".mat" and b"\0" in head


def read_mat_positions(path: Path, request: LayoutRequest) -> npt.NDArray[np.float64]:
    """Read `vehicle_pos` of a .mat file.

    Args:
        path: the file.
        request: layout and number of vehicles, as far as known.

    Returns:
        Positions in the file's own units, shape (T, N, 3).

    Raises:
        FormationError: not a readable .mat file, no such variable, not real finite numbers, or a
            shape that fits no layout or several.
    """
    return arrange(_load_variable(path), request, f"{path}: variable {VARIABLE}")


def arrange(
    matrix: npt.NDArray[np.float64], request: LayoutRequest, where: str
) -> npt.NDArray[np.float64]:
    """Bring a matrix of any orientation to shape (T, N, 3). Errors begin with `where`."""
    _check_finite(matrix, where)
    if request.layout and request.layout not in LAYOUTS:
        raise FormationError(f"layout: '{request.layout}'; legal: {', '.join(LAYOUTS)}")
    layout = request.layout or _infer_layout(matrix.shape, request.vehicles_in_file, where)
    positions = _apply_layout(matrix, layout, request, where)
    if positions.size == 0:
        raise FormationError(f"{where}: empty ({_shape_text(matrix.shape)}); legal: T, N >= 1")
    return positions


def _apply_layout(
    matrix: npt.NDArray[np.float64], layout: str, request: LayoutRequest, where: str
) -> npt.NDArray[np.float64]:
    axes = layout.split("x")
    if len(axes) != matrix.ndim or matrix.shape[axes.index("3")] != 3:
        raise FormationError(
            f"{where}: {_shape_text(matrix.shape)} does not fit layout {layout};"
            f" legal: {len(axes)} dimensions, 3 at number {axes.index('3') + 1}"
        )
    if matrix.ndim == 2:
        rows = matrix if layout == "TNx3" else matrix.T
        return deinterleave(rows, request.vehicles_in_file, request.uavs, where)
    positions = np.transpose(matrix, [axes.index(axis) for axis in ("T", "N", "3")])
    _check_count(positions, matrix, layout, request.vehicles_in_file, where)
    return np.ascontiguousarray(positions)


def _check_count(
    positions: npt.NDArray[np.float64],
    matrix: npt.NDArray[np.float64],
    layout: str,
    vehicles: int,
    where: str,
) -> None:
    if vehicles and positions.shape[1] != vehicles:
        raise FormationError(
            f"{where}: {_shape_text(matrix.shape)} read as {layout} holds {positions.shape[1]}"
            f" vehicles, but vehicles_in_file is {vehicles}; legal: equal, or 0 to take the file's"
        )


def deinterleave(
    rows: npt.NDArray[np.float64], vehicles: int, uavs: int, where: str
) -> npt.NDArray[np.float64]:
    """Split rows (T*N, 3), interleaved vehicle by vehicle, into shape (T, N, 3).

    Args:
        rows: the rows.
        vehicles: N; 0: what their continuity says, see `vehicle_count`.
        uavs: how many fly; 0: not known.
        where: what an error begins with.

    Raises:
        FormationError: the rows do not divide by N, or fit several N.
    """
    if len(rows) == 0:
        return np.empty((0, max(vehicles, 1), 3))
    vehicles = vehicles or infer_vehicles(rows, uavs, where)
    if len(rows) % vehicles:
        raise FormationError(
            f"{where}: {len(rows)} rows do not divide by vehicles_in_file {vehicles};"
            f" legal: a multiple of {vehicles}"
        )
    return np.ascontiguousarray(rows.reshape(-1, vehicles, 3))


def _infer_layout(shape: tuple[int, ...], vehicles: int, where: str) -> str:
    fitting = _fitting_layouts(shape, vehicles)
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        raise FormationError(
            f"{where}: {_shape_text(shape)} is ambiguous; give `layout`, one of"
            f" {', '.join(fitting)} (T steps, N vehicles, 3 axes)"
        )
    wanted = f" with N = vehicles_in_file = {vehicles}" if vehicles and len(shape) == 3 else ""
    raise FormationError(
        f"{where}: {_shape_text(shape)} fits no layout{wanted}; legal: {', '.join(LAYOUTS)}"
        f"{_reshape_hint(shape)}"
    )


def _reshape_hint(shape: tuple[int, ...]) -> str:
    """How a matrix with a row for each moment becomes legal; "" for any other one."""
    if len(shape) != 2 or shape[1] % 3 != 0:
        return ""
    return f"; has it a row for each moment? reshape(M', 3, []) is 3x{shape[0] * shape[-1] // 3}"


def _fitting_layouts(shape: tuple[int, ...], vehicles: int) -> list[str]:
    if len(shape) == 2:
        return [name for name in LAYOUTS_2D if shape[name.split("x").index("3")] == 3]
    if len(shape) == 3:
        return [name for name in LAYOUTS_3D if _fits(name, shape, vehicles)]
    return []


def _fits(layout: str, shape: tuple[int, ...], vehicles: int) -> bool:
    size = dict(zip(layout.split("x"), shape, strict=True))
    # Without a given N a formation has more steps than vehicles.
    right_count = size["N"] == vehicles if vehicles else size["N"] <= size["T"]
    return size["3"] == 3 and right_count


def _load_variable(path: Path) -> npt.NDArray[np.float64]:
    try:
        variables = {variable.name: variable for variable in _read_variables(path)}
    except MatError as error:
        raise FormationError(
            f"{path}: not a readable .mat file ({error}); legal: MATLAB v5, v6, v7 or v7.3"
        ) from error
    if VARIABLE not in variables:
        found = ", ".join(sorted(variables)) or "none"
        raise FormationError(
            f"{path}: no variable {VARIABLE}; the file holds: {found}; legal: a numeric matrix"
            f" {VARIABLE}"
        )
    variable = variables[VARIABLE]
    if variable.values is None:
        raise FormationError(
            f"{path}: variable {VARIABLE}: of type {variable.kind}; legal: a full matrix of real"
            " numbers"
        )
    return variable.values


def _read_variables(path: Path) -> list[Variable]:
    with path.open("rb") as stream:
        is_hdf5 = stream.read(len(mat73.MAGIC)).startswith(_HDF5_HEADS)
    return (
        mat73.read_variables(path, VARIABLE) if is_hdf5 else mat5.read_variables(read_bounded(path))
    )


def _check_finite(matrix: npt.NDArray[np.float64], where: str) -> None:
    bad = np.argwhere(~np.isfinite(matrix))
    if len(bad):
        # MATLAB counts from one.
        place = ", ".join(str(index + 1) for index in bad[0])
        value = matrix[tuple(bad[0])]
        raise FormationError(f"{where}({place}): {value} is not finite; legal: finite numbers")


def _shape_text(shape: tuple[int, ...]) -> str:
    return "x".join(str(size) for size in shape)
