# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Messages of the contract net as ROS messages, and back.

`header.frame_id` is the name of the sender; the frame of a place is that of its own header.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import rospy
from geometry_msgs.msg import PoseStamped

import trident_msgs.msg as ros
from trident_fleet.core.encoding import NS_PER_S
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.intake import check_fields
from trident_fleet.core.tasks.messages import (
    State,
    TaskAnnounce,
    TaskAward,
    TaskBid,
    TaskConfirm,
    TaskMessage,
    TaskProgress,
    TaskState,
    TaskTable,
)
from trident_ros import quoted, stamp_problem

_MOST_EPOCH = 50_000  # a round has 16 bits for it, and later managers need some, too
_MOST_ROBOTS = 255  # of a task, as its field is a byte


def time_of(seconds: float) -> rospy.Time:
    """Simulated time [s] as ROS has it."""
    return rospy.Time(*divmod(round(max(seconds, 0.0) * NS_PER_S), NS_PER_S))


def to_ros(message: TaskMessage, sender: str, frame: str) -> Any:
    """A message as it is published.

    Args:
        message: it.
        sender: name of the member.
        frame: of places, the common one of the team.
    """
    made = _WRITERS[type(message)](message, frame)
    made.header.stamp, made.header.frame_id = time_of(message.stamp_s), sender
    return made


def _announce(task: TaskAnnounce, frame: str) -> ros.TaskAnnounce:
    place = PoseStamped()
    place.header.frame_id = frame
    place.pose.position.x, place.pose.position.y, place.pose.position.z = task.place
    place.pose.orientation.w = 1.0
    made = ros.TaskAnnounce(
        task_id=task.task_id,
        manager=task.manager,
        round=task.round,
        kind=task.kind,
        requirements=task.requirements,
        place=place,
        duration=task.duration_s,
        deadline_s=task.deadline_s,
        value=task.value,
        bids_until=time_of(task.bids_until_s),
        after=list(task.after),
        robots_needed=task.robots_needed,
        repeatable=task.repeatable,
    )
    made.header.stamp = time_of(task.stamp_s)
    return made


def _bid(bid: TaskBid, _: str) -> ros.TaskBid:
    return ros.TaskBid(
        task_id=bid.task_id,
        round=bid.round,
        robot_id=bid.robot_id,
        cost=bid.cost,
        start_s=bid.start_s,
        energy=bid.energy,
        bundle=list(bid.bundle),
        version=bid.version,
        withdraw=bid.withdraw,
    )


def _award(award: TaskAward, _: str) -> ros.TaskAward:
    return ros.TaskAward(
        task_id=award.task_id,
        round=award.round,
        manager=award.manager,
        robot_id=award.robot_id,
        cost=award.cost,
        order=list(award.order),
        epoch=award.epoch,
        lease_until=time_of(award.lease_until_s),
    )


def _confirm(confirm: TaskConfirm, _: str) -> ros.TaskConfirm:
    return ros.TaskConfirm(
        task_id=confirm.task_id,
        round=confirm.round,
        robot_id=confirm.robot_id,
        accept=confirm.accept,
        reason=confirm.reason,
    )


def _progress(progress: TaskProgress, _: str) -> ros.TaskProgress:
    return ros.TaskProgress(
        task_id=progress.task_id,
        round=progress.round,
        robot_id=progress.robot_id,
        done=progress.done,
        remaining_s=progress.remaining_s,
        state=int(progress.state),
        reason=progress.reason,
    )


def _state(state: TaskState, frame: str) -> ros.TaskState:
    return ros.TaskState(
        task=_announce(state.task, frame),
        state=int(state.state),
        robot_id=state.robot_id,
        round=state.round,
        epoch=state.epoch,
        lease_until=time_of(state.lease_until_s),
    )


def _table(table: TaskTable, frame: str) -> ros.TaskTable:
    tasks = [_state(state, frame) for state in table.tasks]
    return ros.TaskTable(manager=table.manager, epoch=table.epoch, tasks=tasks)


_WRITERS: dict[type, Callable[[Any, str], Any]] = {
    TaskAnnounce: _announce,
    TaskBid: _bid,
    TaskAward: _award,
    TaskConfirm: _confirm,
    TaskProgress: _progress,
    TaskTable: _table,
}


