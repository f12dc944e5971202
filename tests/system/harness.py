# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A master, the simulator under it, controllers and clients: what the system tests are made of.

One master and one rospy node live as long as the pytest process (rospy allows one node a process);
everything else is started per test, in a session of its own, writes to a log of its own, and is
ended with the test. Waiting is always for a condition, with a limit that a loaded machine meets.
"""

from __future__ import annotations

import json
import math
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import urlparse

import rospy
import yaml
from gazebo_msgs.srv import (
    ApplyBodyWrench,
    BodyRequest,
    DeleteModel,
    GetLinkState,
    GetModelProperties,
    GetModelState,
    GetPhysicsProperties,
    GetWorldProperties,
    SetLinkState,
    SetModelState,
    SetPhysicsProperties,
    SpawnModel,
    SpawnModelRequest,
)
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from std_msgs.msg import Header
from std_srvs.srv import Empty

from trident_msgs.srv import EnrollSource, Step

REPO = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(REPO / "tests" / "support"))

from ros_processes import RosProcesses, wait_until  # noqa: E402

LIMIT_S = 60.0  # wall time for what takes a second on a quiet machine
SERVICES = {
    "apply_body_wrench": ApplyBodyWrench,
    "clear_body_wrenches": BodyRequest,
    "delete_model": DeleteModel,
    "enroll_source": EnrollSource,
    "get_link_state": GetLinkState,
    "get_model_properties": GetModelProperties,
    "get_model_state": GetModelState,
    "get_physics_properties": GetPhysicsProperties,
    "get_world_properties": GetWorldProperties,
    "pause_physics": Empty,
    "reset_simulation": Empty,
    "reset_world": Empty,
    "set_link_state": SetLinkState,
    "set_model_state": SetModelState,
    "set_physics_properties": SetPhysicsProperties,
    "spawn_sdf_model": SpawnModel,
    "spawn_urdf_model": SpawnModel,
    "step": Step,
    "unpause_physics": Empty,
}
_LAST_SERVICE = "/gazebo/delete_model"  # once it is there, all are
_NAMESPACE = "NAMESPACE_TO_REPLACE"


def eventually(condition: Callable[[], bool], what: str, limit_s: float = LIMIT_S) -> None:
    """Returns when ``condition`` holds; fails the test with ``what`` after ``limit_s``."""
    wait_until(condition, what, limit_s)


@cache
def package(name: str) -> Path:
    """Source folder of a package."""
    found = subprocess.run(["rospack", "find", name], capture_output=True, text=True, check=True)
    return Path(found.stdout.strip())


def program(package_name: str, name: str) -> str:
    """Path of a built executable."""
    for prefix in os.environ["CMAKE_PREFIX_PATH"].split(os.pathsep):
        path = Path(prefix) / "lib" / package_name / name
        if path.is_file():
            return str(path)
    raise AssertionError(f"{package_name}/{name} is not built")


@cache
def _vehicle_template(mav_name: str) -> str:
    model = package("rotors_description") / "urdf" / "mav_generic_odometry_sensor.gazebo"
    arguments = {
        "mav_name": mav_name,
        "namespace": _NAMESPACE,
        "enable_ground_truth": "true",
        "enable_logging": "false",
        "log_file": mav_name,
        "wait_to_record_bag": "false",
        "enable_mavlink_interface": "false",
    }
    command = [str(package("xacro") / "xacro"), str(model)]
    command += [f"{name}:={value}" for name, value in arguments.items()]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def vehicle_urdf(namespace: str, mav_name: str = "firefly") -> str:
    """URDF of a multirotor with odometry, as spawn_mav.launch makes it."""
    return _vehicle_template(mav_name).replace(_NAMESPACE, namespace)


def box_sdf(name: str, size_m: float = 0.2, mass_kg: float = 2.0, extra: str = "") -> str:
    """SDF of a free box; ``extra`` goes into the model element."""
    inertia = mass_kg * size_m**2 / 6.0
    box = f"<geometry><box><size>{size_m} {size_m} {size_m}</size></box></geometry>"
    return f"""<?xml version="1.0"?>
