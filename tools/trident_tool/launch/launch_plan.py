# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a launch file is going to start: known, and checked, before anything is started."""

from __future__ import annotations

import json
import shlex
import subprocess
import xmlrpc.client
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trident_tool.workspace import TridentError

_LOADER = Path(__file__).with_name("load_launch.py")
_SIMULATOR = "gazebo_ros"
_SIMULATOR_TYPES = frozenset({"gzserver", "gazebo", "debug", "perf"})
_SPAWNERS = frozenset({"spawn_model", "spawn_model.py"})
_FLEET_SPAWNER = ("trident_fleet", "spawn_fleet.py")
# Its command makes the world as roslaunch loads the file: it cannot be checked before.
_WORLD_MAKER = "/world_maker"
_MOTOR_TOPIC = "command/motor_speed"
# A launch file of these alone spawns by its spawners and by nothing else.
_NO_SPAWNERS = frozenset(
    {
        "gazebo_ros",
        "joint_state_publisher",
        "robot_state_publisher",
        "rosbag",
        "rotors_control",
        "rotors_gazebo",
        "rotors_teleop",
        "rviz",
        "tf",
        "tf2_ros",
        "topic_tools",
        "trident_control",
        "trident_fleet",
        "trident_nav",
    }
)


@dataclass(frozen=True)
class LaunchNode:
    """One node of a launch file, after substitution.

    Attributes:
        name: its full name.
        namespace: it is in, with a slash at the end.
        package: of its program.
        type: name of its program.
        args: words of its command line.
        env: what the launch file adds to its environment.
        remap: pairs of names.
        required: whether the launch ends with it.
        respawn: whether it is started again.
    """

    name: str
    namespace: str
    package: str
    type: str
    args: tuple[str, ...] = ()
    env: Mapping[str, str] = field(default_factory=dict)
    remap: tuple[tuple[str, str], ...] = ()
    required: bool = False
    respawn: bool = False

    @property
    def spawns(self) -> str | None:
        """Name of the model that it puts into the world, or None."""
        if self.package != _SIMULATOR or self.type not in _SPAWNERS:
            return None
        return _value_of("-model", self.args)

    def resolve(self, topic: str) -> str:
        """Full name of a topic of this node, after its remappings."""
        renamed = {self._full(source): self._full(target) for source, target in self.remap}
        return renamed.get(self._full(topic), self._full(topic))

    def _full(self, name: str) -> str:
        return name if name.startswith("/") else f"{self.namespace.rstrip('/')}/{name}"


@dataclass(frozen=True)
class LaunchPlan:
    """Nodes and parameters of a launch file with its arguments."""

    nodes: tuple[LaunchNode, ...]
    params: Mapping[str, Any]

    @property
    def simulator(self) -> LaunchNode | None:
        """The simulator's node, or None."""
        found = (n for n in self.nodes if n.package == _SIMULATOR and n.type in _SIMULATOR_TYPES)
        return next(found, None)

    @property
    def models(self) -> list[str]:
        """Models that its spawners put into the world, in their order."""
        return [name for node in self.nodes if (name := node.spawns) is not None]

    @property
    def lowest_spawn_m(self) -> float | None:
        """The least height at which its spawners put a model into the world [m], if they say."""
        args = [node.args for node in self.nodes if node.spawns is not None]
        try:
            return min((float(_value_of("-z", words) or 0.0) for words in args), default=None)
        except ValueError:
            return None

    @property
    def motor_topics(self) -> list[str]:
        """Topics of motor speeds that its controllers publish."""
        controllers = (
            node
            for node in self.nodes
            if node.package == "rotors_control" and node.type.endswith("controller_node")
        )
        return sorted({node.resolve(_MOTOR_TOPIC) for node in controllers})

    def of_process(self, process: str) -> LaunchNode | None:
        """The node of one of roslaunch's processes: "UAV1/controller-3" is /UAV1/controller."""
        name = "/" + process.rpartition("-")[0]
        return next((node for node in self.nodes if node.name == name), None)

    def waits(self, env: Mapping[str, str]) -> dict[str, str]:
        """Environment that has the simulator hold time zero for the models of this launch file.

        Nothing where the launch file or the caller says what it is held for.
        """
        parameters = ("/gazebo/wait_for", "/gazebo/wait_for_sources")
        asked = ("TRIDENT_WAIT_FOR", "TRIDENT_WAIT_FOR_MODELS")
        is_configured = any(name in self.params for name in parameters)
        is_configured = is_configured or any(name in env for name in asked)
        if is_configured or not self.models:
            return {}
        return {
            "TRIDENT_WAIT_FOR_MODELS": ",".join(self.models),
            "TRIDENT_WAIT_FOR_CONTROLLERS": ",".join(self.motor_topics),
        }


def load_plan(launch_file: Path, args: Mapping[str, str], env: Mapping[str, str]) -> LaunchPlan:
    """Loads a launch file as roslaunch does, and starts nothing.

    Args:
        launch_file: its path.
        args: of it.
        env: that roslaunch is going to get.

    Raises:
        TridentError: roslaunch would not take it; says why.
    """
    found = load_facts(launch_file, args, env)
    return LaunchPlan(tuple(_node(entry) for entry in found["nodes"]), found["params"])


