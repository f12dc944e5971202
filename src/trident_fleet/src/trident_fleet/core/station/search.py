# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A set of places, what the links are expected to be there, and which of them is next."""

from __future__ import annotations

import numpy as np

from trident_fleet.core.quintic import Array
from trident_fleet.core.station.config import StationConfig
from trident_fleet.core.station.link_field import LinkField, field_of
from trident_fleet.core.station.placement import expected_gain, worst_of
from trident_fleet.core.station.visits import Place, Visits

_REMEMBERED = 400  # measurements that a new search begins with
_ROOM = 2000
_LEAST_NEEDED = 0.05  # share of the places that may be left when others are put aside


class Search:
    """Fields of all links whose other end is known, over the same places.

    Attributes:
        others: where the robots were as it began.
    """

    def __init__(
        self,
        places: Array,
        others: dict[str, Place],
        visits: Visits,
        config: StationConfig,
        remembered: int = _REMEMBERED,
    ) -> None:
        """Begin with what is known.

        Args:
            places: among which to choose [m, world], shape (M, 3).
            others: of the links, where they are.
            visits: what was heard so far.
            config: of the station.
            remembered: measurements that count from before.
        """
        self._places, self._config = places, config
        self.others = others
        self._chosen = np.zeros(len(places), dtype=bool)
        self._goal = 0
        self._fields: dict[str, LinkField] = {
            name: field_of(
                visits.measurements(name, remembered), places, place.position, config.links, _ROOM
            )
            for name, place in others.items()
        }

    def is_about(self, known: dict[str, Place]) -> bool:
        """Whether these are the robots of the search, and none has moved far since."""
        moved = [
            float(np.linalg.norm(known[name].position - place.position))
            for name, place in self.others.items()
            if name in known
        ]
        has_moved = max(moved, default=0.0) > self._config.search.moved_m
        return not has_moved and set(known) == set(self.others)

    def add(self, visits: Visits) -> None:
        """Take the newest measurement of each link."""
        for name, field in self._fields.items():
            newest = visits.newest(name)
            if newest is not None and not field.is_full:
                field.add(newest)

    def choose(self, position: Array, best_db: float) -> tuple[Array, float]:
        """The place with the most expected gain by time; none is chosen twice.

        Args:
            position: of the UAV [m, world].
            best_db: worst link of the best place that is known [dB].

        Returns:
            The place, p_world [m], shape (3,), and the most gain that is expected anywhere [dB].
        """
        mean, variance = worst_of(list(self._fields.values()))
        legal = mean >= self._config.search.needed_db
        if legal.mean() < _LEAST_NEEDED:
            legal = np.ones_like(legal)
        gain = np.where(legal & ~self._chosen, expected_gain(mean, variance, best_db), 0.0)
        away = np.linalg.norm(self._places - position, axis=1)
        cost_s = away / self._config.pilot.v_max + self._config.search.detour_s
        self._goal = int(np.argmax(gain / cost_s))
        self._chosen[self._goal] = True
        return self._places[self._goal], float(gain.max())

    @property
    def has_gone_wrong(self) -> bool:
        """Whether the place that was chosen last is expected to be too bad, unlike others."""
        mean, _ = worst_of(list(self._fields.values()))
        legal = mean >= self._config.search.needed_db
        return not legal[self._goal] and legal.mean() >= _LEAST_NEEDED

    def best_expected(self, position: Array, loss_db_m: float) -> Array:
        """The place whose worst link is expected to be best.

        Args:
            position: of the UAV [m, world].
            loss_db_m: by which a place counts less for each meter that it is away [dB/m].
        """
        mean, _ = worst_of(list(self._fields.values()))
        away = np.linalg.norm(self._places - position, axis=1)
        return np.asarray(self._places[int(np.argmax(mean - loss_db_m * away))])
