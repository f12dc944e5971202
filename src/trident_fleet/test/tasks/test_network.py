# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools

import pytest
from trident_fleet.core.network import Bursts, Channel, LinkModel


def heard(model: LinkModel, count: int, seed: int = 1, step_s: float = 0.0) -> list[int]:
    """What b receives of numbered messages from a."""
    channel: Channel[int] = Channel(["a", "b"], model, seed)
    one, other = channel.port("a"), channel.port("b")
    got = []
    for number in range(count):
        one.send(number, "b")
        channel.advance(channel.now() + step_s)
        got += [envelope.message for envelope in other.receive()]
    channel.advance(channel.now() + 10.0)
    return got + [envelope.message for envelope in other.receive()]


def test_loss_and_doubles_are_as_asked() -> None:
    got = heard(LinkModel(loss=0.3, double=0.1), 4000)
    assert len(set(got)) / 4000 == pytest.approx(0.7, abs=0.03)
    assert len(got) / len(set(got)) == pytest.approx(1.1, abs=0.02)


def test_messages_overtake_one_another_and_come_all() -> None:
    got = heard(LinkModel(), 100)
    assert sorted(got) == list(range(100))
    assert got != sorted(got)


def test_same_seed_same_fate() -> None:
    model = LinkModel(loss=0.4, double=0.2, late=0.1)
    assert heard(model, 200) == heard(model, 200)
    assert heard(model, 200) != heard(model, 200, seed=2)


def test_bursts_lose_in_a_row_and_as_much_as_their_states_say() -> None:
    bursts = Bursts(mean_good_s=8.0, mean_bad_s=2.0, bad_loss=1.0)
    got = set(heard(LinkModel(bursts=bursts), 20000, step_s=0.1))
    lost = [number not in got for number in range(20000)]
    assert sum(lost) / 20000 == pytest.approx(0.2, abs=0.03)
    after_loss = [second for first, second in itertools.pairwise(lost) if first]
    assert sum(after_loss) / len(after_loss) == pytest.approx(0.96, abs=0.02)


def test_the_dead_and_the_parted_hear_nothing() -> None:
    channel: Channel[str] = Channel(["a", "b", "c"], LinkModel(), 1)
    ports = {name: channel.port(name) for name in "abc"}

    def say(text: str) -> dict[str, list[str]]:
        ports["a"].send(text)
        channel.advance(channel.now() + 1.0)
        return {
            name: [envelope.message for envelope in port.receive()] for name, port in ports.items()
        }

    assert say("all") == {"a": [], "b": ["all"], "c": ["all"]}
    channel.split(["a", "b"], ["c"])
    assert say("parted") == {"a": [], "b": ["parted"], "c": []}
    channel.crash("b")
    channel.heal()
    assert say("dead") == {"a": [], "b": [], "c": ["dead"]}
    channel.restart("b")
    assert say("again") == {"a": [], "b": ["again"], "c": ["again"]}


def test_who_is_out_of_reach_hears_nothing() -> None:
    channel: Channel[str] = Channel(
        ["a", "b"], LinkModel(), 1, reach=lambda source, destination, now_s: now_s > 1.0
    )
    one, other = channel.port("a"), channel.port("b")
    one.send("near")
    channel.advance(0.5)
    assert other.receive() == []
    channel.advance(2.0)
    one.send("later")
    channel.advance(3.0)
    assert [envelope.message for envelope in other.receive()] == ["later"]
