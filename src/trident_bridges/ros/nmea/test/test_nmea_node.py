# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""The node nmea_node as a process, with clients on its links."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
import rospy
from boat import LATITUDE_DEG, LONGITUDE_DEG, Boat, Client, start_server, with_checksum
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import QuaternionStamped, TwistStamped
from nmea_msgs.msg import Sentence
from sensor_msgs.msg import NavSatFix, TimeReference
from trident.testing import Ros, eventually, program, recorder

from trident_msgs.msg import RadioPacket

KNOT = 1852.0 / 3600.0


def minutes(field: str, letter: str) -> float:
    """Degrees of ddmm.mmmmm and its letter."""
    degrees, point = divmod(float(field), 100.0)
    return (degrees + point / 60.0) * (-1.0 if letter in "SW" else 1.0)


def test_what_a_boats_instruments_measure_goes_to_all_clients(
    ros: Ros, boat: Boat, client: Callable[[int], Client]
) -> None:
    port = start_server(ros)
    clients = [client(port), client(port)]
    eventually(boat.is_heard, "the node's subscriptions")
    at_s = [100.0]

    def has_come() -> bool:
        at_s[0] += 0.2
        boat.publish(at_s[0])
        kinds = ("GGA", "RMC", "VTG", "GST", "HDT", "XDR", "VHW", "DPT", "MWV", "ZDA", "GSV")
        return all(one.lines(kind) for one in clients for kind in kinds)

    eventually(has_come, "sentences of all instruments")
    for one in clients:
        fields = one.lines("GGA")[-1].split(",")
        assert minutes(fields[2], fields[3]) == pytest.approx(LATITUDE_DEG, abs=1e-7)
        assert minutes(fields[4], fields[5]) == pytest.approx(LONGITUDE_DEG, abs=1e-7)
        assert fields[6] == "4"
        assert float(fields[9]) + float(fields[11]) == pytest.approx(41.0)
        rmc = one.lines("RMC")[-1].split(",")
        assert float(rmc[7]) * KNOT == pytest.approx(2.0, abs=1e-3)
        assert (rmc[8], rmc[9]) == ("90.00", "010126")
        assert one.lines("HDT")[-1].startswith("$HEHDT,90.00,T*")
        assert all(len(line) <= 80 for line in one.read().split("\r\n"))


def test_what_clients_send_is_published(ros: Ros, client: Callable[[int], Client]) -> None:
    port = start_server(ros)
    with (
        recorder("/nmea/fix", NavSatFix) as fixes,
        recorder("/nmea/vel", TwistStamped) as velocities,
        recorder("/nmea/heading", QuaternionStamped) as headings,
        recorder("/nmea/time_reference", TimeReference) as times,
        recorder("/nmea/nmea_sentence", Sentence) as sentences,
    ):
        one = client(port)
        one.send(
            "\xb5\x62noise$"
            + with_checksum("$GPRMC,120000.50,A,6326.3,N,01023.9,E,10.0,0.0,150826,,,A")
        )
        one.send(
            with_checksum("$GNGGA,120000.50,6326.33400,N,01023.94000,E,4,12,1.0,1.5,M,39.5,M,,")
        )
        one.send(with_checksum("$HEHDT,90.0,T"))
        fix = fixes.received()[0]
        assert fix.latitude == pytest.approx(LATITUDE_DEG)
        assert fix.altitude == pytest.approx(41.0)
        assert fix.status.status == 2
        assert math.sqrt(fix.position_covariance[0]) == pytest.approx(0.02)
        assert velocities.received()[0].twist.linear.y == pytest.approx(10.0 * KNOT)
        assert headings.received()[0].quaternion.w == pytest.approx(1.0)  # east: yaw 0
        assert times.received()[0].time_ref == rospy.Time(1786795200, 500_000_000)
        assert len(sentences.received(3)) == 3
        assert sentences.messages[2].sentence == with_checksum("$HEHDT,90.0,T").strip()


