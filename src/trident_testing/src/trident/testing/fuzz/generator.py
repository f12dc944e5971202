# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Random messages of any type, by its definition."""

from __future__ import annotations

import io
import math
import random
import time
from collections.abc import Callable, Sequence
from typing import Any

import genmsg.msgs
import genpy
import roslib.message

from trident.testing.fuzz import values

Make = Callable[[], Any]

#: Of a message's fields that are hostile: some hide a single one among what is plausible.
_RATES = (0.02, 0.1, 0.3, 1.0)
_PLAUSIBLE_LENGTHS = (0, 1, 2, 3, 5, 90)
_HUGE_SHARE = 0.02  # of hostile lengths and texts
#: Not those of a robot: who moves its frames about is obeyed.
_FRAMES = ("some_frame", "other_frame")


class Generator:
    """Message number i of a seed is always the same, but for stamps of now.

    Attributes:
        words: what strings are chosen from where they are plausible: frames, names of things.
    """

    def __init__(self, seed: int, words: Sequence[str] = (), now: Callable[[], float] = time.time):
        """Begin at message 0.

        Args:
            seed: of all that is random.
            words: what strings are chosen from where they are plausible.
            now: the clock of plausible stamps [s].
        """
        self.words = [*_FRAMES, *words]
        self._seed = seed
        self._now = now
        self._random = random.Random(seed)
        self._rate = 0.0
        self._has_huge = False
        self._makers: dict[str, Make] = {}

    def begin(self, number: int) -> random.Random:
        """Start message `number`; its random numbers."""
        self._random.seed(self._seed * 1_000_003 + number)
        self._rate = self._random.choice(_RATES)
        self._has_huge = False
        return self._random

    def chance(self, share: float) -> bool:
        """True in this part of all cases."""
        return self._random.random() < share

    def message(self, kind: type[genpy.Message]) -> Any:
        """A message, or a request of a service, made from its definition alone."""
        message = kind()
        for name, type_name in zip(message.__slots__, message._slot_types, strict=True):
            setattr(message, name, self._maker(type_name)())
        return message

    def mutated(self, example: bytes, kind: type[genpy.Message]) -> Any:
        """A serialized example with some of its fields replaced; stamps are of now unless hit."""
        message = kind().deserialize(example)
        self.stamp(message)
        for _ in range(self._random.choice((0, 1, 1, 1, 2, 5))):
            self._hit(message)
        return message

    def stamp(self, message: Any) -> None:
        """Set all stamps of headers to now."""
        for name, type_name in zip(message.__slots__, message._slot_types, strict=True):
            value = getattr(message, name)
            if type_name == "std_msgs/Header":
                value.stamp = self._stamp_now()
            elif isinstance(value, genpy.Message):
                self.stamp(value)
            elif _are_messages(value):
                for item in value:
                    self.stamp(item)

    def _hit(self, message: Any) -> None:
        """Replace one field somewhere in a message."""
        slots = list(zip(message.__slots__, message._slot_types, strict=True))
        if not slots:
            return
        name, type_name = self._random.choice(slots)
        value = getattr(message, name)
        if isinstance(value, genpy.Message) and self._random.random() < 0.9:
            self._hit(value)
        elif _are_messages(value) and self._random.random() < 0.8:
            self._hit(self._random.choice(value))
        else:
            setattr(message, name, self._replaced(value, type_name))

    def _replaced(self, value: Any, type_name: str) -> Any:
        """Another value of a field; of a list mostly the same with another item."""
        if isinstance(value, (list, tuple)) and value and self._random.random() < 0.7:
            items = list(value)
            base, _, _ = genmsg.msgs.parse_type(type_name)
            items[self._random.randrange(len(items))] = self._hostile(base)
            return items
        return self._hostile(type_name)

    def _hostile(self, type_name: str) -> Any:
        rate, self._rate = self._rate, 1.0
        value = self._maker(type_name)()
        self._rate = rate
        return value

    def _maker(self, type_name: str) -> Make:
        if type_name not in self._makers:
            base, is_array, length = genmsg.msgs.parse_type(type_name)
            if is_array:
                self._makers[type_name] = self._array_maker(base, length)
            else:
                self._makers[type_name] = self._single_maker(base)
        return self._makers[type_name]

    def _single_maker(self, kind: str) -> Make:
        if kind in ("float64", "float32"):
            hostile = values.DOUBLES if kind == "float64" else values.SINGLES
            return self._either(hostile, lambda: self._random.gauss(0.0, 3.0))
        if kind == "bool":
            return lambda: self._random.random() < 0.5
        if values.is_whole_number(kind):
            plausible = lambda: values.fits(kind, self._random.randint(0, 5))  # noqa: E731
            return self._either(values.whole_numbers(kind), plausible)
        makers: dict[str, Make] = {
            "string": self._text,
            "time": self._time,
            "duration": self._duration,
            "geometry_msgs/Quaternion": self._quaternion,
        }
        if kind in makers:
            return makers[kind]
        kind = "std_msgs/Header" if kind == "Header" else kind
        message_class = roslib.message.get_message_class(kind)
        assert message_class is not None, f"there is no message {kind}"
        return lambda: self.message(message_class)

    def _either(self, hostile: Sequence[Any], plausible: Make) -> Make:
        def make() -> Any:
            if self._random.random() < self._rate:
                return self._random.choice(hostile)
            return plausible()

        return make

    def _array_maker(self, base: str, length: int | None) -> Make:
        if base in ("uint8", "char"):
            return lambda: self._random.randbytes(self._length(length, is_plain=True))
        single, is_plain = self._maker(base), genmsg.msgs.is_builtin(base)

        def make() -> list[Any]:
            count = self._length(length, is_plain)
            if count <= 1000:
                return [single() for _ in range(count)]
            few = [single() for _ in range(100)]
            return few * (count // 100)

        return make

    def _length(self, fixed: int | None, is_plain: bool) -> int:
        if fixed is not None:
            return fixed
        if self._random.random() < self._rate:
            if self._may_be_huge():
                return values.HUGE_LENGTH if is_plain else values.HUGE_FEW_LENGTH
            return self._random.choice(values.LENGTHS if is_plain else values.FEW_LENGTHS)
        return self._random.choice(_PLAUSIBLE_LENGTHS if is_plain else _PLAUSIBLE_LENGTHS[:-1])

    def _may_be_huge(self) -> bool:
        """Once in a message: 10^5 texts of 50 kB each only measure how fast memory is copied."""
        if self._has_huge or self._random.random() >= _HUGE_SHARE:
            return False
        self._has_huge = True
        return True

    def _text(self) -> str:
        if self._random.random() < self._rate:
            if self._may_be_huge():
                return values.LONG_TEXT
            return self._random.choice(values.TEXTS)
        return self._random.choice(self.words)

    def _time(self) -> genpy.Time:
        if self._random.random() < self._rate:
            return _with_parts(genpy.Time(), self._random.choice(values.STAMPS))
        return self._stamp_now()

    def _stamp_now(self) -> genpy.Time:
        return genpy.Time.from_sec(max(0.0, self._now()))

    def _duration(self) -> genpy.Duration:
        if self._random.random() < self._rate:
            return _with_parts(genpy.Duration(), self._random.choice(values.DURATIONS))
        return genpy.Duration.from_sec(self._random.uniform(0.0, 2.0))

    def _quaternion(self) -> Any:
        message = roslib.message.get_message_class("geometry_msgs/Quaternion")()
        if self._random.random() < self._rate:
            for name in message.__slots__:
                setattr(message, name, self._random.choice(values.DOUBLES))
            return message
        half = self._random.uniform(-1.6, 1.6)
        message.z, message.w = math.sin(half), math.cos(half)
        return message


def _are_messages(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], genpy.Message)


def _with_parts(value: Any, parts: tuple[int, int]) -> Any:
    """Seconds and nanoseconds as they are on the wire: constructors put them right."""
    value.secs, value.nsecs = parts
    return value


def serialized(message: genpy.Message) -> bytes:
    """As on the wire."""
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
