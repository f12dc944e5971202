# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Followers that take off, join their leader and hold their places around it."""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

import numpy as np

from trident_fleet.core.assignment import assign
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.errors import FormationError
from trident_fleet.core.follow.follow_config import FollowConfig, attached, drift_of, raised
from trident_fleet.core.follow.leader import LeaderState
from trident_fleet.core.follow.reference import Drift, Reference
from trident_fleet.core.quintic import Array, Motion, hold
from trident_fleet.core.schedule import period_times
from trident_fleet.core.separation import min_separation
from trident_fleet.core.transit import leg_duration, transit_path
from trident_fleet.core.transition import Waves, schedule_waves

_STILL_SPEED = 0.05  # [m/s] and [rad/s]
_SHORTEST_JOIN_S = 3.0
_RETRY_S = 1.0
_UNHURRIED = 1.5  # longer than the limits ask for
_LIFTS = (0.0, 1.0, -1.0, 2.0, 4.0)
_OVER_M = 0.2  # more than the separation, above or below a leader that blocks the path


class Phase(enum.Enum):
    """Where the flight is."""

    TAKE_OFF = "take-off"
    JOIN = "flying to the places"
    FOLLOW = "following"
    DONE = "done"  # unless the leader moves on


@dataclass(frozen=True)
class Slots:
    """Motion of the places, and the heading there, at M instants.

    Attributes:
        motion: of the N places, in the world frame.
        yaw: [rad, world], shape (M,).
        yaw_rate: [rad/s], shape (M,).
    """

    motion: Motion
    yaw: Array
    yaw_rate: Array


@dataclass(frozen=True)
class _Blend:
    """When each follower leaves its hover and is at its place, since the first set-point [s].

    With a lift they fly to points that far above (or below) their places, and go down together.
    """

    begin: Array
    duration: Array
    lift_m: float
    descent_s: float
    full_turns: float  # of the yaw of the frame, that the followers leave out

    @property
    def above_s(self) -> float:
        return float((self.begin + self.duration).max())

    @property
    def end_s(self) -> float:
        return self.above_s + (self.descent_s if self.lift_m else 0.0)


