# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from trident_fleet.core.network import LinkModel
from trident_fleet.core.tasks.book import Book
from trident_fleet.core.tasks.messages import State, TaskAnnounce, TaskState
from trident_fleet.core.tasks.protocol import Guards
from trident_fleet.core.tasks.trials.invariants import BrokenError
from trident_fleet.core.tasks.trials.scenes import LOSSY, SHUFFLED, STEP_S, Scene, hard_day, scene


def test_a_healthy_team_does_every_task_once() -> None:
    for seed in range(5):
        made = scene(seed)
        made.run()
        done = Counter(task_id for _, task_id, _ in made.rehearsal.happened.done)
        assert done == {name: task.robots_needed for name, task in made.watch.tasks.items()}


def test_a_lossy_network_costs_at_most_three_times_as_long() -> None:
    for seed in range(8):
        made = scene(seed, LOSSY)
        assert made.run() <= 3.0 * scene(seed).run()
        done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
        assert done == set(made.watch.tasks)


# In the last ones a robot loses its partner in the moment in which they would begin.
@pytest.mark.parametrize("seeds", [range(20), range(20, 40), range(40, 60), (107, 1150, 1439)])
def test_hard_days_end_with_each_task_done_or_a_reason(seeds: Sequence[int]) -> None:
    for seed in seeds:
        made = hard_day(seed)
        until_s = made.run()
        assert not made.rehearsal.open_tasks(), f"seed {seed}: open at {until_s} s"
        manager = made.rehearsal.manager()
        assert manager is not None
        assert manager.manager is not None
        done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
        for task_id in manager.follower.book.records:
            assert task_id in done or task_id in manager.manager.ledger.reasons


def test_a_manager_that_was_cut_off_cannot_free_what_a_newer_one_has_permitted() -> None:
    task = TaskAnnounce(0.0, "t", "old", 7, "visit", "", (0.0, 0.0, 0.0))
    permitted = TaskState(task, State.ACTIVE, "r", 7, 11, 9.0)
    freed = TaskState(task, State.WITHDRAWN, "", 8, 5, 0.0)
    for order in ([permitted, freed], [freed, permitted], [freed, permitted, freed]):
        book = Book()
        for state in order:
            book.join([state])
        assert list(book.records["t"].holders) == ["r"]
        assert book.records["t"].version == (11, 7)


def test_same_seed_same_day() -> None:
    one, other = hard_day(7), hard_day(7)
    assert one.run() == other.run()
    assert one.rehearsal.happened == other.rehearsal.happened
    assert one.rehearsal.channel.counts == other.rehearsal.channel.counts


def test_the_next_manager_takes_over_within_three_seconds() -> None:
    made = scene(3, tasks=6)
    made.run(until_s=4.0)
    first = made.rehearsal.manager()
    assert first is not None
    made.rehearsal.kill(first.name)
    died_s = made.rehearsal.channel.now()
    made.run(until_s=died_s + 3.0)
    second = made.rehearsal.manager()
    assert second is not None
    assert second.name != first.name


def test_tasks_of_a_dead_robot_are_awarded_again_within_five_seconds_of_the_lease() -> None:
    made = scene(2, tasks=6)
    rehearsal = made.rehearsal
    made.run(until_s=6.0)
    victim, held = max(
        (
            (name, set(member.robot.holdings))
            for name, member in rehearsal.members.items()
            if member.robot is not None and member is not rehearsal.manager()
        ),
        key=lambda item: len(item[1]),
    )
    assert held
    rehearsal.kill(victim)
    times = rehearsal.team.times
    made.run(until_s=6.0 + times.lease_s + times.guard_s + 5.0)
    manager = rehearsal.manager()
    assert manager is not None
    for task_id in held:
        record = manager.follower.book.records[task_id]
        assert record.done_by or record.given_up or victim not in record.holders
        assert record.done_by or record.given_up or record.holders


def always(*_: object) -> bool:
    return True


def too_early(now_s: float, lease_until_s: float, guard_s: float) -> bool:
    return now_s >= lease_until_s - 5.5


FAULTS: dict[str, Callable[..., bool]] = {
    "is_current": always,
    "is_newer": lambda epoch, own: epoch != own,
    "lease_holds": always,
    "lease_over": too_early,
    "is_quorum": always,
    "may_repeat": always,
    "permitted": always,
    "all_there": always,
    "after_done": always,
    "same_round": always,
    "in_time": always,
}


@pytest.mark.parametrize("guard", FAULTS)
def test_the_invariants_find_a_broken_guard(guard: str) -> None:
    def broken(_: str) -> Guards:
        guards = Guards()
        setattr(guards, guard, FAULTS[guard])
        return guards

    days = (hard_day(seed, guards=broken, model=SHUFFLED) for seed in range(150))
    with pytest.raises(BrokenError):
        all(day.run(until_s=60.0) for day in days)


class TeamMachine(RuleBasedStateMachine):
    """Whatever befalls a team, in whatever order, the invariants hold, and it ends."""

    @initialize(
        seed=st.integers(0, 1000),
        loss=st.sampled_from([0.0, 0.3]),
        method=st.sampled_from(["plain", "improved"]),
    )
    def start(self, seed: int, loss: float, method: str) -> None:
        model = LinkModel(loss=loss, double=0.2, late=0.1, late_s=1.5)
        self.made: Scene = scene(seed, model, method, tasks=5)
        self.lost: set[str] = set()

    @rule(steps=st.integers(1, 20))
    def wait(self, steps: int) -> None:
        for _ in range(steps):
            self.made.rehearsal.step(STEP_S)
            self.made.watch.check()

    @precondition(lambda self: len(self.lost) < 2)
    @rule(index=st.integers(0, 4))
    def kill(self, index: int) -> None:
        name = f"r{index}"
        self.lost.add(name)
        self.made.rehearsal.kill(name)

    @precondition(lambda self: self.lost)
    @rule()
    def restart(self) -> None:
        name = min(self.lost)
        self.lost.discard(name)
        self.made.rehearsal.restart(name)
        self.made.watch.forget(name)

    @rule(part=st.sets(st.integers(0, 4), min_size=1, max_size=4))
    def part(self, part: set[int]) -> None:
        names = sorted(self.made.rehearsal.members)
        one = [names[index] for index in part]
        self.made.rehearsal.channel.split(one, [name for name in names if name not in one])

    @rule()
    def heal(self) -> None:
        self.made.rehearsal.channel.heal()

    @rule(index=st.integers(0, 4), state=st.sampled_from(["fail", "withdraw"]))
    def end(self, index: int, state: str) -> None:
        member = self.made.rehearsal.members[f"r{index}"]
        channel = self.made.rehearsal.channel
        if member.robot is None or not channel.is_up(member.name):
            return
        for task_id in list(member.robot.holdings)[:1]:
            member.send(getattr(member.robot, state)(task_id, "as it likes", channel.now()))

    @invariant()
    def all_is_well(self) -> None:
        if hasattr(self, "made"):
            self.made.watch.check()


TeamMachine.TestCase.settings = settings(max_examples=30, stateful_step_count=15, deadline=None)
TestTeam = TeamMachine.TestCase
