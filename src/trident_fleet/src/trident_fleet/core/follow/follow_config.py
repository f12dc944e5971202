# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Places of followers: where they are configured to be, and how they move with their leader."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from trident_base.params import named

from trident_fleet.core.config import PlanConfig
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.leader import LeaderState
from trident_fleet.core.follow.reference import Drift, ReferenceConfig
from trident_fleet.core.quintic import Array, Motion
from trident_fleet.core.schedule import FeedConfig
from trident_fleet.core.transition import check_apart

FRAMES = ("heading", "world")


@dataclass(frozen=True)
class FollowConfig:
    """Where followers belong, and how they get there.

    Attributes:
        offsets: of each follower from the leader [m], shape (N, 3), in `frame`.
        frame: `heading`: x ahead of the leader, y to its left, turning with it; `world`.
        assign: whether followers take the places that minimize the distance, not those in order.
        lowest_m: height of the lowest place, however low the leader is [m, world].
        min_separation_m: of any two, the leader included, at the places and while flying there [m].
        end_when_still_s: the flight ends when the leader has not moved for so long [s]; 0: never.
        give_up_s: hover without a free path to the places after which a flight that ends at all
            ends [s].
        plan: take-off and limits of the flight to the places.
        reference: how the leader is kept up with.
        feed: period and spacing of set-points.
    """

    offsets: Array
    frame: str = "heading"
    assign: bool = True
    lowest_m: float = named(0.8, "lowest")
    min_separation_m: float = named(1.0, "min_separation")
    end_when_still_s: float = named(0.0, "end_when_still")
    give_up_s: float = named(60.0, "give_up")
    plan: PlanConfig = field(default_factory=PlanConfig)
    reference: ReferenceConfig = field(default_factory=ReferenceConfig)
    feed: FeedConfig = field(default_factory=FeedConfig)

    def validate(self) -> None:
        """Raise FormationError on the first field with an illegal value."""
        if self.frame not in FRAMES:
            raise FormationError(f"frame: '{self.frame}'; legal: {', '.join(FRAMES)}")
        if not np.isfinite(self.offsets).all():
            raise FormationError(f"offsets: {self.offsets.tolist()}; legal: finite numbers")
        for name in ("lowest_m", "min_separation_m", "end_when_still_s", "give_up_s"):
            value = getattr(self, name)
            if not math.isfinite(value) or value < 0.0:
                raise FormationError(f"{name}: {value}; legal: finite, 0 or more")
        self.plan.validate()
        self.reference.validate()
        self.feed.validate()
        around = np.concatenate([np.zeros((1, 3)), self.offsets])
        check_apart(around, self.min_separation_m, "offsets: counted from the leader, places")


def attached(offsets: Array, frame: str, drift: Drift) -> Motion:
    """Motion of places that are attached to a moving frame.

    Args:
        offsets: of the places [m], shape (N, 3), in `frame`, one of `FRAMES`.
        frame: whether they turn with the yaw of the motion.
        drift: motion of the frame, M samples.
    """
    count = len(drift.place)
    if frame == "world":
        still = np.zeros(offsets.shape)
        return Motion(
            position=drift.place[:, None, :3] + offsets,
            velocity=drift.rate[:, None, :3] + still,
            acceleration=drift.growth[:, None, :3] + still,
        )
    cos, sin = np.cos(drift.place[:, 3])[:, None], np.sin(drift.place[:, 3])[:, None]
    x, y, z = offsets.T
    flat = np.stack([x * cos - y * sin, x * sin + y * cos, np.zeros((count, len(z)))], axis=-1)
    side = np.stack([-flat[..., 1], flat[..., 0], flat[..., 2]], axis=-1)
    turn, twist = drift.rate[:, 3, None, None], drift.growth[:, 3, None, None]
    return Motion(
        position=drift.place[:, None, :3] + flat + z[:, None] * np.array([0.0, 0.0, 1.0]),
        velocity=drift.rate[:, None, :3] + turn * side,
        acceleration=drift.growth[:, None, :3] + twist * side - turn**2 * flat,
    )


def drift_of(leader: LeaderState) -> Drift:
    """A measured state as one sample of a motion."""
    return Drift(
        np.array([[*leader.position, leader.yaw_rad]]),
        np.array([[*leader.velocity, leader.yaw_rate]]),
        np.array([[*leader.acceleration, 0.0]]),
    )


def raised(leader: LeaderState, least_z_m: float) -> LeaderState:
    """The leader, or one above it that stays at a height [m, world]."""
    if leader.position[2] >= least_z_m:
        return leader
    x, y, _ = leader.position
    level = np.array([1.0, 1.0, 0.0])
    return replace(
        leader,
        position=np.array([x, y, least_z_m]),
        velocity=leader.velocity * level,
        acceleration=leader.acceleration * level,
    )