class Followers:
    """The set-points of all followers, period by period; a pure function of the leader's states.

    Attributes:
        phase: where the flight is.
        joined_s: when all are at their places, since the first set-point [s]; None: not yet.
        problem: why they cannot join the leader where it is now; "" if they can.
    """

    def __init__(self, spawn: Array, config: FollowConfig) -> None:
        """Plan the take-off.

        Args:
            spawn: p_world of the followers on the ground [m], shape (N, 3).
            config: places, limits and waits; as many offsets as followers.

        Raises:
            FormationError: an illegal configuration.
        """
        config.validate()
        self.config = config
        self.phase = Phase.TAKE_OFF
        self.joined_s: float | None = None
        self.problem = ""
        self._next_try_s = 0.0
        self._offsets = config.offsets
        climbed = spawn + np.array([0.0, 0.0, config.plan.climb_m])
        self._take_off = hold(spawn, config.plan.ground_s).then(
            transit_path(np.stack([spawn, climbed]), config.plan.limits)
        )
        self._hover = climbed
        self._reference = Reference(config.reference)
        self._blend: _Blend | None = None
        self._still_since_ns: int | None = None

    def step(self, leader: LeaderState | None, elapsed_ns: int, window_ns: int) -> Slots:
        """Commands of one period.

        Args:
            leader: its state, with stamps since the first set-point; None before the first one.
            elapsed_ns: instant that the state is of, since the first set-point [ns].
            window_ns: begin of the period to command [ns]; periods follow each other.
        """
        time = period_times(window_ns, self.config.feed)
        self._give_up_in_time(float(time[0]), leader)
        if leader is None:
            return self._waiting(time)
        drift = self._reference.advance(
            self._kept_up(leader), window_ns, self.config.feed.point_ns, len(time)
        )
        if self.phase is Phase.TAKE_OFF and time[0] >= self._take_off.duration:
            self._try_to_join(drift, float(time[0]))
        self._look_at(leader, elapsed_ns, float(time[0]))
        return self._waiting(time) if self._blend is None else self._blended(drift, time)

    def _give_up_in_time(self, now_s: float, leader: LeaderState | None) -> None:
        limit_s = self._take_off.duration + self.config.give_up_s
        if self.phase is Phase.TAKE_OFF and self.config.end_when_still_s > 0.0 and now_s > limit_s:
            self.phase = Phase.DONE
            if leader is None:
                self.problem = "the leader has not been seen"

    def ideal(self, leader: LeaderState) -> Motion:
        """Where the followers belong at the instant of a measured state, without any delay."""
        return attached(self._offsets, self.config.frame, drift_of(self._kept_up(leader)))

    def _kept_up(self, leader: LeaderState) -> LeaderState:
        return raised(leader, self.config.lowest_m - float(self._offsets[:, 2].min()))

    def _places(self, drift: Drift) -> Motion:
        return attached(self._offsets, self.config.frame, drift)

    def _waiting(self, time: Array) -> Slots:
        """The take-off and the hover after it."""
        yaw = np.full(len(time), self.config.plan.yaw_rad)
        return Slots(self._take_off.sample(time), yaw, np.zeros(len(time)))

    def _try_to_join(self, drift: Drift, now_s: float) -> None:
        if now_s < self._next_try_s:
            return
        try:
            self._blend = self._plan_join(drift, now_s)
        except FormationError as error:
            # The leader moves on: a path may be free in a moment.
            self.problem = str(error)
            self._next_try_s = now_s + _RETRY_S
        else:
            self.problem = ""
            self.phase = Phase.JOIN

    def _plan_join(self, drift: Drift, now_s: float) -> _Blend:
        """Paths from the hovers to the places, each with a growing share of its place's motion.

        Two that move at once keep a straight relative path however the leader moves, so it is
        enough that the separation is held as if the leader stood still.
        """
        goal = self._places(drift).position[0]
        if self.config.assign:
            place = assign(self._hover, goal)
            self._offsets, goal = self._offsets[place], goal[place]
        lift_m, waves = self._free_path(goal, drift.place[0, :3])
        begin, duration = np.full(len(goal), now_s), np.full(len(goal), _SHORTEST_JOIN_S)
        for wave in waves:
            movers = [vehicle for vehicle in wave if vehicle < len(goal)]
            if movers:
                begin[movers] = now_s
                duration[movers] = self._leg_s(self._hover[movers], goal[movers])
                now_s += float(duration[movers].max())
        descent_s = self._leg_s(np.zeros((1, 3)), np.array([[0.0, 0.0, lift_m]]))
        ahead = drift.place[0, 3] - self.config.plan.yaw_rad
        full_turns = float(np.round(ahead / (2.0 * math.pi)))
        return _Blend(begin, duration, lift_m, descent_s, full_turns)

    def _leg_s(self, start: Array, end: Array) -> float:
        """Time for a path [s]; what the place moves on meanwhile is flown on top."""
        leg_s = leg_duration(start, end, self.config.plan.limits)
        return max(_SHORTEST_JOIN_S, _UNHURRIED * leg_s)

    def _free_path(self, goal: Array, leader: Array) -> tuple[float, Waves]:
        """The straight path if it is free of the leader, else one above or below it."""
        own, least = leader[None], self.config.min_separation_m
        start = np.concatenate([self._hover, own])
        required = min(least, min_separation(start[None]))
        over = (least + _OVER_M) * np.array([0.0, 0.0, 1.0])
        refusal = None
        for lift in (factor * over for factor in _LIFTS):
            above = goal + lift
            if not self._may_descend(above, goal, own, required):
                continue
            try:
                waves = schedule_waves(start, np.concatenate([above, own]), required)
            except FormationError as error:
                refusal = refusal or error
            else:
                return float(lift[2]), waves
        raise refusal or FormationError(f"places: too close to the leader; legal: {least:g} m")

    def _may_descend(self, above: Array, goal: Array, own: Array, required: float) -> bool:
        """Whether places above the goals are high enough, and the leader not in the descent."""
        descent = np.concatenate([np.stack([above, goal]), np.stack([own, own])], axis=1)
        is_low = bool((above[:, 2] < self.config.lowest_m).any())
        return not is_low and not min_separation(descent) < required

    def _look_at(self, leader: LeaderState, elapsed_ns: int, now_s: float) -> None:
        """Go to the next phase when it is time."""
        if self.phase is Phase.JOIN and self._blend is not None and now_s >= self._blend.end_s:
            self.phase, self.joined_s = Phase.FOLLOW, now_s
        if self.joined_s is not None:
            self._look_for_end(leader, elapsed_ns)

    def _look_for_end(self, leader: LeaderState, elapsed_ns: int) -> None:
        """It is done once the leader has stood still for long enough."""
        fastest = max(float(np.linalg.norm(leader.velocity)), abs(leader.yaw_rate))
        if fastest > _STILL_SPEED:
            # It was a pause, and no end.
            self._still_since_ns, self.phase = None, Phase.FOLLOW
            return
        if self._still_since_ns is None:
            self._still_since_ns = elapsed_ns
        still_s = (elapsed_ns - self._still_since_ns) / NS_PER_S
        if 0.0 < self.config.end_when_still_s <= still_s:
            self.phase = Phase.DONE

    def _blended(self, drift: Drift, time: Array) -> Slots:
        assert self._blend is not None
        blend, places = self._blend, self._places(drift)
        part = (time[:, None] - blend.begin) / blend.duration
        h = blend.duration[:, None]
        w, w1, w2 = (_share(part, order)[..., None] / h**order for order in range(3))
        away = places.position - self._hover
        lift = np.array([0.0, 0.0, blend.lift_m])
        h = np.array([[blend.descent_s]])
        down = (time[:, None] - blend.above_s) / blend.descent_s
        d, d1, d2 = (_share(down, order)[..., None] / h**order for order in range(3))
        motion = Motion(
            position=self._hover + w * away + lift * (w - d),
            velocity=w1 * away + w * places.velocity + lift * (w1 - d1),
            acceleration=w2 * away
            + 2.0 * w1 * places.velocity
            + w * places.acceleration
            + lift * (w2 - d2),
        )
        yaw = np.full(len(time), self.config.plan.yaw_rad)
        if self.config.frame == "world":
            return Slots(motion, yaw, np.zeros(len(time)))
        # All turn together, with the first of them.
        turned = drift.place[:, 3] - 2.0 * math.pi * blend.full_turns - yaw
        return Slots(
            motion,
            yaw + w[:, 0, 0] * turned,
            w1[:, 0, 0] * turned + w[:, 0, 0] * drift.rate[:, 3],
        )


def _share(part: Array, order: int) -> Array:
    """Minimum-jerk share 0..1 of a path and its derivatives by the part 0..1 of the time."""
    u = np.clip(part, 0.0, 1.0)
    polynomials = (
        u**3 * (10.0 + u * (6.0 * u - 15.0)),
        30.0 * u**2 * (1.0 - u) ** 2,
        60.0 * u * (1.0 - u) * (1.0 - 2.0 * u),
    )
    return np.asarray(polynomials[order])
