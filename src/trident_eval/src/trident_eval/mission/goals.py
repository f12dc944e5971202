# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a joint mission has to reach."""

from __future__ import annotations

from trident_fleet.core.missions.setup import Outcome, Setup

GOALS = {"coverage": 0.97, "found": 0.97, "served": 0.95}
"""Least shares of cells covered, of people found and of people served."""
AFTER_A_LOSS = {"coverage": 0.85}
"""The same where a robot died."""


def goals_of(setup: Setup, whole: bool) -> dict[str, float]:
    """Least shares that a mission has to reach; none for who is alone, or has not all the time.

    Args:
        setup: of the mission.
        whole: whether it has all the time that its file gives it.
    """
    if setup.mode != "joint" or not whole:
        return {}
    return AFTER_A_LOSS if setup.deaths or setup.silences else GOALS


def shares_of(outcome: Outcome) -> dict[str, float]:
    """What goals are held against, 0 ... 1."""
    people = max(outcome.people, 1)
    return {
        "coverage": outcome.coverage,
        "found": outcome.found / people,
        "served": outcome.served / people,
    }


def missed_goals(outcome: Outcome, goals: dict[str, float] | None = None) -> list[str]:
    """What a mission has not reached, with the limit.

    Args:
        outcome: of the mission.
        goals: least shares; None: those of a joint mission.
    """
    shares = shares_of(outcome)
    missed = [
        f"{name} is {100 * shares[name]:.1f} %, the limit {100 * least:g} %"
        for name, least in (GOALS if goals is None else goals).items()
        if shares[name] < least
    ]
    if outcome.contacts:
        missed.append(f"{outcome.contacts} contacts, the limit is 0")
    return missed
