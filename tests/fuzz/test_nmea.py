# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes of NMEA 0183 under hostile messages."""

from __future__ import annotations

import pytest
import rospy
from hostile import Asked, answers_on, started
from nmea_msgs.msg import Sentence
from sensor_msgs.msg import NavSatFix
from trident.testing import Ros, program
from trident_base.ports import free_port


def fix() -> NavSatFix:
    message = NavSatFix(latitude=63.4, longitude=10.4, altitude=40.0)
    message.header.stamp = rospy.Time.now()
    return message


def gga() -> Sentence:
    body = "GPGGA,120000.50,6326.33400,N,01023.94000,E,4,12,1.0,1.5,M,39.5,M,,"
    checksum = 0
    for character in body:
        checksum ^= ord(character)
    message = Sentence(sentence=f"${body}*{checksum:02X}")
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "gps"
    return message


@pytest.mark.fuzzes("trident_bridges/nmea_node")
def test_nmea_node_that_hears_itself(ros: Ros) -> None:
    port = free_port()
    ros.set_param("/boat/links", [{"url": f"udp://127.0.0.1:{port}@127.0.0.1:{port}"}])
    ros.set_param(
        "/boat/rates", {"GGA": 1000.0, "RMC": 1000.0, "HDT": 1000.0, "RTE": 1000.0, "WPL": 1000.0}
    )
    ros.set_param("/boat/topics", {"gnss_status": ""})
    process = started(ros, "/boat", [program("trident_bridges", "nmea_node"), "__name:=boat"])
    answers_on(process, "/boat", Asked("/fix", fix, "/nmea/fix", NavSatFix))


@pytest.mark.fuzzes("nmea_navsat_driver/nmea_topic_driver")
def test_topic_driver(ros: Ros) -> None:
    command = [program("nmea_navsat_driver", "nmea_topic_driver"), "__name:=driver"]
    process = started(ros, "/driver", command)
    answers_on(process, "/driver", Asked("/nmea_sentence", gga, "/fix", NavSatFix))
