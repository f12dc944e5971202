# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""What a vehicle would hear and say: pymavlink behind the node's fcu_url."""

from __future__ import annotations

import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rospy
from mavros_msgs.msg import State
from pymavlink import mavutil
from pymavlink.dialects.v20 import ardupilotmega as mavlink
from pymavlink.generator.mavcrc import x25crc
from trident.testing import Process, Ros, eventually, program, recorder
from trident_base.ports import free_port

_BEAT_S = 0.2
_LIMIT_S = 20.0
_ASK_AGAIN_S = 0.2  # what was published before the node listened is lost
#: Number of the message, and the seed of its checksum: pymavlink's dialect lacks it.
ESC_INFO, _ESC_INFO_SEED = 290, 251


class Peer:
    """System 1, component 1, that beats and remembers what it hears.

    Attributes:
        heard: all messages, in their order.
    """

    def __init__(self, own_port: int, node_port: int) -> None:
        """Begin to beat.

        Args:
            own_port: where it listens.
            node_port: where the node does.
        """
        self._far = ("127.0.0.1", node_port)
        self._link = mavutil.mavlink_connection(
            f"udpin:127.0.0.1:{own_port}", source_system=1, source_component=1
        )
        self._link.clients.add(self._far)
        self._link.last_address = self._far
        self.heard: list[Any] = []
        self._news = threading.Condition()
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        beat_s = 0.0
        while not self._is_over.is_set():
            if time.monotonic() - beat_s > _BEAT_S:
                beat_s = time.monotonic()
                self.send.heartbeat_send(
                    mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, 1, 0, 4
                )
            message = self._link.recv_match(blocking=True, timeout=0.05)
            if message is not None:
                with self._news:
                    self.heard.append(message)
                    self._news.notify_all()

    @property
    def send(self) -> Any:
        """Pymavlink's encoder."""
        return self._link.mav

    def asked(
        self,
        ask: Callable[[], object],
        kind: str,
        is_meant: Callable[[Any], bool] = lambda _message: True,
    ) -> Any:
        """Ask again and again, until an answer has come; it.

        Args:
            ask: publishes or calls.
            kind: name of the message.
            is_meant: which messages of that type count.
        """
        since = len(self.heard)

        def answers() -> list[Any]:
            return [m for m in self.heard[since:] if m.get_type() == kind and is_meant(m)]

        def comes() -> bool:
            ask()
            with self._news:
                return bool(self._news.wait_for(answers, _ASK_AGAIN_S))

        eventually(comes, kind, _LIMIT_S)
        return answers()[0]

    def send_esc_info(self, temperatures: tuple[int, int, int, int]) -> None:
        """ESC_INFO of four motors [0.01 deg C]."""
        payload = struct.pack(
            "<Q4IH4H4hBBBB", 1, 5, 6, 7, 8, 1, 0, 0, 0, 4, *temperatures, 0, 4, 0, 15
        )
        header = struct.pack("<BBBBBB", len(payload), 0, 0, 0, 1, 1)
        header += struct.pack("<I", ESC_INFO)[:3]
        crc = x25crc(header + payload)
        crc.accumulate(bytes([_ESC_INFO_SEED]))
        self._link.port.sendto(b"\xfd" + header + payload + struct.pack("<H", crc.crc), self._far)

    def close(self) -> None:
        """End."""
        self._is_over.set()
        self._thread.join()
        self._link.close()


def wait_for_connection(name: str, node: Process) -> None:
    """Return when a vehicle of a node has its HEARTBEATs."""
    with recorder(f"{name}/state", State) as states:
        eventually(lambda: bool(states.messages and states.messages[-1].connected), node.log)


@contextmanager
def connected_peer(ros: Ros, parameters: dict[str, Any]) -> Iterator[Peer]:
    """A vehicle that beats, and /uav1/mavros with these parameters that is connected to it.

    Args:
        ros: the master, which is cleaned in the end.
        parameters: of the node, in addition to its fcu_url.
    """
    own, far = free_port(), free_port()
    ros.set_param("/uav1/mavros", {"fcu_url": f"udp://:{own}@127.0.0.1:{far}", **parameters})
    one = Peer(far, own)
    node = ros.launch([program("mavros", "mavros_node"), "__name:=mavros", "__ns:=/uav1"])
    wait_for_connection("/uav1/mavros", node)
    yield one
    one.close()
    ros.clean()


def ask_by(peer: Peer, topic: str, message: Any, kind: str) -> Any:
    """What the vehicle hears when a message is published below /uav1/mavros."""
    publisher = rospy.Publisher(f"/uav1/mavros/{topic}", type(message), queue_size=10)
    try:
        return peer.asked(lambda: publisher.publish(message), kind)
    finally:
        publisher.unregister()
