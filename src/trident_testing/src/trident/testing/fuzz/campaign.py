# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Some thousand hostile messages to one node, and what became of it."""

from __future__ import annotations

import time
import warnings
from collections import Counter, deque
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from concurrent.futures import TimeoutError as OutOfTime
from dataclasses import dataclass, field
from typing import Any

import genpy
import rospy

from trident.testing.fuzz.finite import non_finite
from trident.testing.fuzz.generator import Generator, serialized
from trident.testing.fuzz.target import Target
from trident.testing.waiting import eventually

_LARGEST_CHECKED = 4_000_000  # bytes of a message that is searched for numbers that are not finite
_CONNECTION_LIMIT_S = 20.0
_CALL_LIMIT_S = 60.0  # wall time within which a service answers
_REMEMBERED = 12
# What a service proxy raises: a refusal by the node, or a connection that is lost.
_CALL_ERRORS = (
    rospy.ServiceException,
    rospy.ROSException,
    rospy.exceptions.ROSInternalException,
    OSError,
)


@dataclass(frozen=True)
class CampaignOptions:
    """How to treat a node.

    Attributes:
        messages: how many, with the calls of services.
        first: number of the first one.
        seed: of all of them.
        service_share: part of them that are calls, of a node that has topics and services.
        batch: messages after which the node may catch up, so that queues do not drop them.
        words: strings that mean something to the node.
        most_memory_mib: that it may grow by.
    """

    messages: int = 10_000
    first: int = 0
    seed: int = 1
    service_share: float = 0.1
    batch: int = 5
    words: tuple[str, ...] = ()
    most_memory_mib: float = 1000.0


@dataclass
class Findings:
    """What a campaign has found.

    Attributes:
        problems: in words; none: the node has stood it.
        sent: messages by topic or service.
        refused: calls by service that failed or answered success = false.
        heard: messages that the node published meanwhile, by topic.
        seconds: wall time of it.
    """

    problems: list[str] = field(default_factory=list)
    sent: Counter[str] = field(default_factory=Counter)
    refused: Counter[str] = field(default_factory=Counter)
    heard: Counter[str] = field(default_factory=Counter)
    seconds: float = 0.0

    def add(self, problem: str) -> None:
        """Note a problem, the first ones of many."""
        if len(self.problems) < 20:
            self.problems.append(problem)

    def text(self) -> str:
        """All of it for a reader."""
        lines = [f"{sum(self.sent.values())} messages in {self.seconds:.1f} s"]
        lines += [f"  {name}: {count} sent" for name, count in sorted(self.sent.items())]
        lines += [f"  {name}: {count} refused" for name, count in sorted(self.refused.items())]
        lines += [f"  {name}: {count} heard" for name, count in sorted(self.heard.items())]
        return "\n".join([*lines, *(f"PROBLEM {problem}" for problem in self.problems)])


def _is_refusal(response: Any) -> bool:
    """Of services that say so in their answer: nav_msgs/LoadMap has a `result` other than 0."""
    return not getattr(response, "success", True) or getattr(response, "result", 0) != 0