<sdf version="1.6"><model name="{name}"><link name="link">
  <inertial><mass>{mass_kg}</mass><inertia><ixx>{inertia}</ixx><iyy>{inertia}</iyy>
    <izz>{inertia}</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
  <collision name="collision">{box}</collision><visual name="visual">{box}</visual>
</link>{extra}</model></sdf>"""


def pose(x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw_rad: float = 0.0) -> Pose:
    """A pose from its position [m] and heading."""
    turn = Quaternion(0.0, 0.0, math.sin(yaw_rad / 2.0), math.cos(yaw_rad / 2.0))
    return Pose(Point(x, y, z), turn)


class Process:
    """A started program and its log."""

    def __init__(self, command: list[str], env: Mapping[str, str], log: Path) -> None:
        self.log_file = log
        # Inherited by all that it starts. Process ids are reused, so that what is left over is not
        # to be found by a number remembered.
        self._mark = f"TRIDENT_TEST_PROCESS={uuid.uuid4()}"
        name, value = self._mark.split("=")
        with log.open("w", encoding="utf-8") as output:
            self.popen = subprocess.Popen(
                command,
                env={**env, name: value},
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
                text=True,
            )

    @property
    def log(self) -> str:
        """What it has written so far, stdout and stderr."""
        return self.log_file.read_text(encoding="utf-8", errors="replace")

    @property
    def running(self) -> bool:
        return self.popen.poll() is None

    def send(self, number: int) -> None:
        """To this process only, not to its children."""
        self.popen.send_signal(number)

    def wait(self, limit_s: float = LIMIT_S) -> int:
        """Exit code, once it has ended by itself."""
        eventually(lambda: not self.running, f"the end of {self.popen.args}", limit_s)
        return self.popen.returncode

    def stop(self, number: int = signal.SIGINT, limit_s: float = 20.0) -> int:
        """Ends it; what is left after ``limit_s``, or of its children, is killed. Its exit code."""
        if self.running:
            self.send(number)
            with suppress(subprocess.TimeoutExpired):
                self.popen.wait(limit_s)
        for pid in self.family():
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        return self.popen.wait()

    def family(self) -> list[int]:
        """Process ids of what runs of it and of all that it started."""
        mark = self._mark.encode()
        found = []
        for folder in Path("/proc").glob("[0-9]*"):
            with suppress(OSError):
                if mark in (folder / "environ").read_bytes():
                    found.append(int(folder.name))
        return found

    def eventually_logs(self, text: str, limit_s: float = LIMIT_S) -> None:
        """Returns when ``text`` is in the log."""
        eventually(lambda: text in self.log, f"'{text}' in the log of {self.popen.args}", limit_s)


class Ros(RosProcesses):
    """The master of the pytest process, its rospy node, and the programs that tests start."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.programs: list[Process] = []
        self._count = 0
        super().__init__(folder)
        self.env["ROS_LOG_DIR"] = str(folder / "ros_log")
        # Debian's ROS is built for /usr/bin/python3, which "env python3" must find first.
        self.env["PATH"] = "/usr/bin:" + self.env["PATH"]
        # Logs are read while their writers run.
        self.env |= {"PYTHONUNBUFFERED": "1", "ROSCONSOLE_STDOUT_LINE_BUFFERED": "1"}
        self.env.pop("DISPLAY", None)
        for name in ("ROS_MASTER_URI", "ROS_IP", "ROS_HOME", "ROS_LOG_DIR"):
            os.environ[name] = self.env[name]
        os.environ.pop("ROS_HOSTNAME", None)
        self.env.pop("ROS_HOSTNAME", None)
        # This node lives on wall time: servers come, go and reset theirs.
        self.set_param("/use_sim_time", False)
        rospy.init_node("system_tests", disable_signals=True)
        self._permanent = set(rospy.get_param_names())

    def launch(self, command: Sequence[object], name: str = "", **env: str) -> Process:
        """Starts a program in a session of its own, with its output in a file."""
        words = [str(word) for word in command]
        self._count += 1
        label = name or Path(words[0]).name
        path = self.folder / f"{self._count:03d}-{label.strip('/').replace('/', '.')}.log"
        process = Process(words, {**self.env, **env}, path)
        self.programs.append(process)
        return process

    def call(self, *command: object, limit_s: float = LIMIT_S, **env: str) -> str:
        """Runs a program to its end, which must be a success, and returns its output."""
        process = self.launch(command, **env)
        code = process.wait(limit_s)
        assert code == 0, f"{command} ended with {code}:\n{process.log}"
        return process.log

    def clean(self) -> None:
        """Ends all programs of a test and forgets what they left at the master."""
        for process in reversed(self.programs):
            process.stop(limit_s=10.0)
        self.programs.clear()
        for name in self.master.getParamNames("/system_tests")[2]:
            if name not in self._permanent:
                self.master.deleteParam("/system_tests", name)
        self.set_param("/use_sim_time", False)
        self._forget_dead_nodes()

    def _forget_dead_nodes(self) -> None:
        """Unregisters what a kill -9 left behind, so that no test meets another one's nodes."""
        caller = rospy.get_name()
        publishers, subscribers, services = self.master.getSystemState(caller)[2]
        groups = (publishers, subscribers, services)
        names = {node for group in groups for _, nodes in group for node in nodes}
        for node in names - {caller}:
            code, _, uri = self.master.lookupNode(caller, node)
            if code == 1 and _answers(uri):
                continue
            for topic in (topic for topic, nodes in publishers if node in nodes):
                self.master.unregisterPublisher(node, topic, uri)
            for topic in (topic for topic, nodes in subscribers if node in nodes):
                self.master.unregisterSubscriber(node, topic, uri)
            for service in (service for service, nodes in services if node in nodes):
                service_uri = self.master.lookupService(caller, service)[2]
                self.master.unregisterService(node, service, service_uri)

    def kill(self, process: Process) -> None:
        """kill -9."""
        process.stop(signal.SIGKILL)

    def shutdown(self) -> None:
        """Ends everything, the master last."""
        self.clean()
        rospy.signal_shutdown("the tests are over")
        self.close()


