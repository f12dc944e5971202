# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""A ROS master of a test's own, and what the test starts under it."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import xmlrpc.client
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from urllib.parse import urlparse

import rospy
from trident_base.ports import free_port

from trident.testing.programs import Process
from trident.testing.waiting import LIMIT_S, eventually, output_of

PYTHON = "/usr/bin/python3"  # the interpreter that Debian's rospy is built for
CALLER = "/trident_testing"


def answers(uri: str) -> bool:
    """Whether something listens at an address like http://host:port or rosrpc://host:port."""
    address = urlparse(uri)
    try:
        with socket.create_connection((address.hostname, address.port), timeout=2.0):
            return True
    except OSError:
        return False


def _nodes_of(*entries: tuple[str, list[str]]) -> set[str]:
    """All nodes of entries of the master's state."""
    return {node for _, nodes in entries for node in nodes}


def _names_with(node: str, group: list[tuple[str, list[str]]]) -> list[str]:
    """The topics or services of a group of the master's state that a node has."""
    return [name for name, nodes in group if node in nodes]


class RosProcesses:
    """A master on a free port, and plain processes under it; no node of this process.

    Attributes:
        env: environment of what is started.
        master: the master's XML-RPC interface.
    """

    def __init__(self, folder: Path) -> None:
        """Start the master.

        Args:
            folder: for logs and the rest of ROS_HOME.
        """
        port = free_port()
        uri = f"http://127.0.0.1:{port}"
        self.env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1"}
        self.env["ROS_HOME"] = str(folder / "ros_home")
        self.env.setdefault("TRIDENT_STRICT", "1")  # what is odd in a file fails a test
        self.env.pop("ROS_HOSTNAME", None)
        self.master: Any = xmlrpc.client.ServerProxy(uri)
        self._processes: list[subprocess.Popen[str]] = []
        self.master_process = self.start(["rosmaster", "--core", "-p", str(port)])
        eventually(self._master_answers, "an answer of the master")

    def _master_answers(self) -> bool:
        try:
            return bool(self.master.getPid(CALLER))
        except OSError:
            return False

    def set_param(self, name: str, value: Any) -> None:
        """Set a parameter on the master."""
        self.master.setParam(CALLER, name, value)

    def start(self, command: Sequence[str], **options: Any) -> subprocess.Popen[str]:
        """Start a process; `env` adds to the environment, output goes to one pipe by default."""
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options}
        env = {**self.env, **options.pop("env", {})}
        process = subprocess.Popen(list(command), env=env, text=True, **options)
        self._processes.append(process)
        return process

    def start_node(
        self, name: str, command: Sequence[str], **options: Any
    ) -> subprocess.Popen[str]:
        """Start a node under the full `name` and return once the master knows it."""
        process = self.start([*command, f"__name:={name.rsplit('/', 1)[-1]}"], **options)
        eventually(lambda: self.master.lookupNode(CALLER, name)[0] == 1, f"registration of {name}")
        return process

    def run(self, command: Sequence[str], **options: Any) -> tuple[int, str]:
        """Run a process to its end; its exit code and output."""
        process = self.start(command, **options)
        output = output_of(process)
        return process.returncode, output

    def close(self) -> None:
        """End what still runs, the master last."""
        for process in reversed(self._processes):
            if process.poll() is None:
                process.terminate()
        for process in self._processes:
            try:
                process.wait(5.0)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            if process.stdout:
                process.stdout.close()


class Ros(RosProcesses):
    """The master of this process, its one rospy node, and the programs that tests start.

    rospy knows one master and one node a process, so there is one of these, and `clean` empties it
    between tests.

    Attributes:
        folder: where logs go.
        programs: what was started since the last `clean`.
    """

    def __init__(self, folder: Path) -> None:
        """Start the master and this process's node.

        Args:
            folder: for logs.
        """
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
        # This node lives on wall time: servers come, go and reset theirs.
        self.set_param("/use_sim_time", False)
        rospy.init_node(CALLER.strip("/"), disable_signals=True)
        self._permanent = set(rospy.get_param_names())

    def launch(self, command: Sequence[object], name: str = "", **env: str) -> Process:
        """Start a program in a session of its own, with its output in a file.

        Args:
            command: program and arguments.
            name: of the log; default: that of the program.
            env: additions to the environment.
        """
        words = [str(word) for word in command]
        self._count += 1
        label = name or Path(words[0]).name
        path = self.folder / f"{self._count:03d}-{label.strip('/').replace('/', '.')}.log"
        process = Process(words, {**self.env, **env}, path)
        self.programs.append(process)
        return process

    def call(self, *command: object, limit_s: float = LIMIT_S, **env: str) -> str:
        """Run a program to its end, which must be a success; its output."""
        process = self.launch(command, **env)
        code = process.wait(limit_s)
        assert code == 0, f"{command} ended with {code}:\n{process.log}"
        return process.log

    def clean(self) -> None:
        """End all programs of a test and forget what they left at the master."""
        for process in reversed(self.programs):
            process.stop(limit_s=10.0)
        self.programs.clear()
        self._forget_parameters()
        self.set_param("/use_sim_time", False)
        self._forget_dead_nodes()

    def _forget_parameters(self) -> None:
        """Delete them with their sections, which stay when the last parameter of one goes."""
        left = [
            name for name in self.master.getParamNames(CALLER)[2] if name not in self._permanent
        ]
        kept = {name.split("/")[1] for name in self._permanent}
        for section in {name.split("/")[1] for name in left} - kept:
            self.master.deleteParam(CALLER, f"/{section}")
        for name in left:
            self.master.deleteParam(CALLER, name)

    def _forget_dead_nodes(self) -> None:
        """Unregister what a kill -9 left behind, so that no test finds another one's nodes."""
        publishers, subscribers, services = self.master.getSystemState(CALLER)[2]
        for node in _nodes_of(*publishers, *subscribers, *services) - {CALLER}:
            code, _, uri = self.master.lookupNode(CALLER, node)
            if code == 1 and answers(uri):
                continue
            for topic in _names_with(node, publishers):
                self.master.unregisterPublisher(node, topic, uri)
            for topic in _names_with(node, subscribers):
                self.master.unregisterSubscriber(node, topic, uri)
            self._unregister_services(node, _names_with(node, services))

    def _unregister_services(self, node: str, services: list[str]) -> None:
        for service in services:
            service_uri = self.master.lookupService(CALLER, service)[2]
            self.master.unregisterService(node, service, service_uri)

    def kill(self, process: Process) -> None:
        """Kill -9."""
        process.stop(signal.SIGKILL)

    def shutdown(self) -> None:
        """End everything, the master last."""
        self.clean()
        rospy.signal_shutdown("the tests are over")
        self.close()
