# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator under ROS, its services as methods."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import rospy
from gazebo_msgs.srv import (
    ApplyBodyWrench,
    ApplyJointEffort,
    BodyRequest,
    DeleteModel,
    GetJointProperties,
    GetLinkProperties,
    GetLinkState,
    GetModelProperties,
    GetModelState,
    GetPhysicsProperties,
    GetWorldProperties,
    JointRequest,
    SetJointProperties,
    SetLinkProperties,
    SetLinkState,
    SetModelConfiguration,
    SetModelState,
    SetPhysicsProperties,
    SpawnModel,
)
from std_srvs.srv import Empty

from trident.testing.master import CALLER, Ros, answers
from trident.testing.programs import Process
from trident.testing.waiting import LIMIT_S, eventually
from trident_msgs.srv import EnrollSource, Step

Array = npt.NDArray[np.float64]

SERVICES = {
    "apply_body_wrench": ApplyBodyWrench,
    "apply_joint_effort": ApplyJointEffort,
    "clear_body_wrenches": BodyRequest,
    "clear_joint_efforts": JointRequest,
    "clear_joint_forces": JointRequest,
    "delete_model": DeleteModel,
    "enroll_source": EnrollSource,
    "get_joint_properties": GetJointProperties,
    "get_link_properties": GetLinkProperties,
    "get_link_state": GetLinkState,
    "get_model_properties": GetModelProperties,
    "get_model_state": GetModelState,
    "get_physics_properties": GetPhysicsProperties,
    "get_world_properties": GetWorldProperties,
    "pause_physics": Empty,
    "reset_simulation": Empty,
    "reset_world": Empty,
    "set_joint_properties": SetJointProperties,
    "set_link_properties": SetLinkProperties,
    "set_link_state": SetLinkState,
    "set_model_configuration": SetModelConfiguration,
    "set_model_state": SetModelState,
    "set_physics_properties": SetPhysicsProperties,
    "spawn_sdf_model": SpawnModel,
    "spawn_urdf_model": SpawnModel,
    "step": Step,
    "unpause_physics": Empty,
}
_LAST_SERVICE = "/gazebo/delete_model"  # once it is there, all are


@dataclass(frozen=True)
class State:
    """A model in the world frame, at one instant.

    Attributes:
        position: p_world_model [m], shape (3,).
        orientation: R_world_model as quaternion x y z w, shape (4,).
        linear_velocity: v_world of the model's origin [m/s], shape (3,).
        angular_velocity: w_world [rad/s], shape (3,).
    """

    position: Array
    orientation: Array
    linear_velocity: Array
    angular_velocity: Array


