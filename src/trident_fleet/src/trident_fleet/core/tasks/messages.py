# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What managers and robots say to each other about tasks: the fields of trident_msgs' messages.

`stamp_s` stands for the header, times are simulated [s], places are p_common [m]. A `round` is one
auction of a task, and carries the epoch of the manager that holds it in its upper half: of two
rounds of a task, whatever manager held them, the greater is the newer one.
"""

from __future__ import annotations

import enum
import math
from dataclasses import dataclass

Point = tuple[float, float, float]

NOBODY = ""
NO_LIMIT = math.inf
_ATTEMPTS = 1 << 16


def round_of(epoch: int, attempt: int) -> int:
    """The number of an epoch's n-th auction of a task, attempt from 1."""
    return epoch * _ATTEMPTS + attempt


def epoch_of(auction: int) -> int:
    """The epoch of the manager that held this round."""
    return auction // _ATTEMPTS


class State(enum.IntEnum):
    """What is known of a task with one robot. With `NOBODY`, WITHDRAWN: it is free."""

    AWARDED = 0
    ACTIVE = 1
    DONE = 2
    FAILED = 3
    WITHDRAWN = 4


@dataclass(frozen=True)
class TaskAnnounce:
    """A task, and the auction of it.

    Attributes:
        stamp_s: when it was sent [s].
        task_id: unique in the team.
        manager: who holds the auction.
        round: of this auction; 0: no auction yet, a user asks for the task.
        kind: name of what is to be done.
        requirements: of the robot, as JSON (`Requirements`).
        place: where it is done, p_common [m].
        duration_s: of the work at the place [s].
        deadline_s: it is worth nothing when done later [s]; infinite: at any time.
        value: of having it done.
        bids_until_s: bids that come later do not count [s].
        after: tasks that must be done before it is begun.
        robots_needed: that work on it together, at the same time.
        repeatable: doing it twice does no harm.
    """

    stamp_s: float
    task_id: str
    manager: str
    round: int
    kind: str
    requirements: str
    place: Point
    duration_s: float = 0.0
    deadline_s: float = NO_LIMIT
    value: float = 1.0
    bids_until_s: float = 0.0
    after: tuple[str, ...] = ()
    robots_needed: int = 1
    repeatable: bool = False


@dataclass(frozen=True)
class TaskBid:
    """What a task would cost a robot, or that the robot takes its bid back.

    Attributes:
        stamp_s: when it was sent [s].
        task_id: as announced.
        round: as announced.
        robot_id: who bids.
        cost: what the objective would lose; at least 0.
        start_s: when it would be at the place [s].
        energy: that the robot would spend on it [J].
        bundle: tasks that it would do before this one; itself: the robot has it, and offers it.
        version: of the robot's plan: grows with each change of it.
        withdraw: the bid before counts no more.
    """

    stamp_s: float
    task_id: str
    round: int
    robot_id: str
    cost: float
    start_s: float = 0.0
    energy: float = 0.0
    bundle: tuple[str, ...] = ()
    version: int = 0
    withdraw: bool = False


@dataclass(frozen=True)
class TaskAward:
    """A robot has won: the task is its own until the lease ends, if it confirms.

    Attributes:
        stamp_s: when it was sent [s].
        task_id: as announced.
        round: as announced.
        manager: who held the auction.
        robot_id: who has won.
        cost: as bid.
        order: tasks of the robot, in the order in which it shall do them; empty: as it likes.
        epoch: of the manager.
        lease_until_s: the robot claims it no longer than this, unless it is renewed [s].
    """

    stamp_s: float
    task_id: str
    round: int
    manager: str
    robot_id: str
    cost: float
    order: tuple[str, ...]
    epoch: int
    lease_until_s: float


@dataclass(frozen=True)
class TaskConfirm:
    """A robot takes what it has won, or does not, for a reason."""

    stamp_s: float
    task_id: str
    round: int
    robot_id: str
    accept: bool
    reason: str = ""


@dataclass(frozen=True)
class TaskProgress:
    """How far a robot is with a task. From `NOBODY`, WITHDRAWN: a user does not want it any more.

    Attributes:
        stamp_s: when it was sent [s].
        task_id: as announced.
        round: in which the robot won it.
        robot_id: who works on it.
        done: share of the work, 0 ... 1.
        remaining_s: until it is done, as estimated [s].
        state: AWARDED: it waits in the robot's plan; ACTIVE: the robot would begin, or has.
        reason: of a failure or a withdrawal.
    """

    stamp_s: float
    task_id: str
    round: int
    robot_id: str
    done: float
    remaining_s: float
    state: State
    reason: str = ""


@dataclass(frozen=True)
class TaskState:
    """What a member knows of a task with one of the robots that have it, or with nobody."""

    task: TaskAnnounce
    state: State
    robot_id: str
    round: int
    epoch: int
    lease_until_s: float


@dataclass(frozen=True)
class TaskTable:
    """What a member knows of all tasks.

    From the manager of that epoch it renews leases and permits robots to begin; from anybody else
    it says that this member follows that manager and has heard this much of it.
    """

    stamp_s: float
    manager: str
    epoch: int
    tasks: tuple[TaskState, ...]


TaskMessage = TaskAnnounce | TaskBid | TaskAward | TaskConfirm | TaskProgress | TaskTable
