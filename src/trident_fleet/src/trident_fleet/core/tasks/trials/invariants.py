# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What must hold in a team after every message, whatever the network does."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from trident_fleet.core.tasks.book import Book, Record
from trident_fleet.core.tasks.member import Member
from trident_fleet.core.tasks.messages import (
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskMessage,
    TaskProgress,
    epoch_of,
)
from trident_fleet.core.tasks.methods.base import Offer
from trident_fleet.core.tasks.protocol import needs_permission
from trident_fleet.core.tasks.rehearsal import Rehearsal
from trident_fleet.core.tasks.robot import Holding

Known = tuple[int, int, dict[str, State]]
"""What a member knows of a task: the round, the member's epoch, and the states of the holders."""


class BrokenError(AssertionError):
    """An invariant does not hold."""


class Watch:
    """Looks at a rehearsal after every step and every message, and remembers what was."""

    def __init__(self, rehearsal: Rehearsal, tasks: list[TaskAnnounce]) -> None:
        """Of a rehearsal that has not begun, with all tasks that it will have."""
        self.rehearsal = rehearsal
        self.tasks = {task.task_id: task for task in tasks}
        self._epochs: dict[str, int] = {}
        self._managers: dict[int, str] = {}
        self._versions: dict[tuple[str, str], tuple[int, int]] = {}
        self._done: dict[str, set[str]] = {}
        self._seen_begun = 0
        self._permitted: set[tuple[str, str, int]] = set()
        self._records: dict[tuple[str, str], Known] = {}
        for member in rehearsal.members.values():
            self.listen(member)

    def listen(self, member: Member) -> None:
        """Check what each message does to a member."""
        take = member._take

        def watched(source: str, message: TaskMessage) -> None:
            held = set(member.robot.holdings) if member.robot is not None else set()
            offer = self._offer(member, message)
            take(source, message)
            self._check_message(member, message, held)
            self._check_bid(member, message, offer)
            self._check_knowledge(member)
            self._check_reopened(member)

        member._take = watched  # type: ignore[method-assign]

    def _check_message(self, member: Member, message: TaskMessage, held: set[str]) -> None:
        robot = member.robot
        if isinstance(message, TaskAward) and robot is not None:
            gained = set(robot.holdings) - held
            if gained and message.epoch < member.follower.epoch:
                raise BrokenError(f"{member.name} took {gained} from an older manager")

    @staticmethod
    def _offer(member: Member, message: TaskMessage) -> Offer | None:
        """The offer that a manager has from who sends this bid."""
        if not isinstance(message, TaskBid) or member.manager is None:
            return None
        auction = member.manager._auctions.running.get(message.task_id)
        return auction.offers.get(message.robot_id) if auction is not None else None

    def _check_bid(self, member: Member, message: TaskMessage, before: Offer | None) -> None:
        if self._offer(member, message) is before or not isinstance(message, TaskBid):
            return
        assert member.manager is not None
        until_s = member.manager._auctions.running[message.task_id].job.task.bids_until_s
        if self.rehearsal.channel.now() > until_s:
            raise BrokenError(f"a bid of {message.robot_id} counted after the auction")

    def _check_reopened(self, member: Member) -> None:
        """No manager takes a task from a robot that may still have it."""
        for task_id, record in member.follower.book.records.items():
            now = _known(record, member.follower.epoch)
            before = self._records.get((member.name, task_id))
            self._records[member.name, task_id] = now
            if before is None or record.task.robots_needed != 1:
                continue
            if _has_reopened(member, before, now):
                for name, state in before[2].items():
                    self._check_left(name, record.task, before[0], state)

    def _check_left(self, name: str, task: TaskAnnounce, auction: int, state: State) -> None:
        member = self.rehearsal.members[name]
        assert member.robot is not None
        held = member.robot.holdings.get(task.task_id)
        follows = member.follower.epoch == epoch_of(auction)
        if follows and self._is_claimed(held, auction):
            raise BrokenError(f"{task.task_id} was taken from {name} while its lease ran")
        ended = member.robot._ended.get(task.task_id)
        if state is State.ACTIVE and not task.repeatable and not _is_word_of(ended, auction):
            raise BrokenError(f"{task.task_id} was free again, without a word of {name}")

    def _is_claimed(self, held: Holding | None, auction: int) -> bool:
        """Whether a robot has a task by this round, and does not offer it to others."""
        now_s = self.rehearsal.channel.now()
        if held is None or held.round != auction:
            return False
        return held.lease_until_s > now_s and held.offered_until_s <= now_s

    def forget(self, name: str) -> None:
        """A member has restarted: it may know less than before."""
        self._epochs.pop(name, None)
        self._done.pop(name, None)
        self._records = {key: value for key, value in self._records.items() if key[0] != name}
        self.listen(self.rehearsal.members[name])
        self._versions = {key: value for key, value in self._versions.items() if key[0] != name}

    def check(self) -> None:
        """Look at the team as it is now.

        Raises:
            BrokenError: an invariant does not hold.
        """
        for name, member in self.rehearsal.members.items():
            if self.rehearsal.channel.is_up(name):
                self._check_knowledge(member)
                self._check_holdings(member)
                self._check_reopened(member)
        self._check_holders()
        self._check_work()

    def _check_knowledge(self, member: Member) -> None:
        name, follower = member.name, member.follower
        if follower.epoch < self._epochs.get(name, 0):
            raise BrokenError(f"{name} went back to epoch {follower.epoch}")
        self._epochs[name] = follower.epoch
        if _is_on_duty(member) and self._managers.setdefault(follower.epoch, name) != name:
            raise BrokenError(f"{name} and {self._managers[follower.epoch]} share an epoch")
        done = follower.book.done()
        if not self._done.get(name, set()) <= done:
            raise BrokenError(f"{name} forgot that a task is done")
        self._done[name] = done
        self._check_records(name, follower.book)

    def _check_records(self, name: str, book: Book) -> None:
        """No record is older than it was; who may begin is noted."""
        for task_id, record in book.records.items():
            if record.version < self._versions.get((name, task_id), (0, 0)):
                raise BrokenError(f"{name} went back to {record.version} of {task_id}")
            self._versions[name, task_id] = record.version
            active = [one for one in record.holders.values() if one.state >= State.ACTIVE]
            if len(active) >= record.task.robots_needed:
                self._permitted.add((name, task_id, record.round))

    def _check_holdings(self, member: Member) -> None:
        robot, now_s = member.robot, self.rehearsal.channel.now()
        if robot is None:
            return
        robot.current(now_s)
        for task_id, held in robot.holdings.items():
            if held.lease_until_s <= now_s:
                raise BrokenError(f"{member.name} claims {task_id} beyond its lease")
            if robot.plan.can.lacks(held.job.asked):
                raise BrokenError(f"{member.name} holds {task_id}, which it cannot do")
            if not robot.plan.has(task_id):
                raise BrokenError(f"{member.name} holds {task_id} outside its plan")
            if task_id in member.follower.book.done():
                raise BrokenError(f"{member.name} holds {task_id}, which it knows to be done")

    def _check_holders(self) -> None:
        """Those who may work on a task that must not be done twice are of one round."""
        working: dict[str, set[int]] = {}
        for task_id, held in self._holdings():
            if held.granted and not self.tasks[task_id].repeatable:
                working.setdefault(task_id, set()).add(held.round)
        for task_id, rounds in working.items():
            if len(rounds) > 1:
                raise BrokenError(f"{task_id} is permitted in rounds {sorted(rounds)}")

    def _holdings(self) -> Iterator[tuple[str, Holding]]:
        """What the robots have that are up."""
        for name, member in self.rehearsal.members.items():
            if member.robot is not None and self.rehearsal.channel.is_up(name):
                yield from member.robot.holdings.items()

    def _check_work(self) -> None:
        happened = self.rehearsal.happened
        count = Counter(task_id for _, task_id, _ in happened.done)
        for task_id, times in count.items():
            task = self.tasks[task_id]
            if not task.repeatable and times > task.robots_needed:
                raise BrokenError(f"{task_id} was done {times} times")
        for now_s, task_id, name in happened.begun[self._seen_begun :]:
            self._check_begin(now_s, self.tasks[task_id], name, count)
        self._seen_begun = len(happened.begun)

    def _check_begin(self, now_s: float, task: TaskAnnounce, name: str, done: Counter[str]) -> None:
        for before in task.after:
            if not done[before]:
                raise BrokenError(f"{name} began {task.task_id} before {before} was done")
        if needs_permission(task):
            self._check_permission(now_s, task, name)

    def _check_permission(self, now_s: float, task: TaskAnnounce, name: str) -> None:
        robot = self.rehearsal.members[name].robot
        held = robot.holdings.get(task.task_id) if robot is not None else None
        if held is not None and (name, task.task_id, held.round) not in self._permitted:
            raise BrokenError(f"{name} began {task.task_id} at {now_s} s without permission")
        there = sum(_is_there(one, task.task_id) for one in self.rehearsal.members.values())
        if there < task.robots_needed:
            raise BrokenError(f"{name} began {task.task_id} with {there} robots there")


def _is_on_duty(member: Member) -> bool:
    return member.manager is not None and member.manager.on_duty


def _known(record: Record, epoch: int) -> Known:
    states = {name: holder.state for name, holder in record.holders.items()}
    return record.round, epoch, states


def _has_reopened(member: Member, before: Known, now: Known) -> bool:
    """Whether the manager of an epoch has opened a task again that it had given away itself."""
    is_new = before[1] == now[1] and before[0] != now[0]
    is_own = epoch_of(before[0]) == epoch_of(now[0]) == now[1]
    return _is_on_duty(member) and is_new and is_own


def _is_word_of(ended: TaskProgress | None, auction: int) -> bool:
    """Whether a robot has said that it has not done what it won in a round."""
    return ended is not None and ended.round == auction and ended.state is not State.DONE


def _is_there(member: Member, task_id: str) -> bool:
    """Whether a robot waits to begin a task, or has ended it."""
    if member.robot is None:
        return False
    held = member.robot.holdings.get(task_id)
    return (held is not None and held.asked) or task_id in member.robot._ended