def _publisher(topic: str, kind: type[genpy.Message]) -> rospy.Publisher:
    """One without a queue: messages go out in the calling thread and in order."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return rospy.Publisher(topic, kind, queue_size=None, tcp_nodelay=True)


class Campaign:
    """Sends to a node, listens to it, and watches its process."""

    def __init__(
        self,
        target: Target,
        options: CampaignOptions,
        examples: Mapping[str, genpy.Message] | None = None,
        meanwhile: Callable[[], None] | None = None,
    ) -> None:
        """Find out what the node listens to, and connect.

        Args:
            target: the node.
            options: how to treat it.
            examples: sane messages and requests by topic or service. Most of what is sent there
                are copies with a few fields changed: they get farther into a program than what is
                random throughout.
            meanwhile: called after every batch, to send what keeps the node at work.

        Raises:
            LookupError: it listens to nothing.
        """
        self._target = target
        self._options = options
        self._generator = Generator(options.seed, options.words, lambda: rospy.get_time())
        self._findings = Findings()
        self._meanwhile = meanwhile
        self._last: deque[str] = deque(maxlen=_REMEMBERED)
        self._services = target.services()
        self._kinds = target.subscriptions()
        if not self._kinds and not self._services:
            raise LookupError(f"node {target.name} has neither subscribers nor services")
        self._topics = sorted(self._kinds)
        self._service_names = sorted(self._services)
        self._examples = {name: serialized(message) for name, message in (examples or {}).items()}
        unknown = set(self._examples) - set(self._topics) - set(self._service_names)
        assert not unknown, f"{target.name} does not listen to {sorted(unknown)}"

    def run(self) -> Findings:
        """Send everything; what was found."""
        begin, memory = time.monotonic(), self._target.memory_mib
        listeners = self._listen()
        publishers = {topic: _publisher(topic, kind) for topic, kind in self._kinds.items()}
        self._proxies = {name: self._proxy(name) for name in self._service_names}
        self._caller = ThreadPoolExecutor(1)
        try:
            self._connect(publishers)
            self._send_all(publishers, memory)
            self._target.settle()
            self._check_life()
        finally:
            for link in [*listeners, *publishers.values()]:
                link.unregister()
            for proxy in self._proxies.values():
                proxy.close()
            self._caller.shutdown(wait=False)
        self._check_memory(memory)
        self._findings.seconds = time.monotonic() - begin
        return self._findings

    def _send_all(self, publishers: dict[str, rospy.Publisher], memory: float) -> None:
        for number in range(self._options.first, self._options.first + self._options.messages):
            if not self._send(number, publishers):
                break
            if number % self._options.batch == 0:
                if self._meanwhile is not None:
                    self._meanwhile()
                self._target.settle()
            if number % 100 == 0:
                self._check_memory(memory)

    def _connect(self, publishers: dict[str, rospy.Publisher]) -> None:
        """Wait for the node on every topic; drop those that it has closed meanwhile."""
        for topic, publisher in list(publishers.items()):

            def is_settled(topic: str = topic, publisher: rospy.Publisher = publisher) -> bool:
                return self._is_connected(publisher) or topic not in self._target.subscriptions()

            eventually(is_settled, topic, _CONNECTION_LIMIT_S)
            if not self._is_connected(publisher):
                publishers.pop(topic).unregister()
                self._topics.remove(topic)

    def _is_connected(self, publisher: rospy.Publisher) -> bool:
        assert self._target.is_alive, f"{self._target.name} has ended"
        return any(link.endpoint_id == self._target.name for link in publisher.impl.connections)

    def _listen(self) -> list[rospy.Subscriber]:
        return [
            rospy.Subscriber(topic, rospy.AnyMsg, self._hear, (topic, kind))
            for topic, kind in self._target.publications().items()
        ]

    def _hear(self, raw: Any, which: tuple[str, type[genpy.Message]]) -> None:
        topic, kind = which
        if raw._connection_header.get("callerid") != self._target.name:
            return
        self._findings.heard[topic] += 1
        if len(raw._buff) > _LARGEST_CHECKED:
            return
        problem = non_finite(kind().deserialize(raw._buff))
        if problem:
            self._findings.add(f"{topic}: {problem}; {self._after()}")

    def _after(self) -> str:
        return "after " + ", ".join(self._last)

    def _proxy(self, name: str) -> rospy.ServiceProxy:
        return rospy.ServiceProxy(name, self._services[name], persistent=True)

    def _send(self, number: int, publishers: Mapping[str, rospy.Publisher]) -> bool:
        """False: the node has died, or hangs."""
        random = self._generator.begin(number)
        is_call = not self._topics or random.random() < self._options.service_share
        if is_call and self._service_names:
            name = random.choice(self._service_names)
            request = self._made(name, self._services[name]._request_class)
            return self._call(number, name, request)
        topic = random.choice(self._topics)
        message = self._made(topic, self._kinds[topic])
        self._note(number, topic)
        try:
            publishers[topic].publish(message)
        except (rospy.ROSException, OSError):
            return self._check_life()
        return number % 20 != 0 or self._check_life()

    def _made(self, name: str, kind: type[genpy.Message]) -> Any:
        example = self._examples.get(name)
        if example is None or self._generator.chance(0.2):
            return self._generator.message(kind)
        return self._generator.mutated(example, kind)

    def _note(self, number: int, name: str) -> None:
        self._findings.sent[name] += 1
        self._last.append(f"{number} {name}")

    def _call(self, number: int, name: str, request: Any) -> bool:
        self._note(number, name)
        try:
            response = self._caller.submit(self._ask, name, request).result(_CALL_LIMIT_S)
        except OutOfTime:
            self._findings.add(f"{name} gave no answer within {_CALL_LIMIT_S:g} s; {self._after()}")
            return False
        if response is None or _is_refusal(response):
            self._findings.refused[name] += 1
        problem = non_finite(response) if response is not None else ""
        if problem:
            self._findings.add(f"answer of {name}: {problem}; {self._after()}")
        return self._check_life()

    def _ask(self, name: str, request: Any) -> Any:
        """The response; None if the node refuses the call or the connection is lost."""
        try:
            return self._proxies[name](request)
        except _CALL_ERRORS:
            # A persistent proxy keeps a transport that is closed: the next call needs a new one.
            self._proxies[name].close()
            self._proxies[name] = self._proxy(name)
            return None

    def _check_life(self) -> bool:
        if self._target.is_alive:
            return True
        problem = f"{self._target.name} has died; {self._after()}"
        if not any(
            known.startswith(f"{self._target.name} has died") for known in self._findings.problems
        ):
            self._findings.add(problem)
        return False

    def _check_memory(self, before: float) -> None:
        grown = self._target.memory_mib - before
        if grown > self._options.most_memory_mib and not any(
            "has grown" in known for known in self._findings.problems
        ):
            self._findings.add(f"{self._target.name} has grown by {grown:.0f} MiB; {self._after()}")
