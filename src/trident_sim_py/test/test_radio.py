# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import pytest

import trident_sim

AIR = '<plugin name="air" filename="libtrident_radio_medium.so"/>'
ROBOT = """<sdf version="1.6"><model name="{name}"><link name="base">
<gravity>0</gravity></link><plugin name="radio" filename="libtrident_radio.so">{more}</plugin>
</model></sdf>"""


def two_robots(distance: float, more: str = "", seed: int = 1) -> trident_sim.World:
    world = trident_sim.World(f'<sdf version="1.6"><world name="w">{AIR}</world></sdf>', seed=seed)
    for name, x in (("a", 0.0), ("b", distance)):
        world.spawn(name, sdf=ROBOT.format(name=name, more=more), pose=(x, 0.0, 1.0))
    return world


def test_a_message_arrives_with_its_times() -> None:
    world = two_robots(40.0)
    assert world.radio.names == ["a", "b"]
    assert world.radio.send("a", "b", b"\x00\xff", priority=0, deadline=1.0)
    world.step(10)
    (message,) = world.radio.receive("b")
    assert (message.source, message.data, message.sent) == ("a", b"\x00\xff", 0.0)
    assert 0.0002 < message.received < 0.001
    assert world.radio.receive("b") == []


def test_links_say_how_well_and_how_much() -> None:
    world = two_robots(40.0)
    for _ in range(20):
        world.radio.send("a", "b", b"x" * 500)
    world.step(100)
    world.radio.send("b", "all", b"hello")
    world.step(10)
    there, back = world.radio.links()
    assert (there.source, there.destination, there.sent, there.delivered) == ("a", "b", 20, 20)
    assert there.distance == pytest.approx(40.0)
    assert there.snr == pytest.approx(back.snr)
    assert 0.0 < there.mean_delay < 0.1
    assert [m.data for m in world.radio.receive("a")] == [b"hello"]


def test_an_outage_ends_a_link() -> None:
    world = two_robots(40.0)
    world.radio.set_outage("b", True)
    world.radio.send("a", "b", b"x")
    world.step(1000)
    assert world.radio.receive("b") == []
    assert world.radio.links()[0].loss == math.inf
    assert world.radio.links()[0].lost == 1


def test_two_radios_that_are_cut_off_from_each_other_hear_a_third() -> None:
    world = two_robots(40.0)
    world.spawn("c", sdf=ROBOT.format(name="c", more=""), pose=(20.0, 0.0, 1.0))
    world.radio.set_outage("a", True, "b")
    for name in ("b", "c"):
        world.radio.send("a", name, b"x")
    world.step(100)
    assert [len(world.radio.receive(name)) for name in ("b", "c")] == [0, 1]
    with pytest.raises(trident_sim.Error, match="has no link to itself"):
        world.radio.set_outage("a", True, "a")
    world.radio.set_outage("a", False, "b")
    world.radio.send("a", "b", b"x")
    world.step(100)
    assert len(world.radio.receive("b")) == 1


def test_the_same_seed_delivers_the_same() -> None:
    def run(seed: int) -> list[bytes]:
        world = two_robots(2500.0, "<rate>2</rate><tries>1</tries>", seed)
        for i in range(300):
            world.radio.send("a", "b", str(i).encode())
            world.step(2)
        return [m.data for m in world.radio.receive("b")]

    assert run(1) == run(1)
    assert any(run(1) != run(seed) for seed in (2, 3, 4))


def test_bad_input_is_one_error() -> None:
    world = two_robots(40.0)
    with pytest.raises(trident_sim.Error, match="radio 'c'; did you mean"):
        world.radio.send("a", "c", b"x")
    with pytest.raises(trident_sim.Error, match="priority is 7, legal: 0 to 3"):
        world.radio.send("a", "b", b"x", priority=7)
    with pytest.raises(trident_sim.Error, match="a message has 20000 bytes"):
        world.radio.send("a", "b", b"x" * 20000)
    empty = trident_sim.World('<sdf version="1.6"><world name="w"/></sdf>')
    with pytest.raises(trident_sim.Error, match="has no radios"):
        _ = empty.radio
