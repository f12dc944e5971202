# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What each vehicle of a scene did, as numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from trident_eval.core.metrics import lengths
from trident_eval.core.scene import Scene
from trident_eval.core.tracks import Array


@dataclass(frozen=True)
class FlightLog:
    """One vehicle's flight.

    Attributes:
        name: of the vehicle.
        path_m: length of its path.
        highest_m: greatest z_world.
        fastest_m_s: greatest speed between two states.
        tracking_rms_m: distance to its command, over the part that counts; None without command.
        tracking_max_m: the same, its maximum.
    """

    name: str
    path_m: float
    highest_m: float
    fastest_m_s: float
    tracking_rms_m: float | None
    tracking_max_m: float | None


def flights(scene: Scene) -> list[FlightLog]:
    """Every vehicle that has moved through at least two states, in the order of the scene."""
    error = _counted_error(scene)
    found = []
    for index, name in enumerate(scene.tracks.names):
        position = scene.tracks.position[:, index]
        present = np.isfinite(position).all(axis=1)
        if present.sum() < 2:
            continue
        steps = lengths(np.diff(position[present], axis=0))
        speed = steps / np.diff(scene.tracks.time[present])
        own = np.array([]) if error is None else error[:, index]
        own = own[np.isfinite(own)]
        found.append(
            FlightLog(
                name,
                path_m=float(steps.sum()),
                highest_m=float(position[present, 2].max()),
                fastest_m_s=float(speed.max()),
                tracking_rms_m=float(np.sqrt((own**2).mean())) if len(own) else None,
                tracking_max_m=float(own.max()) if len(own) else None,
            )
        )
    return found


def _counted_error(scene: Scene) -> Array | None:
    error = scene.tracking_error()
    if error is None or scene.counted_s is None:
        return error
    begin, end = scene.counted_s
    return error[(scene.tracks.time >= begin) & (scene.tracks.time <= end)]