class Simulation:
    """A simulator that some process of the test runs, and its services.

    Attributes:
        ros: the master it is under.
        process: the server, or the roslaunch around it.
        out_dir: where it leaves its results; None: nowhere.
    """

    def __init__(self, ros: Ros, process: Process, out_dir: Path | None) -> None:
        """Take over a started process.

        Args:
            ros: the master it is under.
            process: the server, or the roslaunch around it.
            out_dir: where it leaves its results, if a folder was given.
        """
        self.ros = ros
        self.process = process
        self.out_dir = out_dir

    @property
    def log(self) -> str:
        """What the process has written so far."""
        return self.process.log

    def serves(self, limit_s: float = LIMIT_S) -> None:
        """Return when all services answer, within wall time [s]."""
        eventually(self._serves, "services of the simulator", limit_s)

    def _serves(self) -> bool:
        assert self.process.running, f"the simulator has ended:\n{self.log}"
        code, _, uri = self.ros.master.lookupService(CALLER, _LAST_SERVICE)
        return code == 1 and answers(uri)

    def call(self, service: str, **fields: Any) -> Any:
        """Call a service of /gazebo whatever the outcome; its response."""
        return rospy.ServiceProxy(f"/gazebo/{service}", SERVICES[service])(**fields)

    def ask(self, service: str, **fields: Any) -> Any:
        """Call a service of /gazebo, which must succeed; its response."""
        response = self.call(service, **fields)
        success = getattr(response, "success", True)
        text = getattr(response, "status_message", "") or getattr(response, "message", "")
        assert success, f"{service} {fields} failed: {text}"
        return response

    def refusal(self, service: str, **fields: Any) -> str:
        """Call a service of /gazebo, which must refuse; what it says."""
        response = self.call(service, **fields)
        assert not response.success, f"{service} {fields} succeeded"
        text: str = getattr(response, "status_message", "") or getattr(response, "message", "")
        assert text, f"{service} {fields} failed without a word"
        return text

    def step(self, n: int = 1) -> float:
        """Do n steps in a paused world, in lockstep with all controllers.

        Returns:
            Simulated time after them [s].
        """
        return float(self.ask("step", n=n).sim_time.to_sec())

    def step_to(self, sim_time_s: float) -> float:
        """Step a paused world to the first step that is not before a simulated time [s].

        Returns:
            Simulated time after the steps [s].
        """
        n = math.ceil((sim_time_s - self.time()) / self.dt() - 1e-6)
        return self.step(n) if n > 0 else self.time()

    def step_and_receive(self, n: int, count: int, received: Callable[[], int]) -> None:
        """Do n steps `count` times, and wait after the k-th until k messages were received.

        A publisher keeps only the newest of its large messages: in one go a busy machine drops
        some.

        Args:
            n: steps at a time, the period of what is published.
            count: of messages.
            received: how many there are, of the topic that has the fewest.
        """
        for k in range(1, count + 1):
            self.step(n)
            self._wait_for(k, count, received)

    @staticmethod
    def _wait_for(k: int, count: int, received: Callable[[], int]) -> None:
        eventually(lambda: received() >= k, f"message {k} of {count}")

    def step_until(
        self, condition: Callable[[], bool], what: str, limit_s: float = 60.0, every_s: float = 0.1
    ) -> float:
        """Step a paused world until a condition holds.

        The limit is in simulated time, so that the result does not depend on the machine.

        Args:
            condition: asked before the first step and every `every_s`.
            what: is waited for; part of the error.
            limit_s: simulated time from now on [s].
            every_s: simulated time between two questions [s].

        Returns:
            Simulated time at which it held [s].

        Raises:
            AssertionError: it did not hold within the limit.
        """
        begin = now = self.time()
        n = max(1, round(every_s / self.dt()))
        while not condition():
            assert now - begin < limit_s - 1e-6, (
                f"{what} did not happen in {limit_s:g} s simulated time"
            )
            now = self.step(n)
        return now

    def time(self) -> float:
        """Simulated time [s]."""
        return float(self.ask("get_world_properties").sim_time)

    def dt(self) -> float:
        """Length of a step [s]."""
        return float(self.ask("get_physics_properties").time_step)

    def until(self, sim_time_s: float, limit_s: float = LIMIT_S) -> None:
        """Return when a running world has reached a simulated time [s], within wall time [s]."""
        eventually(lambda: self.time() >= sim_time_s, f"t = {sim_time_s} s", limit_s)

    def pause(self) -> float:
        """Pause the world; the simulated time at which it stands [s]."""
        self.ask("pause_physics")
        return self.time()

    def unpause(self) -> None:
        """Let the world run."""
        self.ask("unpause_physics")

    def models(self) -> list[str]:
        """Names of all models, static ones too."""
        return list(self.ask("get_world_properties").model_names)

    def state(self, model: str) -> State:
        """Pose and velocity of a model in the world frame."""
        response = self.ask("get_model_state", model_name=model, relative_entity_name="world")
        at, twist = response.pose, response.twist
        turn = at.orientation
        return State(
            _vector(at.position),
            np.array([turn.x, turn.y, turn.z, turn.w]),
            _vector(twist.linear),
            _vector(twist.angular),
        )

    def position(self, model: str) -> tuple[float, float, float]:
        """p_world_model [m]."""
        x, y, z = self.state(model).position.tolist()
        return x, y, z

    def results(self) -> dict[str, Any]:
        """What run.json says of a simulator that has ended: `state_hash`, `steps`, `sim_s`."""
        assert self.out_dir is not None, "it was started without a folder for its results"
        path = self.out_dir / "run.json"
        assert path.is_file(), f"{path} is not there: has it ended?\n{self.log}"
        results: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        return results


def _vector(message: Any) -> Array:
    return np.array([message.x, message.y, message.z])
