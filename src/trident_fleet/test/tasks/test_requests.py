# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from collections import Counter

import pytest
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.messages import State, TaskAnnounce
from trident_fleet.core.tasks.rehearsal import Rehearsal
from trident_fleet.core.tasks.requests import Requests
from trident_fleet.core.tasks.trials.scenes import LOSSY, STEP_S, asked_scene


def run(rehearsal: Rehearsal, until_s: float) -> None:
    while rehearsal.channel.now() < until_s:
        rehearsal.step(STEP_S)


def user_of(rehearsal: Rehearsal) -> Requests:
    assert rehearsal.requests is not None
    return rehearsal.requests


def test_what_a_user_asks_for_is_done_once_whatever_gets_lost() -> None:
    made = asked_scene(3, LOSSY)
    made.run()
    done = Counter(task_id for _, task_id, _ in made.rehearsal.happened.done)
    assert done == {name: task.robots_needed for name, task in made.watch.tasks.items()}
    assert not user_of(made.rehearsal).pending()


def test_tasks_that_only_a_dead_manager_has_heard_are_done() -> None:
    made = asked_scene(5)
    rehearsal = made.rehearsal
    rest = [name for name in rehearsal.members if name != "r0"]
    rehearsal.channel.split(["user", "r0"], rest)
    run(rehearsal, 3.0)
    assert not user_of(rehearsal).pending()
    assert not any(rehearsal.members[name].follower.book.records for name in rest)
    rehearsal.kill("r0")
    rehearsal.channel.heal()
    made.run()
    done = {task_id for _, task_id, _ in rehearsal.happened.done}
    assert done == set(made.watch.tasks)


def test_a_canceled_task_is_not_done_and_has_a_reason() -> None:
    made = asked_scene(2, LOSSY)
    run(made.rehearsal, 2.0)
    user_of(made.rehearsal).cancel("t5")
    made.run()
    done = {task_id for _, task_id, _ in made.rehearsal.happened.done}
    assert done == set(made.watch.tasks) - {"t5"}
    manager = made.rehearsal.manager()
    assert manager is not None
    assert manager.manager is not None
    assert manager.manager.ledger.reasons == {"t5": "canceled"}


def test_bad_requests_are_refused_where_they_are_made_and_where_they_come() -> None:
    made = asked_scene(2)
    user, member = user_of(made.rehearsal), made.rehearsal.members["r1"]
    task = TaskAnnounce(0.0, "t0", "", 0, "visit", "", (1.0, 2.0, 0.0))
    with pytest.raises(TaskError, match="task 't0': task_id is there already, legal: a new one"):
        user.add([task])
    with pytest.raises(TaskError, match="task 'x': unknown, legal: t0, t1, t2, t3, t4, t5"):
        user.cancel("x")
    bad = dataclasses.replace(task, task_id="b", duration_s=-1.0)
    with pytest.raises(TaskError, match=r"task 'b': duration_s is -1.0, legal: finite, from 0"):
        user.add([bad])
    member.follower.request(bad)
    member.follower.request(task)
    member.follower.request(dataclasses.replace(task, stamp_s=5.0))
    member.follower.request(dataclasses.replace(task, value=7.0))
    assert dict(member.follower.problems) == {
        "task 'b': duration_s is -1.0, legal: finite, from 0": 1,
        "task 't0': task_id is there already, legal: a new one": 1,
    }
    assert list(member.follower.book.records) == ["t0"]
    assert member.follower.book.records["t0"].states()[0].state is State.WITHDRAWN
