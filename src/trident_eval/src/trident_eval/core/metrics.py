# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How well a formation was kept."""

from __future__ import annotations

import numpy as np

from trident_eval.core.tracks import Array


def rigid_residuals(measured: Array, commanded: Array) -> Array:
    """What is left of the errors of a formation after the best rigid motion, at each instant.

    Rotation and translation (no scale) that bring the commanded points of an instant closest to the
    measured ones are found by Kabsch's method (Acta Cryst. A32, 922, 1976; with Umeyama's sign, so
    that it is never a reflection).

    Args:
        measured: p_world [m], shape (M, N, 3).
        commanded: p_world [m], shape (M, N, 3).

    Returns:
        Measured less aligned commanded positions [m], shape (M, N, 3); NaN for an instant at which
        a vehicle is missing.
    """
    is_whole = np.isfinite(measured).all(axis=(1, 2)) & np.isfinite(commanded).all(axis=(1, 2))
    residuals = np.full(measured.shape, np.nan)
    measured, commanded = measured[is_whole], commanded[is_whole]
    if len(measured):
        to = measured - measured.mean(axis=1, keepdims=True)
        off = commanded - commanded.mean(axis=1, keepdims=True)
        u, _, vt = np.linalg.svd(np.einsum("mni,mnj->mij", to, off))
        sign = np.ones((len(to), 3))
        sign[:, 2] = np.sign(np.linalg.det(u) * np.linalg.det(vt))
        rotation = np.einsum("mij,mj,mjk->mik", u, sign, vt)
        residuals[is_whole] = to - np.einsum("mij,mnj->mni", rotation, off)
    return residuals


def rms(errors: Array) -> float:
    """Root mean square length of error vectors, shape (..., 3) [m]; NaN if any is missing."""
    return float(np.sqrt((errors**2).sum(axis=-1).mean()))


def lengths(errors: Array) -> Array:
    """Length of each error vector, shape (..., 3) -> (...)."""
    return np.asarray(np.sqrt((errors**2).sum(axis=-1)))


def instant_rms(errors: Array) -> Array:
    """Root mean square over the vehicles at each instant, shape (M, N, 3) -> (M,) [m]."""
    return np.asarray(np.sqrt((errors**2).sum(axis=-1).mean(axis=1)))


def closest_approach(points: Array, goals: Array) -> Array:
    """Smallest distance of each vehicle's polyline to its goal.

    Args:
        points: positions at successive instants [m], shape (M, N, 3), M >= 1; NaN for none.
        goals: shape (N, 3) [m].

    Returns:
        Distances [m], shape (N,); infinite for a vehicle without any position.
    """
    relative = points - goals
    start, along = relative[:-1], np.diff(relative, axis=0)
    length2 = (along**2).sum(axis=-1)
    fraction = -(start * along).sum(axis=-1) / np.where(length2 > 0.0, length2, 1.0)
    nearest = start + np.clip(fraction, 0.0, 1.0)[..., None] * along
    distances = np.concatenate([lengths(relative), lengths(nearest)])
    return np.asarray(np.nan_to_num(distances, nan=np.inf, posinf=np.inf).min(axis=0))
