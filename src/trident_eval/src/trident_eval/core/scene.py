# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What the pictures of a run show, whatever it was read from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from trident_fleet.core.separation import min_separation, pairs

from trident_eval.core.flight_records import Command
from trident_eval.core.metrics import instant_rms, lengths, rigid_residuals
from trident_eval.core.tracks import Array, Tracks
from trident_eval.core.verdict import FORMATION_RMS_LIMIT_M, SEPARATION_SLACK_M, score


@dataclass(frozen=True)
class Scene:
    """Measured and commanded motion, and the limits that apply.

    Attributes:
        title: of the run.
        tracks: where the vehicles were.
        commanded: p_world at the same instants [m], shape (M, N, 3), NaN where unknown; or None.
        counted_s: part of the flight that counts, from and to [s]; or None.
        formation_limit_m: of the formation RMS; or None.
        separation_limit_m: of the minimum separation; or None.
        file_separation_m: minimum separation of the formation file itself; or None.
    """

    title: str
    tracks: Tracks
    commanded: Array | None = None
    counted_s: tuple[float, float] | None = None
    formation_limit_m: float | None = None
    separation_limit_m: float | None = None
    file_separation_m: float | None = None

    def formation_error(self) -> Array | None:
        """Formation RMS at each instant [m], shape (M,)."""
        if self.commanded is None or self.commanded.shape[1] < 2:
            return None
        return instant_rms(rigid_residuals(self.tracks.position, self.commanded))

    def tracking_error(self) -> Array | None:
        """Distance of each vehicle to its command [m], shape (M, N)."""
        if self.commanded is None:
            return None
        return lengths(self.tracks.position - self.commanded)

    def separation(self) -> Array | None:
        """Smallest distance of any two vehicles at each instant [m], shape (M,)."""
        position = self.tracks.position
        if position.shape[1] < 2:
            return None
        i, j = pairs(position.shape[1])
        distances = lengths(position[:, i] - position[:, j])
        smallest = np.nan_to_num(distances, nan=np.inf).min(axis=1)
        return np.where(np.isfinite(smallest), smallest, np.nan)


def formation_scene(title: str, tracks: Tracks, command: Command) -> Scene:
    """Scene of a formation flight with its records."""
    tracks = tracks.select(command.names)
    result = score(tracks, command)
    separation = min_separation(command.rows)
    is_known = np.isfinite(separation)
    return Scene(
        title=title,
        tracks=tracks,
        commanded=command.position(tracks.time),
        counted_s=None if result.start_s is None else (result.start_s, result.end_s),
        formation_limit_m=FORMATION_RMS_LIMIT_M[command.mode],
        separation_limit_m=separation - SEPARATION_SLACK_M[command.mode] if is_known else None,
        file_separation_m=separation if is_known else None,
    )
