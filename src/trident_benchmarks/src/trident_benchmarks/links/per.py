# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Loss of frames over the ratio of signal to noise, counted, next to ns-3's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from trident_benchmarks.links.ns3 import Curve, Ns3
from trident_benchmarks.links.radios import radio_world, saturating

PER_LIMIT_DB = 0.7
WIDTHS = (20, 40, 80)
_FRAME_BYTES = 38  # of a frame besides its message
_HALF_DB, _STEP_DB = 1.4, 0.2  # of the ratios about ns-3's at a loss of 10 %
_STEP_S = 0.1


def ratio_at_tenth(curve: Curve) -> float:
    """The ratio at which a tenth of the frames is lost [dB]: a line through the points about it.

    Args:
        curve: rows of a ratio [dB] and a loss.
    """
    inside = curve[(curve[:, 1] > 0.02) & (curve[:, 1] < 0.5)]
    # Over the ratio this is about a straight line.
    strength = np.log(-np.log1p(-inside[:, 1]))
    slope, level = np.polyfit(inside[:, 0], strength, 1)
    return float((np.log(-np.log1p(-0.1)) - level) / slope)


def counted_losses(mcs: int, width: int, size: int, about_db: float, frames: int) -> Curve:
    """Send frames over a link of each ratio, once each, and count what is lost.

    Args:
        mcs: of the frames.
        width: of the channel [MHz].
        size: of a frame, headers included [bytes].
        about_db: the middle of the ratios.
        frames: at each of them.
    """
    elements = saturating(mcs, width, 0) | {"tries": 1, "queue_bytes": 2 * size * frames}
    world = radio_world({"sink": (0.0, 0.0), "source": (10.0, 0.0)}, elements)

    def newest() -> Any:
        return next(iter(world.radio.links("source")))

    at_10_m = newest().snr
    rows: list[tuple[float, float]] = []
    lost = 0
    for ratio_db in np.arange(about_db - _HALF_DB, about_db + _HALF_DB + 1e-9, _STEP_DB):
        distance = 10.0 * 10.0 ** ((at_10_m - float(ratio_db)) / 20.0)
        world.models["source"].set_pose((distance, 0.0, 1.0))
        for _ in range(frames):
            if not world.radio.send("source", "sink", bytes(size - _FRAME_BYTES)):
                raise RuntimeError("the queue of the source is full")
        link = newest()
        while link.delivered + link.lost < link.sent:
            world.step_until(world.time + _STEP_S)
            link = newest()
        rows.append((link.snr, (link.lost - lost) / frames))
        lost = link.lost
        world.radio.receive("sink")
    return np.array(rows)


def per_rows(peer: Ns3, is_quick: bool) -> Iterator[dict[str, Any]]:
    """Each mode, width and length."""
    for width in WIDTHS:
        for (mcs, size), curve in peer.losses(width).items():
            theirs_db = ratio_at_tenth(curve)
            ours = counted_losses(mcs, width, size, theirs_db, 200 if is_quick else 1000)
            ours_db = ratio_at_tenth(ours)
            near = curve[np.abs(curve[:, 0] - theirs_db) < 2.0 * _HALF_DB]
            yield {
                "suite": "per",
                "mcs": mcs,
                "width": width,
                "bytes": size,
                "ns3_db": theirs_db,
                "snr_db": ours_db,
                "error_db": ours_db - theirs_db,
                "ns3_curve": near.tolist(),
                "curve": ours.tolist(),
                "limit": PER_LIMIT_DB,
                "passed": abs(ours_db - theirs_db) <= PER_LIMIT_DB,
            }


def per_line(row: dict[str, Any]) -> str:
    """A row as one line, without its verdict."""
    return (
        f"MCS {row['mcs']}, {row['width']} MHz, {row['bytes']} B: a tenth is lost at"
        f" {row['snr_db']:.2f} dB, ns-3 {row['ns3_db']:.2f} ({row['error_db']:+.2f} dB)"
    )
