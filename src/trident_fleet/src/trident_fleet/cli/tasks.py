# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""`./trident task add|cancel|list`: what a running team shall do, and how far it is."""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Callable, Sequence

import rospy

from trident_fleet.core.errors import FormationError
from trident_fleet.core.tasks.book import Record
from trident_fleet.core.tasks.fields import TaskError
from trident_fleet.core.tasks.follower import Follower
from trident_fleet.core.tasks.messages import State, TaskAnnounce
from trident_fleet.core.tasks.protocol import Guards
from trident_fleet.core.tasks.requests import Requests
from trident_fleet.nodes.tasks.settings import CoordinatorSettings, read_settings
from trident_fleet.nodes.tasks.topic_port import TopicPort, Wiring
from trident_ros import Refusals, init_node

_POLL_S = 0.1
_WORDS = {
    State.AWARDED: "awarded",
    State.ACTIVE: "active",
    State.DONE: "done",
    State.FAILED: "given up",
    State.WITHDRAWN: "waits",
}


class Terminal:
    """A user who talks with the team."""

    def __init__(self, settings: CoordinatorSettings, user: str, wait_s: float) -> None:
        """Connect, after rospy.init_node(); an answer may take this long, wall time [s]."""
        team, self._wait_s = settings.team, wait_s
        is_relayed = settings.wiring.heard[0][1] is not None
        wiring = Wiring.relayed(user, team.members) if is_relayed else settings.wiring
        self._port = TopicPort(user, team.members, settings.frame, wiring, Refusals())
        self.requests = Requests(Follower(user, team, Guards(), self._port.now()))

    def until(self, is_settled: Callable[[], bool]) -> None:
        """Talk until something is so.

        Raises:
            TaskError: it is not so after a while.
        """
        end = time.monotonic() + self._wait_s
        while not is_settled():
            if time.monotonic() > end:
                raise TaskError(f"no manager has said that it knows it, in {self._wait_s:g} s")
            for envelope in self._port.receive():
                self.requests.on_message(envelope.source, envelope.message, self._port.now())
            for sent in self.requests.on_time(time.monotonic()):
                self._port.send(sent.message, sent.destination)
            time.sleep(_POLL_S)

    def has_heard(self) -> bool:
        """Whether a manager has said what it knows."""
        return self.requests.follower.epoch > 0


def line(record: Record) -> str:
    """What is known of a task, as a line."""
    states = record.states()
    robots = ", ".join(state.robot_id for state in states if state.robot_id) or "-"
    x, y, z = record.task.place
    return (
        f"{record.task.task_id:<16} {_WORDS[min(state.state for state in states)]:<10} "
        f"{robots:<16} {record.task.kind:<12} ({x:g}, {y:g}, {z:g})"
    )


def task_of(options: argparse.Namespace) -> TaskAnnounce:
    """The task that the options describe."""
    return TaskAnnounce(
        0.0,
        options.id,
        "",
        0,
        options.kind,
        options.requirements,
        tuple(options.place),
        options.duration,
        options.deadline,
        options.value,
        after=tuple(options.after),
        robots_needed=options.robots,
        repeatable=options.repeatable,
    )


def parser() -> argparse.ArgumentParser:
    """The command line."""
    made = argparse.ArgumentParser(prog="trident task", description=__doc__)
    made.add_argument("--user", default="gcs", help="who asks; relays must know this name")
    made.add_argument("--wait", type=float, default=20.0, help="for a manager, wall time [s]")
    kinds = made.add_subparsers(dest="action", required=True)
    add = kinds.add_parser("add", help="ask for a task")
    add.add_argument("id", help="unique in the team")
    add.add_argument("place", nargs=3, type=float, metavar=("X", "Y", "Z"), help="[m]")
    add.add_argument("--kind", default="visit", help="what is to be done")
    add.add_argument("--requirements", default="", metavar="JSON", help="of the robot")
    add.add_argument("--duration", type=float, default=0.0, help="of the work [s]")
    add.add_argument("--deadline", type=float, default=math.inf, help="simulated time [s]")
    add.add_argument("--value", type=float, default=1.0, help="of having it done")
    add.add_argument("--after", action="append", default=[], metavar="ID", help="done before it")
    add.add_argument("--robots", type=int, default=1, help="that do it together")
    add.add_argument("--repeatable", action="store_true", help="doing it twice does no harm")
    kinds.add_parser("cancel", help="a task shall not be done any more").add_argument("id")
    kinds.add_parser("list", help="all tasks, and who has them")
    return made


def run(options: argparse.Namespace, terminal: Terminal) -> None:
    """Ask, and print the answer.

    Raises:
        TaskError: the task is not legal, or nobody answers.
    """
    requests = terminal.requests
    terminal.until(terminal.has_heard)
    if options.action == "add":
        for text in requests.add([task_of(options)]):
            print(text, file=sys.stderr)
    elif options.action == "cancel":
        requests.cancel(options.id)
    terminal.until(lambda: not requests.pending())
    records = requests.follower.book.records
    shown = records.values() if options.action == "list" else [records[options.id]]
    for record in shown:
        print(line(record))


def main(arguments: Sequence[str] | None = None) -> int:
    """Ask a running team.

    Returns:
        0: it has heard; 1: it has not, or the task is not legal, and this has been reported.
    """
    options = parser().parse_args(arguments)
    try:
        init_node("trident_task", anonymous=True)
        robots = rospy.get_param("/team/robots", None)
        name = next(iter(robots), "") if isinstance(robots, dict) else ""
        settings = read_settings(lambda key: rospy.get_param(f"/team/{key}", None), name)
        run(options, Terminal(settings, options.user, options.wait))
    except (FormationError, rospy.ROSException, OSError) as error:
        print(f"task: {error}", file=sys.stderr)
        return 1
    finally:
        rospy.signal_shutdown("done")
    return 0


if __name__ == "__main__":
    sys.exit(main())
