# SPDX-FileCopyrightText: 2026 The Trident authors
# SPDX-License-Identifier: Apache-2.0
"""Serves what the tests of services by radio call, as a node of the rover's."""

from __future__ import annotations

import os
import threading

import rospy
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse

from trident_msgs.srv import Step


def arm(request: SetBoolRequest) -> SetBoolResponse:
    """An answer at once."""
    return SetBoolResponse(request.data, "armed" if request.data else "disarmed")


def refuse(request: SetBoolRequest) -> SetBoolResponse:
    """An error with a text."""
    del request
    raise rospy.ServiceException("the arm is folded")


def die(request: SetBoolRequest) -> SetBoolResponse:
    """The end of this process."""
    del request
    os._exit(1)


def hang(request: SetBoolRequest) -> SetBoolResponse:
    """No answer."""
    del request
    threading.Event().wait()
    return SetBoolResponse()


def ask_the_boat(request: SetBoolRequest) -> SetBoolResponse:
    """What the boat's own service answers, by radio."""
    proxy = rospy.ServiceProxy("/rover/to/boat/depth", SetBool)
    return SetBoolResponse(True, "the boat says: " + proxy(request.data).message)


def step(request: SetBoolRequest) -> SetBoolResponse:
    """What the world answers to a node that it waits for."""
    del request
    return SetBoolResponse(True, rospy.ServiceProxy("/gazebo/step", Step)(10).message)


rospy.init_node("rover_services")
for handler in (arm, refuse, die, hang, ask_the_boat, step):
    rospy.Service(f"/rover/{handler.__name__}", SetBool, handler)
rospy.spin()