def load_facts(
    launch_file: Path, args: Mapping[str, str], env: Mapping[str, str]
) -> dict[str, Any]:
    """What load_launch.py prints about a launch file.

    Raises:
        TridentError: roslaunch would not take it; says why.
    """
    words = [f"{name}:={value}" for name, value in args.items()]
    done = subprocess.run(
        ["/usr/bin/python3", str(_LOADER), str(launch_file), *words],
        env=dict(env),
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise TridentError(f"{launch_file.name}: {lines[-1] if lines else 'cannot be loaded'}")
    return dict(json.loads(done.stdout.splitlines()[-1]))


def _node(entry: dict[str, Any]) -> LaunchNode:
    try:
        words = shlex.split(entry["args"])
    except ValueError:
        words = entry["args"].split()
    remap = tuple((source, target) for source, target in entry["remap"])
    return LaunchNode(**{**entry, "args": tuple(words), "remap": remap})


def check_plan(plan: LaunchPlan, env: Mapping[str, str]) -> None:
    """Refuses what the simulator would refuse after it was started.

    Args:
        plan: of the launch.
        env: that roslaunch is going to get.

    Raises:
        TridentError: an option, or the world file, is not legal; more is waited for than comes.
    """
    _check_integers(plan)
    _check_counts(plan)
    node = plan.simulator
    if node is None or _WORLD_MAKER in plan.params:
        return
    program = _program(env)
    if program is None:
        return
    options = _private_params(plan, node.name)
    done = subprocess.run(
        [program, "--check", *node.args],
        input=xmlrpc.client.dumps((_nested(options),), allow_none=True),
        env={**env, **node.env},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode == 1:
        raise TridentError(_reason(done.stderr))


def _reason(log: str) -> str:
    """Why the simulator has refused to start."""
    lines = [line for line in log.splitlines() if "[FATAL]" in line]
    return lines[-1].partition("gzserver: ")[2] if lines else log.strip()


def _value_of(option: str, words: Sequence[str]) -> str | None:
    """What follows ``option``, as the next word or behind ``=``; None: nothing."""
    for word, following in zip(words, (*words[1:], ""), strict=True):
        if word == option:
            return following or None
        if word.startswith(f"{option}="):
            return word.removeprefix(f"{option}=") or None
    return None


def _private_params(plan: LaunchPlan, node: str) -> dict[str, Any]:
    """Parameters of a node, by their names below it."""
    prefix = node + "/"
    return {
        name.removeprefix(prefix): value
        for name, value in plan.params.items()
        if name.startswith(prefix)
    }


def _program(env: Mapping[str, str]) -> str | None:
    """Gzserver of the first workspace that has it."""
    for prefix in env.get("CMAKE_PREFIX_PATH", "").split(":"):
        path = Path(prefix) / "lib" / _SIMULATOR / "gzserver"
        if prefix and path.is_file():
            return str(path)
    return None


def _nested(options: Mapping[str, Any]) -> dict[str, Any]:
    """``{"a/b": 1}`` as the parameter server nests it: ``{"a": {"b": 1}}``."""
    result: dict[str, Any] = {}
    for name, value in options.items():
        *parents, last = name.split("/")
        here = result
        for parent in parents:
            here = here.setdefault(parent, {})
        here[last] = value
    return result


def _check_integers(plan: LaunchPlan) -> None:
    """The master takes no others: roslaunch would end in the middle of its start."""
    for name, value in plan.params.items():
        if isinstance(value, int) and not -(2**31) <= value < 2**31:
            raise TridentError(f"parameter {name} is {value}, must be in [-2147483648, 2147483647]")


def _check_counts(plan: LaunchPlan) -> None:
    wanted = plan.params.get("/gazebo/wait_for")
    if not isinstance(wanted, int) or isinstance(wanted, bool):
        return
    if any(node.package not in _NO_SPAWNERS for node in plan.nodes):
        return  # it may spawn by its own means
    count = len(plan.models) + sum(_fleet_size(plan, node) for node in plan.nodes)
    if wanted > count:
        raise TridentError(
            f"/gazebo/wait_for is {wanted}, but the launch file spawns {count} models: "
            "it would wait for ever"
        )


def _fleet_size(plan: LaunchPlan, node: LaunchNode) -> int:
    if (node.package, node.type) != _FLEET_SPAWNER:
        return 0
    prefix = f"{node.name}/positions/"
    return sum(name.startswith(prefix) for name in plan.params)


def check_real_time_factor(text: str) -> None:
    """Refuses what is no real-time factor before anything else is done with it.

    Raises:
        TridentError: it is no number in [0, 1e6].
    """
    try:
        is_legal = 0.0 <= float(text) <= 1e6
    except ValueError:
        is_legal = False
    if not is_legal:
        raise TridentError(
            f"real_time_factor is {text[:200]!r}, must be a number in [0, 1000000]; 0: as fast as "
            "possible"
        )
