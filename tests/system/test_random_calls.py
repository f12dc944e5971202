# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Ten thousand random service calls, sensible and senseless, against vehicles in flight."""

from __future__ import annotations

import random
import re
from collections import Counter
from collections.abc import Callable
from typing import Any

import genpy
import pytest
import roslib.message
import rospy
import rosservice
from harness import Gazebo, Ros, box_sdf, eventually, pose, vehicle_urdf

CALLS = 10_000
WARM_UP_CALLS = 2_000
#: Memory that may be added after the warm-up [MB]; a leak of 2 kB a call would be 16 MB.
MAX_GROWTH_MB = 12.0
VEHICLES = ("UAV1", "UAV2")
#: A source that enrols holds the world for its set-points, and these calls never send one.
LEFT_OUT = ("enroll_source", "get_loggers", "set_logger_level")
LOG_LINE = re.compile(r"^(\x1b\[[0-9;]*m)*\[ *(INFO|WARN|ERROR|FATAL|DEBUG)\]")

StartGazebo = Callable[..., Gazebo]


class RandomRequests:
    """Requests of any type, of which each field is sometimes sensible.

    Args:
        seed: of the random numbers.
        names: of models, links and frames that exist.
    """

    def __init__(self, seed: int, names: list[str]) -> None:
        self.random = random.Random(seed)
        self.texts = [
            *names,
            *names,
            "",
            "world",
            "no_such",
            "ünï\ncode",
            "x" * 500,
            "UAV1::",
            "::",
        ]
        self.texts += [box_sdf("box"), vehicle_urdf("UAV1")[:3000], "<sdf/>", "<robot name='r'/>"]
        self.numbers = [0.0, 1.0, -1.0, 0.01, 1e-9, 1e300, float("nan"), float("inf")]

    def fill(self, message: genpy.Message) -> genpy.Message:
        """Gives each field a random value, and returns the message."""
        for name, kind in zip(message.__slots__, message._slot_types, strict=True):
            setattr(message, name, self.value(kind))
        return message

    def value(self, kind: str) -> Any:
        """A value of a field type, ``float64[3]`` say."""
        array = re.fullmatch(r"(.*)\[(\d*)\]", kind)
        if array:
            count = int(array[2]) if array[2] else self.random.choice((0, 1, 1, 2, 40))
            values = [self.value(array[1]) for _ in range(count)]
            return bytes(v & 255 for v in values) if array[1] == "uint8" else values
        if kind == "string":
            return self.random.choice(self.texts)
        if kind.startswith("float"):
            return self.random.choice(
                (self.random.uniform(-2, 2), self.random.choice(self.numbers))
            )
        if kind == "bool":
            return self.random.random() < 0.5
        if kind in ("time", "duration"):
            stamp = {"time": genpy.Time, "duration": genpy.Duration}[kind]
            return stamp(self.random.choice((0, 0, 1, 2**31 - 1)), self.random.randrange(10**9))
        if re.fullmatch(r"u?int\d+|byte|char", kind):
            return self.random.choice((0, 1, 2, 7, 100, 127))
        return self.fill(roslib.message.get_message_class(kind)())


def services_of(ros: Ros) -> dict[str, Any]:
    """A persistent proxy of each service of the server."""
    names = [name for name in rosservice.get_service_list() if name.startswith("/gazebo/")]
    names = [name for name in names if name.rsplit("/", 1)[1] not in LEFT_OUT]
    return {
        name: rospy.ServiceProxy(name, rosservice.get_service_class_by_name(name), persistent=True)
        for name in names
    }


def memory_mb(process_id: int) -> float:
    """Memory of a process that is resident [MB]."""
    with open(f"/proc/{process_id}/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * 4096 / 2**20


def outcome(proxy: Any, requests: RandomRequests) -> tuple[bool, str]:
    """Whether a random call succeeded, and what was said."""
    response_class = proxy.service_class._response_class
    try:
        response = proxy(requests.fill(proxy.request_class()))
    except rospy.ServiceException:
        if response_class.__slots__:
            raise
        return False, "an empty response has no words, the log does"
    words = getattr(response, "status_message", "") or getattr(response, "message", "")
    return bool(getattr(response, "success", True)), words


def refresh(gazebo: Gazebo) -> None:
    """The world as it was: running, with both vehicles."""
    for name in VEHICLES:
        if not gazebo.call("get_model_state", model_name=name).success:
            gazebo.spawn(name, at=pose(0.0, 4.0 * VEHICLES.index(name), 0.1))
    gazebo.ask("unpause_physics")


def forget_strangers(gazebo: Gazebo) -> None:
    """Deletes what random spawns have left."""
    for name in gazebo.ask("get_world_properties").model_names:
        if name not in (*VEHICLES, "ground_plane"):
            gazebo.ask("delete_model", model_name=name)


@pytest.mark.parametrize("seed", [20261121])
def test_random_calls_neither_crash_nor_leak_nor_chatter(
    ros: Ros, start_gazebo: StartGazebo, seed: int
) -> None:
    gazebo = start_gazebo()
    refresh(gazebo)
    controllers = [gazebo.controller(name) for name in VEHICLES]
    names = [*VEHICLES, "ground_plane", *(f"{name}::{name}/base_link" for name in VEHICLES), "box"]
    requests = RandomRequests(seed, names)
    proxies = services_of(ros)
    assert len(proxies) > 15
    outcomes: Counter[tuple[str, bool]] = Counter()
    before_mb = 0.0
    for call in range(CALLS):
        if call % 200 == 0:
            forget_strangers(gazebo)
            refresh(gazebo)
        if call == WARM_UP_CALLS:
            before_mb = memory_mb(gazebo.process.family()[0])
        name = requests.random.choice(sorted(proxies))
        success, words = outcome(proxies[name], requests)
        outcomes[name, success] += 1
        assert success or words, f"{name} failed without a word"
        assert "\n" not in words.strip(), f"{name} said more than a line: {words}"
    assert gazebo.process.running, gazebo.log
    forget_strangers(gazebo)
    assert memory_mb(gazebo.process.family()[0]) - before_mb < MAX_GROWTH_MB
    lines = [line for line in gazebo.log.splitlines() if line.strip()]
    strange = [line for line in lines if not LOG_LINE.match(line)]
    assert not strange, "\n".join(strange[:10])
    failures = sum(count for (_, success), count in outcomes.items() if not success)
    assert failures > CALLS / 20, "the calls were all sensible"
    assert sum(outcomes.values()) - failures > CALLS / 20, "no call was sensible"

    gazebo.ask("reset_simulation")
    refresh(gazebo)
    begin = gazebo.time()
    eventually(lambda: gazebo.time() > begin, "the world continues")
    assert all(controller.running for controller in controllers)