def test_sentences_cross_a_simulated_radio(ros: Ros, boat: Boat) -> None:
    ros.set_param("/nmea/links", [{"url": "radio://usv1/gps"}])
    process = ros.launch([program("trident_bridges", "nmea_node"), "__name:=nmea"])
    eventually(lambda: "sends and listens" in process.log, "the node is up")
    with recorder("/usv1/radio/send", RadioPacket) as packets:
        heard = rospy.Publisher("/usv1/radio/receive", RadioPacket, queue_size=10)
        eventually(lambda: boat.is_heard() and heard.get_num_connections() > 0, "subscriptions")
        boat.publish(100.0)
        eventually(lambda: any(b"GPGGA" in packet.data for packet in packets.messages), "a GGA")
        assert {packet.topic for packet in packets.messages} == {"gps"}
        assert all(packet.data.endswith(b"\r\n") for packet in packets.messages)
        with recorder("/nmea/heading", QuaternionStamped) as headings:
            sentence = with_checksum("$HEHDT,90.0,T").encode()
            packet = RadioPacket(source="uav1", destination="usv1", topic="gps", data=sentence)
            heard.publish(packet)
            assert headings.received()[0].quaternion.w == pytest.approx(1.0)
        heard.unregister()


PLACE = "6326.33400,N,01023.94000,E"
# What a peer may do wrong, one of each kind, and how it is named.
BAD = {
    "$HEHDT,90.0,T*00\r\n": "checksum is '00', legal: 16",
    "$HEHDT,91.0,T\r\n": "checksum is '', legal: * and two hexadecimal digits",
    with_checksum("$GPTXT,01,01,02," + 62 * "x"): "length is 83, legal: [0, 82]",
    with_checksum("$HEHDT,90.0,T,1"): "number of fields is 3, legal: [2, 2]",
    with_checksum("$GPGGA,120000,9100.0,N,01023.9,E,4,12,1.0,1.5,M,39.5,M,,"): (
        "latitude is '9100.0', legal: [-90, 90]"
    ),
    with_checksum(f"$GPGGA,,{PLACE},4,12,1.0,1.5,M,39.5,M,,"): "UTC is '', legal: hhmmss.ss",
}


def test_bad_sentences_are_named_with_link_and_peer_and_the_next_fix_is_read(
    ros: Ros, client: Callable[[int], Client]
) -> None:
    port = start_server(ros)
    with (
        recorder("/diagnostics", DiagnosticArray) as diagnostics,
        recorder("/nmea/fix", NavSatFix) as fixes,
        recorder("/nmea/time_reference", TimeReference) as times,
    ):
        one = client(port)
        one.send("".join(BAD))

        def texts() -> str:
            return "\n".join(s.message for array in diagnostics.messages for s in array.status)

        eventually(lambda: all(name in texts() for name in BAD.values()), "the refusals")
        assert f"127.0.0.1:{port}" in texts()
        assert not fixes.messages
        # No sentence has said the date: it is that of the clock.
        one.send(with_checksum(f"$GPGGA,120000.50,{PLACE},4,12,1.0,1.5,M,39.5,M,,"))
        assert fixes.received()[0].latitude == pytest.approx(LATITUDE_DEG)
        assert times.received()[0].time_ref.to_sec() % 86400.0 == pytest.approx(43200.5)


def test_a_fix_that_is_not_finite_is_not_sent(
    ros: Ros, boat: Boat, client: Callable[[int], Client]
) -> None:
    port = start_server(ros)
    one = client(port)
    eventually(boat.is_heard, "the node's subscriptions")
    with recorder("/diagnostics", DiagnosticArray) as diagnostics:
        boat.publish(1.0, latitude_deg=math.nan)

        def is_named() -> bool:
            return any(
                "fix refused: latitude is nan" in status.message
                for array in diagnostics.messages
                for status in array.status
            )

        eventually(is_named, "the refusal")
    boat.publish(2.0)
    eventually(lambda: bool(one.lines("GGA")), "the next good one")
    assert "nan" not in one.read()


def test_a_wrong_parameter_ends_the_node_with_its_name(ros: Ros) -> None:
    ros.set_param("/nmea/rates", {"GGS": 1.0})
    process = ros.launch([program("trident_bridges", "nmea_node"), "__name:=nmea"])
    assert process.wait() == 1
    assert "unknown sentence 'GGS'; did you mean 'GGA'?" in process.log
