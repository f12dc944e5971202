# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What was measured of a radio link, and what that says of places where nothing was measured.

A Gaussian process (Rasmussen and Williams 2006, chapter 2.7 for its linear part): the SNR of free
space with a level and an exponent that are fitted, and shadowing with Gudmundson's correlation over
the places of both ends, so that what was measured counts less once the other robot has moved on.
Where an obstacle blocks the view, the SNR measured there drops, and so does the SNR expected about.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from trident_fleet.core.quintic import Array
from trident_fleet.core.station.config import FieldConfig

Array32 = npt.NDArray[np.float32]

# From here on the exponent has an effect [m].
_REFERENCE_M = 50.0
_NEAREST_M = 1.0
_LEAST_VARIANCE_DB2 = 1e-4


@dataclass(frozen=True)
class Measurement:
    """The SNR of a link at an instant.

    Attributes:
        time_s: when [s].
        position: of the UAV, p_world [m], shape (3,).
        other: where the other robot was, p_world [m], shape (3,).
        snr_db: of the link [dB].
    """

    time_s: float
    position: Array
    other: Array
    snr_db: float


class LinkField:
    """Mean and variance of a link's SNR at M places, for one place of the other robot.

    Each measurement costs O(N M) when it is added, by a row of the Cholesky factor; asking is free.
    No BLAS: its threads would spin next to the simulator, and round by their number.

    Attributes:
        places: p_world [m], shape (M, 3).
        other: where the other robot is, p_world [m], shape (3,).
        mean_db: expected SNR, shape (M,).
        variance_db2: its variance, without that of measuring, shape (M,).
        count: of the measurements.
    """

    def __init__(self, places: Array, other: Array, config: FieldConfig, capacity: int) -> None:
        """Nothing is measured yet.

        Args:
            places: p_world [m], shape (M, 3).
            other: p_world of the other robot [m], shape (3,).
            config: what is believed before.
            capacity: of measurements.
        """
        self.places, self.other, self.count = places, other, 0
        self._config, self._capacity = config, capacity
        self._features = _log_distance(places, other)
        self._place_ends = _ends(places, other)
        self.mean_db = self._prior_db(places, other)
        self.variance_db2 = self._prior_variance(self._features)
        self._seen_ends = np.zeros((capacity, 9), np.float32)
        self._measured_features = np.zeros(capacity)
        self._inverse = np.zeros((capacity, capacity))  # of the Cholesky factor, lower
        self._rows = np.zeros((capacity, len(places)), np.float32)
        self._white = np.zeros(capacity)

    @property
    def is_full(self) -> bool:
        """Whether no measurement can be added any more."""
        return self.count == self._capacity

    def _prior_db(self, places: Array, other: Array) -> Array:
        distance = np.linalg.norm(places - other, axis=-1)
        return np.asarray(self._config.level_db - 20.0 * np.log10(np.maximum(distance, _NEAREST_M)))

    def _prior_variance(self, features: Array) -> Array:
        config = self._config
        linear = config.level_sigma_db**2 + (config.exponent_sigma * features) ** 2
        return np.asarray(linear + config.shadow_sigma_db**2 + config.blocked_sigma_db**2)

    def add(self, measurement: Measurement) -> None:
        """Take one more; precondition: not `is_full`."""
        n, config = self.count, self._config
        feature = float(_log_distance(measurement.position, measurement.other))
        ends = _ends(measurement.position[None], measurement.other)[0]
        own = self._covariance(feature, self._measured_features[:n], ends, self._seen_ends[:n])
        cross = self._covariance(feature, self._features, ends, self._place_ends)
        inverse = self._inverse[:n, :n]
        left = np.einsum("ij,j->i", inverse, own)
        whole = float(self._prior_variance(np.array(feature))) + config.noise_db**2
        pivot = float(np.sqrt(max(whole - float(left @ left), _LEAST_VARIANCE_DB2)))
        known = np.einsum("i,ij->j", left.astype(np.float32), self._rows[:n])
        row = (cross - known) / pivot
        prior_db = float(self._prior_db(measurement.position, measurement.other))
        white = (measurement.snr_db - prior_db - float(left @ self._white[:n])) / pivot
        self._inverse[n, :n] = -np.einsum("i,ij->j", left, inverse) / pivot
        self._inverse[n, n] = 1.0 / pivot
        self._rows[n], self._white[n] = row, white
        self._seen_ends[n], self._measured_features[n] = ends, feature
        self.count = n + 1
        self.mean_db = self.mean_db + row * white
        self.variance_db2 = np.maximum(self.variance_db2 - row * row, _LEAST_VARIANCE_DB2)

    def _covariance(self, feature: float, features: Array, ends: Array32, others: Array32) -> Array:
        """Of the SNR between a pair of ends and N pairs, whose `_ends` have the shape (N, 9)."""
        config = self._config
        square = (others - ends) ** 2
        here, there, turned = (np.sqrt(square[:, i : i + 3].sum(axis=1)) for i in (0, 3, 6))
        linear = config.level_sigma_db**2 + config.exponent_sigma**2 * feature * features
        shadow = config.shadow_sigma_db**2 * np.exp(-(here + there) / config.decorrelation_m)
        view = turned / config.view_rad + there / config.decorrelation_m
        return np.asarray(linear + shadow + config.blocked_sigma_db**2 * np.exp(-view))


def _ends(places: Array, other: Array) -> Array32:
    """Both ends of links, and the direction from the other one, shape (N, 9)."""
    away = places - other
    direction = away / np.maximum(np.linalg.norm(away, axis=1, keepdims=True), 1e-9)
    ends = [places, np.broadcast_to(other, places.shape), direction]
    return np.concatenate(ends, axis=1).astype(np.float32)


def _log_distance(places: Array, other: Array) -> Array:
    """10 log10 of the distance by the reference [dB]."""
    distance = np.maximum(np.linalg.norm(places - other, axis=-1), _NEAREST_M)
    return np.asarray(10.0 * np.log10(distance / _REFERENCE_M))


def field_of(
    measurements: list[Measurement], places: Array, other: Array, config: FieldConfig, spare: int
) -> LinkField:
    """A field with measurements in it, and room for more.

    Args:
        measurements: oldest first.
        places: p_world [m], shape (M, 3).
        other: where the other robot is now, p_world [m], shape (3,).
        config: what is believed before.
        spare: how many more can be added.
    """
    field = LinkField(places, other, config, len(measurements) + spare)
    for measurement in measurements:
        field.add(measurement)
    return field
