# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Services that answer what nobody counts on, for nodes that only ask."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Mapping
from types import TracebackType
from typing import Any

import genpy
import rospy

from trident.testing.fuzz.finite import non_finite
from trident.testing.fuzz.generator import Generator, serialized


class HostileServer:
    """Offers services while it is entered; answer number i of a seed is always the same.

    Attributes:
        answered: calls by service.
        problems: numbers in requests that are not finite, in words.
    """

    def __init__(
        self,
        services: Mapping[str, Any],
        seed: int = 1,
        examples: Mapping[str, genpy.Message] | None = None,
        words: tuple[str, ...] = (),
    ) -> None:
        """Nothing is offered yet.

        Args:
            services: their classes by name.
            seed: of all answers.
            examples: sane answers by service; most answers there are copies with a few fields
                changed.
            words: strings that mean something to who asks.
        """
        self.answered: Counter[str] = Counter()
        self.problems: list[str] = []
        self._kinds = dict(services)
        self._examples = {name: serialized(message) for name, message in (examples or {}).items()}
        self._generator = Generator(seed, words, lambda: rospy.get_time())
        self._lock = threading.Lock()
        self._offered: list[rospy.Service] = []

    def __enter__(self) -> HostileServer:
        """Offer them."""
        self._offered = [
            rospy.Service(name, kind, lambda request, name=name: self._answer(name, request))
            for name, kind in self._kinds.items()
        ]
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Offer them no more."""
        for service in self._offered:
            service.shutdown()

    def _answer(self, name: str, request: genpy.Message) -> Any:
        with self._lock:
            problem = non_finite(request)
            if problem and len(self.problems) < 20:
                self.problems.append(f"request to {name}: {problem}")
            self._generator.begin(self.answered.total())
            self.answered[name] += 1
            kind = self._kinds[name]._response_class
            example = self._examples.get(name)
            if example is None or self._generator.chance(0.2):
                return self._generator.message(kind)
            return self._generator.mutated(example, kind)
