# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Times of the contract net, and the guards that keep it safe, each a question of its own."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from trident_fleet.core.tasks.fields import Capabilities, TaskError
from trident_fleet.core.tasks.messages import NOBODY, TaskAnnounce, TaskMessage


@dataclass(frozen=True)
class Times:
    """All times of the protocol [s]. A message takes up to 0.2 s, and may be lost.

    Attributes:
        bids_s: an auction is open for bids.
        step_s: between two decisions on open auctions.
        retry_s: what was not answered is said again.
        lease_s: a robot claims a task after it was last heard.
        guard_s: a manager waits so much longer than a lease.
        digest_s: between two tables of a member.
        silence_s: of the manager, after which the next one takes over.
        stagger_s: each one later in the succession waits so much longer.
        patience_s: without a bid, after which it is said that nobody can do a task.
    """

    bids_s: float = 2.0
    step_s: float = 0.5
    retry_s: float = 0.5
    lease_s: float = 6.0
    guard_s: float = 0.5
    digest_s: float = 0.4
    silence_s: float = 1.6
    stagger_s: float = 0.5
    patience_s: float = 30.0

    def __post_init__(self) -> None:
        """Refuse times that cannot work.

        Raises:
            TaskError: names field, value and legal range.
        """
        for name, value in vars(self).items():
            if not 0.0 < value < 1e6:
                raise TaskError(f"times of the protocol: {name} is {value}, legal: above 0, finite")
        if self.lease_s <= 2.0 * self.digest_s:
            raise TaskError(
                f"times of the protocol: lease_s is {self.lease_s}, legal: above 2 digest_s = "
                f"{2.0 * self.digest_s}"
            )


@dataclass(frozen=True)
class Team:
    """Who there is.

    Attributes:
        robots: what each robot can do, by name.
        managers: who may manage, in the order of succession.
        attempts: a task that has failed so often is given up.
    """

    robots: dict[str, Capabilities]
    managers: tuple[str, ...]
    times: Times = field(default_factory=Times)
    attempts: int = 3

    @property
    def members(self) -> frozenset[str]:
        """All names."""
        return frozenset(self.robots) | frozenset(self.managers)

    def epoch_after(self, epoch: int, manager: str) -> int:
        """The next epoch of a manager; no two managers ever have the same."""
        count = len(self.managers)
        return (epoch // count + 1) * count + self.managers.index(manager)


@dataclass(frozen=True)
class Sent:
    """A message that a member would send, to one other or to `NOBODY` in particular: to all."""

    message: TaskMessage
    destination: str = NOBODY


class Guards:
    """What must hold before somebody acts. Tests put a broken one in place of each."""

    def is_current(self, epoch: int, own: int) -> bool:
        """Whether a manager's word is of the epoch that this member follows."""
        return epoch == own

    def is_newer(self, epoch: int, own: int) -> bool:
        """Whether a member changes to another manager."""
        return epoch > own

    def lease_holds(self, now_s: float, lease_until_s: float) -> bool:
        """Whether a robot may still claim a task."""
        return now_s < lease_until_s

    def lease_over(self, now_s: float, lease_until_s: float, guard_s: float) -> bool:
        """Whether a manager may think that a robot claims a task no more."""
        return now_s >= lease_until_s + guard_s

    def is_quorum(self, count: int, members: int) -> bool:
        """Whether no other such group can be without one of these."""
        return 2 * count > members

    def may_repeat(self, task: TaskAnnounce, begun: bool) -> bool:
        """Whether a task whose holder vanished is given to another robot."""
        return task.repeatable or not begun

    def permitted(self, needed: bool, granted: bool) -> bool:
        """Whether a robot may begin: some tasks want their manager's word first."""
        return granted or not needed

    def all_there(self, ready: int, needed: int) -> bool:
        """Whether as many robots wait for a task as it needs."""
        return ready >= needed

    def after_done(self, after: Iterable[str], done: Iterable[str]) -> bool:
        """Whether all that a task comes after is done."""
        return set(after) <= set(done)

    def can(self, lacks: list[str]) -> bool:
        """Whether a robot has what a task asks."""
        return not lacks

    def same_round(self, said: int, known: int) -> bool:
        """Whether a robot's word is about the auction that counts."""
        return said == known

    def in_time(self, now_s: float, until_s: float) -> bool:
        """Whether a bid counts."""
        return now_s <= until_s


def needs_permission(task: TaskAnnounce) -> bool:
    """Whether a robot must wait for its manager's table before it begins."""
    return not task.repeatable or task.robots_needed > 1
