# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A formation from a file: which file, how it is laid out, how many fly, scale and offset."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt
from trident_base.params import named

from trident_fleet.core.errors import FormationError
from trident_fleet.core.files.bounded_file import check_kind
from trident_fleet.core.files.mat_file import (
    LayoutRequest,
    deinterleave,
    is_mat_file,
    read_mat_positions,
)
from trident_fleet.core.files.text_file import read_text_rows

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class FormationSource:
    """Where the rows of a formation come from.

    Attributes:
        file: text file or .mat file.
        vehicles_in_file: how many vehicles the rows interleave; 0: what the .mat's shape or the
            rows' continuity says, see `vehicle_count`.
        uavs: how many of them fly, the first ones; 0 means all.
        scale: factor per axis, file units to metres.
        offset: added after scaling, per axis [m, world].
        layout: of a .mat matrix, one of `mat_file.LAYOUTS`; "" infers it.
    """

    file: str = named("", "formation_file")
    vehicles_in_file: int = 0
    uavs: int = 0
    scale: Vector = (1.0, 1.0, 1.0)
    offset: Vector = (0.0, 0.0, 0.0)
    layout: str = ""

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        if not self.file:
            raise FormationError("formation_file: empty; legal: path of a text or .mat file")
        for name in ("vehicles_in_file", "uavs"):
            value = getattr(self, name)
            if value < 0:
                raise FormationError(f"{name}: {value}; legal: 0 or more")
        self._check_scale()
        for axis, shift in zip("xyz", self.offset, strict=True):
            if not math.isfinite(shift):
                raise FormationError(f"offset_{axis}: {shift}; legal: finite")

    def _check_scale(self) -> None:
        for axis, factor in zip("xyz", self.scale, strict=True):
            if not math.isfinite(factor) or factor == 0.0:
                raise FormationError(f"scale_{axis}: {factor}; legal: finite, not 0")


def read_formation(source: FormationSource) -> npt.NDArray[np.float64]:
    """Read a formation file, scaled and shifted.

    Args:
        source: file, layout, scale and offset.

    Returns:
        p_world of each row and vehicle in the file [m], shape (T, N, 3).

    Raises:
        FormationError: anything wrong with the file or with `source`.
    """
    source.validate()
    positions = _read_positions(Path(source.file).expanduser(), source)
    vehicles = positions.shape[1]
    if source.uavs > vehicles:
        raise FormationError(
            f"uavs: {source.uavs}, but {source.file} holds {vehicles}"
            f" vehicle{'s' * (vehicles != 1)}; legal: 1 to {vehicles}{_how_counted(source)}"
        )
    with np.errstate(over="ignore"):
        scaled = positions * np.array(source.scale) + np.array(source.offset)
    if not np.isfinite(scaled).all():
        raise FormationError(
            f"{source.file}: beyond |value| < 1.8e308 after scale {source.scale} and offset"
            f" {source.offset}; legal: smaller values"
        )
    return scaled


def flying_rows(
    positions: npt.NDArray[np.float64], uavs: int, first_row: int = 0
) -> npt.NDArray[np.float64]:
    """The part of a formation that is flown: the first `uavs` vehicles (0: all), from a row on.

    Raises:
        FormationError: there is no such row.
    """
    steps, vehicles, _ = positions.shape
    if not 0 <= first_row < steps:
        raise FormationError(
            f"seq: begins at row {first_row + 1} of {steps}; legal: 0 to {steps * vehicles - 1}"
        )
    return positions[first_row:, : uavs or vehicles]


def _how_counted(source: FormationSource) -> str:
    return "" if source.vehicles_in_file else ", or another vehicles_in_file than the file suggests"


def _read_positions(path: Path, source: FormationSource) -> npt.NDArray[np.float64]:
    try:
        check_kind(path)
        with path.open("rb") as stream:
            head = stream.read(4096)
        if is_mat_file(path, head):
            request = LayoutRequest(source.layout, source.vehicles_in_file, source.uavs)
            return read_mat_positions(path, request)
        if source.layout:
            raise FormationError(
                f"layout: '{source.layout}' for the text file {path}; legal: empty, text rows are"
                " interleaved vehicle by vehicle"
            )
        rows = read_text_rows(path)
        return deinterleave(rows, source.vehicles_in_file, source.uavs, str(path))
    except OSError as error:
        reason = error.strerror or str(error)
        raise FormationError(
            f"{path}: {reason}; legal: a readable text or .mat formation file"
        ) from error