def _answers(uri: str) -> bool:
    """Whether something listens at an address like rosrpc://host:port."""
    address = urlparse(uri)
    try:
        with socket.create_connection((address.hostname, address.port), timeout=2.0):
            return True
    except OSError:
        return False


class Gazebo:
    """A gzserver and the clients of its services."""

    def __init__(
        self,
        ros: Ros,
        world: str | Path = "basic",
        *,
        paused: bool = True,
        args: Sequence[str] = (),
        **params: Any,
    ) -> None:
        self.ros = ros
        params.setdefault("real_time_factor", 0.0)
        for name, value in params.items():
            ros.set_param(f"/gazebo/{name}", value)
        self.out_dir = Path(params["out_dir"]) if "out_dir" in params else None
        file = world
        if isinstance(world, str) and "/" not in world:
            file = package("rotors_gazebo") / "worlds" / f"{world}.world"
        command = [program("gazebo_ros", "gzserver"), *(["-u"] if paused else []), *args, file]
        self.process = ros.launch([*command, "__name:=gazebo"], "gzserver")

    @property
    def log(self) -> str:
        return self.process.log

    def ready(self) -> Gazebo:
        """Returns when all services answer."""
        eventually(self._serves, "services of gzserver")
        return self

    def _serves(self) -> bool:
        assert self.process.running, f"gzserver has ended:\n{self.log}"
        code, _, uri = self.ros.master.lookupService("/system_tests", _LAST_SERVICE)
        return code == 1 and _answers(uri)

    def call(self, service: str, **fields: Any) -> Any:
        """Calls a service of /gazebo whatever the outcome."""
        return rospy.ServiceProxy(f"/gazebo/{service}", SERVICES[service])(**fields)

    def ask(self, service: str, **fields: Any) -> Any:
        """Calls a service of /gazebo, which must succeed."""
        response = self.call(service, **fields)
        success = getattr(response, "success", True)
        text = getattr(response, "status_message", "") or getattr(response, "message", "")
        assert success, f"{service} {fields} failed: {text}"
        return response

    def refusal(self, service: str, **fields: Any) -> str:
        """Calls a service of /gazebo, which must refuse, and returns what it says."""
        response = self.call(service, **fields)
        assert not response.success, f"{service} {fields} succeeded"
        text: str = getattr(response, "status_message", "") or getattr(response, "message", "")
        assert text, f"{service} {fields} failed without a word"
        return text

    def spawn(self, name: str, xml: str = "", at: Pose | None = None, **fields: Any) -> None:
        """Spawns an SDF or URDF text, by default a firefly."""
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

    def step(self, n: int) -> float:
        """n steps; returns the simulated time [s] after them."""
        return float(self.ask("step", n=n).sim_time.to_sec())

    def time(self) -> float:
        """Simulated time [s]."""
        return float(self.ask("get_world_properties").sim_time)

    def until(self, sim_time_s: float, limit_s: float = LIMIT_S) -> None:
        """Returns when the running world has reached a simulated time."""
        eventually(lambda: self.time() >= sim_time_s, f"t = {sim_time_s} s", limit_s)

    def position(self, model: str) -> tuple[float, float, float]:
        """Position in the world [m]."""
        point = self.ask("get_model_state", model_name=model).pose.position
        return point.x, point.y, point.z

    def controller(self, vehicle: str, mav_name: str = "firefly") -> Process:
        """Starts the external position controller of a spawned vehicle."""
        name = f"/{vehicle}/lee_position_controller_node"
        resource = package("rotors_gazebo") / "resource"
        for file in (f"lee_controller_{mav_name}.yaml", f"{mav_name}.yaml"):
            values = yaml.safe_load((resource / file).read_text(encoding="utf-8"))
            for key, value in values.items():
                self.ros.set_param(f"{name}/{key}", value)
        command = [
            program("rotors_control", "lee_position_controller_node"),
            f"__ns:=/{vehicle}",
            "__name:=lee_position_controller_node",
            "odometry:=odometry_sensor1/odometry",
        ]
        return self.ros.launch(command, f"controller-{vehicle}")

    def finish(self, limit_s: float = LIMIT_S) -> dict[str, Any]:
        """Interrupts the server unless it ends by itself; its results."""
        assert self.out_dir is not None
        code = self.process.stop(signal.SIGINT, limit_s)
        return self._results(code)

    def ended(self, limit_s: float = LIMIT_S) -> dict[str, Any]:
        """Waits for the end that was asked for by parameters; the results."""
        assert self.out_dir is not None
        return self._results(self.process.wait(limit_s))

    def _results(self, code: int) -> dict[str, Any]:
        assert code == 0, f"gzserver ended with {code}:\n{self.log}"
        assert self.out_dir is not None
        results: dict[str, Any] = json.loads((self.out_dir / "run.json").read_text("utf-8"))
        return results


