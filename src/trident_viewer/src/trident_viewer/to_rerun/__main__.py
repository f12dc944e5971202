# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Node to_rerun: streams a running simulation to the rerun viewer and into a .rrd file.

It subscribes to every topic whose type it understands, also to those that come later.
"""

from __future__ import annotations

import argparse
import collections
import math
import queue
import re
import signal
import sys
from pathlib import Path
from typing import Any

import roslib.message
import rospy
from trident_eval.core.errors import EvalError

from trident_viewer.to_rerun.converter import Converter
from trident_viewer.to_rerun.recorder import Recorder

_POLL_S = 0.25
_SOCKET_BYTES = 1 << 24  # as large as a picture
_WAITING = 2000  # messages; a sender whose messages nobody takes drops them by itself
_CLOCK = "/clock"
_HELD_S = 2.0  # of simulated time; frames that grow for longer are shown as they are
_INTERRUPTED = 130  # as a shell says it

Message = tuple[str, str, Any, float]  # topic, type, message, simulated time [s]


class Stream:
    """Takes messages from their threads and writes them one after another."""

    def __init__(self, recorder: Recorder, topics: re.Pattern[str]) -> None:
        """Nothing is subscribed to yet."""
        self._recorder = recorder
        self._topics = topics
        self._converter = Converter()
        self._waiting: queue.Queue[Message] = queue.Queue(_WAITING)
        self._subscribers: dict[str, rospy.Subscriber] = {}
        self._had_clock = False
        self._refused: set[str] = set()
        self._held: collections.deque[Message] = collections.deque()
        self._begin_s: float | None = None
        self.seconds = 0.0
        """Simulated time since the first message [s]."""
        self.entities: set[tuple[str, ...]] = set()

    def run(self, seconds: float) -> None:
        """Until the simulation has gone, or so much simulated time has been seen [s]."""
        while not rospy.is_shutdown() and self._discover() and self.seconds < seconds:
            try:
                message = self._waiting.get(timeout=_POLL_S)
                while self._is_before(seconds, message[-1]):
                    self.write(message)
                    message = self._waiting.get_nowait()
            except queue.Empty:
                continue
        self._show_held()

    def _is_before(self, seconds: float, now_s: float) -> bool:
        """Whether a message that came at now_s is within the recording; it counts the time."""
        if self._begin_s is None or now_s < self._begin_s:
            self._begin_s = now_s
        self.seconds = min(now_s - self._begin_s, seconds)
        return self.seconds < seconds

    def _discover(self) -> bool:
        """Subscribes to what is new; whether the simulation is still there."""
        try:
            found = rospy.get_published_topics()
        except OSError:
            return False  # the master has gone
        has_clock = any(topic == _CLOCK for topic, _ in found)
        if self._had_clock and not has_clock:
            return False
        self._had_clock = has_clock
        for topic, kind in found:
            if kind == "sensor_msgs/CameraInfo":
                self._converter.know_camera(topic)
        if has_clock:
            self._subscribe_to_new(found)
        return True

    def _subscribe_to_new(self, found: list[tuple[str, str]]) -> None:
        for topic, kind in found:
            is_wanted = kind in self._converter.types and self._topics.search(topic)
            if is_wanted and topic not in self._subscribers:
                self._subscribe(topic, kind)

    def _subscribe(self, topic: str, kind: str) -> None:
        def take(message: Any) -> None:
            self._waiting.put((topic, kind, message, rospy.get_time()))

        message_class = roslib.message.get_message_class(kind)
        self._subscribers[topic] = rospy.Subscriber(
            topic, message_class, take, queue_size=None, buff_size=_SOCKET_BYTES
        )

    def write(self, message: Message) -> None:
        """Shows a message, or holds it until its frame has its place: none is left out."""
        _, kind, _, now_s = message
        has_to_wait = self._converter.has_to_wait(kind, now_s)
        if has_to_wait and (not self._held or 0.0 <= now_s - self._held[0][-1] < _HELD_S):
            self._held.append(message)
            return
        if has_to_wait or self._converter.is_settled(now_s):
            self._show_held()
        self._show(*message)

    def _show_held(self) -> None:
        while self._held:
            self._show(*self._held.popleft())

    def _show(self, topic: str, kind: str, message: Any, now_s: float) -> None:
        try:
            items = self._converter.items(topic, kind, message, now_s)
        except EvalError as error:
            if topic not in self._refused:
                self._refused.add(topic)
                rospy.logwarn("%s is not shown: %s", topic, error)
            return
        for item in items:
            self._recorder.log(item)
            self.entities.add(item.path)


def main(arguments: list[str] | None = None) -> int:
    """Run to the end.

    Returns:
        0: what there was is shown; 1: it cannot be, and the reason has been reported; 130:
        interrupted.
    """
    options = _parser().parse_args(rospy.myargv(arguments or sys.argv)[1:])
    try:
        topics = _checked(options)
        rospy.init_node("to_rerun", anonymous=True, disable_signals=True)
        recorder = Recorder(options.out, options.viewer)
    except EvalError as error:
        print(f"to_rerun: {error}", file=sys.stderr)
        return 1
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    stream = Stream(recorder, topics)
    code = 0
    try:
        stream.run(options.seconds)
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # what there is is written, however often
        code = _INTERRUPTED
    recorder.close()
    where = f"{options.out}: " if options.out else ""
    text = f"{where}{stream.seconds:.3f} s of simulated time, {len(stream.entities)} entities"
    print(text, flush=True)
    return code


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="to_rerun", description=__doc__)
    parser.add_argument("--out", type=Path, metavar="FILE.rrd", help="record into this file")
    parser.add_argument("--viewer", action="store_true", help="open a viewer on the display")
    parser.add_argument(
        "--seconds",
        type=float,
        default=math.inf,
        metavar="S",
        help="of simulated time; default: until the simulation ends",
    )
    parser.add_argument("--topics", default="", metavar="REGEX", help="only those that match")
    return parser


def _checked(options: argparse.Namespace) -> re.Pattern[str]:
    """The pattern of topics.

    Raises:
        EvalError: an option is wrong; names it, its value and what is legal.
    """
    if options.out is None and not options.viewer:
        raise EvalError("neither --out nor --viewer: there is nowhere to show anything")
    if options.out is not None and options.out.suffix != ".rrd":
        raise EvalError(f"--out {options.out}: suffix '{options.out.suffix}', legal: .rrd")
    if not options.seconds > 0.0:
        raise EvalError(f"--seconds {options.seconds:g}, legal: more than 0")
    try:
        return re.compile(options.topics)
    except re.error as error:
        raise EvalError(f"--topics '{options.topics}', legal: a regex: {error}") from error


if __name__ == "__main__":
    sys.exit(main())
