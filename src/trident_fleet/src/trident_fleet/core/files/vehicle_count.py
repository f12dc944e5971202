# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""How many vehicles the rows of a file interleave, if nobody says it.

Rows that interleave N vehicles come back to the same vehicle every N rows. D(N), the largest
distance between rows that lie N apart, is then a vehicle's largest step, and small, while rows
N - 1 and N + 1 apart belong to different vehicles. So N shows as a dip of D. Multiples of N are
dips, too, which is why the smallest counts. A lone vehicle has no row on one side of the dip: D(1)
is a dip if D grows from there, as it does along a smooth path.

How far vehicles stay from each other says nothing here: read with a wrong number, the same rows may
well stay farther apart.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from trident_fleet.core.errors import FormationError

MAX_INFERRED = 100  # vehicles, as many as a fleet may have
_DIP = 0.5
_DEEP_DIP = 0.25  # a grid of vehicles, a row of them after the other, has 0.5
_FEW = 4  # rows
_LONE_GROWTH = 0.7  # D(1) / D(2): 0.5 on a straight line, 1 for rows without order
_LONE_BEND = 0.5  # of two steps, by one; the path around a ring of up to twelve vehicles has more
_BEND = 1.05  # to and fro among vehicles; six rows in a round have 1
_RIVAL = 1.0 / 3.0  # so much deeper a dip of a larger number makes it as likely
_LISTED = 8

Rows = npt.NDArray[np.float64]


def infer_vehicles(rows: Rows, uavs: int, where: str) -> int:
    """The number of vehicles that rows, interleaved vehicle by vehicle, belong to.

    Args:
        rows: positions in any units, shape (T*N, 3), finite, one or more.
        uavs: how many of them fly; decides where the rows leave it open. 0: not known.
        where: what an error begins with.

    Returns:
        N, the smallest number with which every vehicle moves in small steps.

    Raises:
        FormationError: the rows fit several numbers, and `uavs` is not among them; or no number
            fits.
    """
    if len(rows) == 1:
        return 1
    rows = _scaled(rows)
    divisors = _divisors(len(rows))
    continuous = {n: _largest_step(rows, n) for n in divisors if _is_dip(rows, n)}
    if not continuous:
        return _decided_by_uavs(rows, divisors, uavs, where)
    smallest, rivals = _smallest(rows, continuous, uavs)
    doubt = _doubt(rows, smallest, continuous[smallest], rivals)
    if not doubt:
        return smallest
    one_row = set(divisors) & {len(rows)} - set(continuous)
    return _decided([*continuous, *one_row], [], uavs, doubt, where)


def _decided_by_uavs(rows: Rows, divisors: list[int], uavs: int, where: str) -> int:
    """The number where no number of vehicles moves in small steps."""
    _check_whole(rows, where)
    possible = [n for n in divisors if n >= uavs]
    return _decided(divisors, possible, uavs, "the rows move in no small steps", where)


def _scaled(rows: Rows) -> Rows:
    """Differences of huge numbers stay finite then, and ratios are what counts."""
    largest = float(np.abs(rows).max())
    return rows / largest if largest > 0.0 else rows


def _divisors(count: int) -> list[int]:
    """Numbers of vehicles that may share so many rows."""
    return [n for n in range(1, min(count, MAX_INFERRED) + 1) if count % n == 0]


def _doubt(rows: Rows, vehicles: int, step: float, rivals: list[int]) -> str:
    """Why the smallest number may be another one, or ""; `step`: the largest with it."""
    if step == 0.0:
        return "all stand still"
    if rivals:
        return "they come back to where they were"
    if len(rows) <= MAX_INFERRED and not _is_more_than_one_row(rows, vehicles):
        return "vehicles in flight, or one row of vehicles"
    return ""


def _check_whole(rows: Rows, where: str) -> None:
    """Refuse rows of which some are missing: they are continuous, but do not divide."""
    lags = range(2, min(len(rows) // _FEW, MAX_INFERRED) + 1)
    vehicles = next((lag for lag in lags if _dip(rows, lag) <= _DEEP_DIP), 0)
    if vehicles:
        raise FormationError(
            f"{where}: {len(rows)} rows do not divide by {vehicles}, the number of vehicles with"
            f" which they move in small steps; legal: a multiple of {vehicles}"
        )


def _smallest(rows: Rows, steps: dict[int, float], uavs: int) -> tuple[int, list[int]]:
    """The smallest number that is not one vehicle's path, and larger ones that are as likely."""
    for n in steps:
        rivals = [other for other in steps if other > n and steps[other] < _RIVAL * steps[n]]
        if not (rivals and _is_refuted(rows, n, uavs)):
            break
    return n, rivals


def _is_refuted(rows: Rows, n: int, uavs: int) -> bool:
    """Whether small steps of `n` vehicles are likely those from one vehicle to another."""
    if n == 1:
        return uavs > 1 or (uavs == 0 and _bend(rows, 1) > _LONE_BEND)
    return _bend(rows, n) > _BEND


def _largest_step(rows: Rows, lag: int) -> float:
    return float(np.sqrt(((rows[lag:] - rows[:-lag]) ** 2).sum(axis=-1).max()))


def _is_dip(rows: Rows, lag: int) -> bool:
    """Whether rows `lag` apart are much closer than those that lie one more or one less apart."""
    if 2 * lag > len(rows) or lag + 1 >= len(rows):
        return False
    return _dip(rows, lag) <= (_LONE_GROWTH if lag == 1 else _DIP)


def _dip(rows: Rows, lag: int) -> float:
    """D(lag) by the smaller one of its neighbours; 0 where nothing moves."""
    around = [_largest_step(rows, lag + side) for side in (1, -1) if lag + side > 0]
    step = _largest_step(rows, lag)
    return step / min(around) if step > 0.0 and min(around) > 0.0 else float(step > 0.0)


def _is_more_than_one_row(rows: Rows, lag: int) -> bool:
    """Whether a dip is deeper than that of a single row of vehicles which stand in a grid."""
    return len(rows) >= _FEW * lag and lag > 1 and _dip(rows, lag) <= _DEEP_DIP


def _bend(rows: Rows, lag: int) -> float:
    """How sharp the corners are on the paths of `lag` vehicles: 0 none, 2 straight back."""
    if len(rows) <= 2 * lag:
        return 0.0
    change = rows[2 * lag :] - 2.0 * rows[lag:-lag] + rows[: -2 * lag]
    return float(np.sqrt((change**2).sum(axis=-1).max())) / max(_largest_step(rows, lag), 1e-300)


def _decided(
    candidates: Sequence[int], possible: Sequence[int], uavs: int, reason: str, where: str
) -> int:
    """What `uavs` says, else the only one that is possible."""
    if uavs in candidates:
        return uavs
    if len(possible) == 1:
        return possible[0]
    shown = ", ".join(str(n) for n in candidates[:_LISTED])
    more = ", ..." if len(candidates) > _LISTED else ""
    raise FormationError(
        f"{where}: how many vehicles its rows interleave is open ({reason}); give vehicles_in_file,"
        f" one of {shown}{more}"
    )