class Pilot:
    """Gives set-points to controllers, and knows when they have them."""

    def __init__(self, vehicles: Sequence[str]) -> None:
        self.vehicles = list(vehicles)
        self._accepted: dict[str, set[int]] = {name: set() for name in vehicles}
        self._lock = threading.Lock()
        self._publishers = {
            name: rospy.Publisher(f"/{name}/command/pose", PoseStamped, queue_size=1000)
            for name in vehicles
        }
        self._subscribers = [
            rospy.Subscriber(f"/{name}/command/accepted_setpoint", Header, self._on_accepted, name)
            for name in vehicles
        ]

    def _on_accepted(self, header: Header, vehicle: str) -> None:
        with self._lock:
            self._accepted[vehicle].add(header.stamp.to_nsec())

    def connected(self, vehicle: str) -> Pilot:
        """Returns when the controller of ``vehicle`` listens, and is heard."""
        index = self.vehicles.index(vehicle)
        controller = f"/{vehicle}/lee_position_controller_node"

        def is_connected() -> bool:
            listeners = {link.endpoint_id for link in self._publishers[vehicle].impl.connections}
            return controller in listeners and self._subscribers[index].get_num_connections() > 0

        eventually(is_connected, f"a controller of {vehicle} that takes set-points")
        return self

    def send(self, vehicle: str, x: float, y: float, z: float, stamp_s: float) -> None:
        """Sends a set-point for a stamp > 0, and returns when the controller has confirmed it."""
        message = PoseStamped(pose=pose(x, y, z))
        message.header.stamp = rospy.Time.from_sec(stamp_s)
        message.header.frame_id = "world"
        stamp = message.header.stamp.to_nsec()
        with self._lock:
            self._accepted[vehicle].discard(stamp)
        self.connected(vehicle)
        self._publishers[vehicle].publish(message)
        eventually(
            lambda: stamp in self._accepted[vehicle],
            f"{vehicle}'s controller confirms the set-point of {stamp_s} s",
        )

    def close(self) -> None:
        for publisher in self._publishers.values():
            publisher.unregister()
        for subscriber in self._subscribers:
            subscriber.unregister()


