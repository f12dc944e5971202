# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Hostile messages are the same for a number, huge now and then, and never larger than that."""

from __future__ import annotations

from typing import Any

import pytest
import roslib.message
from trident.testing.fuzz.generator import Generator, serialized
from trident.testing.fuzz.values import HUGE_LENGTH, LONG_TEXT

#: Lists of texts, and of messages that have lists.
KINDS = ("sensor_msgs/JointState", "visualization_msgs/MarkerArray")
MESSAGES = 1000
LARGEST_BYTES = 10_000_000


def made(kind: str) -> list[bytes]:
    generator = Generator(1, now=lambda: 5.0)
    message_class: Any = roslib.message.get_message_class(kind)
    messages = []
    for number in range(MESSAGES):
        generator.begin(number)
        messages.append(serialized(generator.message(message_class)))
    return messages


@pytest.mark.parametrize("kind", KINDS)
def test_a_message_has_at_most_one_huge_part(kind: str) -> None:
    assert max(map(len, made(kind))) < LARGEST_BYTES


def test_some_lists_and_some_texts_are_huge() -> None:
    generator = Generator(1, now=lambda: 5.0)
    message_class: Any = roslib.message.get_message_class("sensor_msgs/JointState")
    lengths, texts = set(), set()
    for number in range(MESSAGES):
        generator.begin(number)
        message = generator.message(message_class)
        lengths |= {len(message.name), len(message.position)}
        texts |= set(message.name)
    assert HUGE_LENGTH in lengths
    assert LONG_TEXT in texts


def test_a_number_makes_the_same_message_again() -> None:
    generator = Generator(1, now=lambda: 5.0)
    message_class: Any = roslib.message.get_message_class("sensor_msgs/JointState")
    for number in range(100):
        generator.begin(number)
        first = serialized(generator.message(message_class))
        generator.begin(number)
        assert serialized(generator.message(message_class)) == first
