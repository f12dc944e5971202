# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Worlds of radios that always have something to send."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import trident_sim

IP_UDP_BYTES = 28
_STEP_S = 0.01
_QUEUE_BYTES = 1_000_000

_WORLD = """<sdf version="1.6"><world name="air"><gravity>0 0 0</gravity>
<physics type="ode"><max_step_size>{step}</max_step_size></physics>
<plugin name="air" filename="libtrident_radio_medium.so"><path>free_space</path>
<shadowing_sigma>{sigma}</shadowing_sigma></plugin></world></sdf>"""

_RADIO = """<sdf version="1.6"><model name="radio"><link name="base"><gravity>0</gravity></link>
<plugin name="radio" filename="libtrident_radio.so">{elements}</plugin></model></sdf>"""


def radio_world(
    places: Mapping[str, tuple[float, float]],
    elements: Mapping[str, object],
    shadowing: float = 0.0,
) -> trident_sim.World:
    """A world in free space with a radio at each place.

    Args:
        places: x and y of each radio by name [m].
        elements: of libtrident_radio.so, for all of them.
        shadowing: its standard deviation [dB].
    """
    world = trident_sim.World(_WORLD.format(step=_STEP_S, sigma=shadowing), seed=1)
    text = "".join(f"<{key}>{value}</{key}>" for key, value in elements.items())
    for name, (x, y) in places.items():
        world.spawn(name, sdf=_RADIO.format(elements=text), pose=(x, y, 1.0))
    return world


def circle(count: int, radius: float) -> dict[str, tuple[float, float]]:
    """A sink in the middle of a circle of sources.

    Args:
        count: of the sources.
        radius: [m].
    """
    places = {"sink": (0.0, 0.0)}
    for i in range(count):
        angle = 2 * math.pi * i / count
        places[f"source{i:02d}"] = (radius * math.cos(angle), radius * math.sin(angle))
    return places


def goodput(
    world: trident_sim.World,
    sources: Sequence[str],
    payload: int,
    seconds: float,
    warm_up: float = 0.0,
) -> float:
    """What comes to `sink` from sources that always have something to send.

    Args:
        world: of radio_world().
        sources: names of radios.
        payload: bytes of a UDP datagram; its headers come on top.
        seconds: simulated time that counts.
        warm_up: simulated time before it.

    Returns:
        [Mbit/s] of payload.
    """
    data = bytes(payload + IP_UDP_BYTES)
    received = 0
    before, steps = round(warm_up / _STEP_S), round((warm_up + seconds) / _STEP_S)
    for step in range(steps):
        for source in sources:
            while world.radio.send(source, "sink", data):
                pass
        world.step()
        heard = len(world.radio.receive("sink"))
        received += heard if step >= before else 0
    return 8e-6 * received * payload / seconds


def saturating(mcs: int | str, width: int, max_ampdu: int) -> dict[str, object]:
    """Elements of a radio for a measurement of goodput."""
    return {
        "rate": mcs,
        "width": width,
        "max_ampdu": max_ampdu,
        "queue_bytes": _QUEUE_BYTES,
        "height": 0,
    }