@contextmanager
def pilot_of(*vehicles: str) -> Iterator[Pilot]:
    """A pilot whose topics end with the block."""
    pilot = Pilot(vehicles)
    try:
        yield pilot
    finally:
        pilot.close()


class Recorder:
    """Messages of a topic, in the order of their arrival."""

    def __init__(self, topic: str, message_type: Any, queue_size: int | None = None) -> None:
        self.topic = topic
        self.messages: list[Any] = []
        self._subscriber = rospy.Subscriber(
            topic, message_type, self.messages.append, queue_size=queue_size, tcp_nodelay=True
        )

    def connected(self, publishers: int = 1) -> Recorder:
        eventually(
            lambda: self._subscriber.get_num_connections() >= publishers,
            f"a publisher of {self.topic}",
        )
        return self

    def received(self, count: int = 1, limit_s: float = LIMIT_S) -> list[Any]:
        """The messages, once there are ``count``."""
        eventually(
            lambda: len(self.messages) >= count, f"{count} messages on {self.topic}", limit_s
        )
        return self.messages

    def close(self) -> None:
        self._subscriber.unregister()


@contextmanager
def recorder(topic: str, message_type: Any, **options: Any) -> Iterator[Recorder]:
    """A connected recorder that ends with the block."""
    result = Recorder(topic, message_type, **options)
    try:
        yield result.connected()
    finally:
        result.close()


def complaints(log: str) -> list[str]:
    """Warnings, errors and tracebacks of a log, one line each."""
    pattern = re.compile(r"\[ ?(WARN|ERROR|FATAL)\]|Traceback \(most recent call last\)")
    return [line for line in log.splitlines() if pattern.search(line)]


def fresh_folder(path: Path) -> str:
    """Makes the folder, empty."""
    shutil.rmtree(path, ignore_errors=True)
    path.mkdir(parents=True)
    return str(path)


def environment(**changes: str) -> Mapping[str, str]:
    """The environment of the tests with changes."""
    return {**os.environ, **changes}


def topic_rate(ros: Ros, topic: str) -> float:
    """What ``rostopic hz`` says of a topic, in messages per wall second."""
    process = ros.launch(["rostopic", "hz", "--wall-time", topic])
    pattern = re.compile(r"average rate: ([0-9.]+)")
    eventually(lambda: len(pattern.findall(process.log)) >= 2, f"a rate of {topic}")
    process.stop()
    return float(pattern.findall(process.log)[-1])
