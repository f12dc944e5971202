# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Axes of a sweep: which values the parameters take.

Axes of listed points are combined each with each. Sampled axes (Latin hypercube, Sobol) are drawn
together, one point of each sample, and the samples are one more axis.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import qmc
from trident_fleet.core.files.strict_yaml import Section

LARGEST_COUNT = 1_000_000  # points of an axis, and of all together
_SAMPLERS = ("latin_hypercube", "sobol")

Point = Mapping[str, Any]


@dataclass(frozen=True)
class Axis:
    """One axis.

    Attributes:
        names: of the parameters that it sets.
        points: values of these parameters, in their order.
    """

    names: tuple[str, ...]
    points: tuple[tuple[Any, ...], ...]


def names_of(axes: Iterable[Axis]) -> list[str]:
    """Of all parameters that axes set."""
    return [name for axis in axes for name in axis.names]


@dataclass(frozen=True)
class _Sampled:
    name: str
    sampler: str
    low: float
    high: float


def read_axes(section: Section | None, samples: int, sampling_seed: int) -> tuple[Axis, ...]:
    """The axes of a scenario file.

    Args:
        section: `axes`; None where it is missing.
        samples: how many points sampled axes get.
        sampling_seed: of the sampled axes.

    Raises:
        FormationError: an axis without values, of an unknown kind, or with a bad number.
    """
    if section is None:
        return ()
    listed: list[Axis] = []
    sampled: list[_Sampled] = []
    for name in section.names():
        entry = section.section(name)
        kind = _kind_of(section, entry, name)
        if kind in _SAMPLERS:
            sampled.append(_read_sampled(entry, name, kind))
        else:
            listed.append(_LISTED[kind](entry, name))
        entry.finish()
    return (*listed, *_sample(section, sampled, samples, sampling_seed))


def _kind_of(section: Section, entry: Section, name: str) -> str:
    """How an axis gives its values."""
    kinds = [kind for kind in (*_LISTED, *_SAMPLERS) if kind in entry]
    if len(kinds) != 1:
        legal = ", ".join((*_LISTED, *_SAMPLERS))
        raise section.error(name, f"{len(kinds)} kinds of values; legal: one of {legal}")
    return kinds[0]


def points_of(axes: Sequence[Axis]) -> list[Point]:
    """Each point of one axis with each point of the others, the last axis fastest."""
    names = names_of(axes)
    combined = itertools.product(*(axis.points for axis in axes))
    return [dict(zip(names, itertools.chain(*parts), strict=True)) for parts in combined]


def _read_list(entry: Section, name: str) -> Axis:
    values = entry.items("list")
    if not values:
        raise entry.error("list", "empty; legal: one value or more")
    return Axis((name,), tuple((value,) for value in values))


def _read_grid(entry: Section, name: str) -> Axis:
    """Parameters of their own, each value of one with each of the others."""
    grid = entry.section("grid")
    parts = {part: grid.items(part) for part in grid.names()}
    for part, values in parts.items():
        if not values:
            raise grid.error(part, "empty; legal: one value or more")
    if not parts:
        raise entry.error("grid", "empty; legal: parameters, each with its list of values")
    return Axis(tuple(parts), tuple(itertools.product(*parts.values())))


def _read_range(entry: Section, name: str) -> Axis:
    low, high, count = _three(entry, "range")
    return _axis(name, np.linspace(low, high, count))


def _read_log_range(entry: Section, name: str) -> Axis:
    low, high, count = _three(entry, "log_range")
    if low <= 0 or high <= 0:
        raise entry.error("log_range", f"[{low:g}, {high:g}]; legal: numbers above 0")
    return _axis(name, np.exp(np.linspace(math.log(low), math.log(high), count)))


_LISTED: dict[str, Callable[[Section, str], Axis]] = {
    "list": _read_list,
    "grid": _read_grid,
    "range": _read_range,
    "log_range": _read_log_range,
}


def _axis(name: str, values: Any) -> Axis:
    return Axis((name,), tuple((float(f"{value:.12g}"),) for value in values))


def _three(entry: Section, kind: str) -> tuple[float, float, int]:
    low, high, count = entry.vector(kind, (0.0, 0.0, 0.0))
    if count != int(count) or not 1 <= count <= LARGEST_COUNT:
        legal = f"[first, last, count], count a whole number from 1 to {LARGEST_COUNT}"
        raise entry.error(kind, f"count {count:g}; legal: {legal}")
    return low, high, int(count)


def _read_sampled(entry: Section, name: str, kind: str) -> _Sampled:
    values = entry.items(kind)
    is_pair = len(values) == 2 and all(type(value) in (int, float) for value in values)
    if not is_pair or not all(map(math.isfinite, values)) or not values[0] < values[1]:
        raise entry.error(kind, f"{values}; legal: [lowest, highest], lowest < highest")
    return _Sampled(name, kind, float(values[0]), float(values[1]))


def _sample(
    section: Section, sampled: Sequence[_Sampled], samples: int, sampling_seed: int
) -> list[Axis]:
    """One axis of all sampled parameters; no axis without them."""
    if not sampled:
        return []
    sampler = _sampler_of(section, sampled)
    if not 1 <= samples <= LARGEST_COUNT:
        raise section.error(
            sampled[0].name, f"{samples} samples; legal: `samples:` from 1 to {LARGEST_COUNT}"
        )
    unit = _draw(sampler, len(sampled), samples, sampling_seed)
    low, high = np.array([(one.low, one.high) for one in sampled]).T
    points = low + unit * (high - low)
    rows = tuple(tuple(float(f"{value:.12g}") for value in row) for row in points)
    return [Axis(tuple(one.name for one in sampled), rows)]


def _sampler_of(section: Section, sampled: Sequence[_Sampled]) -> str:
    """That of all sampled parameters."""
    kinds = {one.sampler for one in sampled}
    if len(kinds) > 1:
        named = ", ".join(sorted(kinds))
        raise section.error(sampled[-1].name, f"sampled by {named}; legal: one sampler for all")
    return kinds.pop()


def _draw(kind: str, dimensions: int, samples: int, seed: int) -> Any:
    """Points of the unit cube, shape (samples, dimensions).

    Latin hypercube: McKay, Beckman, Conover (1979); Sobol: scrambled (Owen 1998).
    """
    if kind == "latin_hypercube":
        return qmc.LatinHypercube(dimensions, seed=seed).random(samples)
    engine = qmc.Sobol(dimensions, scramble=True, seed=seed)
    # Whole powers of two keep the balance of the sequence; what is more than asked for is left.
    return engine.random_base2(max(0, math.ceil(math.log2(samples))))[:samples]