def from_ros(message: Any, frame: str) -> TaskMessage:
    """A message as it has come.

    Args:
        message: one of the six types.
        frame: that places must have.

    Raises:
        TaskError: names field, value and legal range.
    """
    stamp_s = _seconds("header.stamp", message.header.stamp)
    read: TaskMessage = _READERS[type(message)](message, stamp_s, frame)
    return read


def _legal_epoch(epoch: int) -> int:
    if epoch > _MOST_EPOCH:
        raise TaskError(f"epoch is {epoch}, legal: 0 ... {_MOST_EPOCH}")
    return epoch


def _seconds(name: str, stamp: Any) -> float:
    problem = stamp_problem(stamp)
    if problem:
        raise TaskError(f"{name}: {problem}")
    return float(stamp.secs) + stamp.nsecs / NS_PER_S


def _read_announce(message: ros.TaskAnnounce, stamp_s: float, frame: str) -> TaskAnnounce:
    found, place = message.place.header.frame_id, message.place.pose.position
    if found != frame:
        raise TaskError(
            f"task {quoted(message.task_id)!r}: place.header.frame_id is {quoted(found)!r}, "
            f"legal: {frame}"
        )
    task = TaskAnnounce(
        stamp_s,
        message.task_id,
        message.manager,
        message.round,
        message.kind,
        message.requirements,
        (place.x, place.y, place.z),
        message.duration,
        message.deadline_s,
        message.value,
        _seconds("bids_until", message.bids_until),
        tuple(message.after),
        message.robots_needed,
        message.repeatable,
    )
    check_fields(task, _MOST_ROBOTS)
    return task


def _read_bid(message: ros.TaskBid, stamp_s: float, _: str) -> TaskBid:
    return TaskBid(
        stamp_s,
        message.task_id,
        message.round,
        message.robot_id,
        message.cost,
        message.start_s,
        message.energy,
        tuple(message.bundle),
        message.version,
        message.withdraw,
    )


def _read_award(message: ros.TaskAward, stamp_s: float, _: str) -> TaskAward:
    return TaskAward(
        stamp_s,
        message.task_id,
        message.round,
        message.manager,
        message.robot_id,
        message.cost,
        tuple(message.order),
        _legal_epoch(message.epoch),
        _seconds("lease_until", message.lease_until),
    )


def _read_confirm(message: ros.TaskConfirm, stamp_s: float, _: str) -> TaskConfirm:
    return TaskConfirm(
        stamp_s,
        message.task_id,
        message.round,
        message.robot_id,
        message.accept,
        message.reason,
    )


def _known_state(state: int) -> State:
    if state not in list(State):
        raise TaskError(f"state is {state}, legal: 0 ... {max(State):d}")
    return State(state)


def _read_progress(message: ros.TaskProgress, stamp_s: float, _: str) -> TaskProgress:
    if not 0.0 <= message.done <= 1.0:
        raise TaskError(f"done is {message.done}, legal: 0 ... 1")
    if not 0.0 <= message.remaining_s < math.inf:
        raise TaskError(f"remaining_s is {message.remaining_s}, legal: finite, from 0")
    return TaskProgress(
        stamp_s,
        message.task_id,
        message.round,
        message.robot_id,
        message.done,
        message.remaining_s,
        _known_state(message.state),
        message.reason,
    )


def _read_table(message: ros.TaskTable, stamp_s: float, frame: str) -> TaskTable:
    tasks = tuple(
        TaskState(
            _read_announce(one.task, _seconds("task.header.stamp", one.task.header.stamp), frame),
            _known_state(one.state),
            one.robot_id,
            one.round,
            _legal_epoch(one.epoch),
            _seconds("lease_until", one.lease_until),
        )
        for one in message.tasks
    )
    return TaskTable(stamp_s, message.manager, _legal_epoch(message.epoch), tasks)


_READERS: dict[type, Callable[[Any, float, str], Any]] = {
    ros.TaskAnnounce: _read_announce,
    ros.TaskBid: _read_bid,
    ros.TaskAward: _read_award,
    ros.TaskConfirm: _read_confirm,
    ros.TaskProgress: _read_progress,
    ros.TaskTable: _read_table,
}
