# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of positions that were sent as NMEA 0183, next to where the antenna was."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from trident_eval.core.bridges.nmea import POSITION_LIMIT_M, NmeaLog
from trident_eval.core.plots import color, saved_figures

# GGA's qualities that are drawn, and how they are called.
_QUALITIES = {1: "single", 5: "RTK float", 4: "RTK fixed"}


def draw_nmea(logs: list[NmeaLog], folder: Path) -> list[Path]:
    """Draw nmea_<vehicle>.png of each stream that has positions with a known truth.

    Args:
        logs: of a run.
        folder: where the files go; must exist.

    Returns:
        The files.
    """
    drawings = {f"nmea_{log.vehicle}.png": partial(_draw, log) for log in logs}
    return saved_figures(drawings, folder)


def _draw(log: NmeaLog) -> Any:
    import matplotlib.pyplot as plt

    known = np.isfinite(log.truth).all(axis=1)
    if not known.any():
        return None
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 4.8), layout="constrained")
    left.plot(*log.truth[known, :2].T, color="#555555", label="antenna")
    for index, (quality, name) in enumerate(_QUALITIES.items()):
        of_kind = known & (log.quality == quality)
        if not of_kind.any():
            continue
        left.plot(*log.p_enu[of_kind, :2].T, ".", ms=4, color=color(index), label=name)
        right.semilogy(
            log.time[of_kind],
            np.maximum(log.error_m[of_kind], 1e-4),
            ".",
            ms=4,
            color=color(index),
            label=name,
        )
    right.axhline(POSITION_LIMIT_M, color="#B00020", ls="--", lw=1.0, label="limit of RTK fixed")
    left.set(xlabel="east [m]", ylabel="north [m]", title="positions of GGA")
    left.set_aspect("equal", adjustable="datalim")
    right.set(xlabel="simulated time [s]", ylabel="distance from the antenna [m]")
    right.set_title("how far they were from the truth")
    left.legend()
    right.legend()
    figure.suptitle(f"{log.vehicle}: {sum(log.sentences.values())} sentences of NMEA 0183")
    return figure
