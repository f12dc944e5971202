# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Random delays at the hand-overs of rospy: messages, services, connections, locks, timers.

Mostly none, now and then 0.1 to 500 ms. A delay is a function of the seed, the program with its
arguments, the place, and how often the thread was there.
"""

from __future__ import annotations

import functools
import hashlib
import random
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

_SHORT = (1.0 / 100.0, 1e-4, 2e-3)  # one in so many, from and to [s]
_LONG = (1.0 / 2000.0, 2e-3, 0.5)
_OURS = ("trident_",)


class Delays:
    """The delays of one process."""

    def __init__(self, seed: str) -> None:
        """Args: seed of all processes of a run."""
        self._seed = f"{seed}|{' '.join(sys.argv)}"
        self._local = threading.local()

    def of(self, place: str) -> float:
        """The next delay of this thread at a place [s]."""
        visits: dict[str, int] = self._local.__dict__
        visits[place] = visits.get(place, 0) + 1
        text = f"{self._seed}|{place}|{visits[place]}"
        # Not hash(), which differs from process to process.
        digest = hashlib.blake2b(text.encode(), digest_size=8).digest()
        chance = random.Random(int.from_bytes(digest, "big"))
        drawn = chance.random()
        for one_in, low, high in (_LONG, _SHORT):
            if drawn < one_in:
                return float(low * (high / low) ** chance.random())
        return 0.0

    def hand_over(self, place: str) -> None:
        """Sleep for it."""
        delay_s = self.of(place)
        if delay_s > 0.0:
            _sleep(delay_s)


_sleep = time.sleep
_new_lock = threading.Lock


class DelayedLock:
    """A lock that is taken late."""

    def __init__(self, delays: Delays) -> None:
        """Args: delays of the process."""
        self._lock = _new_lock()
        self._delays = delays

    def acquire(self, *words: Any, **options: Any) -> bool:
        """As of threading.Lock."""
        self._delays.hand_over("lock")
        return bool(self._lock.acquire(*words, **options))

    def release(self) -> None:
        """As of threading.Lock."""
        self._lock.release()

    def locked(self) -> bool:
        """As of threading.Lock."""
        return self._lock.locked()

    def __enter__(self) -> bool:
        """As of threading.Lock."""
        return self.acquire()

    def __exit__(self, *_: object) -> None:
        """As of threading.Lock."""
        self.release()


def _delay(delays: Delays, owner: Any, name: str, place: str, after: bool = False) -> None:
    """Have a method of rospy begin late, and end late, too."""
    method: Callable[..., Any] = getattr(owner, name)

    @functools.wraps(method)
    def delayed(*words: Any, **options: Any) -> Any:
        delays.hand_over(place)
        try:
            return method(*words, **options)
        finally:
            if after:
                delays.hand_over(place + ", back")

    setattr(owner, name, delayed)


def install(seed: str) -> None:
    """Change rospy in this process, if it has it.

    Args:
        seed: of all processes of the run.
    """
    try:
        from rospy import topics
        from rospy.impl import tcpros_service
    except ImportError:
        return
    delays = Delays(seed)
    _delay(delays, topics._SubscriberImpl, "receive_callback", "message")
    _delay(delays, topics._SubscriberImpl, "add_connection", "publisher found", after=True)
    _delay(delays, topics._PublisherImpl, "add_connection", "subscriber found", after=True)
    _delay(delays, topics._PublisherImpl, "publish", "publish", after=True)
    _delay(delays, tcpros_service.ServiceProxy, "call", "service", after=True)
    _delay(delays, threading.Event, "wait", "timer", after=True)

    def lock() -> Any:
        caller = sys._getframe(1).f_globals.get("__name__", "")
        return DelayedLock(delays) if caller.startswith(_OURS) else _new_lock()

    threading.Lock = lock  # type: ignore[assignment]
