# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""nmea_navsat_driver's nodes under its names, topics and parameters."""

from __future__ import annotations

import math
import os
import pty
import socket
import tty
from collections.abc import Iterator
from contextlib import suppress
from random import Random

import pytest
import rospy
from geometry_msgs.msg import QuaternionStamped, TwistStamped
from nmea_msgs.msg import Sentence
from sensor_msgs.msg import NavSatFix, TimeReference
from trident.testing import Ros, eventually, program, recorder
from trident_base.ports import free_port


def with_checksum(text: str) -> str:
    checksum = 0
    for character in text[1:]:
        checksum ^= ord(character)
    return f"{text}*{checksum:02X}\r\n"


RMC = with_checksum("$GPRMC,120000.50,A,6326.3,N,01023.9,E,10.0,90.0,150826,,,A")
GGA = with_checksum("$GPGGA,120000.50,6326.33400,N,01023.94000,E,4,12,2.0,1.5,M,39.5,M,,")
HDT = with_checksum("$HEHDT,90.0,T")


@pytest.fixture
def line() -> Iterator[tuple[int, str]]:
    """The near end of a pseudo-terminal, and the name of its far end."""
    near, far = pty.openpty()
    tty.setraw(far)
    yield near, os.ttyname(far)
    os.close(near)
    os.close(far)


def start(ros: Ros, name: str, **params: object) -> None:
    for key, value in params.items():
        ros.set_param(f"/{name}/{key}", value)
    ros.launch([program("nmea_navsat_driver", name)])


def feed(near: int, text: str, messages: list[object], count: int = 1) -> None:
    """Writes to the line until so many messages have come: what came before it was open is lost."""

    def has_come() -> bool:
        os.write(near, text.encode())
        return len(messages) >= count

    eventually(has_come, "messages of the line")


def check_fix(fix: NavSatFix, frame_id: str) -> None:
    assert fix.header.frame_id == frame_id
    assert fix.latitude == pytest.approx(63.4389)
    assert fix.altitude == pytest.approx(41.0)
    assert fix.status.status == 2
    assert fix.position_covariance[0] == pytest.approx((2.0 * 0.02) ** 2)
    assert fix.position_covariance[8] == pytest.approx((2.0 * 2.0 * 2 * 0.02) ** 2)


def test_a_receiver_on_a_serial_line_is_published(ros: Ros, line: tuple[int, str]) -> None:
    start(ros, "nmea_serial_driver", port=line[1], baud=38400, frame_id="antenna")
    with (
        recorder("/fix", NavSatFix) as fixes,
        recorder("/vel", TwistStamped) as velocities,
        recorder("/heading", QuaternionStamped) as headings,
        recorder("/time_reference", TimeReference) as times,
    ):
        feed(line[0], RMC + GGA + HDT, fixes.messages)
        check_fix(fixes.messages[0], "antenna")
        assert velocities.received()[0].twist.linear.x == pytest.approx(5.14444, abs=1e-4)
        assert headings.received()[0].quaternion.z == pytest.approx(math.sin(math.pi / 4))
        assert times.received()[0].source == "antenna"
        assert times.messages[0].time_ref == rospy.Time(1786795200, 500_000_000)


def test_sentences_of_a_topic_keep_their_stamp_and_frame(ros: Ros) -> None:
    start(ros, "nmea_topic_driver")
    publisher = rospy.Publisher("nmea_sentence", Sentence, queue_size=10)
    with recorder("/fix", NavSatFix) as fixes:
        eventually(lambda: publisher.get_num_connections() > 0, "the driver's subscription")
        message = Sentence(sentence=GGA.strip())
        message.header.stamp = rospy.Time(12, 34)
        message.header.frame_id = "roof"
        publisher.publish(message)
        check_fix(fixes.received()[0], "roof")
        assert fixes.messages[0].header.stamp == rospy.Time(12, 34)
    publisher.unregister()


def test_datagrams_are_read_on_the_loopback_interface(ros: Ros) -> None:
    port = free_port()
    start(ros, "nmea_socket_driver", port=port, useRMC=True)
    with recorder("/fix", NavSatFix) as fixes:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:

            def has_come() -> bool:
                client.sendto(RMC.encode(), ("127.0.0.1", port))
                return bool(fixes.messages)

            eventually(has_come, "a fix of RMC")
        assert fixes.messages[0].latitude == pytest.approx(63.0 + 26.3 / 60.0)
    assert "where upstream binds all interfaces" in ros.programs[-1].log


def hostile_bytes(seed: int) -> bytes:
    """Noise, cut and changed sentences; the same for a seed."""
    random = Random(seed)
    blocks = []
    for _ in range(200):
        text = bytearray((RMC + GGA + HDT).encode())
        for _ in range(random.randrange(1, 6)):
            text[random.randrange(len(text))] = random.randrange(256)
        blocks.append(bytes(text[random.randrange(40) :]))
        blocks.append(random.randbytes(random.randrange(60)))
    return b"".join(blocks)


def test_hostile_bytes_on_a_line_leave_the_driver_at_work(ros: Ros, line: tuple[int, str]) -> None:
    start(ros, "nmea_serial_driver", port=line[1], baud=4_000_000)
    with recorder("/heading", QuaternionStamped) as headings:
        feed(line[0], HDT, headings.messages)
        noise = hostile_bytes(1)
        for at in range(0, len(noise), 512):
            os.write(line[0], noise[at : at + 512])
        count = len(headings.messages)
        feed(line[0], HDT, headings.messages, count + 1)
    assert ros.programs[-1].running


def test_hostile_datagrams_leave_the_driver_at_work(ros: Ros) -> None:
    port = free_port()
    start(ros, "nmea_socket_driver", port=port)
    with (
        recorder("/heading", QuaternionStamped) as headings,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client,
    ):
        client.connect(("127.0.0.1", port))

        def is_heard() -> bool:
            with suppress(ConnectionRefusedError):  # it is not up yet
                client.send(HDT.encode())
            return bool(headings.messages)

        eventually(is_heard, "the driver")
        noise = hostile_bytes(2)
        for at in range(0, len(noise), 200):
            client.send(noise[at : at + 200])
        count = len(headings.messages)
        eventually(lambda: is_heard() and len(headings.messages) > count, "the next good one")
    assert ros.programs[-1].running


def test_a_serial_line_becomes_a_topic(ros: Ros, line: tuple[int, str]) -> None:
    start(ros, "nmea_topic_serial_reader", port=line[1], baud=38400)
    with recorder("/nmea_sentence", Sentence) as sentences:
        feed(line[0], GGA + HDT, sentences.messages, 2)
        assert {m.sentence for m in sentences.messages} == {GGA.strip(), HDT.strip()}
        assert sentences.messages[0].header.frame_id == "gps"


def test_gnss_time_stamps_fixes_where_it_is_asked_for(ros: Ros, line: tuple[int, str]) -> None:
    start(ros, "nmea_serial_driver", port=line[1], baud=38400, use_GNSS_time=True)
    with recorder("/fix", NavSatFix) as fixes:
        feed(line[0], RMC + GGA, fixes.messages)
        assert fixes.messages[0].header.stamp == rospy.Time(1786795200, 500_000_000)
