# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator server without a launch file, and what belongs to it."""

from __future__ import annotations

import signal
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import rospy
import yaml
from gazebo_msgs.srv import SpawnModel, SpawnModelRequest
from geometry_msgs.msg import Pose

from trident.testing.master import Ros
from trident.testing.models import pose, vehicle_urdf
from trident.testing.programs import Process, package, program
from trident.testing.simulation import Simulation
from trident.testing.waiting import LIMIT_S


class Gazebo(Simulation):
    """A gzserver of the test's own, without a launch file."""

    def __init__(
        self,
        ros: Ros,
        world: str | Path = "basic",
        *,
        paused: bool = True,
        args: Sequence[str] = (),
        **params: Any,
    ) -> None:
        """Start it.

        Args:
            ros: the master it is under.
            world: a path, or a name in rotors_gazebo/worlds.
            paused: whether it starts paused.
            args: more arguments of gzserver.
            params: private parameters, e.g. `seed`, `wait_for`, `out_dir`; `real_time_factor` is 0
                (as fast as possible) and `strict` true (what is odd in files is refused) unless
                given.
        """
        params.setdefault("real_time_factor", 0.0)
        params.setdefault("strict", True)
        for name, value in params.items():
            ros.set_param(f"/gazebo/{name}", value)
        file = world
        if isinstance(world, str) and "/" not in world:
            file = package("rotors_gazebo") / "worlds" / f"{world}.world"
        self.ros = ros
        process = self._start_server([*(["-u"] if paused else []), *args, str(file)])
        super().__init__(ros, process, Path(params["out_dir"]) if "out_dir" in params else None)

    def _start_server(self, arguments: list[str]) -> Process:
        """The process that the server is in; another form of it overrides this."""
        command = [program("gazebo_ros", "gzserver"), *arguments, "__name:=gazebo"]
        return self.ros.launch(command, "gzserver")

    def ready(self) -> Gazebo:
        """Return when all services answer."""
        self.serves()
        return self

    def spawn(self, name: str, xml: str = "", at: Pose | None = None, **fields: Any) -> None:
        """Spawn an SDF or URDF text, by default a firefly 0.1 m above the origin."""
        xml = xml or vehicle_urdf(name)
        service = "spawn_urdf_model" if "<robot" in xml else "spawn_sdf_model"
        request = SpawnModelRequest(
            model_name=name,
            model_xml=xml,
            robot_namespace=fields.pop("robot_namespace", f"/{name}"),
            initial_pose=at or pose(z=0.1),
            reference_frame=fields.pop("reference_frame", "world"),
        )
        assert not fields
        response = rospy.ServiceProxy(f"/gazebo/{service}", SpawnModel)(request)
        assert response.success, response.status_message

    def controller(self, vehicle: str, mav_name: str = "firefly") -> Process:
        """Start the external position controller of a spawned vehicle."""
        name = f"/{vehicle}/lee_position_controller_node"
        resource = package("rotors_gazebo") / "resource"
        for file in (f"lee_controller_{mav_name}.yaml", f"{mav_name}.yaml"):
            values = yaml.safe_load((resource / file).read_text(encoding="utf-8"))
            for key, value in values.items():
                self.ros.set_param(f"{name}/{key}", value)
        return self._start_controller(
            vehicle,
            [
                f"__ns:=/{vehicle}",
                "__name:=lee_position_controller_node",
                "odometry:=odometry_sensor1/odometry",
            ],
        )

    def _start_controller(self, vehicle: str, arguments: list[str]) -> Process:
        """The process that the controller is in; another form of it overrides this."""
        command = [program("rotors_control", "lee_position_controller_node"), *arguments]
        return self.ros.launch(command, f"controller-{vehicle}")

    def finish(self, limit_s: float = LIMIT_S) -> dict[str, Any]:
        """Interrupt the server unless it ends by itself; its results."""
        return self._ended_with(self.process.stop(signal.SIGINT, limit_s))

    def ended(self, limit_s: float = LIMIT_S) -> dict[str, Any]:
        """Wait for the end that was asked for by parameters; the results."""
        return self._ended_with(self.process.wait(limit_s))

    def _ended_with(self, code: int) -> dict[str, Any]:
        assert code == 0, f"gzserver ended with {code}:\n{self.log}"
        return self.results()
